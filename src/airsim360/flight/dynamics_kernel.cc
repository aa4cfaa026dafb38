#include "airsim360/flight/dynamics_kernel.h"

#include "airsim360/flight/drone_step.h"
#include "airsim360/flight/state_lanes.h"

namespace airsim360::internal::AIRSIM360_ISA {
namespace {

template <class Drive>
AIRSIM360_LANES void StepWith(const DroneConstants<double>& c, const DroneSurroundings& surroundings,
                              const RotorSpeeds& commands, const RotorHealth& health, DroneState& state) {
  BodyState<double> s;
  double command[kMaxRotors];
  LoadState(state, c.rotors, s);
  LoadCommands(commands, health, c.rotors, command);
  const bool near_ground = FeelsGround(c, surroundings.ground_distance);
  StepLanes<Drive>(c, LoadSurroundings(surroundings), near_ground, command, 1, s);
  StoreState(s, c.rotors, state);
}

}  // namespace

void StepOne(const DroneConstants<double>& c, const DroneSurroundings& surroundings,
             const RotorSpeeds& commands, const RotorHealth& health, DroneState& state) {
  if (c.upright) {
    StepWith<UprightDrive<double>>(c, surroundings, commands, health, state);
  } else {
    StepWith<TiltedDrive<double>>(c, surroundings, commands, health, state);
  }
}

}  // namespace airsim360::internal::AIRSIM360_ISA
