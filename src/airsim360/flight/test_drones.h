// Drones for the tests of the dynamics.
#pragma once

#include "airsim360/flight/drone_model.h"

namespace airsim360 {

/// The five-inch quadrotor of Agilicious (Foehn et al., Science Robotics 7(67), 2022), as in the paper's
/// data.
inline DroneModel AgiliciousDrone() {
  DroneModel m;
  m.name = "agilicious";
  m.mass = 0.752;
  m.inertia_B.m = {{{0.0025, 0, 0}, {0, 0.0021, 0}, {0, 0, 0.0043}}};
  const double x[] = {0.075, -0.075, -0.075, 0.075}, y[] = {-0.1, 0.1, -0.1, 0.1}, turn[] = {-1, -1, 1, 1};
  for (int i = 0; i < 4; ++i) {
    RotorModel r;
    r.p_B = {x[i], y[i], 0};
    r.direction = turn[i];
    r.diameter = 0.13;
    r.thrust_factor = 1.5625e-6;
    r.torque_ratio = 0.016;
    r.tau_up = r.tau_down = 0.033;
    r.max_speed = 2332;  // 8.5 N
    r.in_plane_drag = 1.2e-5;
    m.rotors.push_back(r);
  }
  m.quadratic_drag_B = {0.01, 0.01, 0.01};
  m.half_size_B = {0.14, 0.17, 0.04};
  return m;
}

/// The same with every term of the rotors switched on, off the centre and with unequal lags.
inline DroneModel DroneWithEveryTerm() {
  DroneModel m = AgiliciousDrone();
  m.name = "every term";
  m.inertia_B.m = {{{0.0025, 1e-4, -5e-5}, {1e-4, 0.0021, 7e-5}, {-5e-5, 7e-5, 0.0043}}};
  for (RotorModel& r : m.rotors) {
    r.p_B.z = 0.012;
    r.tau_up = 0.025;
    r.tau_down = 0.04;
    r.inertia = 9e-6;
    r.inflow = 3e-5;
    r.translational_lift = 2e-3;
    r.flapping = 2e-6;
  }
  m.linear_drag_B = {0.05, 0.06, 0.08};
  m.quadratic_drag_B = {0.01, 0.015, 0.03};
  return m;
}

/// AirSim's generic quadrotor (AirLib MultiRotorParams and FastPhysicsEngine): 1 kg, GWS 9x5 propellers of
/// 4.179446 N and 0.055562 N m at 669.86 rad/s, drag 0.10993 m^2 * density along Z. Its drag takes each axis
/// alone (v_i |v_i|), ours |v| v_i: equal along an axis.
inline DroneModel AirSimDrone() {
  DroneModel m;
  m.name = "AirSim generic quadrotor";
  m.mass = 1;
  m.inertia_B.m = {{{0.006721, 0, 0}, {0, 0.008041, 0}, {0, 0, 0.014279}}};
  const double arm = 0.2275 * 0.70710678118654752;
  const double x[] = {arm, -arm, arm, -arm}, y[] = {-arm, arm, arm, -arm}, turn[] = {-1, -1, 1, 1};
  for (int i = 0; i < 4; ++i) {
    RotorModel r;
    r.p_B = {x[i], y[i], 0.025};
    r.direction = turn[i];
    r.diameter = 0.2286;
    r.max_speed = 669.86;
    r.thrust_factor = 4.179446 / (r.max_speed * r.max_speed);
    r.torque_ratio = 0.055562 / 4.179446;
    r.tau_up = r.tau_down = 0.005;
    m.rotors.push_back(r);
  }
  m.quadratic_drag_B = Vec3d{0.005383, 0.005838, 0.10993} * kSeaLevelAirDensity;
  m.half_size_B = {0.28, 0.28, 0.05};
  return m;
}

}  // namespace airsim360
