// Where the segments of a path meet.
#pragma once

#include <vector>

#include "airsim360/planning/splines/polynomial_trajectory.h"

namespace airsim360 {

/// The beginnings of all segments, and the end.
std::vector<Vec3d> KnotsOf(const PolynomialTrajectory& trajectory);

}  // namespace airsim360
