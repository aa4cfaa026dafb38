// All lamps of a scene (emissive triangles in groups), and choosing among many of them.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "airsim360/render/shading/surface_tables.h"
#include "airsim360/scene/environment.h"
#include "airsim360/scene/scene.h"

namespace airsim360::internal {

/// A point on a lamp chosen for a shaded point.
struct LightSample {
  Vec3f p;         ///< in W
  Vec3f normal;    ///< of the lamp there
  Vec3f radiance;  ///< towards the shaded point
  float pdf;       ///< per area of the lamp, all choices included; 0 = no lamp matters here
};

/// Immutable.
class LightTable {
 public:
  LightTable(const Scene& scene, const SurfaceTables& tables, const Environment& environment);
  bool empty() const;
  size_t size() const;  ///< lamps
  /// Chooses by estimated contribution (power, distance, orientation); u in [0, 1)^3.
  LightSample Sample(Vec3f p, Vec3f normal, Vec3f u) const;
  /// Density, per area, with which Sample at (p, normal) gives a point of this triangle; for multiple
  /// importance sampling.
  float Pdf(Vec3f p, Vec3f normal, uint32_t instance, uint32_t triangle) const;

 private:
  struct Impl;
  std::unique_ptr<const Impl> impl_;
};

}  // namespace airsim360::internal
