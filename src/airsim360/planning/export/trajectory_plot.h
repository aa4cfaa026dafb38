// Pictures of flights as SVG: the way over a map, and speed, acceleration, snap and height over time.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "airsim360/planning/clearance_field.h"
#include "airsim360/planning/splines/polynomial_trajectory.h"

namespace airsim360 {

struct PlotOptions {
  std::string title;
  double max_speed = 0, max_acceleration = 0;  ///< limits, drawn as lines; 0 = none
  const ClearanceField* map = nullptr;         ///< what stands around, seen from above; may be null
};

/// One flight: a map with the way coloured by speed and its waypoints, and four diagrams over time.
std::string PlotFlight(const PolynomialTrajectory& trajectory, const PlotOptions& options);

/// Many ways over one map.
std::string PlotRoutes(std::span<const std::vector<Vec3d>> routes, const PlotOptions& options);

}  // namespace airsim360
