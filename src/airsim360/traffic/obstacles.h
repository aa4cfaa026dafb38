// People and things in the street, found along the way of a vehicle.
#pragma once

#include <cmath>
#include <span>

#include "airsim360/traffic/disc_grid.h"
#include "airsim360/traffic/traffic.h"

namespace airsim360::internal {

/// Metres from the front of a vehicle to the nearest that it has to stop for, and to the nearest who stands so close beside its way
/// that it goes past at a walking pace. 0: beside its body; infinite: nothing.
struct InTheWay {
  double gap = INFINITY, beside = INFINITY;
};

class ObstacleGrid {
 public:
  explicit ObstacleGrid(std::span<const TrafficObstacle> obstacles);
  /// What a vehicle meets within `reach`, now or within the next 1.6 s. People walk into standing cars: gap 0 if somebody touches
  /// its body now.
  InTheWay Find(const TrafficModel& model, const TrafficState& state, uint32_t vehicle, double reach) const;
  /// Whether somebody is, or soon will be, up to `reach` metres behind a vehicle.
  bool IsBehind(const TrafficModel& model, const TrafficState& state, uint32_t vehicle, double reach) const;

 private:
  InTheWay Beside(const TrafficModel& model, const TrafficState& state, uint32_t vehicle) const;

  DiscGrid standing_, walking_;  // now
  DiscGrid coming_;              // who walks, now and soon
};

/// The place `ahead` metres (negative: behind) of the front of a vehicle along its way, as far aside of its lanes as it keeps.
LanePoint AlongWay(const TrafficModel& model, const DrivingVehicle& vehicle, const VehicleShape& shape, double ahead);

}  // namespace airsim360::internal
