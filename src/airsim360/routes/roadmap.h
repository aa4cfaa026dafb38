// Free places of a scene and the free straight ways between them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "airsim360/trace/ray_tracer.h"

namespace airsim360 {

/// Ground seen from above, metres in W.
struct Box2d {
  Vec2d min, max;
};

/// A place in a room: heights of its floor and of its ceiling there.
struct RoomSpot {
  Vec2d at;
  double floor = 0, ceiling = 0;
};

/// The part of a scene where its things stand: the cells of a town that hold most of them, or a box around a single model or
/// a room. A building that is entered at its first viewpoint is its rooms.
struct SurveyedGround {
  std::vector<Vec2d> cells;  ///< south-west corners; empty: the box counts
  Box3f box;
  std::vector<Box3f> ceilings;  ///< of the rooms, where there are any
  /// The point at (u, v) in [0, 1)^2: equal areas are equally likely.
  Vec2d At(double u, double v) const;
  bool in_rooms() const { return !ceilings.empty(); }
  /// The same below the ceilings; nullopt where no floor is below one.
  std::optional<RoomSpot> InRoom(const RayTracer& tracer, double u, double v) const;
  /// Whether a point is below one of the ceilings, with something over it.
  bool IsInRoom(const RayTracer& tracer, Vec3d p_W) const;
};
/// Whether a scene has a sky and a ceiling over its first viewpoint: a building that stands in the open, and is meant to be seen from
/// within.
bool BeginsUnderACeiling(const Scene& scene);
SurveyedGround FindSurveyedGround(const Scene& scene);

/// The k-th number of three sequences that fill the unit cube evenly (axis 0 … 2), each begun at an offset in [0, 1).
double LowDiscrepancy(uint64_t k, int axis, double offset);

/// Metres that routes keep from surfaces in rooms at most: with what rounded corners take they fit through the doors of a flat.
inline constexpr double kClearanceInRooms = 0.25;

/// Box around the cells of the ground that hold most of the things of everyday size; around a single model in
/// the open, its box and some way around it.
Box2d InhabitedGround(const Scene& scene);

/// Where to look for free places.
struct PlaceOptions {
  uint64_t seed = 0;
  double radius = 1;                         ///< metres free around a place
  double min_height = 1.6, max_height = 60;  ///< metres above the ground
  int candidates = 900;                      ///< places tried
  std::vector<Vec3d> passages = {};          ///< more places to be tried, such as the middles of doors; they come last
};

/// Free places at heights from low to high, denser near the ground, the scene's spawn first if it is free. In
/// a town they are spread over the cells of the ground that hold most of the things of everyday size (a far
/// horizon is left out) and have something below them; in a building below its ceilings, heights counted from
/// each floor; around a single model in the open, or in a closed room, over its box. A pure function of scene and options.
std::vector<Vec3d> FindFreePlaces(const RayTracer& tracer, const PlaceOptions& options);

/// Why a place cannot be flown from or to: "is outside the world", "is inside of something solid, or below the ground", "is 0.1 m
/// from a surface, less than 0.3 m"; "" if it can. Above everything is still in the world.
std::string PlaceFault(const RayTracer& tracer, Vec3d p_W, double clearance);

/// True if a ball of `radius` can move along the segment. Its free distance is measured at most 0.1 m apart
/// where it is tight.
bool IsFree(const RayTracer& tracer, Vec3d a, Vec3d b, double radius);

struct Roadmap {
  std::vector<Vec3d> places;
  std::vector<std::vector<std::pair<int, double>>> ways;  ///< from each place: (place, cost)
};

/// Connects each place with its nearest ones where a ball of `radius` can move between them. The cost of a
/// way is its length, more at height, so that shortest ways follow the streets. `neighbours`: more where walls stand between places.
inline constexpr int kNeighboursInTowns = 10, kNeighboursInRooms = 30;
Roadmap Connect(const RayTracer& tracer, std::vector<Vec3d> places, double radius, int neighbours = kNeighboursInTowns);

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
