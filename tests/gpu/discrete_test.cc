// What only a GPU with memory of its own does (staged uploads, pictures copied by another queue) gives the same bytes: software
// plays one.
#include <gtest/gtest.h>

#include "airsim360/base/error.h"
#include "airsim360/worlds/worlds.h"
#include "color_compare.h"

namespace airsim360 {
namespace {

using namespace test;

struct Two {
  std::shared_ptr<const Scene> scene = BuildWorld("sunlit_room", {.seed = 1});
  std::shared_ptr<const RayTracer> tracer = std::make_shared<const RayTracer>(scene);
  RendererOptions options{.tier = Tier::kFast, .environment = ClearSky(40)};
  std::unique_ptr<GpuRenderer> shared = MakeVulkanRenderer(tracer, options);
  std::unique_ptr<GpuRenderer> discrete = MakeVulkanRenderer(tracer, options, {.validate = test::ValidationInstalled(), .discrete = true});
};

// Both are made once: most of the time goes into their pipelines.
class GpuDiscrete : public testing::Test {
 protected:
  static Two& Both() {
    if (!kept_) kept_ = std::make_unique<Two>();
    return *kept_;
  }
  void TearDown() override {
    if (!kept_) return;
    for (const std::string& message : kept_->discrete->messages()) ADD_FAILURE() << message;
  }
  static void TearDownTestSuite() { kept_ = nullptr; }

 private:
  inline static std::unique_ptr<Two> kept_;
};

// The room's mesh breathes.
std::shared_ptr<const SceneState> BreathingState(const Scene& scene, int step) {
  auto state = std::make_shared<SceneState>();
  const MeshId mesh = scene.instances[0].mesh;
  auto positions = std::make_shared<std::vector<Vec3f>>(scene.meshes[mesh].positions);
  for (Vec3f& p : *positions) p = p * (1.0f + 0.01f * static_cast<float>(step));
  state->deformed.push_back({mesh, positions});
  return state;
}

TEST_F(GpuDiscrete, EveryTierIsTheSameByteForByte) {
  AIRSIM360_NEEDS_GPU();
  Two& gpus = Both();
  for (const Tier tier : {Tier::kLabels, Tier::kFast, Tier::kHigh, Tier::kReference}) {
    RenderRequest request = ColorRequest(*gpus.scene, 32);
    request.tier = tier, request.samples = 2;
    request.products.flow = request.products.coverage = tier == Tier::kFast;
    request.X_WC_next = request.X_WC;
    request.state = BreathingState(*gpus.scene, 1), request.next_state = BreathingState(*gpus.scene, 2);
    Frame a, b;
    gpus.shared->Render(request, a);
    gpus.discrete->Render(request, b);
    EXPECT_EQ(a.rgb.empty(), tier == Tier::kLabels);
    EXPECT_TRUE(std::ranges::equal(a.rgb.pixels(), b.rgb.pixels()));
    EXPECT_TRUE(std::ranges::equal(a.range.pixels(), b.range.pixels()));
    EXPECT_TRUE(std::ranges::equal(a.entity.pixels(), b.entity.pixels()));
    EXPECT_TRUE(std::ranges::equal(a.flow.pixels(), b.flow.pixels()));
    EXPECT_TRUE(std::ranges::equal(a.coverage.pixels(), b.coverage.pixels()));
  }
}

TEST_F(GpuDiscrete, FramesInFlightDoNotTouchEachOther) {
  AIRSIM360_NEEDS_GPU();
  Two& gpus = Both();
  RenderRequest request = ColorRequest(*gpus.scene, 32);
  std::vector<uint64_t> tickets;
  for (int i = 0; i < 9; ++i) {
    request.state = BreathingState(*gpus.scene, i);
    tickets.push_back(gpus.discrete->Submit({&request, 1}));
    if (i < 2) continue;
    const int oldest = i - 2;
    request.state = BreathingState(*gpus.scene, oldest);
    Frame alone;
    gpus.shared->Render(request, alone);
    const auto ticket = tickets[static_cast<size_t>(oldest)];
    EXPECT_TRUE(std::ranges::equal(alone.rgb.pixels(), gpus.discrete->Wait(ticket).front().rgb)) << oldest;
    gpus.discrete->Release(ticket);
  }
}

TEST_F(GpuDiscrete, PicturesStayOnTheGpuWhereNobodyReadsThem) {
  AIRSIM360_NEEDS_GPU();
  Two& gpus = Both();
  const RenderRequest request = ColorRequest(*gpus.scene, 32);
  for (const bool wanted : {false, true}) {
    gpus.discrete->ReadBack(wanted);
    const uint64_t ticket = gpus.discrete->Submit({&request, 1});
    const GpuFrame frame = gpus.discrete->Wait(ticket).front();
    EXPECT_EQ(frame.width, 32);
    EXPECT_EQ(frame.rgb.empty(), !wanted);
    gpus.discrete->Release(ticket);
  }
}

TEST_F(GpuDiscrete, PicturesLargerThanAPieceOfMemoryAreNamed) {
  AIRSIM360_NEEDS_GPU();
  Two& gpus = Both();
  RenderRequest request = ColorRequest(*gpus.scene, 32);
  request.camera = Equirectangular{8192, 4096};
  request.tier = Tier::kHigh;
  Frame frame;
  try {
    gpus.discrete->Render(request, frame);
    GTEST_SKIP() << "this GPU gives as much";
  } catch (const RuntimeError& error) {
    EXPECT_NE(std::string(error.what()).find("smaller picture"), std::string::npos) << error.what();
  }
  // And it goes on working.
  gpus.discrete->Render(ColorRequest(*gpus.scene, 32), frame);
  EXPECT_EQ(frame.rgb.width(), 32);
}

}  // namespace
}  // namespace airsim360
