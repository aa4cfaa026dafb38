// Which renderer `--device` gives, and how it goes on where a GPU fails.
#include <gtest/gtest.h>

#include <algorithm>

#include "airsim360/base/error.h"
#include "airsim360/render/vulkan/choose_renderer.h"
#include "airsim360/worlds/worlds.h"
#include "gpu_fixture.h"

namespace airsim360 {
namespace {

std::shared_ptr<const RayTracer> Room() {
  static const auto tracer = std::make_shared<const RayTracer>(BuildWorld("box_room", {.seed = 1}));
  return tracer;
}

RenderRequest SmallRequest() {
  RenderRequest request;
  request.camera = Equirectangular{16, 8};
  request.X_WC.p = {0, 0, 1.5};
  request.tier = Tier::kLabels;
  request.products.rgb = false;
  return request;
}

// What is said while a renderer for `choice` is made and renders twice; the pictures are checked.
std::string Said(const DeviceChoice& choice) {
  Frame expected, frame;
  MakeCpuRenderer(Room())->Render(SmallRequest(), expected);
  testing::internal::CaptureStderr();
  const auto renderer = MakeRenderer(Room(), {.tier = Tier::kLabels}, choice);
  for (int i = 0; i < 2; ++i) {
    renderer->Render(SmallRequest(), frame);
    EXPECT_TRUE(std::ranges::equal(frame.entity.pixels(), expected.entity.pixels()));
  }
  return testing::internal::GetCapturedStderr();
}

TEST(Device, AutoWithoutAGpuIsTheCpuAndSaysNothing) {
  if (MachineHasGpu()) GTEST_SKIP() << "this machine has a GPU";
  EXPECT_EQ(Said({.device = "auto"}), "");
}

TEST(Device, UnknownOnesAreNamed) { EXPECT_THROW(MakeRenderer(Room(), {}, {.device = "gpu"}), InputError); }

TEST(Device, AutoGoesOnOnTheCpuAndSaysWhy) {
  AIRSIM360_NEEDS_GPU();
  int usable = 0;
  for (const GpuInfo& gpu : ListGpus()) {
    if (gpu.missing.empty()) usable = gpu.index;
  }
  const std::pair<GpuFault, const char*> faults[] = {{GpuFault::kNoVulkan, "no Vulkan driver found"},
                                                     {GpuFault::kOldDriver, "Vulkan 1.1, 1.2 is needed"},
                                                     {GpuFault::kNoMemory, "out of GPU memory"},
                                                     {GpuFault::kNoFrameMemory, "out of GPU memory"},
                                                     {GpuFault::kLost, "the GPU was lost"}};
  for (const auto& [fault, words] : faults) {
    const std::string said = Said({"auto", usable, fault});
    EXPECT_NE(said.find(words), std::string::npos) << said;
    EXPECT_NE(said.find("cpu"), std::string::npos) << said;
    // Once, after the name of the device where that could be opened.
    EXPECT_LE(std::count(said.begin(), said.end(), '\n'), 2) << said;
    EXPECT_THROW(
        MakeRenderer(Room(), {.tier = Tier::kLabels}, {"vulkan", usable, fault})->Render(SmallRequest(), *std::make_unique<Frame>()),
        RuntimeError);
  }
}

}  // namespace
}  // namespace airsim360
