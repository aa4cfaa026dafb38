// The shared shading source gives the same numbers as C++ and as GLSL on a GPU. (C++ scalar against SIMD: ShadingShared tests.)
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <vector>

#include "airsim360/base/random.h"
#include "airsim360/render/shared/shading_scalar.h"
#include "airsim360/render/vulkan/gpu_memory.h"
#include "airsim360/render/vulkan/gpu_shaders.h"
#include "gpu_fixture.h"

#define SHARED static inline __attribute__((unused))
#define INOUT(T) T&
namespace airsim360::internal::scalar {
#include "airsim360/render/shared/shading_marks.h"
}
#undef SHARED
#undef INOUT

namespace airsim360 {
namespace {

using namespace internal;

constexpr uint32_t kCode[] = {
#include "functions.comp.inc"
};
constexpr uint32_t kCount = 256;

struct Function {
  const char* name;
  double low, high;
  int ulps;
  float (*evaluate)(float, float, float);
};

const Function kFunctions[] = {
#define FN(low, high, ulps, expression)                          \
  {#expression, low, high, ulps, [](float a, float b, float c) { \
     using namespace scalar;                                     \
     (void)a, (void)b, (void)c;                                  \
     return static_cast<float>(expression);                      \
   }},
#include "functions.inc"
#undef FN
};

struct Push {
  VkDeviceAddress arguments, results;
  uint32_t count;
};

void RunOnGpu(GpuDevice& device, std::span<const uint32_t> words, const Push& push) {
  const VkDevice d = device.device();
  const VkShaderModuleCreateInfo code{VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO, nullptr, 0, words.size_bytes(), words.data()};
  VkShaderModule module;
  CheckVk(vkCreateShaderModule(d, &code, nullptr, &module), "loading a shader");
  const VkPushConstantRange range{VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof(Push)};
  const VkPipelineLayoutCreateInfo layout_info{VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO, nullptr, 0, 0, nullptr, 1, &range};
  VkPipelineLayout layout;
  CheckVk(vkCreatePipelineLayout(d, &layout_info, nullptr, &layout), "making a pipeline");
  const VkComputePipelineCreateInfo info{
      VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO,
      nullptr,
      0,
      {VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO, nullptr, 0, VK_SHADER_STAGE_COMPUTE_BIT, module, "main", nullptr},
      layout,
      VK_NULL_HANDLE,
      0};
  VkPipeline pipeline;
  CheckVk(vkCreateComputePipelines(d, VK_NULL_HANDLE, 1, &info, nullptr, &pipeline), "compiling");
  device.Run([&](VkCommandBuffer commands) {
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline);
    vkCmdPushConstants(commands, layout, VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof(Push), &push);
    vkCmdDispatch(commands, (push.count + 63) / 64, 1, 1);
    const VkMemoryBarrier barrier{VK_STRUCTURE_TYPE_MEMORY_BARRIER, nullptr, VK_ACCESS_SHADER_WRITE_BIT, VK_ACCESS_HOST_READ_BIT};
    vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, VK_PIPELINE_STAGE_HOST_BIT, 0, 1, &barrier, 0, nullptr, 0,
                         nullptr);
  });
  vkDestroyPipeline(d, pipeline, nullptr);
  vkDestroyPipelineLayout(d, layout, nullptr);
  vkDestroyShaderModule(d, module, nullptr);
}

// Units in the last place of the larger, or of 1/16.
double UlpsApart(float a, float b) {
  const float magnitude = std::max({std::fabs(a), std::fabs(b), 1.0f / 16});
  return std::fabs(static_cast<double>(a) - b) / (std::nextafter(magnitude, INFINITY) - magnitude);
}

// By function, the largest distance from the CPU's.
std::vector<double> WorstOf(GpuDevice& device, std::span<const uint32_t> code) {
  const size_t functions = std::size(kFunctions);
  const GpuBuffer arguments(device, functions * 3 * kCount * sizeof(float), MemoryKind::kUpload);
  const GpuBuffer results(device, functions * kCount * sizeof(float), MemoryKind::kReadBack);
  auto* in = reinterpret_cast<float*>(arguments.mapped());
  RngStream random(5, "functions");
  for (size_t f = 0; f < functions; ++f) {
    for (uint32_t i = 0; i < 3 * kCount; ++i)
      in[3 * f * kCount + i] = static_cast<float>(random.Uniform(kFunctions[f].low, kFunctions[f].high));
  }
  RunOnGpu(device, code, {arguments.address(), results.address(), kCount});
  results.Invalidate();
  const auto* out = reinterpret_cast<const float*>(results.mapped());
  std::vector<double> worst(functions);
  for (size_t f = 0; f < functions; ++f) {
    const float* a = in + 3 * f * kCount;
    for (uint32_t i = 0; i < kCount; ++i)
      worst[f] = std::max(worst[f], UlpsApart(out[f * kCount + i], kFunctions[f].evaluate(a[i], a[kCount + i], a[2 * kCount + i])));
  }
  return worst;
}

TEST(GpuShading, EverySharedFunctionIsTheCpus) {
  AIRSIM360_NEEDS_GPU();
  GpuDevice device({.validate = test::ValidationInstalled()});
  // As the renderer loads its shaders. With fused operations eight functions are 4 to 14 units off.
  const std::vector<double> worst = WorstOf(device, WithoutContraction(kCode));
  // Hardware adds up a dot product and divides in ways of its own, which Vulkan allows: an H100 is up to 31 units off.
  const double more = device.info().software ? 1 : 16;
  for (size_t f = 0; f < std::size(kFunctions); ++f) EXPECT_LE(worst[f], more * kFunctions[f].ulps) << kFunctions[f].name;
  std::printf("%zu functions, at most %.1f units in the last place\n", worst.size(), *std::ranges::max_element(worst));
  for (const std::string& message : device.messages()) ADD_FAILURE() << message;
}

}  // namespace
}  // namespace airsim360
