#include "airsim360/render/frame/label_tables.h"

#include <algorithm>
#include <map>
#include <utility>

namespace airsim360::internal {
namespace {

// Entity of every primitive of a slot (0 = the instance's own), from the parts of the mesh.
void AddPrimitiveEntities(const Mesh& mesh, const HitSlot& slot, std::vector<uint32_t>& out) {
  size_t part = 0;
  for (uint32_t i = 0; i < slot.primitive_count; ++i) {
    const uint32_t triangle = slot.triangles == nullptr ? i : slot.triangles[i];
    while (triangle - mesh.parts[part].first_triangle >= mesh.parts[part].triangle_count) ++part;
    out.push_back(mesh.parts[part].entity);
  }
}

bool HasEntities(const Mesh& mesh) {
  return std::ranges::any_of(mesh.parts, [](const MeshPart& part) { return part.entity != kNoEntity; });
}

void SetNormalMatrix(const Mat3f& A, float* out) {
  const Vec3f a = A.column(0), b = A.column(1), c = A.column(2);
  const Mat3f cofactor = Mat3f::FromColumns(Cross(b, c), Cross(c, a), Cross(a, b));
  for (int i = 0; i < 9; ++i) out[i] = cofactor.m[i / 3][i % 3];
}

}  // namespace

LabelTables::LabelTables(const RayTracer& tracer)
    : first_slot_(tracer.first_slots().begin(), tracer.first_slots().end()),
      entities_(1, kNoEntity),
      sky_entity_(tracer.scene().sky_entity) {
  const Scene& scene = tracer.scene();
  // Instances of one mesh share the tables of its geometries, told apart by their triangle lists.
  std::map<std::pair<MeshId, const uint32_t*>, std::pair<uint32_t, uint32_t>> bases;
  slots_.reserve(tracer.slots().size());
  for (const HitSlot& slot : tracer.slots()) {
    const Instance& instance = scene.instances[slot.instance];
    const Mesh& mesh = scene.meshes[instance.mesh];
    const auto [entry, is_new] = bases.try_emplace({instance.mesh, slot.triangles});
    if (is_new) {
      auto& [entity_base, triangle_base] = entry->second;
      entity_base = 0;
      if (HasEntities(mesh)) {
        entity_base = static_cast<uint32_t>(entities_.size());
        AddPrimitiveEntities(mesh, slot, entities_);
      }
      triangle_base = kMiss;
      if (slot.triangles != nullptr) {
        triangle_base = static_cast<uint32_t>(triangles_.size());
        triangles_.insert(triangles_.end(), slot.triangles, slot.triangles + slot.primitive_count);
      }
    }
    SlotLabels labels{};
    labels.entity_base = entry->second.first;
    labels.entity_mask = labels.entity_base == 0 ? 0 : ~0u;
    labels.entity = instance.entity;
    labels.instance = slot.instance;
    labels.triangle_base = entry->second.second;
    SetNormalMatrix(slot.normal_in_world ? Mat3f() : instance.X_WM.A, labels.normal_matrix);
    slots_.push_back(labels);
  }
  category_.push_back(kVoid);
  for (const Entity& entity : scene.entities) category_.push_back(entity.category);

  // Misses look up the first element of everything.
  if (first_slot_.empty()) first_slot_.push_back(0);
  if (slots_.empty()) slots_.emplace_back();
  if (triangles_.empty()) triangles_.push_back(0);
  entities_.shrink_to_fit();
  triangles_.shrink_to_fit();
}

void LabelTables::Place(uint32_t instance, const Mat3f& normal_frame) {
  // Slots are in the order of their instances.
  auto slot = std::ranges::lower_bound(slots_, instance, {}, &SlotLabels::instance);
  for (; slot != slots_.end() && slot->instance == instance; ++slot) SetNormalMatrix(normal_frame, slot->normal_matrix);
}

void LabelTables::Apply(const RayTracer& tracer) {
  const Scene& scene = tracer.scene();
  for (uint32_t i : moved_) {
    auto slot = std::ranges::lower_bound(tracer.slots(), i, {}, &HitSlot::instance);
    Place(i, slot->normal_in_world ? Mat3f() : scene.instances[i].X_WM.A);
  }
  moved_.clear();
  for (const MovedInstance& m : tracer.moved()) {
    Place(m.instance, m.X_WM.A);
    moved_.push_back(m.instance);
  }
}

LabelView LabelTables::view() const {
  return {first_slot_.data(), slots_.data(), entities_.data(), triangles_.data(), category_.data(), sky_entity_};
}

}  // namespace airsim360::internal
