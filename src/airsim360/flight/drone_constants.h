// What the equations of motion need of a drone, worked out once (plain data, one precision).
#pragma once

#include "airsim360/flight/drone_model.h"

namespace airsim360::internal {

/// One rotor. Signs are folded in, so that the equations only add.
template <class T>
struct RotorConstants {
  Vec3<T> p, axis;                   ///< hub and unit axis, B
  T p2;                              ///< x^2 + y^2 of the hub
  T thrust;                          ///< k_f
  T torque;                          ///< reaction torque along the axis / speed^2: direction * torque_ratio * k_f
  T drag, inflow, lift, flap;        ///< k_d, k_z, k_h, k_flap
  T spin;                            ///< angular momentum along the axis / speed: -direction * inertia
  T half_decay_up, half_decay_down;  ///< exp(-dt / 2 tau)
  T rate_up, rate_down;              ///< 1 / tau
  T max_speed;
  T power;         ///< shaft power / speed^3
  T induced;       ///< induced velocity^2 / speed^2 in hover: k_f / (2 rho pi R^2)
  T ground;        ///< (R / 4)^2, of Cheeseman and Bennett's ground effect
  T least_height;  ///< R / 2: nearer to the ground their formula is not used
};

/// Sums over the rotors of k_h times powers of their places; r2 = x^2 + y^2.
template <class T>
struct LiftSums {
  T one = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0, xr2 = 0, yr2 = 0;
};

/// Plain data. Terms whose coefficients are all zero are switched off for the whole drone.
template <class T>
struct DroneConstants {
  int rotors = 0;
  /// All axes are +Z of B, at one height and of one diameter: few sums over the rotors give their wrench.
  bool upright = false;
  bool has_products = false;  ///< of inertia
  bool has_height = false;    ///< `height` is not 0
  bool has_inflow = false, has_lift = false, has_flapping = false, has_spin = false, has_battery = false;
  bool plain = false;  ///< upright, and none of the has_ terms
  RotorConstants<T> rotor[kMaxRotors];
  LiftSums<T> lift;
  T height;  ///< of the rotor plane above B, when upright
  T dt, half_dt, sixth_dt;
  T most_turning;  ///< rad/s, about each axis
  T inverse_mass;
  Mat3<T> inertia, inverse_inertia;
  Vec3<T> inertia_gaps;  ///< J_z - J_y, J_x - J_z, J_y - J_x
  Vec3<T> linear_drag, quadratic_drag;
  // Battery: ohms, 1 / efficiency, watts, and what one ampere takes off the charge in a step.
  T cells, resistance, inverse_efficiency, idle_power, charge_per_ampere;
};

/// InputError as CheckModel. `dt` > 0 seconds.
template <class T>
DroneConstants<T> MakeDroneConstants(const DroneModel& model, double dt);

}  // namespace airsim360::internal
