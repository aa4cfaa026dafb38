// The world as planning sees it: distances to its real surfaces, a coarse map of it, and where flights may
// be.
#pragma once

#include <memory>
#include <span>
#include <string>

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

/// What flights between some points must keep clear of: a world with a map of it around them, inside its FlightBox. The map
/// is made when it is first asked for and kept while it holds all points asked for. One thread at a time.
class FlightSpace {
 public:
  explicit FlightSpace(std::shared_ptr<const RayTracer> tracer);
  /// `points`: at least one. Valid until the next call.
  const BoundedClearance& Around(std::span<const Vec3d> points);
  const WorldClearance& clearance() const { return *clearance_; }  ///< after Around

 private:
  std::shared_ptr<const RayTracer> tracer_;
  Box3d limits_, mapped_;
  std::unique_ptr<WorldClearance> clearance_;
  std::unique_ptr<BoundedClearance> bounded_;
};

/// InputError naming the point unless it has ground below, in worlds that have ground.
void CheckAboveGround(const RayTracer& tracer, Vec3d p, const std::string& name);

}  // namespace airsim360
