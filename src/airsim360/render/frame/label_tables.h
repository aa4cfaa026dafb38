// Flat tables from the ids of a hit to entity, category and normal.
#pragma once

#include <cstdint>
#include <vector>

#include "airsim360/trace/ray_tracer.h"

namespace airsim360::internal {

/// From one HitSlot to what labels need.
struct SlotLabels {
  uint32_t entity_base;  ///< the entity of a primitive is entities[entity_base + (primitive & entity_mask)] …
  uint32_t entity_mask;
  uint32_t entity;  ///< … or this where that is 0
  uint32_t instance;
  uint32_t triangle_base;  ///< the triangle is triangles[triangle_base + primitive]; kMiss = primitive itself
  float normal_matrix[9];  ///< row-major, mesh frame to W, up to a positive factor and sign
};

/// What label code needs; pointers into LabelTables. All arrays have at least one element.
struct LabelView {
  const uint32_t* first_slot;
  const SlotLabels* slots;
  const uint32_t* entities;
  const uint32_t* triangles;
  const uint32_t* category_of_entity;
  uint32_t sky_entity;  ///< of rays that hit nothing
};

class LabelTables {
 public:
  explicit LabelTables(const RayTracer& tracer);
  LabelView view() const;
  /// Follows what moves: `tracer` is the one of construction or one that a DynamicTracer made of it. Views
  /// stay valid.
  void Apply(const RayTracer& tracer);

 private:
  void Place(uint32_t instance, const Mat3f& normal_frame);

  std::vector<uint32_t> moved_;  // instances whose slots are not as built
  std::vector<uint32_t> first_slot_, entities_, triangles_, category_;
  std::vector<SlotLabels> slots_;
  uint32_t sky_entity_;
};

}  // namespace airsim360::internal
