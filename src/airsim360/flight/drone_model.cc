#include "airsim360/flight/drone_model.h"

#include <cmath>
#include <string_view>

#include "airsim360/base/error.h"

namespace airsim360 {
namespace {

[[noreturn]] void Refuse(const DroneModel& model, std::string_view what, double value, std::string_view wanted) {
  throw InputError("drone '" + model.name + "': " + std::string(what) + " = " + std::to_string(value) + "; it must be " +
                   std::string(wanted));
}

void CheckPositive(const DroneModel& model, std::string_view what, double value) {
  if (!(value > 0 && std::isfinite(value))) Refuse(model, what, value, "positive and finite");
}

void CheckAtLeastZero(const DroneModel& model, std::string_view what, double value) {
  if (!(value >= 0 && std::isfinite(value))) Refuse(model, what, value, "zero or positive, and finite");
}

void CheckFinite(const DroneModel& model, std::string_view what, Vec3d v) {
  for (int i = 0; i < 3; ++i) {
    if (!std::isfinite(v[i])) Refuse(model, what, v[i], "finite");
  }
}

void CheckRotor(const DroneModel& model, const RotorModel& r, int number) {
  const std::string name = "rotor " + std::to_string(number) + " ";
  CheckFinite(model, name + "p_B", r.p_B);
  CheckFinite(model, name + "axis_B", r.axis_B);
  const double length = Norm(r.axis_B);
  if (std::abs(length - 1) > 1e-6) Refuse(model, name + "length of axis_B", length, "1");
  if (std::abs(r.direction) != 1) Refuse(model, name + "direction", r.direction, "+1 or -1");
  CheckPositive(model, name + "thrust_factor", r.thrust_factor);
  CheckPositive(model, name + "tau_up", r.tau_up);
  CheckPositive(model, name + "tau_down", r.tau_down);
  CheckPositive(model, name + "max_speed", r.max_speed);
  CheckAtLeastZero(model, name + "diameter", r.diameter);
  CheckAtLeastZero(model, name + "torque_ratio", r.torque_ratio);
  CheckAtLeastZero(model, name + "inertia", r.inertia);
  CheckAtLeastZero(model, name + "in_plane_drag", r.in_plane_drag);
  CheckAtLeastZero(model, name + "inflow", r.inflow);
  CheckAtLeastZero(model, name + "translational_lift", r.translational_lift);
  CheckAtLeastZero(model, name + "flapping", r.flapping);
}

void CheckInertia(const DroneModel& model) {
  const auto& J = model.inertia_B.m;
  for (int i = 0; i < 3; ++i) CheckPositive(model, "inertia_B diagonal", J[i][i]);
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < i; ++k) {
      if (J[i][k] != J[k][i]) Refuse(model, "inertia_B asymmetry", J[i][k] - J[k][i], "0 (a symmetric matrix)");
    }
  }
  // Sylvester's criterion: all leading minors are positive.
  CheckPositive(model, "inertia_B minor", J[0][0] * J[1][1] - J[0][1] * J[1][0]);
  CheckPositive(model, "inertia_B determinant", model.inertia_B.determinant());
}

void CheckBattery(const DroneModel& model) {
  const BatteryModel& b = model.battery;
  if (b.cells == 0) return;
  CheckPositive(model, "battery cells", b.cells);
  CheckPositive(model, "battery capacity_ah", b.capacity_ah);
  CheckPositive(model, "battery efficiency", b.efficiency);
  CheckAtLeastZero(model, "battery resistance", b.resistance);
  CheckAtLeastZero(model, "battery idle_power", b.idle_power);
}

}  // namespace

void CheckModel(const DroneModel& model) {
  const int n = static_cast<int>(model.rotors.size());
  if (n < 3 || n > kMaxRotors) Refuse(model, "number of rotors", n, "3 to " + std::to_string(kMaxRotors));
  CheckPositive(model, "mass", model.mass);
  CheckInertia(model);
  for (int i = 0; i < n; ++i) CheckRotor(model, model.rotors[i], i);
  for (int i = 0; i < 3; ++i) {
    CheckAtLeastZero(model, "linear_drag_B", model.linear_drag_B[i]);
    CheckAtLeastZero(model, "quadratic_drag_B", model.quadratic_drag_B[i]);
    CheckAtLeastZero(model, "half_size_B", model.half_size_B[i]);
  }
  CheckBattery(model);
}

double HoverSpeed(const DroneModel& model) {
  double lift = 0;
  for (const RotorModel& r : model.rotors) lift += r.thrust_factor * r.axis_B.z;
  if (!(lift > 0)) Refuse(model, "sum of k_f axis_z", lift, "positive: the rotors do not thrust upwards");
  return std::sqrt(model.mass * kGravity / lift);
}

}  // namespace airsim360
