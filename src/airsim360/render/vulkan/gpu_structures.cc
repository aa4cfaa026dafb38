// Bottom-level acceleration structures: built in batches, then copied to the size they turned out to need.
#include <algorithm>
#include <memory>

#include "airsim360/base/error.h"
#include "airsim360/render/vulkan/gpu_scene.h"
#include "airsim360/render/vulkan/gpu_structure.h"

namespace airsim360::internal {
namespace {

constexpr VkDeviceSize kBatchBytes = VkDeviceSize{256} << 20;  // of structures and scratch at once
constexpr size_t kBatchMeshes = 1024;
constexpr VkAccelerationStructureTypeKHR kBottom = VK_ACCELERATION_STRUCTURE_TYPE_BOTTOM_LEVEL_KHR;
constexpr VkBuildAccelerationStructureFlagsKHR kFlags =
    VK_BUILD_ACCELERATION_STRUCTURE_ALLOW_COMPACTION_BIT_KHR | VK_BUILD_ACCELERATION_STRUCTURE_PREFER_FAST_TRACE_BIT_KHR;

void Wait(VkCommandBuffer commands, VkAccessFlags from, VkAccessFlags to) {
  const VkMemoryBarrier barrier{VK_STRUCTURE_TYPE_MEMORY_BARRIER, nullptr, from, to};
  constexpr VkPipelineStageFlags kBuild = VK_PIPELINE_STAGE_ACCELERATION_STRUCTURE_BUILD_BIT_KHR;
  vkCmdPipelineBarrier(commands, kBuild, kBuild, 0, 1, &barrier, 0, nullptr, 0, nullptr);
}

constexpr VkAccessFlags kWrite = VK_ACCESS_ACCELERATION_STRUCTURE_WRITE_BIT_KHR, kRead = VK_ACCESS_ACCELERATION_STRUCTURE_READ_BIT_KHR;

// A pool of queries that goes with its scope.
struct SizeQueries {
  SizeQueries(GpuDevice& device, uint32_t count) : device(device.device()) {
    VkQueryPoolCreateInfo info{VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO, nullptr};
    info.queryType = VK_QUERY_TYPE_ACCELERATION_STRUCTURE_COMPACTED_SIZE_KHR;
    info.queryCount = count;
    CheckVk(vkCreateQueryPool(this->device, &info, nullptr, &pool), "making queries");
  }
  ~SizeQueries() { vkDestroyQueryPool(device, pool, nullptr); }
  VkDevice device;
  VkQueryPool pool = VK_NULL_HANDLE;
};

// Structures that are destroyed with their scope.
struct Temporary {
  GpuDevice& device;
  std::vector<VkAccelerationStructureKHR> list;
  ~Temporary() {
    for (VkAccelerationStructureKHR s : list) device.rt().destroy_structure(device.device(), s, nullptr);
  }
};

}  // namespace

void GpuScene::Describe(MeshId mesh, VkDeviceAddress positions, VkBuildAccelerationStructureFlagsKHR flags,
                        VkBuildAccelerationStructureModeKHR mode, MeshBuild& out) const {
  const GpuMesh& record = records_[mesh];
  for (uint32_t g = 0; g < 3; ++g) {
    VkAccelerationStructureGeometryKHR& geometry = out.geometries[g];
    geometry = {VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_KHR, nullptr};
    geometry.geometryType = VK_GEOMETRY_TYPE_TRIANGLES_KHR;
    // A pane tints a ray of light once (pane.rahit).
    geometry.flags = g == 0 ? VK_GEOMETRY_OPAQUE_BIT_KHR : g == 2 ? VK_GEOMETRY_NO_DUPLICATE_ANY_HIT_INVOCATION_BIT_KHR : 0;
    auto& triangles = geometry.geometry.triangles;
    triangles = {VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_TRIANGLES_DATA_KHR, nullptr};
    triangles.vertexFormat = VK_FORMAT_R32G32B32_SFLOAT;
    triangles.vertexData.deviceAddress = positions;
    triangles.vertexStride = sizeof(Vec3f);
    triangles.maxVertex = static_cast<uint32_t>(scene_->meshes[mesh].positions.size() - 1);
    triangles.indexType = VK_INDEX_TYPE_UINT32;
    triangles.indexData.deviceAddress = record.indices + VkDeviceAddress{12} * record.first[g];
    out.counts[g] = record.first[g + 1] - record.first[g];
    out.ranges[g] = {out.counts[g], 0, 0, 0};
  }
  out.info = {VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_BUILD_GEOMETRY_INFO_KHR, nullptr};
  out.info.type = VK_ACCELERATION_STRUCTURE_TYPE_BOTTOM_LEVEL_KHR;
  out.info.flags = flags;
  out.info.mode = mode;
  out.info.geometryCount = 3;
  out.info.pGeometries = out.geometries.data();
  out.sizes = {VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_BUILD_SIZES_INFO_KHR, nullptr};
  device_.rt().build_sizes(device_.device(), VK_ACCELERATION_STRUCTURE_BUILD_TYPE_DEVICE_KHR, &out.info, out.counts.data(), &out.sizes);
}

void GpuScene::BuildStructures(const std::vector<MeshId>& used) {
  std::vector<MeshId> batch;
  VkDeviceSize bytes = 0;
  for (MeshId mesh : used) {
    MeshBuild build;
    Describe(mesh, records_[mesh].positions, kFlags, VK_BUILD_ACCELERATION_STRUCTURE_MODE_BUILD_KHR, build);
    const VkDeviceSize needs = build.sizes.accelerationStructureSize + build.sizes.buildScratchSize;
    if (!batch.empty() && (bytes + needs > kBatchBytes || batch.size() == kBatchMeshes)) {
      BuildBatch(batch);
      batch.clear(), bytes = 0;
    }
    batch.push_back(mesh), bytes += needs;
  }
  if (!batch.empty()) BuildBatch(batch);
}

void GpuScene::BuildBatch(const std::vector<MeshId>& batch) {
  const auto count = static_cast<uint32_t>(batch.size());
  const VkDeviceSize scratch_align = ScratchAlign(device_);
  const auto builds = std::make_unique<MeshBuild[]>(count);
  std::vector<VkDeviceSize> at(count), scratch_at(count);
  VkDeviceSize size = 0, scratch_size = 0;
  for (uint32_t i = 0; i < count; ++i) {
    Describe(batch[i], records_[batch[i]].positions, kFlags, VK_BUILD_ACCELERATION_STRUCTURE_MODE_BUILD_KHR, builds[i]);
    at[i] = size, scratch_at[i] = scratch_size;
    size += Up(builds[i].sizes.accelerationStructureSize, 256);
    scratch_size += Up(builds[i].sizes.buildScratchSize, scratch_align);
  }

  // Build all at once, each with its own scratch, and ask for the sizes.
  const GpuBuffer storage(device_, size, MemoryKind::kDevice), scratch(device_, scratch_size + scratch_align, MemoryKind::kDevice);
  Temporary loose{device_, {}};
  std::vector<VkAccelerationStructureBuildGeometryInfoKHR> infos;
  std::vector<const VkAccelerationStructureBuildRangeInfoKHR*> ranges;
  for (uint32_t i = 0; i < count; ++i) {
    loose.list.push_back(CreateStructure(device_, storage.handle(), at[i], builds[i].sizes.accelerationStructureSize, kBottom));
    builds[i].info.dstAccelerationStructure = loose.list.back();
    builds[i].info.scratchData.deviceAddress = Up(scratch.address(), scratch_align) + scratch_at[i];
    infos.push_back(builds[i].info);
    ranges.push_back(builds[i].ranges.data());
  }
  const SizeQueries queries(device_, count);
  device_.Run([&](VkCommandBuffer commands) {
    vkCmdResetQueryPool(commands, queries.pool, 0, count);
    device_.rt().build(commands, count, infos.data(), ranges.data());
    Wait(commands, kWrite, kRead);
    device_.rt().write_properties(commands, count, loose.list.data(), VK_QUERY_TYPE_ACCELERATION_STRUCTURE_COMPACTED_SIZE_KHR, queries.pool,
                                  0);
  });
  std::vector<VkDeviceSize> sizes(count);
  CheckVk(vkGetQueryPoolResults(device_.device(), queries.pool, 0, count, count * sizeof(VkDeviceSize), sizes.data(), sizeof(VkDeviceSize),
                                VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT),
          "reading sizes");

  // Copy to what they need.
  for (uint32_t i = 0; i < count; ++i) {
    const GpuRange place = arena_.Take(sizes[i]);
    structures_[batch[i]] = CreateStructure(device_, place.buffer, place.offset, sizes[i], kBottom);
    const VkAccelerationStructureDeviceAddressInfoKHR address{VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_DEVICE_ADDRESS_INFO_KHR, nullptr,
                                                              structures_[batch[i]]};
    addresses_[batch[i]] = device_.rt().structure_address(device_.device(), &address);
  }
  device_.Run([&](VkCommandBuffer commands) {
    for (uint32_t i = 0; i < count; ++i) {
      const VkCopyAccelerationStructureInfoKHR copy{VK_STRUCTURE_TYPE_COPY_ACCELERATION_STRUCTURE_INFO_KHR, nullptr, loose.list[i],
                                                    structures_[batch[i]], VK_COPY_ACCELERATION_STRUCTURE_MODE_COMPACT_KHR};
      device_.rt().copy(commands, &copy);
    }
  });
}

}  // namespace airsim360::internal
