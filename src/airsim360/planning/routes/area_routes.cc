#include "airsim360/planning/routes/area_routes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "airsim360/base/error.h"

namespace airsim360 {

std::vector<Vec3d> CoverageRoute(const CoverageArea& area) {
  constexpr double kMaxLanes = 10'000;
  const Vec2d size = area.max - area.min;
  if (!(size.x > 0 && size.y > 0))
    throw InputError("coverage: the area is " + std::to_string(size.x) + " by " + std::to_string(size.y) + " m; it needs a size");
  if (!(area.spacing > 0)) throw InputError("coverage: the spacing is " + std::to_string(area.spacing) + " m, must be positive");
  // Lanes along u; the rectangle's corners in (u, v) say how far they reach.
  const double c = std::cos(area.heading), s = std::sin(area.heading);
  const Vec2d middle = (area.min + area.max) * 0.5;
  const double half_v = 0.5 * (std::fabs(size.x * s) + std::fabs(size.y * c));
  const double count = std::ceil(2 * half_v / area.spacing);
  if (!(count <= kMaxLanes)) throw InputError("coverage: more than 10,000 lanes; give a larger spacing");
  const int lanes = std::max(1, static_cast<int>(count));
  std::vector<Vec3d> route;
  for (int i = 0; i < lanes; ++i) {
    const double v = -half_v + (i + 0.5) * 2 * half_v / lanes;
    // The part of the lane over the rectangle, made longer by what its neighbours' corners stick out.
    double low = -1e300, high = 1e300;
    for (const auto& [extent, du, dv] : {std::array{size.x / 2, c, -s}, std::array{size.y / 2, s, c}}) {
      if (std::fabs(du) < 1e-12) continue;
      const double a = (-extent - dv * v) / du, b = (extent - dv * v) / du;
      low = std::max(low, std::min(a, b));
      high = std::min(high, std::max(a, b));
    }
    if (!(low < high)) continue;
    const double first = i % 2 ? high : low, last = i % 2 ? low : high;
    for (const double u : {first, last}) route.push_back({middle.x + c * u - s * v, middle.y + s * u + c * v, area.height});
  }
  return route;
}

std::vector<Vec3d> OrbitRoute(const Orbit& orbit) {
  if (!(orbit.radius > 0)) throw InputError("orbit: the radius is " + std::to_string(orbit.radius) + " m, must be positive");
  if (!(std::fabs(orbit.turns) > 0 && std::fabs(orbit.turns) <= 1000))
    throw InputError("orbit: turns are " + std::to_string(orbit.turns) + ", must not be zero, and at most 1000");
  const int legs = std::max(2, static_cast<int>(std::ceil(std::fabs(orbit.turns) * std::max(orbit.points_per_turn, 3))));
  std::vector<Vec3d> route;
  for (int i = 0; i <= legs; ++i) {
    const double part = static_cast<double>(i) / legs;
    const double angle = orbit.start + 2 * std::numbers::pi * orbit.turns * part;
    route.push_back(orbit.center + Vec3d{orbit.radius * std::cos(angle), orbit.radius * std::sin(angle), orbit.climb * part});
  }
  return route;
}

}  // namespace airsim360
