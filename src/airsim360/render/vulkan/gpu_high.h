// Tables of the tiers beyond `fast` on the GPU: the sun map, mean light of lamps, which triangles are lamps.
#pragma once

#include <optional>

#include "airsim360/render/shading/shader.h"
#include "airsim360/render/shading/sun_map.h"
#include "airsim360/render/vulkan/gpu_memory.h"

namespace airsim360::internal {

/// Numbers that tier `high` keeps of a pixel between its passes (high.glsl).
inline constexpr size_t kGpuHighPlanes = 38;

class GpuHighTables {
 public:
  /// Bakes the sun map and uploads. RuntimeError where there is no room.
  GpuHighTables(GpuDevice& device, const Shader& shader, const RayTracer& tracer);
  /// Of a GpuHigh.
  VkDeviceAddress address() const { return record_.address; }

 private:
  GpuArena arena_;
  GpuRange record_;
};

}  // namespace airsim360::internal
