#include "airsim360/traffic/obstacles.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "airsim360/traffic/parking.h"

namespace airsim360::internal {
namespace {

constexpr double kMargin = 0.35;        // metres beside the body
constexpr double kTightMargin = -0.15;  // beside those who stand, at a walking pace: they turn a shoulder away
constexpr double kStandsStill = 0.01;   // m^2/s^2
constexpr double kHeight = 2.5;         // metres above or below the street that no longer concern it

}  // namespace

ObstacleGrid::ObstacleGrid(std::span<const TrafficObstacle> obstacles) {
  for (const TrafficObstacle& obstacle : obstacles) {
    const bool stands = Dot(obstacle.v, obstacle.v) < kStandsStill;
    (stands ? standing_ : walking_).Add(obstacle.p, obstacle.radius);
    if (stands) continue;
    // Where it will be, too: those who step off the kerb are seen before.
    for (const double seconds : {0.0, 0.8, 1.6}) coming_.Add(obstacle.p + obstacle.v * seconds, obstacle.radius);
  }
  for (DiscGrid* grid : {&standing_, &walking_, &coming_}) grid->Sort();
}

InTheWay ObstacleGrid::Beside(const TrafficModel& model, const TrafficState& state, uint32_t vehicle) const {
  InTheWay found;
  // Discs along the body that are as wide as it is, from nose to tail: in bends a long one is not where its way is.
  const VehicleShape& shape = model.vehicles[vehicle].shape;
  const RigidTransform X_WB = PoseOf(model, state, vehicle, state.t_ns);
  const double r = shape.width / 2, first = shape.length / 2 - r, last = -first;
  const int steps = std::max(1, static_cast<int>(std::ceil((first - last) / r)));
  for (int k = 0; k <= steps; ++k) {
    const Vec3d p = X_WB.p + X_WB.R.column(0) * (first + (last - first) * k / steps);
    if (standing_.Meets(p, r + kMargin, kHeight)) found.beside = 0;
    if (walking_.Meets(p, r, kHeight) || standing_.Meets(p, r + kTightMargin, kHeight)) return {0, 0};
  }
  return found;
}

bool ObstacleGrid::IsBehind(const TrafficModel& model, const TrafficState& state, uint32_t vehicle, double reach) const {
  const VehicleShape& shape = model.vehicles[vehicle].shape;
  const RigidTransform X_WB = PoseOf(model, state, vehicle, state.t_ns);
  const double r = shape.width / 2;
  for (double back = 0; back <= reach; back += r / 2) {
    const Vec3d p = X_WB.p - X_WB.R.column(0) * (shape.length / 2 - r + back);
    if (standing_.Meets(p, r, kHeight) || coming_.Meets(p, r, kHeight)) return true;
  }
  return false;
}

InTheWay ObstacleGrid::Find(const TrafficModel& model, const TrafficState& state, uint32_t vehicle, double reach) const {
  if (coming_.empty() && standing_.empty()) return {};
  const DrivingVehicle& self = state.vehicles[vehicle];
  const VehicleShape& shape = model.vehicles[vehicle].shape;
  const double half_width = shape.width / 2;
  InTheWay found = Beside(model, state, vehicle);
  for (double ahead = 0.5; ahead <= reach && ahead - 0.5 < found.gap; ahead += 1) {
    const Vec3d p = AlongWay(model, self, shape, ahead + half_width).p;
    if (standing_.Meets(p, half_width + kMargin, kHeight)) found.beside = std::min(found.beside, ahead - 0.5);
    if (coming_.Meets(p, half_width + kMargin, kHeight) || standing_.Meets(p, half_width + kTightMargin, kHeight)) found.gap = ahead - 0.5;
  }
  return found;
}

namespace {

// From one lane to another whose place for bicycles is another: over some metres, not at once.
double AsideAt(const TrafficModel& model, const DrivingVehicle& vehicle, const VehicleShape& shape, LaneId lane, double s) {
  constexpr double kOver = 8;  // metres
  const double here = shape.aside(model.lanes.lane(lane));
  if (!shape.bicycle || s > kOver) return here;
  const std::array<LaneId, 6> way{vehicle.ahead[1],  vehicle.ahead[0],  vehicle.lane,
                                  vehicle.behind[0], vehicle.behind[1], vehicle.behind[2]};
  const auto at = std::ranges::find(way, lane);
  if (at == way.end() || at + 1 == way.end() || *(at + 1) == kNoLane) return here;
  const double before = shape.aside(model.lanes.lane(*(at + 1))), u = std::clamp(s / kOver, 0.0, 1.0);
  return before + (here - before) * u * u * (3 - 2 * u);
}

}  // namespace

LanePoint AlongWay(const TrafficModel& model, const DrivingVehicle& vehicle, const VehicleShape& shape, double ahead) {
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
  LanePoint at = model.lanes.At(lane, s);
  const double left = AsideAt(model, vehicle, shape, lane, s) + ParkingShift(model, vehicle, shape, vehicle.s + ahead);
  at.p = at.p + Vec3d{-at.direction.y, at.direction.x, 0} * left;
  return at;
}

}  // namespace airsim360::internal
