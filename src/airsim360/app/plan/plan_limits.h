// The limits of `airsim360 plan`: flags, drones, reports.
#pragma once

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>
#include <string>

#include "airsim360/planning/splines/trajectory_limits.h"

namespace airsim360 {

struct LimitArguments {
  double vmax = 0, amax = 0, climb = 0, descent = 0;  ///< 0: not given
  std::string axis_vmax, axis_amax, drone;
};

/// 0 stands for a flag that nobody gave: InputError naming it where somebody gives it.
void RefuseZero(CLI::Option* option, const char* flag);

void AddLimitFlags(CLI::App& command, LimitArguments& arguments);

/// InputError naming the flag for a limit that is not a number above zero; `timed`: the waypoints have times,
/// so that --vmax and --amax may be missing. --drone: thrust and body rate of a drone of the catalogue, a
/// drone .yaml, or words.
TrajectoryLimits ParseLimits(const LimitArguments& arguments, bool timed);

/// Whether a flight respects the limits, but for rounding (1e-9).
bool RespectsLimits(const PolynomialTrajectory& trajectory, const TrajectoryLimits& limits);

/// Adds the certified peaks of what a drone limits (max_thrust, m/s^2; max_body_rate, rad/s) if it does.
void ReportDrone(const PolynomialTrajectory& trajectory, const TrajectoryLimits& limits, nlohmann::ordered_json& out);

}  // namespace airsim360
