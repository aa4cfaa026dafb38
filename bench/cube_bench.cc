// What other simulators do with our own tracer: six 90 degree faces, then a correct look-up into the
// panorama, against tracing the panorama itself. Colour (tier fast, no antialiasing), range and entity ids,
// rendered and remapped on all threads from tables made beforehand.
// Usage: cube_bench [--width W] [--rounds N] [--out DIR]
// Prints medians of alternating rounds for faces of W / pi pixels (the panorama's resolution at the equator)
// and of W / 4 (the width many tools take). --out writes the faces and the panorama as PNG, a folder a size,
// for nona_bench.py and other stitchers to time.
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "airsim360/base/file.h"
#include "airsim360/base/parallel.h"
#include "airsim360/image/codecs.h"
#include "airsim360/opening/world_loader.h"
#include "airsim360/render/renderer.h"
#include "arguments.h"
#include "median.h"

namespace {

using namespace airsim360;

constexpr std::array<CubeFaceName, 6> kFaces = {CubeFaceName::kPosX, CubeFaceName::kNegX, CubeFaceName::kPosY,
                                                CubeFaceName::kNegY, CubeFaceName::kPosZ, CubeFaceName::kNegZ};

/// Where a panorama pixel looks: a face and a position between four of its pixel centres.
struct LookUp {
  uint8_t face;
  uint16_t x, y;  // upper left of the four
  float u, v;     // share of the right and of the lower ones
  uint32_t nearest;
};

std::vector<LookUp> MakeTable(const Equirectangular& target, int size) {
  std::vector<LookUp> table(static_cast<size_t>(target.width) * target.height);
  ParallelFor(target.height, [&](int64_t row) {
    for (int column = 0; column < target.width; ++column) {
      const Vec3d ray = *PixelToRay(target, {column + 0.5, static_cast<double>(row) + 0.5});
      LookUp& out = table[static_cast<size_t>(row) * target.width + column];
      for (size_t f = 0; f < 6; ++f) {
        const auto at = RayToPixel(CubeFace{kFaces[f], size}, ray);
        if (!at) continue;
        const double x = std::clamp(at->x - 0.5, 0.0, size - 1.001), y = std::clamp(at->y - 0.5, 0.0, size - 1.001);
        const auto x0 = static_cast<int>(x), y0 = static_cast<int>(y);
        const int nx = std::clamp(static_cast<int>(at->x), 0, size - 1), ny = std::clamp(static_cast<int>(at->y), 0, size - 1);
        out = {static_cast<uint8_t>(f),    static_cast<uint16_t>(x0),  static_cast<uint16_t>(y0),
               static_cast<float>(x - x0), static_cast<float>(y - y0), static_cast<uint32_t>(ny * size + nx)};
        break;
      }
    }
  });
  return table;
}

uint8_t Mix(uint8_t a, uint8_t b, uint8_t c, uint8_t d, float u, float v) {
  const float top = a + (static_cast<float>(b) - a) * u, bottom = c + (static_cast<float>(d) - c) * u;
  return static_cast<uint8_t>(top + (bottom - top) * v + 0.5f);
}

/// Linear for colour, nearest for labels.
void Remap(const std::vector<LookUp>& table, const std::array<Frame, 6>& faces, Frame& out) {
  ParallelFor(out.rgb.height(), [&](int64_t row) {
    const size_t first = static_cast<size_t>(row) * out.rgb.width();
    for (size_t i = first; i < first + out.rgb.width(); ++i) {
      const LookUp& at = table[i];
      const Frame& face = faces[at.face];
      const Rgb8 *top = &face.rgb(at.x, at.y), *bottom = &face.rgb(at.x, at.y + 1);
      out.rgb.pixels()[i] = {Mix(top[0].r, top[1].r, bottom[0].r, bottom[1].r, at.u, at.v),
                             Mix(top[0].g, top[1].g, bottom[0].g, bottom[1].g, at.u, at.v),
                             Mix(top[0].b, top[1].b, bottom[0].b, bottom[1].b, at.u, at.v)};
      out.range.pixels()[i] = face.range.pixels()[at.nearest];
      out.entity.pixels()[i] = face.entity.pixels()[at.nearest];
    }
  });
}

double Milliseconds(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

int main(int argc, char** argv) {
  const int width = std::max(64, std::atoi(Argument(argc, argv, "--width", "2048"))) / 2 * 2;
  const int rounds = std::max(1, std::atoi(Argument(argc, argv, "--rounds", "7")));
  const std::string out = Argument(argc, argv, "--out", "");
  const auto scene = LoadWorld({.world = "downtown_west"});
  const auto tracer = std::make_shared<const RayTracer>(scene);
  const auto renderer = MakeCpuRenderer(tracer, {.tier = Tier::kFast});
  const Equirectangular panorama{width, width / 2};
  const RigidTransform X_WC = BodyPose(VecCast<double>(scene->spawn.value_or(Vec3f{})), 0.7, 0, 0) * CameraInBody();
  const auto render = [&](const Camera& camera, Frame& frame) {
    RenderRequest request = MakeRequest(camera, X_WC, Tier::kFast, {.semantic = false});
    request.edge_samples = 1;
    renderer->Render(request, frame);
  };

  std::printf("downtown_west, %dx%d, colour + range + entity, %d threads, medians of %d alternating rounds\n", width, width / 2,
              ThreadCount(), rounds);
  Frame direct, stitched;
  std::array<Frame, 6> faces;
  render(panorama, direct);
  for (int size : {static_cast<int>(std::lround(width / M_PI)), width / 4}) {
    const std::vector<LookUp> table = MakeTable(panorama, size);
    stitched = direct;
    std::vector<double> whole, six, remap;
    for (int round = -1; round < rounds; ++round) {
      const double a = Milliseconds([&] { render(panorama, direct); });
      const double b = Milliseconds([&] {
        for (size_t f = 0; f < 6; ++f) render(CubeFace{kFaces[f], size}, faces[f]);
      });
      const double c = Milliseconds([&] { Remap(table, faces, stitched); });
      if (round < 0) continue;  // warm
      whole.push_back(a), six.push_back(b), remap.push_back(c);
    }
    size_t wrong = 0;
    for (size_t i = 0; i < direct.entity.size(); ++i) wrong += direct.entity.pixels()[i] != stitched.entity.pixels()[i];
    const double d = Median(whole), s = Median(six), r = Median(remap);
    std::printf(
        "faces %4d: direct %.1f ms, six faces %.1f ms + remap %.1f ms, ratio %.2f; ids differ in %.2f %% of "
        "pixels\n",
        size, d, s, r, (s + r) / d, 100.0 * static_cast<double>(wrong) / static_cast<double>(direct.entity.size()));
    if (out.empty()) continue;
    const std::string folder = out + "/" + std::to_string(size);
    CreateWritableFolder(folder);
    for (size_t f = 0; f < 6; ++f)
      WriteFileAtomically(folder + "/" + kCubeFaceNames[static_cast<int>(kFaces[f])] + ".png", EncodePng(faces[f].rgb));
    WriteFileAtomically(folder + "/direct.png", EncodePng(direct.rgb));
  }
  return 0;
}
