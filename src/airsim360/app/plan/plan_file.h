// Reading planned trajectories back: the JSON and YAML that `airsim360 plan` writes.
#pragma once

#include <filesystem>
#include <optional>

#include "airsim360/planning/splines/polynomial_trajectory.h"
#include "airsim360/planning/yaw_profile.h"

namespace airsim360 {

struct PlannedPath {
  PolynomialTrajectory trajectory;
  std::optional<YawRule> yaw;  ///< constant or polynomials, where the file has one
};

/// By the extension: .json (order, durations, coefficients) or .yaml (PolynomialTrajectory). InputError
/// naming file and place for anything else, and for segments that do not join.
PlannedPath ReadPlanFile(const std::filesystem::path& path);

}  // namespace airsim360
