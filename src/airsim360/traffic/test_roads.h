// Roads for tests.
#pragma once

#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include "airsim360/traffic/near_misses.h"
#include "airsim360/traffic/traffic.h"

namespace airsim360 {

/// One lane in a circle of `length` metres, of two pieces.
inline std::shared_ptr<const RoadNetwork> RingRoad(double length, float speed) {
  auto roads = std::make_shared<RoadNetwork>();
  const double radius = length / (2 * std::numbers::pi);
  const int steps = static_cast<int>(length / 4);
  for (int half = 0; half < 2; ++half) {
    Lane lane{.points = {}, .speed = speed, .next = {static_cast<LaneId>(1 - half)}};
    for (int i = 0; i <= steps / 2; ++i) {
      const double a = std::numbers::pi * (half + 2.0 * i / (steps / 2 * 2));
      lane.points.push_back({static_cast<float>(radius * std::cos(a)), static_cast<float>(radius * std::sin(a)), 0});
    }
    roads->lanes.push_back(lane);
  }
  return roads;
}

/// A street of `length` metres from west to east and back again, far away; at `junction` metres a way of 10 m with a signal,
/// if there are phases.
inline std::shared_ptr<const RoadNetwork> Street(double junction, std::vector<SignalPhase> phases) {
  auto roads = std::make_shared<RoadNetwork>();
  const auto at = [](double x, double y) { return Vec3f{static_cast<float>(x), static_cast<float>(y), 0}; };
  roads->lanes = {{.points = {at(0, 0), at(junction, 0)}, .speed = 13.9f, .next = {1}},
                  {.points = {at(junction, 0), at(junction + 10, 0)}, .speed = 13.9f, .next = {2}, .junction = 0, .signal = 0},
                  {.points = {at(junction + 10, 0), at(2000, 0), at(2000, 3000), at(0, 3000), at(0, 0)}, .speed = 13.9f, .next = {0}}};
  roads->junctions = {{.center = at(junction + 5, 0), .radius = 5, .phases = std::move(phases)}};
  return roads;
}

/// A street from west to east at whose end, 100 m along, one way goes straight on (lane 1) and one turns right with a radius of
/// 10 m (lane 2); both lead back far away.
inline std::shared_ptr<const RoadNetwork> Fork() {
  auto roads = std::make_shared<RoadNetwork>();
  const auto at = [](double x, double y) { return Vec3f{static_cast<float>(x), static_cast<float>(y), 0}; };
  Lane turn{.points = {}, .speed = 6, .next = {4}, .junction = 0};
  for (int i = 0; i <= 16; ++i) {
    const double a = std::numbers::pi / 2 * i / 16;
    turn.points.push_back(at(100 + 10 * std::sin(a), -10 + 10 * std::cos(a)));
  }
  roads->lanes = {{.points = {at(0, 0), at(100, 0)}, .speed = 13.9f, .next = {1, 2}},
                  {.points = {at(100, 0), at(130, 0)}, .speed = 13.9f, .next = {3}, .junction = 0},
                  turn,
                  {.points = {at(130, 0), at(2000, 0), at(2000, 3000), at(0, 3000), at(0, 0)}, .speed = 13.9f, .next = {0}},
                  {.points = {at(110, -10), at(110, -2000), at(-500, -2000), at(-500, 0), at(0, 0)}, .speed = 13.9f, .next = {0}}};
  roads->junctions = {{.center = at(110, 0), .radius = 20, .phases = {}}};
  return roads;
}

/// Two lanes to the east, and ways back of their own.
inline std::shared_ptr<const RoadNetwork> TwoLanes() {
  auto roads = std::make_shared<RoadNetwork>();
  roads->lanes = {{.points = {{0, 0, 0}, {600, 0, 0}}, .next = {2}, .right = 1},
                  {.points = {{0, -3.2f, 0}, {600, -3.2f, 0}}, .next = {3}, .left = 0},
                  {.points = {{600, 0, 0}, {600, 2000, 0}, {0, 2000, 0}, {0, 0, 0}}, .next = {0}},
                  {.points = {{600, -3.2f, 0}, {600, -2000, 0}, {0, -2000, 0}, {0, -3.2f, 0}}, .next = {1}}};
  return roads;
}

inline TrafficModel ModelOf(std::shared_ptr<const RoadNetwork> roads, size_t count, uint64_t seed = 1) {
  return {.lanes = LaneMap(std::move(roads)), .vehicles = std::vector<TrafficVehicle>(count), .seed = seed};
}

/// What a vehicle covers of a level street.
inline internal::GroundBox FootprintOf(const TrafficModel& model, const TrafficState& state, size_t vehicle) {
  const RigidTransform X = PoseOf(model, state, vehicle, state.t_ns);
  const VehicleShape& shape = model.vehicles[vehicle].shape;
  return {{X.p.x, X.p.y}, {X.R.column(0).x, X.R.column(0).y}, shape.length / 2, shape.width / 2};
}

inline void Drive(const TrafficModel& model, double seconds, TrafficState& state, std::span<const TrafficObstacle> obstacles = {}) {
  for (int64_t end = state.t_ns + static_cast<int64_t>(seconds * 1e9); state.t_ns < end;) TickTraffic(model, obstacles, state);
}

}  // namespace airsim360
