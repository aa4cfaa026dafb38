// Omni360-WayPoint: random flights through worlds, each proved within its limits and free of collisions.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "airsim360/planning/routes/point_to_point.h"
#include "airsim360/planning/routes/random_route.h"
#include "airsim360/scene/scene.h"
#include "airsim360/stage/stage.h"

namespace airsim360 {

/// One world of the set: how many routes, and how long their flights are.
struct WaypointWorld {
  std::string name;
  int64_t routes;
  double min_length, max_length;  ///< metres
};
/// Limits of a flight and the interval of its samples: a route is flown once with each.
struct KinematicSet {
  std::string name;
  double max_acceleration, max_speed, interval;
};
/// The paper's tables (City Park 20,000 routes of 50-150 m, …). Worlds that do not exist yet join by name.
const std::vector<WaypointWorld>& WaypointWorlds();
const std::vector<KinematicSet>& KinematicSets();

/// A world ready for drawing routes: distances, map, and what can be reached from the spawn.
class WaypointSpace {
 public:
  /// InputError if nothing can be reached.
  WaypointSpace(Stage& stage, double radius);
  const BoundedClearance& world() const { return *world_; }
  const ClearanceField& map() const { return *map_; }
  const ReachableSpace& reachable() const { return *reachable_; }

 private:
  std::shared_ptr<const ClearanceField> map_;
  std::unique_ptr<ClearanceQuery> clearance_;
  std::unique_ptr<BoundedClearance> world_;
  std::unique_ptr<ReachableSpace> reachable_;
};

/// One route, flown with every kinematic set.
struct WaypointRoute {
  std::vector<Vec3d> waypoints;          ///< as drawn
  std::vector<CertifiedFlight> flights;  ///< by kinematic set, all certified
  std::vector<double> lengths;           ///< metres, of the flights
};
/// A pure function of its arguments. RuntimeError if no draw succeeds.
WaypointRoute MakeWaypointRoute(const WaypointSpace& space, const WaypointWorld& world, uint64_t seed, int64_t index, double radius);

struct WaypointSetOptions {
  std::filesystem::path out;
  uint64_t seed = 0;
  int64_t shard = 0, shards = 1;
  int64_t most_routes = 0;               ///< of each world; 0 = as many as the paper has
  double radius = 0.5;                   ///< metres to keep from every surface
  std::vector<std::string> worlds = {};  ///< only these; empty = all of the table
  std::function<bool(const std::string&)> exists = {};
  std::function<std::shared_ptr<Stage>(const std::string&)> open = {};
};
struct WaypointSetResult {
  int64_t flights = 0, written = 0;  ///< of this shard; written by this run
  std::vector<std::string> skipped;  ///< worlds that do not exist
  bool complete = false;             ///< all parts of all shards are there: index and statistics are written
  double planning_s = 0;             ///< wall clock of routes, flights and certificates
  double preparing_s = 0;            ///< and of worlds and maps
};

/// Writes OUT/WORLD/SET/part-NNNN.npz and .csv, 500 routes a part; shard I does the parts with number % N ==
/// I, skips those that are there, and the run that finds all parts done writes index.csv, statistics.json,
/// README.md and pictures. The bytes depend on seed, radius and counts only. InputError if OUT holds a set
/// made with other options; RuntimeError if writing fails.
WaypointSetResult WriteWaypointSet(const WaypointSetOptions& options);

}  // namespace airsim360
