#include "airsim360/flight/drone_constants.h"

#include <cmath>
#include <numbers>

namespace airsim360::internal {
namespace {

template <class T>
RotorConstants<T> MakeRotor(const RotorModel& r, double dt) {
  const double radius = r.diameter / 2;
  const double disc = std::numbers::pi * radius * radius;
  RotorConstants<T> c;
  c.p = VecCast<T>(r.p_B);
  c.axis = VecCast<T>(r.axis_B);
  c.p2 = T(r.p_B.x * r.p_B.x + r.p_B.y * r.p_B.y);
  c.thrust = T(r.thrust_factor);
  c.torque = T(r.direction * r.torque_ratio * r.thrust_factor);
  c.drag = T(r.in_plane_drag);
  c.inflow = T(r.inflow);
  c.lift = T(r.translational_lift);
  c.flap = T(r.flapping);
  c.spin = T(-r.direction * r.inertia);
  c.half_decay_up = T(std::exp(-0.5 * dt / r.tau_up));
  c.half_decay_down = T(std::exp(-0.5 * dt / r.tau_down));
  c.rate_up = T(1 / r.tau_up);
  c.rate_down = T(1 / r.tau_down);
  c.max_speed = T(r.max_speed);
  c.power = T(r.torque_ratio * r.thrust_factor);
  c.induced = T(disc > 0 ? r.thrust_factor / (2 * kSeaLevelAirDensity * disc) : 0);
  c.ground = T(radius * radius / 16);
  c.least_height = T(radius / 2);
  return c;
}

bool IsUpright(const DroneModel& model) {
  const RotorModel& first = model.rotors.front();
  for (const RotorModel& r : model.rotors) {
    if (r.axis_B != Vec3d{0, 0, 1} || r.p_B.z != first.p_B.z || r.diameter != first.diameter) return false;
  }
  return true;
}

template <class T>
void FindTerms(const DroneModel& model, DroneConstants<T>& c) {
  for (const RotorModel& r : model.rotors) {
    c.has_inflow |= r.inflow != 0;
    c.has_lift |= r.translational_lift != 0;
    c.has_flapping |= r.flapping != 0;
    c.has_spin |= r.inertia != 0;
  }
  c.has_battery = model.battery.cells > 0;
  const auto& J = model.inertia_B.m;
  c.has_products = J[0][1] != 0 || J[0][2] != 0 || J[1][2] != 0;
  c.has_height = model.rotors.front().p_B.z != 0;
  c.upright = IsUpright(model);
  c.plain = c.upright && !(c.has_inflow || c.has_lift || c.has_flapping || c.has_spin || c.has_battery || c.has_products || c.has_height);
}

template <class T>
LiftSums<T> SumLift(const DroneModel& model) {
  LiftSums<double> s;
  for (const RotorModel& r : model.rotors) {
    const double k = r.translational_lift, x = r.p_B.x, y = r.p_B.y, r2 = x * x + y * y;
    s.one += k, s.x += k * x, s.y += k * y;
    s.xx += k * x * x, s.xy += k * x * y, s.yy += k * y * y;
    s.xr2 += k * x * r2, s.yr2 += k * y * r2;
  }
  return {T(s.one), T(s.x), T(s.y), T(s.xx), T(s.xy), T(s.yy), T(s.xr2), T(s.yr2)};
}

template <class T>
void SetInertia(const Mat3d& J, DroneConstants<T>& c) {
  // Rows of the inverse are cross products of columns over the determinant.
  const Vec3d a = J.column(0), b = J.column(1), d = J.column(2);
  const double det = J.determinant();
  c.inertia_gaps = VecCast<T>(Vec3d{d.z - b.y, a.x - d.z, b.y - a.x});
  const Vec3d inverse_rows[3] = {Cross(b, d) / det, Cross(d, a) / det, Cross(a, b) / det};
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) {
      c.inertia.m[i][k] = T(J.m[i][k]);
      c.inverse_inertia.m[i][k] = T(inverse_rows[i][k]);
    }
  }
}

template <class T>
void SetBattery(const BatteryModel& b, double dt, DroneConstants<T>& c) {
  constexpr double kSecondsPerHour = 3600;
  c.cells = T(b.cells);
  c.resistance = T(b.resistance);
  c.inverse_efficiency = T(1 / b.efficiency);
  c.idle_power = T(b.idle_power);
  c.charge_per_ampere = T(b.cells > 0 ? dt / (kSecondsPerHour * b.capacity_ah) : 0);
}

}  // namespace

template <class T>
DroneConstants<T> MakeDroneConstants(const DroneModel& model, double dt) {
  CheckModel(model);
  DroneConstants<T> c;
  c.rotors = static_cast<int>(model.rotors.size());
  for (int i = 0; i < c.rotors; ++i) c.rotor[i] = MakeRotor<T>(model.rotors[i], dt);
  FindTerms(model, c);
  c.lift = SumLift<T>(model);
  c.height = T(model.rotors.front().p_B.z);
  c.dt = T(dt);
  c.half_dt = T(dt / 2);
  c.sixth_dt = T(dt / 6);
  c.most_turning = T(1.5 / dt);
  c.inverse_mass = T(1 / model.mass);
  SetInertia(model.inertia_B, c);
  c.linear_drag = VecCast<T>(model.linear_drag_B);
  c.quadratic_drag = VecCast<T>(model.quadratic_drag_B);
  SetBattery(model.battery, dt, c);
  return c;
}

template DroneConstants<float> MakeDroneConstants(const DroneModel&, double);
template DroneConstants<double> MakeDroneConstants(const DroneModel&, double);

}  // namespace airsim360::internal
