// Two renderers of one scene, and how their colours are compared.
#pragma once

#include <algorithm>
#include <cstdlib>
#include <memory>

#include "airsim360/render/cpu/cpu_renderer.h"
#include "gpu_fixture.h"

namespace airsim360::test {

/// A scene before both renderers, the GPU's under the validation layers.
struct Pair {
  std::shared_ptr<const RayTracer> tracer;
  std::unique_ptr<Renderer> cpu;
  std::unique_ptr<GpuRenderer> gpu;

  Pair(std::shared_ptr<const Scene> scene, const Environment& environment, Tier tier)
      : tracer(std::make_shared<const RayTracer>(std::move(scene), RayTracerOptions{.isa = "avx2"})),
        cpu(MakeCpuRendererWithoutRooms(tracer, {.tier = tier, .environment = environment})),
        gpu(MakeVulkanRenderer(tracer, {.tier = tier, .environment = environment}, {.validate = test::ValidationInstalled()})) {}
};

struct ColorDifference {
  double mean = 0;        // absolute, of 255
  double off = 0;         // share of pixels with a channel more than 3 codes off
  double off_inside = 0;  // likewise, away from edges
};

inline ColorDifference Difference(const Frame& cpu, const Frame& gpu) {
  ColorDifference d;
  int inside = 0;
  for (int y = 0; y < cpu.rgb.height(); ++y) {
    for (int x = 0; x < cpu.rgb.width(); ++x) {
      const Rgb8 a = cpu.rgb(x, y), b = gpu.rgb(x, y);
      const int r = std::abs(a.r - b.r), g = std::abs(a.g - b.g), l = std::abs(a.b - b.b);
      d.mean += (r + g + l) / 3.0;
      const bool off = std::max({r, g, l}) > 3;
      d.off += off;
      if (NearEdge(cpu, x, y, true)) continue;
      ++inside;
      d.off_inside += off;
    }
  }
  d.mean /= static_cast<double>(cpu.rgb.size());
  d.off /= static_cast<double>(cpu.rgb.size());
  d.off_inside /= std::max(1, inside);
  return d;
}

inline RenderRequest ColorRequest(const Scene& scene, int width) {
  RenderRequest request;
  request.camera = Equirectangular{width, width / 2};
  const Vec3f spawn = scene.spawn.value_or(Vec3f{0, 0, 2});
  request.X_WC = BodyPose(VecCast<double>(spawn) + Vec3d{0.1, 0.2, 0.3}, 0.4, -0.1, 0.05) * CameraInBody();
  request.products = {.normal = true, .albedo = true, .radiance = true};
  return request;
}

/// Without clouds, which take longer to bake than all else here.
inline Environment ClearSky(double sun_elevation_deg) {
  Environment environment;
  environment.cloud_cover = environment.cirrus_cover = 0;
  environment.sun_elevation_deg = sun_elevation_deg;
  return environment;
}

/// A suite whose tests look at sunlit_room by day: its renderers are made once for all of them, since their sky and pipelines
/// take longer than the pictures.
class RoomByDaySuite : public testing::Test {
 protected:
  static Pair& Room(Tier tier) {
    if (!kept_) kept_ = std::make_unique<Pair>(BuildWorld("sunlit_room", {.seed = 1}), ClearSky(40), tier);
    return *kept_;
  }
  void TearDown() override {
    if (!kept_) return;
    for (const std::string& message : kept_->gpu->messages()) ADD_FAILURE() << message;
  }
  static void TearDownTestSuite() { kept_ = nullptr; }

 private:
  inline static std::unique_ptr<Pair> kept_;
};

}  // namespace airsim360::test
