// Changing to the lane beside.
#pragma once

#include <optional>
#include <vector>

#include "airsim360/traffic/occupancy.h"

namespace airsim360::internal {

/// Changes of one tick, so that no two come to the same place from either side.
class LaneChanges {
 public:
  LaneChanges(const TrafficModel& model, const TrafficState& state, const Occupancy& occupancy)
      : model_(model), state_(state), occupancy_(occupancy) {}

  /// Moves `own`, vehicle `vehicle`, to a lane beside its own if that pays and is safe.
  void Consider(uint32_t vehicle, DrivingVehicle& own);

  /// Whether somebody has come to this place of a lane in this tick, and that somebody has.
  bool TakenThisTick(LaneId lane, double s) const;
  void Take(LaneId lane, double s) { taken_.emplace_back(lane, s); }

 private:
  bool Allowed(uint32_t vehicle, const DrivingVehicle& own) const;
  bool Pays(uint32_t vehicle, LaneId target, double s) const;
  double Follow(uint32_t follower, LaneId lane, double s, const Occupant* front) const;

  const TrafficModel& model_;
  const TrafficState& state_;
  const Occupancy& occupancy_;
  std::vector<std::pair<LaneId, double>> taken_;
};

}  // namespace airsim360::internal
