// A multirotor by its physical parameters: what the dynamics integrate, controllers are tuned to, and words
// are turned into.
#pragma once

#include <string>
#include <vector>

#include "airsim360/math/standard_atmosphere.h"
#include "airsim360/math/transform.h"

namespace airsim360 {

inline constexpr int kMaxRotors = 8;
inline constexpr double kSeaLevelAirDensity = 1.225;  ///< kg/m^3, ISA

/// One rotor. Coefficients hold at kSeaLevelAirDensity and scale with density.
struct RotorModel {
  Vec3d p_B;                              ///< hub, metres from the centre of mass
  Vec3d axis_B{0, 0, 1};                  ///< unit; thrust acts along it
  double direction = 1;                   ///< +1: the reaction torque on the body is along +axis_B (the rotor turns clockwise
                                          ///< seen from the tip of the axis), -1: along -axis_B
  double diameter = 0;                    ///< metres
  double thrust_factor = 0;               ///< k_f, N/(rad/s)^2: hover thrust = k_f * speed^2
  double torque_ratio = 0;                ///< k_m / k_f, metres
  double tau_up = 0.03, tau_down = 0.03;  ///< seconds, first-order lag of the speed
  double max_speed = 0;                   ///< rad/s
  double inertia = 0;                     ///< of rotor and propeller about the axis, kg m^2
  double in_plane_drag = 0;               ///< k_d, N per (rad/s * m/s): H-force against the in-plane air velocity
  double inflow = 0;                      ///< k_z, N per (rad/s * m/s): loss of thrust with axial air velocity (climb)
  double translational_lift = 0;          ///< k_h, N/(m/s)^2 of in-plane air velocity
  double flapping = 0;                    ///< k_flap, N m per (rad/s * m/s)
};

struct BatteryModel {
  int cells = 0;  ///< in series; 0 = an ideal supply that never empties
  double capacity_ah = 0;
  double resistance = 0;     ///< ohm, of the whole pack
  double efficiency = 0.75;  ///< of motors and speed controllers: shaft power / electrical power
  double idle_power = 0;     ///< W, electronics
  // The rotors' max_speed holds at full, unloaded voltage and falls in proportion to the voltage.
};

struct DroneModel {
  std::string name;
  double mass = 0;                 ///< kg
  Mat3d inertia_B;                 ///< kg m^2 about the centre of mass
  std::vector<RotorModel> rotors;  ///< 3 to kMaxRotors
  Vec3d linear_drag_B;             ///< N/(m/s) along the axes of B
  Vec3d quadratic_drag_B;          ///< N/(m/s)^2: force -c |v| v_i, v the air velocity of the body
  BatteryModel battery;
  Vec3d half_size_B;  ///< metres; box around the whole drone with propellers, centred on B
};

/// Speed in rad/s at which all rotors, turning alike, carry the weight at sea-level density: the sum of
/// k_f speed^2 axis_z is mass * kGravity. InputError naming the drone if they cannot thrust upwards.
double HoverSpeed(const DroneModel& model);

/// InputError naming the drone and the figure if the model cannot be integrated: number of rotors, a mass,
/// lag or speed that is not positive and finite, an inertia that is not symmetric positive definite, an axis
/// that is not a unit vector. Whether the drone is a likely one is not asked.
void CheckModel(const DroneModel& model);

}  // namespace airsim360
