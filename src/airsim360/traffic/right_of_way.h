// Who may enter a junction: signals, conflicting ways, priority, room behind it.
#pragma once

#include <vector>

#include "airsim360/traffic/occupancy.h"

namespace airsim360::internal {

/// Grants ways through junctions, one vehicle after the other, within one tick.
class RightOfWay {
 public:
  RightOfWay(const TrafficModel& model, const TrafficState& state, const Occupancy& occupancy);

  /// Whether a vehicle whose next lane leads through a junction may pass the stop line, `distance` metres ahead.
  /// `first`: nobody is between it and the line. Keeps `granted` of the vehicle.
  bool MayEnter(uint32_t vehicle, double distance, bool first, DrivingVehicle& own);

 private:
  bool IsBusy(uint32_t vehicle, LaneId way) const;
  bool MustYield(uint32_t vehicle, LaneId way) const;
  bool HasRoomBehind(uint32_t vehicle) const;
  int Rank(LaneId way) const;
  /// The first on its way to `way`: seconds until it is at the line, infinite if nobody comes; how long it has stood there;
  /// whether there is room for it behind the junction; who it is.
  struct Coming {
    double seconds = INFINITY;
    int64_t waited_ns = 0;
    bool room = false;
    LaneId exit = kNoLane;
    uint32_t vehicle = 0;
  };
  Coming ComingTo(LaneId way) const;

  const TrafficModel& model_;
  const TrafficState& state_;
  const Occupancy& occupancy_;
  std::vector<std::vector<uint32_t>> granted_;  // by way: those who may enter and have not
};

}  // namespace airsim360::internal
