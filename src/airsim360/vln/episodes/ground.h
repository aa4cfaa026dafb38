// What is where in a world, asked with rays. For the .cc files of this folder.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "airsim360/routes/world_clearance.h"
#include "airsim360/trace/ray_tracer.h"

namespace airsim360::internal {

struct GroundHit {
  double z = 0;
  EntityId entity = kNoEntity;
};

/// Of a tracer without people and bodies. Immutable.
class VlnGround {
 public:
  explicit VlnGround(std::shared_ptr<const RayTracer> tracer);
  const std::shared_ptr<const RayTracer>& tracer() const { return tracer_; }
  const Scene& scene() const { return tracer_->scene(); }
  const Box3d& flight_box() const { return box_; }
  /// Where places are drawn: the flight box, of a building in the open its rooms.
  const Box3d& inhabited() const { return inhabited_; }
  /// Flights are within rooms: of a scene without a sky, or of a building in the open whose first viewpoint is below a ceiling.
  bool rooms() const { return rooms_; }
  /// Something is above a point.
  bool IsCovered(Vec3d p) const { return tracer_->Intersect(VecCast<float>(p), {0, 0, 1}).has_value(); }
  /// The first surface below a point; nullopt where there is none.
  std::optional<GroundHit> Below(Vec3d p) const;
  /// The first surface seen from high above a place.
  std::optional<GroundHit> At(double x, double y) const { return Below({x, y, top_}); }
  bool Is(EntityId entity, const char* category) const;
  /// A ball of `radius` is free there, inside where flights are; where those are in rooms, below a ceiling.
  bool IsFree(Vec3d p, double radius) const;
  /// What the segment meets first; kNoEntity: nothing.
  EntityId Meets(Vec3d from, Vec3d to) const;

 private:
  std::shared_ptr<const RayTracer> tracer_;
  Box3d box_, inhabited_;
  double top_;
  bool rooms_;
};

}  // namespace airsim360::internal
