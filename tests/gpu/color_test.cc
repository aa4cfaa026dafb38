// Colours of tier `fast` are the CPU's.
#include <gtest/gtest.h>

#include "airsim360/base/error.h"
#include "airsim360/worlds/worlds.h"
#include "gpu_fixture.h"

namespace airsim360 {
namespace {

struct Pair {
  std::shared_ptr<const RayTracer> tracer;
  std::unique_ptr<Renderer> cpu;
  std::unique_ptr<GpuRenderer> gpu;

  explicit Pair(std::shared_ptr<const Scene> scene, bool validate = false)
      : tracer(std::make_shared<const RayTracer>(std::move(scene), RayTracerOptions{.isa = "avx2"})),
        cpu(MakeCpuRenderer(tracer, {.tier = Tier::kFast})),
        gpu(MakeVulkanRenderer(tracer, {.tier = Tier::kFast}, {.validate = validate})) {}
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

class GpuColorOf : public testing::TestWithParam<const char*> {};

TEST_P(GpuColorOf, IsTheCpus) {
  AIRSIM360_NEEDS_GPU();
  const auto scene = BuildWorld(GetParam(), {.seed = 1});
  Pair pair(scene, std::string(GetParam()) == "sunlit_room");
  RenderRequest request = ColorRequest(*scene, 128);
  for (const int samples : {1, 4}) {
    request.aa_samples = samples;
    Frame cpu, gpu;
    pair.cpu->Render(request, cpu);
    pair.gpu->Render(request, gpu);
    const ColorDifference d = Difference(cpu, gpu);
    std::printf("%s, %d samples: mean %.3f of 255, %.2f %% of pixels off by more than 3, %.2f %% away from edges\n",
                GetParam(), samples, d.mean, 100 * d.off, 100 * d.off_inside);
    EXPECT_LE(d.mean, samples == 1 ? 0.3 : 0.8);
    EXPECT_LE(d.off, samples == 1 ? 0.01 : 0.05);
    EXPECT_FLOAT_EQ(cpu.exposure, gpu.exposure);
    if (samples > 1) continue;
    double albedo = 0;
    for (size_t i = 0; i < cpu.albedo.size(); ++i)
      albedo += std::fabs(cpu.albedo.pixels()[i].g - gpu.albedo.pixels()[i].g);
    EXPECT_LE(albedo / static_cast<double>(cpu.albedo.size()), 1e-3);
  }
  for (const std::string& message : pair.gpu->messages()) ADD_FAILURE() << message;
}

INSTANTIATE_TEST_SUITE_P(Worlds, GpuColorOf, testing::Values("sunlit_room", "city_park"));

TEST(GpuColor, ManyCamerasAndEveryCurveAreWhatEachIsAlone) {
  AIRSIM360_NEEDS_GPU();
  const auto scene = BuildWorld("sunlit_room", {.seed = 1});
  Pair pair(scene);
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
