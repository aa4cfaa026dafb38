#include "airsim360/flight/dynamics/dynamics.h"

#include "airsim360/flight/dynamics/drone_step.h"
#include "airsim360/flight/dynamics/dynamics_kernel.h"
#include "airsim360/flight/dynamics/state_lanes.h"

namespace airsim360 {
namespace {

using internal::BodyState;
using internal::DroneConstants;
using internal::LaneSurroundings;

template <class Drive>
DroneDerivative DerivativeWith(const DroneConstants<double>& c, const DroneSurroundings& surroundings, const RotorSpeeds& commands,
                               const RotorHealth& health, const DroneState& state) {
  BodyState<double> s;
  internal::LoadState(state, c.rotors, s);
  const LaneSurroundings<double> around = internal::LoadSurroundings(surroundings);
  double command[kMaxRotors], target[kMaxRotors], ground[kMaxRotors];
  internal::LoadCommands(commands, health, c.rotors, command);
  for (int i = 0; i < c.rotors; ++i) {
    target[i] = internal::LimitSpeed(command[i], c.rotor[i].max_speed);
    ground[i] = 1;
  }
  if (c.has_battery) internal::UseBattery(c, around.density, command, s, target);
  if (internal::FeelsGround(c, around.ground_distance)) internal::FindGround(c, around, s, ground);
  const Drive drive(c, {s.speed, target, around.density, ground});
  const internal::SteadyLoads<double> loads = internal::MakeSteadyLoads(c, around);
  const internal::Motion<double> rate = internal::Differentiate(c, loads, drive, {s.v, s.w, {s.q[0], s.q[1], s.q[2], s.q[3]}});

  DroneDerivative out;
  out.a_WB = rate.v;
  out.angular_acceleration_B = rate.w;
  for (int i = 0; i < c.rotors; ++i) {
    out.rotor_rates[i] = internal::SpeedRate(c.rotor[i], s.speed[i], target[i]);
  }
  out.specific_force_B = internal::Rotation<double>(s.q).ToBody(rate.v + Vec3d{0, 0, kGravity});
  return out;
}

}  // namespace

DroneDynamics::DroneDynamics(const DroneModel& model, double dt)
    : constants_(internal::MakeDroneConstants<double>(model, dt)), step_(AIRSIM360_SELECT_KERNEL(StepOne)) {}

void DroneDynamics::Step(const DroneSurroundings& surroundings, const RotorSpeeds& commands, const RotorHealth& health,
                         DroneState& state) const {
  step_(constants_, surroundings, commands, health, state);
}

DroneDerivative DroneDynamics::Derivative(const DroneSurroundings& surroundings, const RotorSpeeds& commands, const RotorHealth& health,
                                          const DroneState& state) const {
  if (constants_.upright) {
    return DerivativeWith<internal::UprightDrive<double>>(constants_, surroundings, commands, health, state);
  }
  return DerivativeWith<internal::TiltedDrive<double>>(constants_, surroundings, commands, health, state);
}

void StepDrone(const DroneModel& model, const DroneSurroundings& surroundings, const RotorSpeeds& commands, const RotorHealth& health,
               double dt, DroneState& state) {
  DroneDynamics(model, dt).Step(surroundings, commands, health, state);
}

double BatteryVoltage(const DroneModel& model, const DroneState& state) {
  if (model.battery.cells == 0) return 0;
  const DroneConstants<double> c = internal::MakeDroneConstants<double>(model, 1e-3);
  return internal::LoadBattery(c, 1.0, state.rotor_speeds.data(), state.charge).voltage;
}

}  // namespace airsim360
