// How tier `fast` differs from `reference` in one world: renders both at given poses and prints, by region,
// the ratio of mean luminance of the displayed pictures in linear light (solid-angle weighted), and WS-PSNR.
// Usage: tier_difference [--world NAME] [--width W] [--samples N] [--pose x,y,z,yaw_deg]...
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

#include "airsim360/image/color.h"
#include "airsim360/projection/camera.h"
#include "airsim360/render/renderer.h"
#include "airsim360/sim/world_loader.h"

namespace {

using namespace airsim360;

struct Pose {
  double x = 0, y = 0, z = 0, yaw_deg = 0;
};

const char* Argument(int argc, char** argv, const char* name, const char* value) {
  for (int i = 1; i + 1 < argc; ++i) {
    if (std::strcmp(argv[i], name) == 0) value = argv[i + 1];
  }
  return value;
}

std::vector<Pose> Poses(int argc, char** argv, const Scene& scene) {
  std::vector<Pose> poses;
  for (int i = 1; i + 1 < argc; ++i) {
    Pose p;
    if (std::strcmp(argv[i], "--pose") == 0 &&
        std::sscanf(argv[i + 1], "%lf,%lf,%lf,%lf", &p.x, &p.y, &p.z, &p.yaw_deg) >= 3)
      poses.push_back(p);
  }
  const Vec3f spawn = scene.spawn.value_or(scene.bounds.center());
  if (poses.empty()) poses = {{spawn.x, spawn.y, spawn.z, 0}, {spawn.x, spawn.y, spawn.z + 12.0, 90}};
  return poses;
}

// Linear light of a displayed colour.
double Luminance(Rgb8 c) {
  return 0.2126 * SrgbToLinear(c.r) + 0.7152 * SrgbToLinear(c.g) + 0.0722 * SrgbToLinear(c.b);
}

enum Region { kSky, kSunlit, kShade, kLeaves, kGlass, kAll, kRegions };
constexpr const char* kRegionNames[] = {"sky", "sunlit", "shade", "leaves", "glass", "all"};

// Sums over the pixels of a region, weighted by solid angle.
struct Sums {
  double weight = 0, fast = 0, reference = 0, squares = 0;
};

Region RegionOf(const RayTracer& tracer, Vec3f origin, Vec3f direction, Vec3f to_sun) {
  const auto hit = tracer.Intersect(origin, direction);
  if (!hit) return kSky;
  const Scene& scene = tracer.scene();
  const Mesh& mesh = scene.meshes[scene.instances[hit->surface.instance].mesh];
  for (const MeshPart& part : mesh.parts) {
    if (hit->surface.triangle < part.first_triangle ||
        hit->surface.triangle >= part.first_triangle + part.triangle_count)
      continue;
    const SurfaceKind kind = scene.materials[part.material].kind;
    if (kind == SurfaceKind::kFoliage) return kLeaves;
    if (kind == SurfaceKind::kGlass) return kGlass;
  }
  const Vec3f p = origin + direction * hit->distance + hit->normal * 0.02f;
  const bool lit = Dot(hit->normal, to_sun) > 0 && !tracer.Intersect(p, to_sun);
  return lit ? kSunlit : kShade;
}

}  // namespace

int main(int argc, char** argv) {
  const int width = std::max(64, std::atoi(Argument(argc, argv, "--width", "512"))) / 2 * 2;
  const int samples = std::max(1, std::atoi(Argument(argc, argv, "--samples", "64")));
  const auto scene = LoadWorld({.world = Argument(argc, argv, "--world", "downtown_west")});
  const auto tracer = std::make_shared<const RayTracer>(scene);
  const auto renderer = MakeCpuRenderer(tracer, {.tier = Tier::kFast});
  const double azimuth = scene->environment.sun_azimuth_deg * M_PI / 180,
               elevation = scene->environment.sun_elevation_deg * M_PI / 180;
  const Vec3f to_sun{static_cast<float>(std::sin(azimuth) * std::cos(elevation)),
                     static_cast<float>(std::cos(azimuth) * std::cos(elevation)),
                     static_cast<float>(std::sin(elevation))};

  std::array<Sums, kRegions> sums;
  for (const Pose& pose : Poses(argc, argv, *scene)) {
    const Equirectangular camera{width, width / 2};
    RenderRequest request{
        .camera = camera,
        .X_WC = BodyPose({pose.x, pose.y, pose.z}, pose.yaw_deg * M_PI / 180, 0, 0) * CameraInBody(),
        .samples = samples};
    Frame fast, reference;
    renderer->Render(request, fast);
    request.tier = Tier::kReference;
    const RenderStats stats = renderer->Render(request, reference);
    std::printf("pose %.1f %.1f %.1f %.0f: reference %.1f s\n", pose.x, pose.y, pose.z, pose.yaw_deg,
                stats.render_ms / 1000);
    for (int y = 0; y < width / 2; ++y) {
      const double weight = std::cos((0.5 - (y + 0.5) / (width / 2)) * M_PI);
      for (int x = 0; x < width; ++x) {
        const Vec3f d = VecCast<float>(request.X_WC.R * *PixelToRay(camera, {x + 0.5, y + 0.5}));
        const Region region = RegionOf(*tracer, VecCast<float>(request.X_WC.p), d, to_sun);
        const Rgb8 a = fast.rgb(x, y), b = reference.rgb(x, y);
        const double squares = (std::pow(a.r - b.r, 2) + std::pow(a.g - b.g, 2) + std::pow(a.b - b.b, 2)) / 3;
        for (Region r : {region, kAll}) {
          sums[r].weight += weight;
          sums[r].fast += weight * Luminance(a);
          sums[r].reference += weight * Luminance(b);
          sums[r].squares += weight * squares;
        }
      }
    }
  }
  std::printf("%-8s %8s %10s %10s %14s %10s\n", "region", "share", "fast", "reference", "fast/reference",
              "WS-PSNR dB");
  for (int r = 0; r < kRegions; ++r) {
    const Sums& s = sums[r];
    if (s.weight == 0) continue;
    std::printf("%-8s %7.1f%% %10.4f %10.4f %14.3f %10.2f\n", kRegionNames[r],
                100 * s.weight / sums[kAll].weight, s.fast / s.weight, s.reference / s.weight,
                s.fast / s.reference, 10 * std::log10(255 * 255 / std::max(s.squares / s.weight, 1e-9)));
  }
}
