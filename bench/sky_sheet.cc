// Skies by lot (`environments sample`) over open ground as a camera takes them (`--look photo`, tier `fast`), on one sheet: of each
// panorama what lies above the horizon and a little below it.
// Usage: sky_sheet [--count N] [--seed S] [--columns N] [--width W] [--out FILE.png]
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>

#include "airsim360/base/file.h"
#include "airsim360/image/codecs.h"
#include "airsim360/render/relightable.h"
#include "airsim360/scene/environment_sampler.h"
#include "airsim360/sensors/rig.h"
#include "arguments.h"

namespace {

using namespace airsim360;

// Nothing but a sky; what lies below the horizon is its far ground.
std::shared_ptr<const Scene> OpenGround() {
  SceneBuilder builder("open ground");
  builder.AddSky();
  return builder.Build();
}

}  // namespace

int main(int argc, char** argv) {
  const int count = std::max(1, std::atoi(Argument(argc, argv, "--count", "24"))),
            columns = std::max(1, std::atoi(Argument(argc, argv, "--columns", "3"))),
            width = std::max(64, std::atoi(Argument(argc, argv, "--width", "400"))) / 2 * 2;
  const uint64_t seed = std::strtoull(Argument(argc, argv, "--seed", "1"), nullptr, 10);
  const int shown = width * 11 / 40, gap = width / 100, rows = (count + columns - 1) / columns;

  const auto tracer = std::make_shared<const RayTracer>(OpenGround());
  PanoramicRig rig;
  rig.camera = Equirectangular{width, width / 2};
  rig.tier = Tier::kFast, rig.look = Look::kPhoto;
  Image<Rgb8> sheet(columns * (width + gap) - gap, rows * (shown + gap) - gap);
  for (Rgb8& pixel : sheet.pixels()) pixel = {255, 255, 255};
  Capture capture;
  for (int i = 0; i < count; ++i) {
    const Environment environment = SampleEnvironment(seed + static_cast<uint64_t>(i));
    const auto renderer = MakeCpuRenderer(tracer, {.tier = Tier::kFast, .environment = environment});
    CaptureRig(rig, {RigidTransform{{}, {0, 0, 2}}, {}, {}}, 0, *renderer, capture);
    const int left = i % columns * (width + gap), top = i / columns * (shown + gap);
    for (int y = 0; y < shown; ++y)
      for (int x = 0; x < width; ++x) sheet(left + x, top + y) = capture.frame.rgb(x, y);
    std::printf("%d: sun %.0f deg, low clouds %.2f\n", i, environment.sun_elevation_deg, environment.cloud_cover);
    std::fflush(stdout);
  }
  WriteFileAtomically(Argument(argc, argv, "--out", "sky_sheet.png"), EncodePng(sheet));
  return 0;
}
