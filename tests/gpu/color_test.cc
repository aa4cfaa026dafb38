// Colours of tier `fast` are the CPU's.
#include <gtest/gtest.h>

#include <cstdlib>
#include <sstream>

#include "airsim360/base/error.h"
#include "airsim360/worlds/worlds.h"
#include "gpu_fixture.h"

namespace airsim360 {
namespace {

struct Pair {
  std::shared_ptr<const RayTracer> tracer;
  std::unique_ptr<Renderer> cpu;
  std::unique_ptr<GpuRenderer> gpu;

  Pair(std::shared_ptr<const Scene> scene, const Environment& environment)
      : tracer(std::make_shared<const RayTracer>(std::move(scene), RayTracerOptions{.isa = "avx2"})),
        cpu(MakeCpuRenderer(tracer, {.tier = Tier::kFast, .environment = environment})),
        gpu(MakeVulkanRenderer(tracer, {.tier = Tier::kFast, .environment = environment}, {.validate = true})) {}
};

struct ColorDifference {
  double mean = 0;    // absolute, of 255
  double off = 0;     // share of pixels with a channel more than 3 codes off
  double off_inside = 0;  // likewise, away from edges
};

ColorDifference Difference(const Frame& cpu, const Frame& gpu) {
  ColorDifference d;
  int inside = 0;
  for (int y = 0; y < cpu.rgb.height(); ++y) {
    for (int x = 0; x < cpu.rgb.width(); ++x) {
      const Rgb8 a = cpu.rgb(x, y), b = gpu.rgb(x, y);
      const int r = std::abs(a.r - b.r), g = std::abs(a.g - b.g), l = std::abs(a.b - b.b);
      d.mean += (r + g + l) / 3.0;
      const bool off = std::max({r, g, l}) > 3;
      d.off += off;
      if (test::NearEdge(cpu, x, y, true)) continue;
      ++inside;
      d.off_inside += off;
    }
  }
  d.mean /= static_cast<double>(cpu.rgb.size());
  d.off /= static_cast<double>(cpu.rgb.size());
  d.off_inside /= std::max(1, inside);
  return d;
}

RenderRequest ColorRequest(const Scene& scene, int width) {
  RenderRequest request;
  request.camera = Equirectangular{width, width / 2};
  const Vec3f spawn = scene.spawn.value_or(Vec3f{0, 0, 2});
  request.X_WC = BodyPose(VecCast<double>(spawn) + Vec3d{0.1, 0.2, 0.3}, 0.4, -0.1, 0.05) * CameraInBody();
  request.products = {.normal = true, .albedo = true, .radiance = true};
  return request;
}

// Without clouds, which take longer to bake than all else here.
Environment ClearSky(double sun_elevation_deg) {
  Environment environment;
  environment.cloud_cover = environment.cirrus_cover = 0;
  environment.sun_elevation_deg = sun_elevation_deg;
  return environment;
}

void ExpectTheCpus(const std::shared_ptr<const Scene>& scene, const Environment& environment, const std::string& what) {
  Pair pair(scene, environment);
  RenderRequest request = ColorRequest(*scene, 128);
  for (const int samples : {1, 4}) {
    request.aa_samples = samples;
    Frame cpu, gpu;
    pair.cpu->Render(request, cpu);
    pair.gpu->Render(request, gpu);
    const ColorDifference d = Difference(cpu, gpu);
    std::printf("%s, %d samples: mean %.3f of 255, %.2f %% of pixels off by more than 3, %.2f %% away from edges\n",
                what.c_str(), samples, d.mean, 100 * d.off, 100 * d.off_inside);
    EXPECT_LE(d.mean, 0.25);
    EXPECT_LE(d.off, 0.01);
    EXPECT_LE(d.off_inside, 0.002);
    EXPECT_FLOAT_EQ(cpu.exposure, gpu.exposure);
    double albedo = 0;
    for (size_t i = 0; i < cpu.albedo.size(); ++i)
      albedo += std::fabs(cpu.albedo.pixels()[i].g - gpu.albedo.pixels()[i].g);
    EXPECT_LE(albedo / static_cast<double>(cpu.albedo.size()), 1e-3);
  }
  for (const std::string& message : pair.gpu->messages()) ADD_FAILURE() << message;
}

TEST(GpuColor, OfARoomByDayIsTheCpus) {
  AIRSIM360_NEEDS_GPU();
  ExpectTheCpus(BuildWorld("sunlit_room", {.seed = 1}), ClearSky(40), "sunlit_room by day");
}

TEST(GpuColor, OfARoomByNightIsTheCpus) {
  AIRSIM360_NEEDS_GPU();
  ExpectTheCpus(BuildWorld("sunlit_room", {.seed = 1}), ClearSky(-12), "sunlit_room by night");
}

TEST(GpuColor, OfWorldsAskedForIsTheCpus) {
  AIRSIM360_NEEDS_GPU();
  std::istringstream worlds(std::getenv("AIRSIM360_GPU_WORLDS") ? std::getenv("AIRSIM360_GPU_WORLDS") : "");
  std::string world;
  if (!(worlds >> world)) GTEST_SKIP() << "AIRSIM360_GPU_WORLDS names no world";
  do {
    ExpectTheCpus(BuildWorld(world, {.seed = 1}), {}, world);
  } while (worlds >> world);
}

TEST(GpuColor, ManyCamerasAndEveryCurveAreWhatEachIsAlone) {
  AIRSIM360_NEEDS_GPU();
  const auto scene = BuildWorld("sunlit_room", {.seed = 1});
  Pair pair(scene, ClearSky(40));
  for (const ToneCurve tone : {ToneCurve::kAgx, ToneCurve::kLinear}) {
    std::vector<RenderRequest> requests(3, ColorRequest(*scene, 32));
    for (size_t i = 0; i < requests.size(); ++i) {
      requests[i].tone = tone;
      requests[i].exposure_ev = static_cast<double>(i);
      requests[i].products = {};
    }
    const uint64_t ticket = pair.gpu->Submit(requests);
    const auto frames = pair.gpu->Wait(ticket);
    for (size_t i = 0; i < requests.size(); ++i) {
      Frame alone;
      pair.gpu->Render(requests[i], alone);
      EXPECT_TRUE(std::ranges::equal(alone.rgb.pixels(), frames[i].rgb)) << i;
    }
    pair.gpu->Release(ticket);
  }
}

TEST(GpuColor, WhatItCannotDrawIsNamed) {
  AIRSIM360_NEEDS_GPU();
  EXPECT_EQ(GpuCannot(Tier::kFast, {}), "");
  EXPECT_NE(GpuCannot(Tier::kHigh, {}).find("high"), std::string::npos);
  Environment wet;
  wet.wetness = 1;
  EXPECT_NE(GpuCannot(Tier::kFast, wet), "");
  EXPECT_EQ(GpuCannot(Tier::kLabels, wet), "");
}

}  // namespace
}  // namespace airsim360
