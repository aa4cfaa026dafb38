// Tier `high` is the CPU's: the same random choices, so that what is left is rounding, and choices that hang on it.
#include <gtest/gtest.h>

#include "airsim360/base/error.h"
#include "airsim360/worlds/worlds.h"
#include "color_compare.h"

namespace airsim360 {
namespace {

using namespace test;

class GpuHigh : public RoomByDaySuite {};
class GpuReference : public RoomByDaySuite {};

double MeanOf(const Image<Rgb32f>& image) {
  double sum = 0;
  for (const Rgb32f& c : image.pixels()) sum += c.r + c.g + c.b;
  return sum / static_cast<double>(image.size());
}

// The GPU's picture is far nearer to the CPU's than the CPU's own with other random choices.
void ExpectTheCpus(Pair& pair, RenderRequest request, const std::string& what, double mean, double off) {
  request.tier = Tier::kHigh;
  Frame cpu, gpu, other;
  pair.cpu->Render(request, cpu);
  pair.gpu->Render(request, gpu);
  request.seed = 7;
  pair.cpu->Render(request, other);
  const ColorDifference d = Difference(cpu, gpu), noise = Difference(cpu, other);
  std::printf("%s: mean %.3f of 255, %.2f %% of pixels off by more than 3, %.2f %% away from edges; another seed: %.3f, %.2f %%\n",
              what.c_str(), d.mean, 100 * d.off, 100 * d.off_inside, noise.mean, 100 * noise.off);
  EXPECT_LE(d.mean, mean);
  EXPECT_LE(d.off, off);
  EXPECT_LE(d.mean, 0.15 * noise.mean);
  // A tile whose noise is near a limit may take another number of rounds of rays, and so have other noise.
  EXPECT_NEAR(MeanOf(gpu.radiance), MeanOf(cpu.radiance), 6e-3 * MeanOf(cpu.radiance));
  EXPECT_EQ(Compare(cpu, gpu, true).far, 0);
}

TEST_F(GpuHigh, OfARoomByDayIsTheCpus) {
  AIRSIM360_NEEDS_GPU();
  Pair& pair = Room(Tier::kHigh);
  const Scene& scene = pair.tracer->scene();
  RenderRequest request = ColorRequest(scene, 128);
  ExpectTheCpus(pair, request, "sunlit_room by day", 0.4, 0.02);
  request.denoise = false;
  ExpectTheCpus(pair, request, "sunlit_room by day, as sampled", 0.8, 0.08);
}

TEST_F(GpuHigh, LightKeptFromTheLastFramesIsTheCpus) {
  AIRSIM360_NEEDS_GPU();
  Pair& pair = Room(Tier::kHigh);
  const Scene& scene = pair.tracer->scene();
  const Camera cameras[] = {Equirectangular{64, 32}, Pinhole{48, 32, 30, 28, 25, 15}};
  for (const Camera& camera : cameras) {
    RenderRequest request = ColorRequest(scene, 64);
    request.camera = camera;
    request.tier = Tier::kHigh;
    request.temporal = true;
    Frame cpu, gpu, alone;
    for (int i = 0; i < 4; ++i) {
      request.X_WC.p = request.X_WC.p + Vec3d{0.02, 0.01, 0.005};
      request.X_WC.R = request.X_WC.R * RotationY(0.03);
      pair.cpu->Render(request, cpu);
      pair.gpu->Render(request, gpu);
      const ColorDifference d = Difference(cpu, gpu);
      std::printf("camera %zu, frame %d that keeps light: mean %.3f of 255, %.2f %% of pixels off by more than 3\n", camera.index(), i,
                  d.mean, 100 * d.off);
      EXPECT_LE(d.mean, 0.6);
      EXPECT_LE(d.off, 0.04);
    }
    request.temporal = false;
    pair.cpu->Render(request, cpu);
    pair.gpu->Render(request, alone);
    EXPECT_GT(Difference(gpu, alone).mean, 0.6);
  }
  RenderRequest two[2];
  two[0].temporal = two[1].temporal = true;
  EXPECT_THROW(pair.gpu->Submit(two), InputError);
}

TEST_F(GpuHigh, OfARoomByNightIsTheCpus) {
  AIRSIM360_NEEDS_GPU();
  const auto scene = BuildWorld("sunlit_room", {.seed = 1});
  Pair pair(scene, ClearSky(-12), Tier::kHigh);
  ExpectTheCpus(pair, ColorRequest(*scene, 128), "sunlit_room by night", 0.2, 0.01);
  for (const std::string& message : pair.gpu->messages()) ADD_FAILURE() << message;
}

// Paths take the same random choices, so that most pixels agree; where rounding sends one another way it brings other light.
void ExpectTheCpusPaths(Pair& pair, const std::string& what, const Camera& camera = Equirectangular{64, 32}) {
  RenderRequest request = ColorRequest(pair.tracer->scene(), 64);
  request.camera = camera;
  request.tier = Tier::kReference;
  request.samples = 4;
  Frame cpu, gpu, other;
  pair.cpu->Render(request, cpu);
  pair.gpu->Render(request, gpu);
  request.seed = 7;
  pair.cpu->Render(request, other);
  const ColorDifference d = Difference(cpu, gpu), noise = Difference(cpu, other);
  std::printf("%s: mean %.3f of 255, %.2f %% of pixels off by more than 3; another seed: %.3f, %.2f %%\n", what.c_str(), d.mean,
              100 * d.off, noise.mean, 100 * noise.off);
  EXPECT_LE(d.mean, 0.15 * noise.mean);
  EXPECT_NEAR(MeanOf(gpu.radiance), MeanOf(cpu.radiance), 0.02 * MeanOf(cpu.radiance));
  EXPECT_EQ(Compare(cpu, gpu, camera.index() == 0).far, 0);
  for (const std::string& message : pair.gpu->messages()) ADD_FAILURE() << message;
}

TEST_F(GpuReference, ThroughAFisheyeAndAPinholeIsTheCpus) {
  AIRSIM360_NEEDS_GPU();
  ExpectTheCpusPaths(Room(Tier::kReference), "paths through a fisheye", Fisheye{48, 40, 14, 14, 24, 20, {0.02, -0.004, 0, 0}, 1.3});
  ExpectTheCpusPaths(Room(Tier::kReference), "paths through a pinhole", Pinhole{48, 32, 30, 28, 25, 15});
}

TEST_F(GpuReference, OfARoomByDayIsTheCpus) {
  AIRSIM360_NEEDS_GPU();
  ExpectTheCpusPaths(Room(Tier::kReference), "paths by day");
}

TEST_F(GpuReference, OfARoomByNightIsTheCpus) {
  AIRSIM360_NEEDS_GPU();
  Pair night(BuildWorld("sunlit_room", {.seed = 1}), ClearSky(-12), Tier::kReference);
  ExpectTheCpusPaths(night, "paths by night");
}

TEST_F(GpuHigh, OfWorldsAskedForIsTheCpus) {
  AIRSIM360_NEEDS_GPU();
  const std::vector<std::string> worlds = WorldsAskedFor();
  if (worlds.empty()) GTEST_SKIP() << "AIRSIM360_GPU_WORLDS names no world";
  for (const std::string& world : worlds) {
    const auto scene = WorldOf(world);
    Pair pair(scene, {}, Tier::kHigh);
    ExpectTheCpus(pair, ColorRequest(*scene, 128), world, 0.5, 0.03);
  }
}

TEST_F(GpuHigh, TurningByColumnsRollsThePicture) {
  AIRSIM360_NEEDS_GPU();
  Pair& pair = Room(Tier::kHigh);
  const Scene& scene = pair.tracer->scene();
  constexpr int kWidth = 32, kColumns = 5;
  RenderRequest request = ColorRequest(scene, kWidth);
  request.tier = Tier::kHigh;
  Frame straight, turned;
  pair.gpu->Render(request, straight);
  const double angle = 2 * 3.14159265358979323846 * kColumns / kWidth, c = std::cos(angle), s = std::sin(angle);
  RigidTransform turn;
  turn.R.m[0][0] = c, turn.R.m[0][2] = s, turn.R.m[2][0] = -s, turn.R.m[2][2] = c;
  request.X_WC = request.X_WC * turn;
  pair.gpu->Render(request, turned);
  for (int y = 0; y < kWidth / 2; ++y) {
    for (int x = 0; x < kWidth; ++x) ASSERT_EQ(turned.rgb(x, y), straight.rgb((x + kColumns) % kWidth, y)) << x << " " << y;
  }
}

}  // namespace
}  // namespace airsim360
