// How people on foot meet vehicles: they wait for those that come, walk around those that stand, and get out of the way.
#pragma once

#include <span>
#include <vector>

#include "airsim360/people/crowd/crowd.h"
#include "airsim360/people/crowd/orca.h"

namespace airsim360::internal {

/// Someone on foot who looks at vehicles.
struct Pedestrian {
  NavPoint at;
  Vec2d p;
  Vec2d wanted;        ///< m/s
  double rest = 0;     ///< metres to where they go; 0 = unknown
  double seconds = 3;  ///< how far ahead they look
};

/// What they do about them.
struct Dodge {
  Vec2d wanted;          ///< m/s
  bool waits = false;    ///< until one has passed
  bool escapes = false;  ///< out of the way of one, perhaps faster than they like to walk
};

/// The vehicles of a tick.
class Vehicles {
 public:
  explicit Vehicles(std::span<const CrowdVehicle> vehicles);

  /// Those that somebody at p may meet while they look ahead, in a fixed order. Empty for nearly all.
  std::vector<const CrowdVehicle*> Near(Vec2d p, double z) const;

 private:
  struct Sorted {
    Vec2d middle;  // of all places where it will be
    double reach;  // metres around the middle
    const CrowdVehicle* vehicle;
  };
  std::vector<Sorted> sorted_;  // by x
  double widest_ = 0;           // metres: the longest reach
};

Dodge DodgeVehicles(std::span<const CrowdVehicle* const> near, const NavMesh& mesh, const Pedestrian& self);

/// The velocities that keep a body out of a vehicle. False: it is too far away to matter.
bool KeepOut(const CrowdVehicle& vehicle, Vec2d p, HalfPlane& plane);

/// Metres from p to the side of a vehicle now; negative inside.
double DistanceTo(const CrowdVehicle& vehicle, Vec2d p);

}  // namespace airsim360::internal
