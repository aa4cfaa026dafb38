// Lights of tier `reference` on the GPU: the sky's density, the tree of lamps, their triangles.
#pragma once

#include <algorithm>

#include "airsim360/render/shading/shader.h"
#include "airsim360/render/vulkan/gpu_memory.h"

namespace airsim360::internal {

/// Paths of a pixel that one pass of path.rgen adds where a submission has so many pixels: few, so that none takes so long that
/// a driver takes the GPU for lost (amdgpu: ten seconds).
inline int GpuPathsOfAPass(uint64_t pixels) {
  constexpr uint64_t kPaths = uint64_t{1} << 24;
  return static_cast<int>(std::clamp<uint64_t>(kPaths / std::max<uint64_t>(pixels, 1), 1, 8));
}

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
