// Colours of tier `fast` are the CPU's.
#include <gtest/gtest.h>

#include <cmath>

#include "airsim360/base/error.h"
#include "airsim360/render/frame/test_room.h"
#include "airsim360/worlds/worlds.h"
#include "color_compare.h"

namespace airsim360 {
namespace {

using namespace test;

class GpuColor : public RoomByDaySuite {};

void ExpectTheCpus(Pair& pair, const std::string& what, int width = 128, bool has_leaves = false) {
  RenderRequest request = ColorRequest(pair.tracer->scene(), width);
  for (const int samples : {1, 4}) {
    request.edge_samples = samples;
    Frame cpu, gpu;
    pair.cpu->Render(request, cpu);
    pair.gpu->Render(request, gpu);
    const ColorDifference d = Difference(cpu, gpu);
    std::printf("%s, %d samples: mean %.3f of 255, %.2f %% of pixels off by more than 3, %.2f %% away from edges\n", what.c_str(), samples,
                d.mean, 100 * d.off, 100 * d.off_inside);
    // On the CPU edge samples of leaves take the sun from leaves around by chance (sun_pixels.h), on the GPU they ask.
    const bool noisy = has_leaves && samples > 1;
    EXPECT_LE(d.mean, noisy ? 2 : 0.25);
    EXPECT_LE(d.off, noisy ? 0.1 : 0.01);
    EXPECT_LE(d.off_inside, 0.002);
    EXPECT_FLOAT_EQ(cpu.exposure, gpu.exposure);
    double albedo = 0;
    for (size_t i = 0; i < cpu.albedo.size(); ++i) albedo += std::fabs(cpu.albedo.pixels()[i].g - gpu.albedo.pixels()[i].g);
    EXPECT_LE(albedo / static_cast<double>(cpu.albedo.size()), 1e-3);
  }
  for (const std::string& message : pair.gpu->messages()) ADD_FAILURE() << message;
}

void ExpectTheCpus(const std::shared_ptr<const Scene>& scene, const Environment& environment, const std::string& what, int width = 128,
                   bool has_leaves = false) {
  Pair pair(scene, environment, Tier::kFast);
  ExpectTheCpus(pair, what, width, has_leaves);
}

TEST_F(GpuColor, OfARoomByDayIsTheCpus) {
  AIRSIM360_NEEDS_GPU();
  ExpectTheCpus(Room(Tier::kFast), "sunlit_room by day");
}

TEST_F(GpuColor, OfARoomByNightIsTheCpus) {
  AIRSIM360_NEEDS_GPU();
  ExpectTheCpus(BuildWorld("sunlit_room", {.seed = 1}), ClearSky(-12), "sunlit_room by night");
}

TEST_F(GpuColor, OfWindowsAndHeadLampsByNightIsTheCpus) {
  AIRSIM360_NEEDS_GPU();
  ExpectTheCpus(MakeNightStreet(true), ClearSky(-25), "street by night");
}

TEST_F(GpuColor, OfRainIsTheCpus) {
  AIRSIM360_NEEDS_GPU();
  Environment rain = ClearSky(25);
  rain.wetness = 0.9, rain.rain_mm_h = 8;
  ExpectTheCpus(MakeOpenSquare(), rain, "square in rain", 64);
  ExpectTheCpus(BuildWorld("sunlit_room", {.seed = 1}), rain, "sunlit_room in rain", 64);
}

TEST_F(GpuColor, OfSnowIsTheCpus) {
  AIRSIM360_NEEDS_GPU();
  Environment snow = ClearSky(25);
  snow.snow_depth = 0.6, snow.snowfall_mm_h = 3;
  ExpectTheCpus(MakeOpenSquare(), snow, "square in snow", 64);
  ExpectTheCpus(BuildWorld("sunlit_room", {.seed = 1}), snow, "sunlit_room in snow", 64);
}

TEST_F(GpuColor, OfFogBeforeAndBehindRoofsIsTheCpus) {
  AIRSIM360_NEEDS_GPU();
  Environment fog = ClearSky(25);
  fog.visibility_m = 30;
  ExpectTheCpus(MakeOpenSquare(), fog, "square in fog", 64);
  ExpectTheCpus(BuildWorld("sunlit_room", {.seed = 1}), fog, "sunlit_room in fog", 64);
}

// Every mesh with vertex normals swells in waves, so that its normals follow.
std::shared_ptr<const SceneState> BentState(const Scene& scene) {
  auto state = std::make_shared<SceneState>();
  for (MeshId m = 0; m < scene.meshes.size(); ++m) {
    if (scene.meshes[m].normals.empty()) continue;
    auto positions = std::make_shared<std::vector<Vec3f>>(scene.meshes[m].positions);
    for (Vec3f& p : *positions) p = p * (1.0f + 0.03f * std::sin(9.0f * (p.x + p.y + p.z)));
    state->deformed.push_back({m, positions});
  }
  return state;
}

TEST_F(GpuColor, OfBentMeshesIsTheCpus) {
  AIRSIM360_NEEDS_GPU();
  Pair& pair = Room(Tier::kFast);
  const Scene& scene = pair.tracer->scene();
  RenderRequest request = ColorRequest(scene, 64);
  request.edge_samples = 1;
  request.state = BentState(scene);
  ASSERT_FALSE(request.state->deformed.empty());
  Frame cpu, gpu;
  pair.cpu->Render(request, cpu);
  pair.gpu->Render(request, gpu);
  const ColorDifference d = Difference(cpu, gpu);
  std::printf("%zu bent meshes: mean %.3f of 255, %.2f %% of pixels off by more than 3\n", request.state->deformed.size(), d.mean,
              100 * d.off);
  EXPECT_LE(d.mean, 0.1);
  EXPECT_LE(d.off, 0.005);
}

TEST_F(GpuColor, OfWorldsAskedForIsTheCpus) {
  AIRSIM360_NEEDS_GPU();
  const std::vector<std::string> worlds = WorldsAskedFor();
  if (worlds.empty()) GTEST_SKIP() << "AIRSIM360_GPU_WORLDS names no world";
  for (const std::string& world : worlds) ExpectTheCpus(WorldOf(world), {}, world, 128, true);
}

TEST_F(GpuColor, ManyCamerasAndEveryCurveAreWhatEachIsAlone) {
  AIRSIM360_NEEDS_GPU();
  Pair& pair = Room(Tier::kFast);
  const Scene& scene = pair.tracer->scene();
  for (const ToneCurve tone : {ToneCurve::kAgx, ToneCurve::kLinear}) {
    std::vector<RenderRequest> requests(3, ColorRequest(scene, 32));
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

TEST_F(GpuColor, ItsRaysCanBeTracedOnceMoreAlone) {
  AIRSIM360_NEEDS_GPU();
  Pair& pair = Room(Tier::kFast);
  const Scene& scene = pair.tracer->scene();
  RenderRequest request = ColorRequest(scene, 32);
  request.edge_samples = 1;
  pair.gpu->TraceAloneMs(request);
  request.tier = Tier::kHigh;
  EXPECT_THROW(pair.gpu->TraceAloneMs(request), InputError);
}

}  // namespace
}  // namespace airsim360
