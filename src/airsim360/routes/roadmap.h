// Free places of a scene and the free straight ways between them.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "airsim360/trace/ray_tracer.h"

namespace airsim360 {

/// Ground seen from above, metres in W.
struct Box2d {
  Vec2d min, max;
};

/// The part of a scene where its things stand: the cells of a town that hold most of them, or a box around a single model or
/// a room.
struct SurveyedGround {
  std::vector<Vec2d> cells;  ///< south-west corners; empty: the box counts
  Box3f box;
  /// The point at (u, v) in [0, 1)^2: equal areas are equally likely.
  Vec2d At(double u, double v) const;
};
SurveyedGround FindSurveyedGround(const Scene& scene);

/// The k-th number of three sequences that fill the unit cube evenly (axis 0 … 2), each begun at an offset in [0, 1).
double LowDiscrepancy(uint64_t k, int axis, double offset);

/// Box around the cells of the ground that hold most of the things of everyday size; around a single model in
/// the open, its box and some way around it.
Box2d InhabitedGround(const Scene& scene);

/// Where to look for free places.
struct PlaceOptions {
  uint64_t seed = 0;
  double radius = 1;                         ///< metres free around a place
  double min_height = 1.6, max_height = 60;  ///< metres above the ground
  int candidates = 900;                      ///< places tried
};

/// Free places at heights from low to high, denser near the ground, the scene's spawn first if it is free. In
/// a town they are spread over the cells of the ground that hold most of the things of everyday size (a far
/// horizon is left out) and have something below them; around a single model in the open, or in a room, over
/// its box. A pure function of scene and options.
std::vector<Vec3d> FindFreePlaces(const RayTracer& tracer, const PlaceOptions& options);

/// True if a ball of `radius` can move along the segment. Its free distance is measured at most 0.1 m apart
/// where it is tight.
bool IsFree(const RayTracer& tracer, Vec3d a, Vec3d b, double radius);

struct Roadmap {
  std::vector<Vec3d> places;
  std::vector<std::vector<std::pair<int, double>>> ways;  ///< from each place: (place, cost)
};

/// Connects each place with its nearest ones where a ball of `radius` can move between them. The cost of a
/// way is its length, more at height, so that shortest ways follow the streets.
Roadmap Connect(const RayTracer& tracer, std::vector<Vec3d> places, double radius);

/// Cheapest ways from one place to all (Dijkstra).
struct CheapestWays {
  std::vector<double> cost;   ///< infinite where there is none
  std::vector<int> previous;  ///< place before, -1 at the start and where there is no way
};
CheapestWays FindCheapestWays(const Roadmap& map, int from);

/// The cheapest way to `to` for a ball of `radius` with corners cut where the straight way is free; the place where `ways` begin is
/// left out. Empty where no way leads.
std::vector<Vec3d> ShortWay(const RayTracer& tracer, const Roadmap& map, const CheapestWays& ways, size_t to, double radius);

}  // namespace airsim360
