#include "airsim360/flight/dynamics/downwash.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace airsim360 {
namespace {

// Schlichting's round jet: eddy viscosity 0.0161 sqrt(K).
constexpr double kEddy = 0.0161;
constexpr double kAxis = 3 / (8 * std::numbers::pi * kEddy);  // 7.41

/// Shape across the jet at distance x: 1 / (1 + eta^2 / 4)^2, eta = sqrt(3 / pi) / 4 r / (0.0161 x).
double Across(double r, double x) {
  const double eta = 0.25 * std::sqrt(3 / std::numbers::pi) * r / (kEddy * x);
  const double bell = 1 + 0.25 * eta * eta;
  return 1 / (bell * bell);
}

}  // namespace

RotorWake WakeOf(const DroneModel& model, const DroneState& state, double air_density) {
  Vec3d force_B, middle_B;
  RotorWake wake;
  for (size_t i = 0; i < model.rotors.size(); ++i) {
    const RotorModel& r = model.rotors[i];
    const double speed = state.rotor_speeds[i];
    force_B += r.axis_B * (r.thrust_factor * speed * speed / kSeaLevelAirDensity);
    middle_B += r.p_B / static_cast<double>(model.rotors.size());
    wake.disc_area += std::numbers::pi / 4 * r.diameter * r.diameter;
  }
  const Mat3d R_WB = ToMatrix(state.q_WB);
  wake.p_W = state.p_WB + R_WB * middle_B;
  wake.direction_W = -Normalized(R_WB * force_B);
  // Thrust and density fall together: K does not depend on the density, but air that is not there blows
  // nothing.
  wake.momentum = air_density > 0 ? Norm(force_B) : 0;
  return wake;
}

Vec3d WakeVelocity(const RotorWake& wake, Vec3d p_W) {
  const Vec3d d = p_W - wake.p_W;
  const double x = Dot(d, wake.direction_W);
  if (x <= 0 || wake.momentum <= 0 || wake.disc_area <= 0) return {};
  const double r = Norm(d - wake.direction_W * x);
  // Momentum theory in hover: T = 2 rho A v_i^2.
  const double induced = std::sqrt(wake.momentum / (2 * wake.disc_area));
  const double joint = kAxis * std::sqrt(wake.momentum) / (2 * induced);
  const double radius = std::sqrt(wake.disc_area / std::numbers::pi);
  const double near_axis = induced * (1 + x / std::hypot(x, radius));
  const double axis = std::min(near_axis, kAxis * std::sqrt(wake.momentum) / x);
  return wake.direction_W * (axis * Across(r, std::max(x, joint)));
}

Vec3d DownwashOn(std::span<const RotorWake> wakes, size_t own, Vec3d p_W) {
  Vec3d flux;
  for (size_t i = 0; i < wakes.size(); ++i) {
    if (i == own) continue;
    const Vec3d v = WakeVelocity(wakes[i], p_W);
    flux += v * Norm(v);
  }
  const double square = Norm(flux);
  return square > 0 ? flux / std::sqrt(square) : Vec3d{};
}

}  // namespace airsim360
