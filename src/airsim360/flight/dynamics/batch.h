// Many drones of one model stepped together, in single precision: for fleets and for learning. The equations
// are those of DroneDynamics, compiled for SIMD lanes; every instruction set and number of threads gives the
// same bits.
#pragma once

#include <vector>

#include "airsim360/flight/drone_state.h"
#include "airsim360/flight/dynamics/batch_blocks.h"

namespace airsim360 {

/// Holds the states; a copy is a snapshot.
class DroneBatch {
 public:
  /// `count` >= 1 drones at rest at the origin with rotors stopped, in calm sea-level air. `dt` > 0 seconds.
  /// InputError as CheckModel, and for a count below 1.
  DroneBatch(const DroneModel& model, int count, double dt = 1e-3);

  int size() const { return count_; }
  double dt() const { return dt_; }

  /// 0 <= i < size() in all of these. Positions keep about 48 bits, everything else 24.
  DroneState state(int i) const;
  void SetState(int i, const DroneState& state);
  /// Commands of failed rotors count as 0. They hold until set again.
  void SetCommands(int i, const RotorSpeeds& commands, const RotorHealth& health = kAllRotorsWork);
  void SetSurroundings(int i, const DroneSurroundings& surroundings);

  /// Advances every drone by `steps` steps, on all threads.
  void Step(int steps = 1);

 private:
  int count_;
  double dt_;
  internal::DroneConstants<float> constants_;
  std::vector<internal::DroneBlock> blocks_;
  std::vector<internal::SurroundingsBlock> surroundings_;  ///< one while all drones are in calm air
  bool near_ground_ = false;
};

}  // namespace airsim360
