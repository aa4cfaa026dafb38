// Where rain, snow and fog do not get: under roofs.
#pragma once

#include "airsim360/base/table_vector.h"
#include "airsim360/render/shared/shading_data.h"
#include "airsim360/render/surface/surface_tables.h"
#include "airsim360/trace/ray_tracer.h"

namespace airsim360::internal {

/// Heights of what stops rain, seen along the way that rain falls, over the detailed part of a scene around its spawn. Panes stop
/// it, leaves do not, nor do poles and wires (what is thinner than three texels); roofs reach a texel farther than they do, so
/// that none leaks at its edge. Immutable; the same bytes with any number of threads.
class RoofMap {
 public:
  /// At most `size` texels a side, none smaller than a quarter of a metre. `tracer`: what stands still (StaticTracer).
  RoofMap(const RayTracer& tracer, const SurfaceTables& tables, int size = 1024);

  RoofView view() const;
  /// Whether rain does not get to p.
  bool Hides(Vec3f p) const;

 private:
  void Bake(const RayTracer& tracer, const SurfaceTables& tables, float top);
  void LeaveThinThings();

  int size_ = 0;
  float texel_ = 0;            ///< metres
  float left_ = 0, near_ = 0;  ///< lowest x at z = 0, and y
  TableVector<float> heights_;
};

}  // namespace airsim360::internal
