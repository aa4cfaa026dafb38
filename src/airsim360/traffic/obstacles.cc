#include "airsim360/traffic/obstacles.h"

#include <algorithm>
#include <cmath>

namespace airsim360::internal {
namespace {

constexpr double kCell = 4;       // metres: more than half a vehicle and a person
constexpr double kMargin = 0.35;  // metres beside the body
constexpr double kHeight = 2.5;   // metres above or below the street that no longer concern it

uint64_t CellOf(double x, double y) {
  const auto i = static_cast<int64_t>(std::floor(x / kCell)), j = static_cast<int64_t>(std::floor(y / kCell));
  return (static_cast<uint64_t>(i) << 32) ^ (static_cast<uint64_t>(j) & 0xffffffffu);
}

bool IsPlace(Vec3d p) { return std::abs(p.x) < 1e7 && std::abs(p.y) < 1e7 && std::abs(p.z) < 1e7; }

}  // namespace

ObstacleGrid::ObstacleGrid(std::span<const TrafficObstacle> obstacles) {
  for (const TrafficObstacle& obstacle : obstacles) {
    // Where it will be, too: those who step off the kerb are seen before.
    for (const double seconds : {0.0, 0.8, 1.6}) {
      const Vec3d p = obstacle.p + obstacle.v * seconds;
      if (IsPlace(p)) cells_.push_back({CellOf(p.x, p.y), p, obstacle.radius});
      if (Dot(obstacle.v, obstacle.v) < 0.01) break;
    }
  }
  std::ranges::stable_sort(cells_, {}, &Place::cell);
}

bool ObstacleGrid::Meets(Vec3d p, double half_width) const {
  for (const double dx : {-kCell, 0.0, kCell}) {
    for (const double dy : {-kCell, 0.0, kCell}) {
      const auto found = std::ranges::equal_range(cells_, CellOf(p.x + dx, p.y + dy), {}, &Place::cell);
      for (const Place& place : found) {
        const double reach = half_width + kMargin + place.radius;
        if (std::hypot(place.p.x - p.x, place.p.y - p.y) < reach && std::abs(place.p.z - p.z) < kHeight) return true;
      }
    }
  }
  return false;
}

double ObstacleGrid::GapAhead(const TrafficModel& model, const TrafficState& state, uint32_t vehicle, double reach) const {
  if (cells_.empty()) return INFINITY;
  const DrivingVehicle& self = state.vehicles[vehicle];
  const double half_width = model.vehicles[vehicle].shape.width / 2;
  for (double ahead = 0.5; ahead <= reach; ahead += 1)
    if (Meets(AlongWay(model, self, ahead + half_width).p, half_width)) return ahead - 0.5;
  return INFINITY;
}

LanePoint AlongWay(const TrafficModel& model, const DrivingVehicle& vehicle, double ahead) {
  double s = vehicle.s + ahead;
  LaneId lane = vehicle.lane;
  for (size_t k = 0; k < vehicle.ahead.size() && s > model.lanes.length(lane) && vehicle.ahead[k] != kNoLane; ++k) {
    s -= model.lanes.length(lane);
    lane = vehicle.ahead[k];
  }
  for (size_t k = 0; k < vehicle.behind.size() && s < 0 && vehicle.behind[k] != kNoLane; ++k) {
    lane = vehicle.behind[k];
    s += model.lanes.length(lane);
  }
  return model.lanes.At(lane, s);
}

}  // namespace airsim360::internal
