// Labels of the GPU are those of the CPU, through every camera.
#include <gtest/gtest.h>

#include <numbers>

#include "airsim360/render/cpu/test_room.h"
#include "airsim360/worlds/worlds.h"
#include "gpu_fixture.h"

namespace airsim360 {
namespace {

using test::Compare;
using test::LabelDifference;
constexpr double kPi = std::numbers::pi;

RenderRequest LabelRequest(const Camera& camera, const RigidTransform& X_WC) {
  RenderRequest request;
  request.camera = camera;
  request.X_WC = X_WC;
  request.tier = Tier::kLabels;
  request.products = {.rgb = false, .normal = true, .position = true, .material = true};
  return request;
}

struct Pair {
  std::shared_ptr<const RayTracer> tracer;
  std::unique_ptr<Renderer> cpu;
  std::unique_ptr<GpuRenderer> gpu;

  explicit Pair(std::shared_ptr<const Scene> scene)
      : tracer(std::make_shared<const RayTracer>(std::move(scene), RayTracerOptions{.isa = "avx2"})),
        cpu(MakeCpuRenderer(tracer)),
        gpu(MakeVulkanRenderer(tracer, {}, {.validate = true})) {}
};

// 0.02 per cent of the pixels, each within a pixel of an edge; range to 1e-5.
void ExpectSameLabels(const LabelDifference& d, const std::string& what) {
  std::printf("%s: %d of %d labels differ (%d far from edges), range %.2g, normal %.2g over %d pixels\n",
              what.c_str(), d.different, d.pixels, d.far, d.range, d.normal, d.off_edges);
  EXPECT_LE(d.different, std::max(1.0, 2e-4 * d.pixels)) << what;
  EXPECT_EQ(d.far, 0) << what;
  EXPECT_LE(d.range, 1e-5) << what;
  EXPECT_LE(d.normal, 1e-4) << what;
  EXPECT_GT(d.off_edges, d.pixels / 8) << what;
}

TEST(GpuLabels, AreTheCpusThroughEveryCamera) {
  AIRSIM360_NEEDS_GPU();
  Pair pair(test::MakeRoom());
  RngStream rng(3, "gpu");
  const Camera cameras[] = {Equirectangular{128, 64},
                            CubeFace{CubeFaceName::kNegX, 64},
                            CubeFace{CubeFaceName::kPosY, 48},
                            Pinhole{100, 60, 70, 65, 51, 29},
                            Fisheye::Equidistant(64, 64, kPi * 1.1),
                            Fisheye{80, 64, 20, 20, 40, 32, {0.01, -0.002, 0, 0}, 1.5}};
  for (const Camera& camera : cameras) {
    const RenderRequest request = LabelRequest(camera, test::RandomPose(rng));
    Frame cpu, gpu;
    pair.cpu->Render(request, cpu);
    pair.gpu->Render(request, gpu);
    ExpectSameLabels(Compare(cpu, gpu, camera.index() == 0), "camera " + std::to_string(camera.index()));
    EXPECT_EQ(cpu.rgb.size(), gpu.rgb.size());
    for (size_t i = 0; i < cpu.position.size(); ++i) {
      if (cpu.entity.pixels()[i] != gpu.entity.pixels()[i]) continue;
      ASSERT_LE(Norm(cpu.position.pixels()[i] - gpu.position.pixels()[i]), 1e-3f);
      ASSERT_EQ(cpu.material.pixels()[i], gpu.material.pixels()[i]);
    }
  }
  for (const std::string& message : pair.gpu->messages()) ADD_FAILURE() << message;
}

TEST(GpuLabels, AreTheClosedFormOfTheRoom) {
  AIRSIM360_NEEDS_GPU();
  Pair pair(test::MakeRoom());
  RngStream rng(4, "gpu");
  const Equirectangular camera{128, 64};
  const RenderRequest request = LabelRequest(camera, test::RandomPose(rng));
  Frame frame;
  pair.gpu->Render(request, frame);
  for (int y = 0; y < camera.height; ++y) {
    for (int x = 0; x < camera.width; ++x) {
      const Vec3d d = request.X_WC.R * *PixelToRay(camera, {x + 0.5, y + 0.5});
      if (!test::FarFromEdges(request.X_WC.p, d)) continue;
      const test::Truth truth = test::Look(request.X_WC.p, d);
      ASSERT_EQ(frame.entity(x, y), truth.entity) << x << ' ' << y;
      ASSERT_NEAR(frame.range(x, y), truth.range, 1e-5 * truth.range);
      ASSERT_LE(Norm(VecCast<double>(frame.normal(x, y)) - truth.normal), 1e-5);
    }
  }
}

class GpuLabelsOf : public testing::TestWithParam<const char*> {};

TEST_P(GpuLabelsOf, AreTheCpus) {
  AIRSIM360_NEEDS_GPU();
  const auto scene = BuildWorld(GetParam(), {.seed = 1});
  Pair pair(scene);
  const Vec3f spawn = scene->spawn.value_or(Vec3f{0, 0, 2});
  const RigidTransform X_WC =
      BodyPose(VecCast<double>(spawn) + Vec3d{0.1, 0.2, 0.3}, 0.4, -0.1, 0.05) * CameraInBody();
  const RenderRequest request = LabelRequest(Equirectangular{256, 128}, X_WC);
  Frame cpu, gpu;
  pair.cpu->Render(request, cpu);
  pair.gpu->Render(request, gpu);
  ExpectSameLabels(Compare(cpu, gpu, true), GetParam());
  for (const std::string& message : pair.gpu->messages()) ADD_FAILURE() << message;
}

INSTANTIATE_TEST_SUITE_P(Worlds, GpuLabelsOf, testing::Values("box_room", "sunlit_room", "city_park"));

TEST(GpuLabels, RollWithACameraTurnedByColumns) {
  AIRSIM360_NEEDS_GPU();
  Pair pair(test::MakeOpenSquare());
  const RigidTransform level = BodyPose({0.5, 0.25, 2}, 0.3, 0.2, -0.1) * CameraInBody();
  RenderRequest request = LabelRequest(Equirectangular{64, 32}, level);
  Frame still, turned;
  pair.gpu->Render(request, still);
  request.X_WC.R = level.R * RotationY(5 * 2 * kPi / 64);
  pair.gpu->Render(request, turned);
  for (int y = 0; y < 32; ++y) {
    for (int x = 0; x < 64; ++x) {
      ASSERT_EQ(turned.range(x, y), still.range((x + 5) % 64, y));
      ASSERT_EQ(turned.entity(x, y), still.entity((x + 5) % 64, y));
    }
  }
}

}  // namespace
}  // namespace airsim360
