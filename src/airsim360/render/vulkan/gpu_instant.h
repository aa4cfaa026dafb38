// The scene at one instant on the GPU: instances where they are now, deformed meshes, the top-level structure.
#pragma once

#include <map>
#include <memory>
#include <vector>

#include "airsim360/render/vulkan/gpu_scene.h"
#include "airsim360/scene/scene_state.h"

namespace airsim360::internal {

/// InputError for an index that the scene lacks, lists out of order, vertices that are too few, too many or not finite.
void CheckState(const Scene& scene, const SceneState& state);

class GpuInstant {
 public:
  GpuInstant(GpuDevice& device, const GpuScene& scene);
  ~GpuInstant();
  GpuInstant(const GpuInstant&) = delete;
  GpuInstant& operator=(const GpuInstant&) = delete;

  /// Writes what differs from the last state; nothing of this may be in use by the GPU. nullptr = as built.
  void Set(const std::shared_ptr<const SceneState>& state);
  /// Builds what Set has changed. Ends with a barrier for ray tracing.
  void Record(VkCommandBuffer commands);
  VkDeviceAddress tlas() const { return tlas_address_; }
  VkDeviceAddress instances() const { return records_.address(); }

 private:
  // A deformed mesh. Refitted, every 30th time built anew.
  struct Body {
    GpuRange vertices;  // positions, then normals where the mesh has some
    VkDeviceAddress scratch = 0;
    std::vector<uint32_t> weld;  // of vertices with normals
    VkAccelerationStructureKHR structure = VK_NULL_HANDLE;
    VkDeviceAddress address = 0;
    std::shared_ptr<const std::vector<Vec3f>> positions;
    int refits = -1;  // since the last build; -1 = never built
    bool changed = false;
    std::vector<uint32_t> instances;
  };
  Body& MakeBody(MeshId mesh);
  void WriteInstance(uint32_t index, const AffineTransform& X_WM, bool hidden, const Body* body);
  void RecordBodies(VkCommandBuffer commands);
  void RecordTop(VkCommandBuffer commands);

  GpuDevice& device_;
  const GpuScene& scene_;
  GpuBuffer structures_, records_;  // VkAccelerationStructureInstanceKHR and GpuInstance of every instance
  GpuBuffer tlas_storage_, scratch_;
  GpuArena body_vertices_, body_memory_;  // of all bodies
  VkAccelerationStructureKHR tlas_ = VK_NULL_HANDLE;
  VkDeviceAddress tlas_address_ = 0;
  std::shared_ptr<const SceneState> state_;
  bool built_ = false;
  std::vector<uint32_t> touched_;  // instances that are not as built
  std::map<MeshId, Body> bodies_;
};

}  // namespace airsim360::internal
