#include "airsim360/app/plan/plan_limits.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "airsim360/app/flags/arguments.h"
#include "airsim360/base/error.h"
#include "airsim360/flight/control/gains.h"

namespace airsim360 {
namespace {

/// Of the controllers whose limits on body rate a plan keeps to.
constexpr double kControlPeriod = 0.002;

double Limit(const char* flag, double value) { return value == 0 ? TrajectoryLimits::kNone : CheckPositive(flag, value); }

Vec3d AxisLimit(const char* flag, const std::string& text) {
  if (text.empty()) return {TrajectoryLimits::kNone, TrajectoryLimits::kNone, TrajectoryLimits::kNone};
  const std::vector<double> v = ParseNumbers(flag, text, 3, "x,y,z: three numbers above zero");
  for (const double value : v) CheckPositive(flag, value);
  return {v[0], v[1], v[2]};
}

}  // namespace

void RefuseZero(CLI::Option* option, const char* flag) {
  option->each([flag](const std::string& text) {
    double value = 1;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error == std::errc() && value == 0) CheckPositive(flag, value);
  });
}

void AddLimitFlags(CLI::App& command, LimitArguments& a) {
  RefuseZero(command.add_option("--vmax", a.vmax, "greatest speed, m/s; REQUIRED unless the waypoints have times"), "--vmax");
  RefuseZero(command.add_option("--amax", a.amax, "greatest acceleration, m/s^2; REQUIRED unless the waypoints have times"), "--amax");
  command.add_option("--axis-vmax", a.axis_vmax, "greatest speed along each axis, x,y,z in m/s");
  command.add_option("--axis-amax", a.axis_amax, "greatest acceleration along each axis, x,y,z in m/s^2");
  RefuseZero(command.add_option("--climb", a.climb, "greatest vertical speed upwards, m/s"), "--climb");
  RefuseZero(command.add_option("--descent", a.descent, "greatest vertical speed downwards, m/s"), "--descent");
  command.add_option("--drone", a.drone, "keep to the thrust and body rates of a drone of the catalogue, a .yaml, or words in quotes");
}

TrajectoryLimits ParseLimits(const LimitArguments& a, bool timed) {
  if (!timed || a.vmax != 0) CheckPositive("--vmax", a.vmax);
  if (!timed || a.amax != 0) CheckPositive("--amax", a.amax);
  TrajectoryLimits limits{.speed = Limit("--vmax", a.vmax),
                          .acceleration = Limit("--amax", a.amax),
                          .axis_speed = AxisLimit("--axis-vmax", a.axis_vmax),
                          .axis_acceleration = AxisLimit("--axis-amax", a.axis_amax),
                          .climb = Limit("--climb", a.climb),
                          .descent = Limit("--descent", a.descent)};
  if (a.drone.empty()) return limits;
  const DroneModel drone = FindDrone(a.drone);
  const ControlGains gains = SynthesizeGains(drone, kControlPeriod);
  limits.thrust_per_mass = gains.max_thrust / drone.mass;
  limits.body_rate = std::min(gains.max_rate.x, gains.max_rate.y);
  return limits;
}

bool RespectsLimits(const PolynomialTrajectory& trajectory, const TrajectoryLimits& limits) {
  constexpr double kRounding = 1 + 1e-9;
  return WithinLimits(trajectory, {.speed = limits.speed * kRounding,
                                   .acceleration = limits.acceleration * kRounding,
                                   .axis_speed = limits.axis_speed * kRounding,
                                   .axis_acceleration = limits.axis_acceleration * kRounding,
                                   .climb = limits.climb * kRounding,
                                   .descent = limits.descent * kRounding,
                                   .thrust_per_mass = limits.thrust_per_mass * kRounding,
                                   .body_rate = limits.body_rate * kRounding});
}

void ReportDrone(const PolynomialTrajectory& trajectory, const TrajectoryLimits& limits, nlohmann::ordered_json& out) {
  if (!std::isfinite(limits.body_rate)) return;
  out["max_thrust"] = PeakThrust(trajectory).value;
  out["thrust_limit"] = limits.thrust_per_mass;
  out["max_body_rate"] = PeakBodyRate(trajectory).value;
  out["body_rate_limit"] = limits.body_rate;
}

}  // namespace airsim360
