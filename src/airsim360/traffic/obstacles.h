// People and things in the street, found along the way of a vehicle.
#pragma once

#include <span>

#include "airsim360/traffic/disc_grid.h"
#include "airsim360/traffic/traffic.h"

namespace airsim360::internal {

class ObstacleGrid {
 public:
  explicit ObstacleGrid(std::span<const TrafficObstacle> obstacles);
  /// Metres from the front of a vehicle to the nearest in its way within `reach`, now or within the next 1.6 s; 0 if somebody
  /// touches its body now: people walk into standing cars. Infinite: nothing.
  double GapAhead(const TrafficModel& model, const TrafficState& state, uint32_t vehicle, double reach) const;

 private:
  bool Touches(const TrafficModel& model, const DrivingVehicle& self, const VehicleShape& shape) const;

  DiscGrid discs_;  // now and soon
  DiscGrid now_;
};

/// The place `ahead` metres (negative: behind) of the front of a vehicle along its way.
LanePoint AlongWay(const TrafficModel& model, const DrivingVehicle& vehicle, double ahead);

}  // namespace airsim360::internal
