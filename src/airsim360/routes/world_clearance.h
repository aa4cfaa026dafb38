// The world as planning sees it: distances to its real surfaces, a coarse map of it, and where flights may
// be.
#pragma once

#include <memory>

#include "airsim360/planning/clearance.h"
#include "airsim360/planning/clearance_field.h"
#include "airsim360/trace/ray_tracer.h"

namespace airsim360 {

/// Exact distances from a ray tracer (less a bound of its rounding), answered from a coarse map where that is
/// enough. The map may be null.
class WorldClearance : public ClearanceQuery {
 public:
  WorldClearance(std::shared_ptr<const RayTracer> tracer, std::shared_ptr<const ClearanceField> field);
  double Clearance(Vec3d p_W, double max_distance) const override;
  double LowerBound(Vec3d p_W, double enough, double max_distance) const override;
  const RayTracer& tracer() const { return *tracer_; }
  const ClearanceField* field() const { return field_.get(); }

 private:
  std::shared_ptr<const RayTracer> tracer_;
  std::shared_ptr<const ClearanceField> field_;
};

/// Map of everything in `box` that a scene holds. The voxel grows until there are at most 64 million.
std::shared_ptr<const ClearanceField> MapScene(const Scene& scene, const Box3d& box, double voxel);

/// Where flights may be: over the ground where the things of the world are, up to `ceiling` metres above the
/// highest of them; the whole of a closed room; around a single model in the open.
Box3d FlightBox(const RayTracer& tracer, double ceiling = 30);

/// InputError naming the point unless it has ground below, in worlds that have ground.
void CheckAboveGround(const RayTracer& tracer, Vec3d p, const std::string& name);

}  // namespace airsim360
