#include <algorithm>
#include <string>

#include "airsim360/base/error.h"
#include "airsim360/dataset/waypoint_set.h"
#include "airsim360/planning/arc_length.h"
#include "airsim360/routes/world_clearance.h"

namespace airsim360 {

const std::vector<WaypointWorld>& WaypointWorlds() {
  static const std::vector<WaypointWorld> worlds = {
      {"city_park", 20'000, 50, 150}, {"downtown_west", 5'000, 20, 50}, {"new_york_city", 5'000, 20, 50}, {"sf_city", 20'000, 50, 150}};
  return worlds;
}

const std::vector<KinematicSet>& KinematicSets() {
  static const std::vector<KinematicSet> sets = {{"a3_v16_t0.5", 3, 16, 0.5}, {"a5_v21_t1", 5, 21, 1}};
  return sets;
}

WaypointSpace::WaypointSpace(Stage& stage, double radius) {
  constexpr double kVoxel = 0.5;
  const auto tracer = stage.solid();
  const Scene& scene = stage.scene();
  const Box3d box = FlightBox(*tracer);
  map_ = MapScene(scene, box, kVoxel);
  clearance_ = std::make_unique<WorldClearance>(tracer, map_);
  world_ = std::make_unique<BoundedClearance>(*clearance_, box);
  const Vec3d spawn =
      scene.spawn ? VecCast<double>(*scene.spawn) : Vec3d{(box.min.x + box.max.x) / 2, (box.min.y + box.max.y) / 2, box.max.z - 5};
  reachable_ = std::make_unique<ReachableSpace>(*map_, spawn, radius);
  if (reachable_->volume() == 0) throw InputError("world '" + scene.name + "': nothing can be reached from its spawn");
}

namespace {

constexpr int kDraws = 400;           // of a route before it is given up
constexpr int kCorrections = 4;       // rounds of adding waypoints before another draw is cheaper
constexpr double kSpare = 0.25;       // metres that the legs keep beyond the radius, for the curves
constexpr double kCurveShare = 0.97;  // legs are drawn a little shorter than their curves may be long

}  // namespace

WaypointRoute MakeWaypointRoute(const WaypointSpace& space, const WaypointWorld& world, uint64_t seed, int64_t index, double radius) {
  const RandomRouteOptions draw{.min_length = world.min_length,
                                .max_length = world.max_length * kCurveShare,
                                .room = radius + kSpare,
                                .min_legs = 2,
                                .max_legs = world.max_length > 60 ? 6 : 4};
  RngStream random(seed, "waypoint set " + world.name, static_cast<uint64_t>(index));
  for (int i = 0; i < kDraws; ++i) {
    auto waypoints = DrawRoute(space.map(), space.reachable(), space.world(), draw, random);
    if (!waypoints) continue;
    WaypointRoute route;
    for (const KinematicSet& set : KinematicSets()) {
      const FlightOptions options{.limits = {.speed = set.max_speed, .acceleration = set.max_acceleration},
                                  .allocation = {.sample_interval = set.interval},
                                  .radius = radius,
                                  .rounds = kCorrections};
      CertifiedFlight flight = FlyThrough(*waypoints, space.world(), options);
      const double length = ArcLength(flight.flight.trajectory);
      if (!flight.certificate.certified || length < world.min_length || length > world.max_length) break;
      route.flights.push_back(std::move(flight));
      route.lengths.push_back(length);
    }
    if (route.flights.size() < KinematicSets().size()) continue;
    route.waypoints = std::move(*waypoints);
    return route;
  }
  throw RuntimeError("waypoint set: no free route " + std::to_string(index) + " in '" + world.name + "' among " + std::to_string(kDraws) +
                     " draws");
}

}  // namespace airsim360
