// Whether a drone's figures can belong to a real one.
#pragma once

#include <string>
#include <vector>

#include "airsim360/flight/drone_model.h"

namespace airsim360 {

/// Figures by which drones of all sizes are alike.
struct DroneFigures {
  double thrust_coefficient = 0;  ///< C_T = T / (rho n^2 D^4)
  double torque_share = 0;        ///< k_m / (k_f D)
  double figure_of_merit = 0;     ///< ideal over shaft power in hover
  double tip_mach = 0;            ///< at full speed
  double thrust_to_weight = 0;
  double spacing = 0;            ///< least distance of hubs / diameter (coaxial pairs left out)
  double hover_speed = 0;        ///< rad/s
  double hover_shaft_power = 0;  ///< W
  double max_thrust = 0;         ///< N
};
DroneFigures FiguresOf(const DroneModel& model);

/// Every bound that the model breaks, as "C_T 0.31 is not in 0.06 ... 0.22"; empty = plausible. Bounds:
/// docs/internals/drone_laws.md.
std::vector<std::string> GateProblems(const DroneModel& model);

}  // namespace airsim360
