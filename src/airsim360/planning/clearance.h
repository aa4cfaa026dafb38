// What planning knows of a world: how far the nearest surface is.
#pragma once

#include <algorithm>

#include "airsim360/math/vector.h"

namespace airsim360 {

/// Axis-aligned box in double precision, metres in W.
struct Box3d {
  Vec3d min, max;
  bool Contains(Vec3d p) const { return p.x >= min.x && p.x <= max.x && p.y >= min.y && p.y <= max.y && p.z >= min.z && p.z <= max.z; }
};

/// Distances to the surfaces of a world. Implementations are immutable and may be asked by several threads.
class ClearanceQuery {
 public:
  virtual ~ClearanceQuery() = default;
  /// Metres from p (in W) to the nearest surface, at most `max_distance`; exact but for rounding, so that it
  /// changes by at most the distance between two points.
  virtual double Clearance(Vec3d p_W, double max_distance) const = 0;
  /// A number not above Clearance(p_W, infinity), cheaper where it can be at least `enough`: implementations
  /// with a coarse bound return that one if it suffices, else Clearance(p_W, max_distance).
  virtual double LowerBound(Vec3d p_W, double enough, double max_distance) const {
    (void)enough;
    return Clearance(p_W, max_distance);
  }
};

/// Another query inside a box whose sides count as surfaces seen from within; 0 outside.
class BoundedClearance : public ClearanceQuery {
 public:
  /// `inner` must outlive this.
  BoundedClearance(const ClearanceQuery& inner, const Box3d& box) : inner_(inner), box_(box) {}
  double Clearance(Vec3d p, double max_distance) const override {
    const double room = Room(p);
    return room > 0 ? inner_.Clearance(p, std::min(room, max_distance)) : 0;
  }
  double LowerBound(Vec3d p, double enough, double max_distance) const override {
    const double room = Room(p);
    return room > 0 ? std::min(room, inner_.LowerBound(p, enough, std::min(room, max_distance))) : 0;
  }
  const Box3d& box() const { return box_; }

 private:
  double Room(Vec3d p) const {
    const Vec3d room = Min(p - box_.min, box_.max - p);
    return std::min({room.x, room.y, room.z});
  }
  const ClearanceQuery& inner_;
  Box3d box_;
};

}  // namespace airsim360
