// Surfaces that a drone can touch: those of the scene and the boxes of other drones.
#pragma once

#include <span>
#include <vector>

#include "airsim360/flight/collision/contact.h"
#include "airsim360/flight/dynamics/downwash.h"
#include "airsim360/trace/ray_tracer.h"

namespace airsim360 {

/// A drone as others meet it: its box, at the beginning of the step.
struct DroneBox {
  RigidTransform X_WB;
  Vec3d half_size_B;
  Vec3d v_WB;
  double radius = 0;  ///< of a sphere around the box
  size_t vehicle = 0;
  EntityId entity = kNoEntity;
  RotorWake wake = {};
};

/// All drones of a simulation, sorted along x, so that neighbours are found without looking at all.
class DroneBoxes {
 public:
  explicit DroneBoxes(std::vector<DroneBox> boxes);
  /// Calls visit(box) for every box whose sphere comes within `range` of p, but that of vehicle `self`; in
  /// the order of x, then of the vehicles.
  template <class Visit>
  void Near(Vec3d p_W, double range, size_t self, const Visit& visit) const {
    const double reach = range + largest_;
    for (size_t i = FirstFrom(p_W.x - reach); i < boxes_.size() && boxes_[i].X_WB.p.x <= p_W.x + reach; ++i) {
      const DroneBox& box = boxes_[i];
      if (box.vehicle != self && Norm(box.X_WB.p - p_W) <= range + box.radius) visit(box);
    }
  }

 private:
  size_t FirstFrom(double x) const;
  std::vector<DroneBox> boxes_;
  double largest_ = 0;  // radius
};

/// First point of a box on the segment from outside, with its outward normal.
std::optional<SurfacePoint> HitBox(const DroneBox& box, Vec3d from_W, Vec3d to_W);
/// Point of the box's surface nearest to p; also for points inside.
SurfacePoint NearestOnBox(const DroneBox& box, Vec3d p_W);

/// What one drone can touch during one step.
class WorldContacts : public ContactQuery {
 public:
  WorldContacts(const RayTracer& tracer, const DroneBoxes& drones, size_t self) : tracer_(tracer), drones_(drones), self_(self) {}
  std::optional<SurfacePoint> FirstHit(Vec3d from_W, Vec3d to_W) const override;
  std::optional<SurfacePoint> Nearest(Vec3d p_W, double range) const override;

 private:
  const RayTracer& tracer_;
  const DroneBoxes& drones_;
  size_t self_;
};

}  // namespace airsim360
