// What a tracking controller follows: a point of a trajectory with its derivatives.
#pragma once

#include "airsim360/math/vector.h"

namespace airsim360 {

/// In W; derivatives of position up to snap.
struct ReferencePoint {
  Vec3d p, v, a, jerk, snap;
  double yaw = 0, yaw_rate = 0;
};

/// A trajectory by time: planned polynomials and analytic curves alike. Immutable: many drones and threads
/// may ask at once.
class ReferenceTrajectory {
 public:
  virtual ~ReferenceTrajectory() = default;
  /// t in [0, duration()], seconds.
  virtual ReferencePoint At(double t) const = 0;
  virtual double duration() const = 0;
};

/// x = A sin wt, y = A sin wt cos wt about `center`, begun at rest: the phase runs up to w over `ramp`
/// seconds (a septic smooth step of its rate: continuous to snap) and back at the end. The speed
/// is largest, sqrt(2) A w, in the middle.
class Lemniscate : public ReferenceTrajectory {
 public:
  Lemniscate(Vec3d center, double amplitude, double peak_speed, int loops = 1, double ramp = 4);
  ReferencePoint At(double t) const override;
  double duration() const override;
  double ramp() const { return ramp_; }

 private:
  Vec3d center_;
  double amplitude_, w_, ramp_, cruise_;
};

}  // namespace airsim360
