// A ray tracing pipeline: one ray generation shader with the hit shaders that all share.
#pragma once

#include <span>

#include "airsim360/render/vulkan/gpu_memory.h"

namespace airsim360::internal {

/// What a pass is told, as in common.glsl.
struct GpuPush {
  VkDeviceAddress frame;  ///< its parameters
  int32_t pass, paths;    ///< for shaders that do several things; paths of a pixel
};

class GpuPipeline {
 public:
  GpuPipeline(GpuDevice& device, std::span<const uint32_t> raygen);
  ~GpuPipeline();
  GpuPipeline(const GpuPipeline&) = delete;
  GpuPipeline& operator=(const GpuPipeline&) = delete;

  /// Records the tracing of width x height x depth invocations.
  void Trace(VkCommandBuffer commands, const GpuPush& push, uint32_t width, uint32_t height, uint32_t depth) const;

 private:
  void MakePipeline(std::span<const uint32_t> raygen);
  void MakeTable();

  GpuDevice& device_;
  VkPipelineLayout layout_ = VK_NULL_HANDLE;
  VkPipeline pipeline_ = VK_NULL_HANDLE;
  GpuBuffer table_;
  VkStridedDeviceAddressRegionKHR raygen_{}, miss_{}, hit_{};
};

}  // namespace airsim360::internal
