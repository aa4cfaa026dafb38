// The thing that a surface belongs to.
#pragma once

#include <algorithm>

#include "airsim360/trace/ray_tracer.h"

namespace airsim360 {

/// kNoEntity where it belongs to none.
inline EntityId EntityAt(const Scene& scene, const SurfaceRef& surface) {
  const Instance& instance = scene.instances[surface.instance];
  const auto& parts = scene.meshes[instance.mesh].parts;
  const auto after = std::ranges::upper_bound(parts, surface.triangle, {}, &MeshPart::first_triangle);
  if (after != parts.begin() && std::prev(after)->entity != kNoEntity) return std::prev(after)->entity;
  return instance.entity;
}

}  // namespace airsim360
