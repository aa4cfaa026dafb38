// The CPU shader's tables on the GPU: surfaces, textures, sky, probes, lamps.
#pragma once

#include <array>

#include "airsim360/render/shading/shader.h"
#include "airsim360/render/vulkan/gpu_memory.h"

namespace airsim360::internal {

class GpuShadeTables {
 public:
  /// Uploads what `shader` holds for `scene`. RuntimeError where there is no room.
  GpuShadeTables(GpuDevice& device, const Shader& shader, const Scene& scene);
  /// Of the GpuShade of a tone curve.
  VkDeviceAddress address(ToneCurve tone) const { return views_[static_cast<size_t>(tone)].address; }

 private:
  GpuArena arena_;
  std::array<GpuRange, 3> views_;
};

}  // namespace airsim360::internal
