// One multirotor as a rigid body with spinning rotors, in double precision. Equations and sources:
// docs/internals/flight.md. The batched kernel (batch.h) is compiled from the same equations.
#pragma once

#include "airsim360/flight/drone_constants.h"
#include "airsim360/flight/drone_model.h"
#include "airsim360/flight/drone_state.h"
#include "airsim360/flight/dynamics/dynamics_kernel.h"

namespace airsim360 {

/// Rates of change of a state.
struct DroneDerivative {
  Vec3d a_WB;                    ///< m/s^2, in W, gravity included
  Vec3d angular_acceleration_B;  ///< rad/s^2
  RotorSpeeds rotor_rates{};     ///< rad/s^2
  Vec3d specific_force_B;        ///< m/s^2: acceleration without gravity, what an accelerometer at B reads
};

/// A drone prepared for stepping: everything that depends only on the model and on the step. Immutable; may
/// be used by many threads.
class DroneDynamics {
 public:
  /// `dt` > 0 seconds. InputError as CheckModel.
  explicit DroneDynamics(const DroneModel& model, double dt = 1e-3);

  /// Advances `state` by one step of classical RK4 (order 4); rotor speeds follow their exact exponential
  /// towards the commands, which hold for the step. Commands are limited to 0 .. the speed that the battery
  /// allows; one that is not a number counts as 0.
  void Step(const DroneSurroundings& surroundings, const RotorSpeeds& commands, const RotorHealth& health, DroneState& state) const;

  /// Rates at `state`, by the same equations.
  DroneDerivative Derivative(const DroneSurroundings& surroundings, const RotorSpeeds& commands, const RotorHealth& health,
                             const DroneState& state) const;

  double dt() const { return constants_.dt; }
  int rotors() const { return constants_.rotors; }

 private:
  internal::DroneConstants<double> constants_;
  internal::StepOneKernel* step_;
};

/// DroneDynamics(model, dt).Step(...), for a step of a drone that is not stepped again.
void StepDrone(const DroneModel& model, const DroneSurroundings& surroundings, const RotorSpeeds& commands, const RotorHealth& health,
               double dt, DroneState& state);

/// Voltage of the battery with the rotors at the state's speeds (at sea-level density), V; 0 for an ideal
/// supply.
double BatteryVoltage(const DroneModel& model, const DroneState& state);

}  // namespace airsim360
