#include "airsim360/render/vulkan/gpu_pipeline.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <vector>

#include "airsim360/base/error.h"
#include "airsim360/render/vulkan/gpu_shaders.h"

namespace airsim360::internal {
namespace {

// Groups in the order of the shader binding table. Hit groups are by geometry (opaque, alpha-tested, clear pane), first for
// rays that see panes, then for rays of light that pass them.
enum Stage : uint32_t { kRaygen, kMissStage, kLightMiss, kHit, kAlpha, kPane, kStages };
constexpr uint32_t kNone = VK_SHADER_UNUSED_KHR, kGroups = 9, kMissGroups = 2, kHitGroups = 6;
struct Group {
  uint32_t general, closest, any;
};
constexpr Group kTable[kGroups] = {{kRaygen, kNone, kNone}, {kMissStage, kNone, kNone}, {kLightMiss, kNone, kNone},
                                   {kNone, kHit, kNone},    {kNone, kHit, kAlpha},      {kNone, kHit, kNone},
                                   {kNone, kHit, kNone},    {kNone, kHit, kAlpha},      {kNone, kHit, kPane}};
constexpr VkShaderStageFlags kAllStages =
    VK_SHADER_STAGE_RAYGEN_BIT_KHR | VK_SHADER_STAGE_CLOSEST_HIT_BIT_KHR | VK_SHADER_STAGE_ANY_HIT_BIT_KHR | VK_SHADER_STAGE_MISS_BIT_KHR;

// Shader modules that go with their scope.
struct Modules {
  VkDevice device;
  std::vector<VkShaderModule> list;
  ~Modules() {
    for (VkShaderModule m : list) vkDestroyShaderModule(device, m, nullptr);
  }
  // Every operation is rounded by itself, as on the CPU: shared functions then agree to the last bit on lavapipe.
  VkShaderModule Add(std::span<const uint32_t> fused) {
    const std::vector<uint32_t> code = WithoutContraction(fused);
    const VkShaderModuleCreateInfo info{VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO, nullptr, 0, code.size() * sizeof(uint32_t),
                                        code.data()};
    VkShaderModule out;
    CheckVk(vkCreateShaderModule(device, &info, nullptr, &out), "loading a shader");
    list.push_back(out);
    return out;
  }
};

}  // namespace

GpuPipeline::GpuPipeline(GpuDevice& device, std::span<const uint32_t> raygen) : device_(device) {
  const VkPushConstantRange push{kAllStages, 0, sizeof(GpuPush)};
  VkPipelineLayoutCreateInfo info{VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO, nullptr};
  info.pushConstantRangeCount = 1;
  info.pPushConstantRanges = &push;
  CheckVk(vkCreatePipelineLayout(device.device(), &info, nullptr, &layout_), "making a pipeline");
  MakePipeline(raygen);
  MakeTable();
}

GpuPipeline::~GpuPipeline() {
  vkDestroyPipeline(device_.device(), pipeline_, nullptr);
  vkDestroyPipelineLayout(device_.device(), layout_, nullptr);
}

void GpuPipeline::MakePipeline(std::span<const uint32_t> raygen) {
  Modules modules{device_.device(), {}};
  const std::pair<VkShaderStageFlagBits, std::span<const uint32_t>> codes[kStages] = {
      {VK_SHADER_STAGE_RAYGEN_BIT_KHR, raygen},          {VK_SHADER_STAGE_MISS_BIT_KHR, MissShader()},
      {VK_SHADER_STAGE_MISS_BIT_KHR, LightMissShader()}, {VK_SHADER_STAGE_CLOSEST_HIT_BIT_KHR, HitShader()},
      {VK_SHADER_STAGE_ANY_HIT_BIT_KHR, AlphaAnyHit()},  {VK_SHADER_STAGE_ANY_HIT_BIT_KHR, PaneAnyHit()}};
  std::vector<VkPipelineShaderStageCreateInfo> stages;
  for (const auto& [stage, code] : codes) {
    stages.push_back({VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO, nullptr, 0, stage, modules.Add(code), "main", nullptr});
  }
  std::vector<VkRayTracingShaderGroupCreateInfoKHR> groups;
  for (const Group& g : kTable) {
    VkRayTracingShaderGroupCreateInfoKHR group{VK_STRUCTURE_TYPE_RAY_TRACING_SHADER_GROUP_CREATE_INFO_KHR, nullptr};
    group.type =
        g.general != kNone ? VK_RAY_TRACING_SHADER_GROUP_TYPE_GENERAL_KHR : VK_RAY_TRACING_SHADER_GROUP_TYPE_TRIANGLES_HIT_GROUP_KHR;
    group.generalShader = g.general, group.closestHitShader = g.closest, group.anyHitShader = g.any;
    group.intersectionShader = kNone;
    groups.push_back(group);
  }
  VkRayTracingPipelineCreateInfoKHR info{VK_STRUCTURE_TYPE_RAY_TRACING_PIPELINE_CREATE_INFO_KHR, nullptr};
  info.stageCount = kStages;
  info.pStages = stages.data();
  info.groupCount = kGroups;
  info.pGroups = groups.data();
  info.maxPipelineRayRecursionDepth = 1;
  info.layout = layout_;
  CheckVk(device_.rt().create_pipelines(device_.device(), VK_NULL_HANDLE, VK_NULL_HANDLE, 1, &info, nullptr, &pipeline_),
          "compiling shaders");
}

void GpuPipeline::MakeTable() {
  const auto& limits = device_.pipeline_limits();
  const uint32_t handle = limits.shaderGroupHandleSize;
  const auto up = [](VkDeviceSize n, VkDeviceSize to) { return (n + to - 1) / to * to; };
  const VkDeviceSize stride = up(handle, std::max<VkDeviceSize>(limits.shaderGroupHandleAlignment, 32));
  const VkDeviceSize base = std::max<VkDeviceSize>(limits.shaderGroupBaseAlignment, 64);
  std::vector<std::byte> handles(size_t{handle} * kGroups);
  CheckVk(device_.rt().group_handles(device_.device(), pipeline_, 0, kGroups, handles.size(), handles.data()), "reading shader handles");

  const VkDeviceSize miss_at = up(stride, base), hit_at = miss_at + up(stride * kMissGroups, base);
  table_ = GpuBuffer(device_, hit_at + stride * kHitGroups + base, MemoryKind::kUpload);
  const VkDeviceAddress start = up(table_.address(), base);
  std::byte* to = table_.mapped() + (start - table_.address());
  for (uint32_t g = 0; g < kGroups; ++g) {
    const VkDeviceSize at = g == 0 ? 0 : g <= kMissGroups ? miss_at + stride * (g - 1) : hit_at + stride * (g - 1 - kMissGroups);
    std::memcpy(to + at, handles.data() + size_t{handle} * g, handle);
  }
  const VkDeviceSize raygen_size = up(stride, base);
  raygen_ = {start, raygen_size, raygen_size};
  miss_ = {start + miss_at, stride, stride * kMissGroups};
  hit_ = {start + hit_at, stride, stride * kHitGroups};
}

void GpuPipeline::Trace(VkCommandBuffer commands, const GpuPush& push, uint32_t width, uint32_t height, uint32_t depth) const {
  vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_RAY_TRACING_KHR, pipeline_);
  vkCmdPushConstants(commands, layout_, kAllStages, 0, sizeof(push), &push);
  const VkStridedDeviceAddressRegionKHR callable{};
  device_.rt().trace_rays(commands, &raygen_, &miss_, &hit_, &callable, width, height, depth);
}

}  // namespace airsim360::internal
