// Waypoints for collecting: over an area, around a place, along a line of travel.
#pragma once

#include <vector>

#include "airsim360/math/vector.h"

namespace airsim360 {

struct CoverageArea {
  Vec2d min, max;       ///< metres in W
  double height = 20;   ///< z of the flight
  double spacing = 10;  ///< metres between neighbouring lanes, at most
  double heading = 0;   ///< radians, direction of the lanes
};
/// Lanes back and forth over a rectangle ("lawn-mower"): no point of it is farther than spacing / 2 from a
/// lane. InputError for an area or a spacing that is not positive, or more than 10,000 lanes.
std::vector<Vec3d> CoverageRoute(const CoverageArea& area);

struct Orbit {
  Vec3d center;
  double radius = 10;
  double turns = 1;  ///< positive: counter-clockwise seen from above
  double climb = 0;  ///< metres gained over all turns
  double start = 0;  ///< radians, where it begins
  int points_per_turn = 12;
};
/// Waypoints on a circle or helix around a place. InputError for a radius or turns that are not positive
/// (turns: not zero).
std::vector<Vec3d> OrbitRoute(const Orbit& orbit);

}  // namespace airsim360
