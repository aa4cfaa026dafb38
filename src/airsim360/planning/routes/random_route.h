// Random sparse waypoints as a collector would give them: reachable, with clear legs, of a given length.
#pragma once

#include <optional>
#include <vector>

#include "airsim360/base/random.h"
#include "airsim360/planning/clearance_field.h"
#include "airsim360/planning/routes/reachable.h"

namespace airsim360 {

struct RandomRouteOptions {
  double min_length = 50, max_length = 150;  ///< metres along the legs
  double room = 1.5;                         ///< metres that the legs keep from every surface
  double min_height = 2, max_height = 40;    ///< of the first waypoint above what is below it
  int min_legs = 2, max_legs = 6;
};

/// Waypoints whose first is in the reachable space of `field` and whose legs are clear in `world`, which may
/// know gaps that the map is too coarse for; nullopt if this draw led nowhere (draw again). A pure function
/// of the arguments and the state of `random`.
std::optional<std::vector<Vec3d>> DrawRoute(const ClearanceField& field, const ReachableSpace& space, const ClearanceQuery& world,
                                            const RandomRouteOptions& options, RngStream& random);

}  // namespace airsim360
