// The constant part of a scene on the GPU: meshes with compacted bottom-level structures, tables from hits to labels.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "airsim360/render/vulkan/gpu_memory.h"
#include "airsim360/render/vulkan/gpu_records.h"
#include "airsim360/scene/scene.h"

namespace airsim360::internal {

/// What Vulkan asks to build one mesh; geometry 0 opaque triangles, 1 alpha-tested ones, 2 clear panes (some may be empty).
struct MeshBuild {
  std::array<VkAccelerationStructureGeometryKHR, 3> geometries;
  std::array<VkAccelerationStructureBuildRangeInfoKHR, 3> ranges;
  std::array<uint32_t, 3> counts;
  VkAccelerationStructureBuildGeometryInfoKHR info;
  VkAccelerationStructureBuildSizesInfoKHR sizes;
};

class GpuScene {
 public:
  /// Uploads everything. RuntimeError where there is no room, or more than 2^24 instances (VkAccelerationStructureInstanceKHR).
  GpuScene(GpuDevice& device, std::shared_ptr<const Scene> scene);
  ~GpuScene();
  GpuScene(const GpuScene&) = delete;
  GpuScene& operator=(const GpuScene&) = delete;

  const Scene& scene() const { return *scene_; }
  /// Addresses of tables: GpuMesh by mesh, category by entity, GpuAlpha by material.
  VkDeviceAddress meshes() const { return meshes_.address; }
  VkDeviceAddress categories() const { return categories_.address; }
  VkDeviceAddress alphas() const { return alphas_.address; }
  /// Of a mesh: its vertices, its structure (0 where no instance has it or it has no triangles).
  VkDeviceAddress positions(MeshId mesh) const { return records_[mesh].positions; }
  VkDeviceAddress structure(MeshId mesh) const { return addresses_[mesh]; }
  /// Fills `out` for a mesh with its vertices at `positions`; `flags` and `mode` as Vulkan takes them. `out` must stay where it
  /// is.
  void Describe(MeshId mesh, VkDeviceAddress positions, VkBuildAccelerationStructureFlagsKHR flags,
                VkBuildAccelerationStructureModeKHR mode, MeshBuild& out) const;

 private:
  void UploadMesh(MeshId id);
  void UploadAlphas();
  void BuildStructures(const std::vector<MeshId>& used);
  void BuildBatch(const std::vector<MeshId>& batch);

  GpuDevice& device_;
  std::shared_ptr<const Scene> scene_;
  GpuArena arena_;
  std::vector<GpuMesh> records_;
  std::vector<VkAccelerationStructureKHR> structures_;
  std::vector<VkDeviceAddress> addresses_;
  GpuRange meshes_, categories_, alphas_;
};

}  // namespace airsim360::internal
