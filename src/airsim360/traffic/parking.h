// Cars park at the kerb and leave again.
#pragma once

#include <span>
#include <vector>

#include "airsim360/math/box.h"
#include "airsim360/traffic/lane_changes.h"
#include "airsim360/traffic/obstacles.h"
#include "airsim360/traffic/occupancy.h"
#include "airsim360/traffic/traffic.h"

namespace airsim360 {

/// Bays of TrafficModel, and the cars that have to go so that there are so many.
struct ParkingBays {
  std::vector<ParkingBay> bays;  ///< by lane, then by s
  std::vector<uint32_t> away;    ///< indices into `cars`, ascending
};

/// Bays in rows of cars that stand to the right of a lane between junctions: gaps of 14 to 30 m between two of them. All that there are,
/// and if they are fewer than `wanted`, others for which up to three cars next to each other go, drawn by `seed`. `cars`: boxes of the
/// cars in W; a gap that one of `others` reaches into is none. A box bounds what it holds along the axes of W: in streets that run
/// between them gaps seem smaller than they are.
ParkingBays ParkingBaysBeside(const LaneMap& lanes, std::span<const Box3f> cars, std::span<const Box3f> others, size_t wanted = 0,
                              uint64_t seed = 0);

namespace internal {

/// Metres to the left of the way through the lane that the point `s` metres from its beginning has, of one who parks or leaves.
double ParkingShift(const TrafficModel& model, const DrivingVehicle& own, const VehicleShape& shape, double s);

/// Metres from the front to where it begins to turn into its bay, at least 0; 0 on its way out.
double ToParkingTurn(const TrafficModel& model, const DrivingVehicle& own);

/// Metres from the front to the end of the bay that it is driving into; infinite: none.
double GapToBay(const TrafficModel& model, const DrivingVehicle& own);

/// Parking in one tick.
class ParkingTick {
 public:
  /// `lane_changes` knows who comes to which place of a lane in this tick.
  ParkingTick(const TrafficModel& model, const TrafficState& state, const Occupancy& occupancy, const ObstacleGrid& obstacles,
              LaneChanges& lane_changes);

  /// Of one who has driven on: a car that has come to another lane may choose a free bay there; who has come to rest in its bay stays;
  /// who is out of it drives on as others.
  void Consider(uint32_t vehicle, int64_t t_ns, DrivingVehicle& own);
  /// Of one who is in its bay: it stands, backs up to have room to turn unless somebody is behind it, and leaves when nobody comes.
  void Stay(uint32_t vehicle, int64_t t_ns, DrivingVehicle& own);

 private:
  void Choose(uint32_t vehicle, DrivingVehicle& own);
  bool MayLeave(uint32_t vehicle, const DrivingVehicle& own) const;

  const TrafficModel& model_;
  const TrafficState& state_;
  const Occupancy& occupancy_;
  const ObstacleGrid& obstacles_;
  LaneChanges& lane_changes_;
  std::vector<bool> taken_;  // by bay
};

}  // namespace internal
}  // namespace airsim360
