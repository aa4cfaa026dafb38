#include "airsim360/flight/dynamics/dynamics_kernel.h"

#include "airsim360/flight/dynamics/drone_step.h"
#include "airsim360/flight/dynamics/state_lanes.h"

namespace airsim360::internal::AIRSIM360_ISA {
namespace {

template <class Drive>
AIRSIM360_LANES void StepWith(const DroneConstants<double>& c, const DroneSurroundings& surroundings, const RotorSpeeds& commands,
                              const RotorHealth& health, DroneState& state) {
  const int rotors = Drive::Layout::Rotors(c);
  BodyState<double> s;
  double command[kMaxRotors];
  LoadState(state, rotors, s);
  LoadCommands(commands, health, rotors, command);
  const bool near_ground = FeelsGround(c, surroundings.ground_distance);
  StepLanes<Drive>(c, LoadSurroundings(surroundings), near_ground, command, 1, s);
  StoreState(s, rotors, state);
}

}  // namespace

void StepOne(const DroneConstants<double>& c, const DroneSurroundings& surroundings, const RotorSpeeds& commands, const RotorHealth& health,
             DroneState& state) {
  ChooseDrive<double>(c, [&]<class Drive>(Drive*) { StepWith<Drive>(c, surroundings, commands, health, state); });
}

}  // namespace airsim360::internal::AIRSIM360_ISA
