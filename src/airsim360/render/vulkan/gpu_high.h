// Tables of the tiers beyond `fast` on the GPU: the sun map, mean light of lamps, which triangles are lamps.
#pragma once

#include <optional>

#include "airsim360/render/shading/shader.h"
#include "airsim360/render/shading/sun_map.h"
#include "airsim360/render/vulkan/gpu_cameras.h"
#include "airsim360/render/vulkan/gpu_memory.h"

namespace airsim360::internal {

/// Numbers that passes keep of a pixel for each other: tier `high` (high.glsl), `reference` (path.rgen), recorded rays
/// (record.glsl).
inline constexpr size_t kGpuHighPlanes = 38, kGpuPathPlanes = 4, kGpuRecordPlanes = 12 * 8 + 2;

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

/// Light of the last frame of tier `high` (RenderRequest::temporal), kept on the GPU.
class GpuHistory {
 public:
  explicit GpuHistory(GpuDevice& device) : device_(device) {}
  /// Tells `out` where the last frame is and how it was seen, and that of now, through `field`, is the last from here on.
  void Fill(const RenderRequest& request, const RayField& field, GpuCamera& out);
  /// Counts frames that are added up, for their random choices; any other frame begins anew.
  void Count(bool temporal) { frames_ = temporal ? frames_ + 1 : 0; }
  uint64_t frames() const { return frames_; }

 private:
  GpuDevice& device_;
  GpuBuffer planes_;
  int width_ = 0, height_ = 0;
  bool separable_ = false;
  Mat3d R_;
  Vec3d p_;
  uint64_t frames_ = 0;
};

}  // namespace airsim360::internal
