// Lights of tier `reference` on the GPU: the sky's density, the tree of lamps, their triangles.
#pragma once

#include "airsim360/render/shading/shader.h"
#include "airsim360/render/vulkan/gpu_memory.h"

namespace airsim360::internal {

/// Paths of a pixel that one pass of path.rgen adds: few, so that no dispatch is long.
inline constexpr int kGpuPathsOfAPass = 8;

class GpuPathTables {
 public:
  /// RuntimeError where there is no room.
  GpuPathTables(GpuDevice& device, const Shader& shader, const RayTracer& tracer);
  /// Of a GpuPath.
  VkDeviceAddress address() const { return record_.address; }

 private:
  GpuArena arena_;
  GpuRange record_;
};

}  // namespace airsim360::internal
