#include "airsim360/render/vulkan/gpu_instant.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "airsim360/base/error.h"
#include "airsim360/render/surface/bent_normals.h"
#include "airsim360/render/vulkan/gpu_structure.h"

namespace airsim360::internal {
namespace {

constexpr int kRefitsOfABuild = 30;
constexpr VkBuildAccelerationStructureFlagsKHR kBodyFlags =
    VK_BUILD_ACCELERATION_STRUCTURE_ALLOW_UPDATE_BIT_KHR | VK_BUILD_ACCELERATION_STRUCTURE_PREFER_FAST_TRACE_BIT_KHR;

VkAccelerationStructureKHR Create(GpuDevice& device, VkBuffer buffer, size_t offset, size_t size, VkAccelerationStructureTypeKHR type,
                                  VkDeviceAddress& address) {
  const VkAccelerationStructureKHR structure = CreateStructure(device, buffer, offset, size, type);
  const VkAccelerationStructureDeviceAddressInfoKHR ask{VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_DEVICE_ADDRESS_INFO_KHR, nullptr,
                                                        structure};
  address = device.rt().structure_address(device.device(), &ask);
  return structure;
}

void Barrier(VkCommandBuffer commands, VkPipelineStageFlags to, VkAccessFlags access) {
  const VkMemoryBarrier barrier{VK_STRUCTURE_TYPE_MEMORY_BARRIER, nullptr, VK_ACCESS_ACCELERATION_STRUCTURE_WRITE_BIT_KHR, access};
  vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_ACCELERATION_STRUCTURE_BUILD_BIT_KHR, to, 0, 1, &barrier, 0, nullptr, 0, nullptr);
}

bool IsFinite(const AffineTransform& X) {
  float sum = X.p.x + X.p.y + X.p.z;
  for (int i = 0; i < 9; ++i) sum += X.A.m[i / 3][i % 3];
  return std::isfinite(sum);
}

// The top-level build of `count` instances.
void DescribeTop(VkAccelerationStructureGeometryKHR& geometry, VkDeviceAddress instances,
                 VkAccelerationStructureBuildGeometryInfoKHR& info) {
  geometry = {VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_KHR, nullptr};
  geometry.geometryType = VK_GEOMETRY_TYPE_INSTANCES_KHR;
  geometry.geometry.instances = {VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_INSTANCES_DATA_KHR, nullptr, VK_FALSE, {instances}};
  info = {VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_BUILD_GEOMETRY_INFO_KHR, nullptr};
  info.type = VK_ACCELERATION_STRUCTURE_TYPE_TOP_LEVEL_KHR;
  info.flags = VK_BUILD_ACCELERATION_STRUCTURE_PREFER_FAST_TRACE_BIT_KHR;
  info.mode = VK_BUILD_ACCELERATION_STRUCTURE_MODE_BUILD_KHR;
  info.geometryCount = 1;
  info.pGeometries = &geometry;
}

}  // namespace

void CheckState(const Scene& scene, const SceneState& state) {
  for (size_t i = 0; i < state.moved.size(); ++i) {
    const MovedInstance& m = state.moved[i];
    if (m.instance >= scene.instances.size()) throw InputError("scene state: no instance " + std::to_string(m.instance));
    if (i > 0 && state.moved[i - 1].instance >= m.instance)
      throw InputError("scene state: moved instances are not in order at " + std::to_string(m.instance));
    if (!IsFinite(m.X_WM)) throw InputError("scene state: the place of instance " + std::to_string(m.instance) + " is not finite");
  }
  for (size_t i = 0; i < state.deformed.size(); ++i) {
    const DeformedMesh& d = state.deformed[i];
    if (d.mesh >= scene.meshes.size()) throw InputError("scene state: no mesh " + std::to_string(d.mesh));
    if (i > 0 && state.deformed[i - 1].mesh >= d.mesh)
      throw InputError("scene state: deformed meshes are not in order at " + std::to_string(d.mesh));
    if (d.positions == nullptr || d.positions->size() != scene.meshes[d.mesh].positions.size())
      throw InputError("scene state: mesh " + std::to_string(d.mesh) + " has another number of vertices");
    for (const Vec3f& p : *d.positions) {
      if (!std::isfinite(p.x + p.y + p.z)) throw InputError("scene state: a vertex of mesh " + std::to_string(d.mesh) + " is not finite");
    }
  }
}

GpuInstant::GpuInstant(GpuDevice& device, const GpuScene& scene)
    : device_(device),
      scene_(scene),
      structures_(device, (scene.scene().instances.size() + 1) * sizeof(VkAccelerationStructureInstanceKHR), MemoryKind::kUpload),
      records_(device, (scene.scene().instances.size() + 1) * sizeof(GpuInstance), MemoryKind::kUpload),
      body_vertices_(device, MemoryKind::kUpload),
      body_memory_(device) {
  const auto& instances = scene.scene().instances;
  for (uint32_t i = 0; i < instances.size(); ++i) WriteInstance(i, instances[i].X_WM, false, nullptr);
  VkAccelerationStructureGeometryKHR geometry;
  VkAccelerationStructureBuildGeometryInfoKHR info;
  DescribeTop(geometry, structures_.address(), info);
  const auto count = static_cast<uint32_t>(instances.size());
  VkAccelerationStructureBuildSizesInfoKHR sizes{VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_BUILD_SIZES_INFO_KHR, nullptr};
  device.rt().build_sizes(device.device(), VK_ACCELERATION_STRUCTURE_BUILD_TYPE_DEVICE_KHR, &info, &count, &sizes);
  tlas_storage_ = GpuBuffer(device, sizes.accelerationStructureSize, MemoryKind::kDevice);
  scratch_ = GpuBuffer(device, sizes.buildScratchSize + ScratchAlign(device), MemoryKind::kDevice);
  tlas_ = Create(device, tlas_storage_.handle(), 0, tlas_storage_.size(), VK_ACCELERATION_STRUCTURE_TYPE_TOP_LEVEL_KHR, tlas_address_);
}

GpuInstant::~GpuInstant() {
  const auto destroy = [&](VkAccelerationStructureKHR s) {
    if (s != VK_NULL_HANDLE) device_.rt().destroy_structure(device_.device(), s, nullptr);
  };
  destroy(tlas_);
  for (auto& [mesh, body] : bodies_) destroy(body.structure);
}

void GpuInstant::WriteInstance(uint32_t index, const AffineTransform& X, bool hidden, const Body* body) {
  const Instance& instance = scene_.scene().instances[index];
  // Put together here and written at once: memory of a GPU is slow to read, and bit fields would be.
  VkAccelerationStructureInstanceKHR out{};
  GpuInstance record{};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) out.transform.matrix[i][j] = record.A[3 * i + j] = X.A.m[i][j];
    out.transform.matrix[i][3] = record.p[i] = X.p[i];
  }
  const VkDeviceAddress structure = body != nullptr ? body->address : scene_.structure(instance.mesh);
  out.instanceCustomIndex = index;
  out.mask = hidden || structure == 0 ? 0 : 0xff;
  out.instanceShaderBindingTableRecordOffset = 0;
  out.flags = VK_GEOMETRY_INSTANCE_TRIANGLE_FACING_CULL_DISABLE_BIT_KHR;
  out.accelerationStructureReference = structure;
  record.positions = body != nullptr ? body->vertices.address : scene_.positions(instance.mesh);
  const bool bent_normals = body != nullptr && !body->weld.empty();
  record.normals = bent_normals ? static_cast<uint32_t>(body->weld.size()) : 0;
  record.mesh = instance.mesh;
  record.entity = instance.entity;
  record.hidden = hidden ? 1 : 0;
  reinterpret_cast<VkAccelerationStructureInstanceKHR*>(structures_.mapped())[index] = out;
  reinterpret_cast<GpuInstance*>(records_.mapped())[index] = record;
}

GpuInstant::Body& GpuInstant::MakeBody(MeshId mesh) {
  Body& body = bodies_[mesh];
  if (body.structure != VK_NULL_HANDLE) return body;
  const Scene& scene = scene_.scene();
  const Mesh& shape = scene.meshes[mesh];
  if (!shape.normals.empty()) body.weld = WeldVertices(shape);
  const size_t vectors = shape.positions.size() + body.weld.size();
  body.vertices = body_vertices_.Take(vectors * sizeof(Vec3f));
  MeshBuild build;
  scene_.Describe(mesh, body.vertices.address, kBodyFlags, VK_BUILD_ACCELERATION_STRUCTURE_MODE_BUILD_KHR, build);
  const size_t align = ScratchAlign(device_);
  const size_t scratch = std::max(build.sizes.buildScratchSize, build.sizes.updateScratchSize);
  body.scratch = Up(body_memory_.Take(scratch + align).address, align);
  const GpuRange storage = body_memory_.Take(build.sizes.accelerationStructureSize);
  body.structure = Create(device_, storage.buffer, storage.offset, build.sizes.accelerationStructureSize,
                          VK_ACCELERATION_STRUCTURE_TYPE_BOTTOM_LEVEL_KHR, body.address);
  for (uint32_t i = 0; i < scene.instances.size(); ++i) {
    if (scene.instances[i].mesh == mesh) body.instances.push_back(i);
  }
  return body;
}

void GpuInstant::Set(const std::shared_ptr<const SceneState>& state) {
  if (built_ && state == state_) return;
  built_ = false;
  state_ = state;
  static const SceneState kNothing;
  const SceneState& s = state ? *state : kNothing;
  const Scene& scene = scene_.scene();

  // Deformed meshes that any instance has.
  std::vector<uint32_t> now;
  for (const DeformedMesh& deformed : s.deformed) {
    if (scene_.structure(deformed.mesh) == 0) continue;
    Body& body = MakeBody(deformed.mesh);
    now.insert(now.end(), body.instances.begin(), body.instances.end());
    if (body.positions == deformed.positions) continue;
    body.positions = deformed.positions;
    std::memcpy(body.vertices.mapped, deformed.positions->data(), deformed.positions->size() * sizeof(Vec3f));
    if (!body.weld.empty()) {
      auto* normals = reinterpret_cast<Vec3f*>(body.vertices.mapped) + deformed.positions->size();
      std::vector<Vec3f> bent(body.weld.size());
      BendNormals(scene.meshes[deformed.mesh], *deformed.positions, body.weld, bent);
      std::memcpy(normals, bent.data(), bent.size() * sizeof(Vec3f));
    }
    body.changed = true;
  }

  // What moves, and what did and is back.
  for (const MovedInstance& m : s.moved) now.push_back(m.instance);
  std::ranges::sort(now);
  now.erase(std::unique(now.begin(), now.end()), now.end());
  std::vector<uint32_t> both;
  std::ranges::set_union(now, touched_, std::back_inserter(both));
  for (uint32_t i : both) {
    const auto moved = std::ranges::lower_bound(s.moved, i, {}, &MovedInstance::instance);
    const bool moves = moved != s.moved.end() && moved->instance == i;
    const MeshId mesh = scene.instances[i].mesh;
    const auto deformed = std::ranges::lower_bound(s.deformed, mesh, {}, &DeformedMesh::mesh);
    const bool bends = deformed != s.deformed.end() && deformed->mesh == mesh && bodies_.count(mesh) != 0;
    WriteInstance(i, moves ? moved->X_WM : scene.instances[i].X_WM, moves && moved->hidden, bends ? &bodies_.at(mesh) : nullptr);
  }
  touched_ = std::move(now);
}

void GpuInstant::Record(VkCommandBuffer commands) {
  if (built_) return;
  RecordBodies(commands);
  RecordTop(commands);
  built_ = true;
}

void GpuInstant::RecordBodies(VkCommandBuffer commands) {
  // All in one call, so that the GPU builds them side by side.
  const auto count = static_cast<size_t>(std::ranges::count_if(bodies_, [](const auto& b) { return b.second.changed; }));
  if (count == 0) return;
  const auto builds = std::make_unique<MeshBuild[]>(count);
  std::vector<VkAccelerationStructureBuildGeometryInfoKHR> infos;
  std::vector<const VkAccelerationStructureBuildRangeInfoKHR*> ranges;
  for (auto& [mesh, body] : bodies_) {
    if (!body.changed) continue;
    const bool anew = body.refits < 0 || body.refits + 1 >= kRefitsOfABuild;
    MeshBuild& build = builds[infos.size()];
    scene_.Describe(mesh, body.vertices.address, kBodyFlags,
                    anew ? VK_BUILD_ACCELERATION_STRUCTURE_MODE_BUILD_KHR : VK_BUILD_ACCELERATION_STRUCTURE_MODE_UPDATE_KHR, build);
    build.info.srcAccelerationStructure = anew ? VK_NULL_HANDLE : body.structure;
    build.info.dstAccelerationStructure = body.structure;
    build.info.scratchData.deviceAddress = body.scratch;
    infos.push_back(build.info);
    ranges.push_back(build.ranges.data());
    body.refits = anew ? 0 : body.refits + 1;
    body.changed = false;
  }
  device_.rt().build(commands, static_cast<uint32_t>(count), infos.data(), ranges.data());
  Barrier(commands, VK_PIPELINE_STAGE_ACCELERATION_STRUCTURE_BUILD_BIT_KHR, VK_ACCESS_ACCELERATION_STRUCTURE_READ_BIT_KHR);
}

void GpuInstant::RecordTop(VkCommandBuffer commands) {
  VkAccelerationStructureGeometryKHR geometry;
  VkAccelerationStructureBuildGeometryInfoKHR info;
  DescribeTop(geometry, structures_.address(), info);
  info.dstAccelerationStructure = tlas_;
  info.scratchData.deviceAddress = Up(scratch_.address(), ScratchAlign(device_));
  const VkAccelerationStructureBuildRangeInfoKHR range{static_cast<uint32_t>(scene_.scene().instances.size()), 0, 0, 0};
  const VkAccelerationStructureBuildRangeInfoKHR* ranges = &range;
  device_.rt().build(commands, 1, &info, &ranges);
  Barrier(commands, VK_PIPELINE_STAGE_RAY_TRACING_SHADER_BIT_KHR, VK_ACCESS_ACCELERATION_STRUCTURE_READ_BIT_KHR);
}

}  // namespace airsim360::internal
