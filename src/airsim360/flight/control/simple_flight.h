// AirSim's SimpleFlight: its cascade, gains, limits and motor mixing. Signals and angles inside are AirSim's
// (forward-right-down); this is the only place of flight that knows them.
#pragma once

#include "airsim360/flight/control/autopilot_state.h"
#include "airsim360/flight/control/estimate.h"
#include "airsim360/flight/control/goal.h"

namespace airsim360 {

/// Of AirSim 1.8.1, AirLib/include/vehicles/multirotor/firmwares/simple_flight/firmware/Params.hpp (facts).
struct SimpleFlightGains {
  Vec3d rate_p{0.25, 0.25, 0.25};       ///< signal per rad/s
  double max_rate = 2.5;                ///< rad/s
  Vec3d level_p{2.5, 2.5, 2.5};         ///< share of max_rate per rad
  double max_level = 0.57119866428905;  ///< rad: pi / 5.5
  Vec3d velocity_p{0.2, 0.2, 2.0};      ///< share of max_level (x, y) or of throttle (z) per m/s
  double velocity_i_z = 2.0;
  double integral_discount = 0.9999;  ///< of the z integral, each step
  double max_velocity = 6;            ///< m/s, of the position loop's output
  double min_throttle = 0.3;
  Vec3d position_p{0.25, 0.25, 0.25};  ///< share of max_velocity per metre
  double min_angling_throttle = 0.05;  ///< below it the motors all get the throttle alone
};

/// Signals of the rotors, 0 to 1 of each one's full thrust. Quad X layouts get AirSim's mixing matrix; others
/// the signs and proportions of their arms in its place.
RotorValues SimpleFlightSignals(const DroneModel& model, const SimpleFlightGains& gains, const Goal& goal, const StateEstimate& estimate,
                                double dt, AutopilotState& state);

}  // namespace airsim360
