#include "airsim360/traffic/obstacles.h"

#include <algorithm>
#include <cmath>

namespace airsim360::internal {
namespace {

constexpr double kMargin = 0.35;  // metres beside the body
constexpr double kHeight = 2.5;   // metres above or below the street that no longer concern it

}  // namespace

ObstacleGrid::ObstacleGrid(std::span<const TrafficObstacle> obstacles) {
  for (const TrafficObstacle& obstacle : obstacles) {
    now_.Add(obstacle.p, obstacle.radius);
    // Where it will be, too: those who step off the kerb are seen before.
    for (const double seconds : {0.0, 0.8, 1.6}) {
      discs_.Add(obstacle.p + obstacle.v * seconds, obstacle.radius);
      if (Dot(obstacle.v, obstacle.v) < 0.01) break;
    }
  }
  discs_.Sort();
  now_.Sort();
}

bool ObstacleGrid::Touches(const TrafficModel& model, const DrivingVehicle& self, const VehicleShape& shape) const {
  // Discs along the body that are as wide as it is, from nose to tail.
  const double r = shape.width / 2, first = -r, last = r - shape.length;
  const int steps = std::max(1, static_cast<int>(std::ceil((first - last) / r)));
  for (int k = 0; k <= steps; ++k)
    if (now_.Meets(AlongWay(model, self, first + (last - first) * k / steps).p, r, kHeight)) return true;
  return false;
}

double ObstacleGrid::GapAhead(const TrafficModel& model, const TrafficState& state, uint32_t vehicle, double reach) const {
  if (discs_.empty()) return INFINITY;
  const DrivingVehicle& self = state.vehicles[vehicle];
  const VehicleShape& shape = model.vehicles[vehicle].shape;
  const double half_width = shape.width / 2;
  if (Touches(model, self, shape)) return 0;
  for (double ahead = 0.5; ahead <= reach; ahead += 1)
    if (discs_.Meets(AlongWay(model, self, ahead + half_width).p, half_width + kMargin, kHeight)) return ahead - 0.5;
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
