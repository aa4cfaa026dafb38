// Reading planned trajectories back: the JSON and YAML that `airsim360 plan` writes.
#pragma once

#include <filesystem>
#include <optional>

#include "airsim360/planning/polynomial_trajectory.h"

namespace airsim360 {

struct PlannedPath {
  PolynomialTrajectory trajectory;
  std::optional<double> yaw;  ///< radians, where the file has one
};

/// By the extension: .json (order, durations, coefficients) or .yaml (PolynomialTrajectory). InputError
/// naming file and place for anything else.
PlannedPath ReadPlanFile(const std::filesystem::path& path);

}  // namespace airsim360
