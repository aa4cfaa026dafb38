// How tiers `fast` and `high` differ from `reference` in one world: renders all at given poses and prints, by
// region, the ratio of mean luminance of the displayed pictures in linear light, WS-PSNR and mean FLIP, all
// weighted by solid angle, and the same for a reference of half the paths and another seed (its noise).
// Usage: tier_difference [--world NAME] [--width W] [--samples N] [--pose x,y,z[,yaw_deg]]... [--out DIR]
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

#include "airsim360/base/file.h"
#include "airsim360/eval/image_metrics.h"
#include "airsim360/image/codecs.h"
#include "airsim360/image/color.h"
#include "airsim360/opening/world_loader.h"
#include "airsim360/projection/camera.h"
#include "airsim360/render/renderer.h"
#include "airsim360/scene/viewpoint.h"
#include "arguments.h"

namespace {

using namespace airsim360;

struct Pose {
  double x = 0, y = 0, z = 0, yaw_deg = 0;
};

std::vector<Pose> Poses(int argc, char** argv, const Scene& scene) {
  std::vector<Pose> poses;
  for (int i = 1; i < argc; ++i) {
    Pose p;
    const char* value = nullptr;
    if (std::strncmp(argv[i], "--pose=", 7) == 0) value = argv[i] + 7;
    if (std::strcmp(argv[i], "--pose") == 0) value = i + 1 < argc ? argv[i + 1] : "";
    if (value == nullptr) continue;
    if (std::sscanf(value, "%lf,%lf,%lf,%lf", &p.x, &p.y, &p.z, &p.yaw_deg) < 3) {
      std::fprintf(stderr, "not x,y,z[,yaw_deg]: --pose %s\n", value);
      std::exit(2);
    }
    poses.push_back(p);
  }
  const Vec3f spawn = FirstViewpoint(scene);
  if (poses.empty()) poses = {{spawn.x, spawn.y, spawn.z, 0}, {spawn.x, spawn.y, spawn.z + 12.0, 90}};
  return poses;
}

// Linear light of a displayed colour.
double Luminance(Rgb8 c) { return 0.2126 * SrgbToLinear(c.r) + 0.7152 * SrgbToLinear(c.g) + 0.0722 * SrgbToLinear(c.b); }

enum Region { kSky, kSunlit, kShade, kLeaves, kGlass, kAll, kRegions };
constexpr const char* kRegionNames[] = {"sky", "sunlit", "shade", "leaves", "glass", "all"};

// Sums over the pixels of a region, weighted by solid angle.
struct Sums {
  double weight = 0, shown = 0, reference = 0, squares = 0, flip = 0;
};
using Table = std::array<Sums, kRegions>;

Region RegionOf(const RayTracer& tracer, Vec3f origin, Vec3f direction, Vec3f to_sun) {
  const auto hit = tracer.Intersect(origin, direction);
  if (!hit) return kSky;
  const Scene& scene = tracer.scene();
  const Mesh& mesh = scene.meshes[scene.instances[hit->surface.instance].mesh];
  for (const MeshPart& part : mesh.parts) {
    if (hit->surface.triangle < part.first_triangle || hit->surface.triangle >= part.first_triangle + part.triangle_count) continue;
    const SurfaceKind kind = scene.materials[part.material].kind;
    if (kind == SurfaceKind::kFoliage) return kLeaves;
    if (kind == SurfaceKind::kGlass) return kGlass;
  }
  const Vec3f p = origin + direction * hit->distance + hit->normal * 0.02f;
  const bool lit = Dot(hit->normal, to_sun) > 0 && !tracer.Intersect(p, to_sun);
  return lit ? kSunlit : kShade;
}

void Compare(const Image<Rgb8>& shown, const Image<Rgb8>& reference, const Image<Region>& regions, Table& sums) {
  const Image<float> flip = Flip(reference, shown, {.wrap_columns = true});
  for (int y = 0; y < shown.height(); ++y) {
    const double weight = std::cos((0.5 - (y + 0.5) / shown.height()) * M_PI);
    for (int x = 0; x < shown.width(); ++x) {
      const Rgb8 a = shown(x, y), b = reference(x, y);
      const double squares = (std::pow(a.r - b.r, 2) + std::pow(a.g - b.g, 2) + std::pow(a.b - b.b, 2)) / 3;
      for (Region r : {regions(x, y), kAll}) {
        sums[r].weight += weight;
        sums[r].shown += weight * Luminance(a);
        sums[r].reference += weight * Luminance(b);
        sums[r].squares += weight * squares;
        sums[r].flip += weight * static_cast<double>(flip(x, y));
      }
    }
  }
}

void Print(const char* name, const Table& sums) {
  std::printf("%s\n%-8s %8s %10s %10s %10s %11s %8s\n", name, "region", "share", "shown", "reference", "ratio", "WS-PSNR dB", "FLIP");
  for (int r = 0; r < kRegions; ++r) {
    const Sums& s = sums[r];
    if (s.weight == 0) continue;
    std::printf("%-8s %7.1f%% %10.4f %10.4f %10.3f %11.2f %8.3f\n", kRegionNames[r], 100 * s.weight / sums[kAll].weight, s.shown / s.weight,
                s.reference / s.weight, s.shown / s.reference, 10 * std::log10(255 * 255 / std::max(s.squares / s.weight, 1e-9)),
                s.flip / s.weight);
  }
}

}  // namespace

int main(int argc, char** argv) {
  const int width = std::max(64, std::atoi(Argument(argc, argv, "--width", "512"))) / 2 * 2;
  const int samples = std::max(1, std::atoi(Argument(argc, argv, "--samples", "64")));
  const auto scene = LoadWorld({.world = Argument(argc, argv, "--world", "downtown_west")});
  const auto tracer = std::make_shared<const RayTracer>(scene);
  const auto renderer = MakeCpuRenderer(tracer, {.tier = Tier::kHigh});
  const double azimuth = scene->environment.sun_azimuth_deg * M_PI / 180, elevation = scene->environment.sun_elevation_deg * M_PI / 180;
  const Vec3f to_sun{static_cast<float>(std::sin(azimuth) * std::cos(elevation)),
                     static_cast<float>(std::cos(azimuth) * std::cos(elevation)), static_cast<float>(std::sin(elevation))};

  const std::string out = Argument(argc, argv, "--out", "");
  if (!out.empty()) CreateWritableFolder(out);
  Table fast_sums, high_sums, noise_sums;
  int count = 0;
  for (const Pose& pose : Poses(argc, argv, *scene)) {
    const Equirectangular camera{width, width / 2};
    RenderRequest request;
    request.camera = camera;
    request.X_WC = BodyPose({pose.x, pose.y, pose.z}, pose.yaw_deg * M_PI / 180, 0, 0) * CameraInBody();
    Image<Region> regions(width, width / 2);
    for (int y = 0; y < width / 2; ++y) {
      for (int x = 0; x < width; ++x) {
        const Vec3f d = VecCast<float>(request.X_WC.R * *PixelToRay(camera, {x + 0.5, y + 0.5}));
        regions(x, y) = RegionOf(*tracer, VecCast<float>(request.X_WC.p), d, to_sun);
      }
    }
    Frame fast, high, reference, half;
    renderer->Render(request, fast);
    request.tier = Tier::kHigh;
    renderer->Render(request, high);
    request.tier = Tier::kReference, request.samples = samples;
    const RenderStats stats = renderer->Render(request, reference);
    request.samples = std::max(1, samples / 2), request.seed = 1;
    renderer->Render(request, half);
    std::printf("pose %.1f %.1f %.1f %.0f: reference %.1f s\n", pose.x, pose.y, pose.z, pose.yaw_deg, stats.render_ms / 1000);
    Compare(fast.rgb, reference.rgb, regions, fast_sums);
    Compare(high.rgb, reference.rgb, regions, high_sums);
    Compare(half.rgb, reference.rgb, regions, noise_sums);
    const std::string stem = out + "/" + std::to_string(count++) + "_";
    if (out.empty()) continue;
    WriteFileAtomically(stem + "fast.png", EncodePng(fast.rgb));
    WriteFileAtomically(stem + "high.png", EncodePng(high.rgb));
    WriteFileAtomically(stem + "reference.png", EncodePng(reference.rgb));
  }
  Print("fast", fast_sums);
  Print("high", high_sums);
  Print("reference of half the paths and another seed: noise", noise_sums);
  return 0;
}
