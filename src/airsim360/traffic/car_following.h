// How a driver keeps speed and distance, and when changing the lane pays.
#pragma once

#include <algorithm>
#include <cmath>

namespace airsim360 {

/// A driver's habits. Defaults: a car in town, after Treiber and Kesting, "Traffic Flow Dynamics", Springer 2013, table 11.2.
struct Driver {
  double speed_factor = 1;    ///< of the limit
  double top_speed = 70;      ///< m/s that the vehicle can do
  double headway = 1.5;       ///< seconds to the one in front
  double gap = 2;             ///< metres to the one in front when both stand
  double acceleration = 1.4;  ///< m/s^2
  double braking = 2;         ///< m/s^2, comfortable
  double politeness = 0.2;    ///< weight of what a lane change costs others
};

/// m/s that a driver wants where `limit` is allowed.
inline double WantedSpeed(const Driver& driver, double limit) { return std::min(limit * driver.speed_factor, driver.top_speed); }

/// m/s^2 that a driver never brakes harder than.
inline constexpr double kHardestBraking = 8;

/// The Intelligent Driver Model: acceleration in m/s^2 at speed `v` with the wanted speed `v0` > 0, `gap` metres behind
/// something that moves at `v_front` (M. Treiber, A. Hennecke, D. Helbing, Phys. Rev. E 62, 1805, 2000). An infinite gap:
/// nothing in front. Never below -kHardestBraking.
inline double IdmAcceleration(const Driver& driver, double v, double v0, double gap, double v_front) {
  const double ratio = v / v0;
  double free = driver.acceleration * (1 - ratio * ratio * ratio * ratio);
  if (ratio > 1) free = std::max(free, -driver.braking);  // a new limit is no emergency
  if (!std::isfinite(gap)) return std::max(free, -kHardestBraking);
  const double dynamic = v * driver.headway + v * (v - v_front) / (2 * std::sqrt(driver.acceleration * driver.braking));
  const double wanted = driver.gap + std::max(0.0, dynamic);
  const double q = wanted / std::max(gap, 0.1);
  return std::max(std::min(free, driver.acceleration * (1 - ratio * ratio * ratio * ratio - q * q)), -kHardestBraking);
}

/// The gap in metres at which all drive evenly at `v` < `v0`: where IdmAcceleration is 0.
inline double EquilibriumGap(const Driver& driver, double v, double v0) {
  const double ratio = v / v0;
  return (driver.gap + v * driver.headway) / std::sqrt(1 - ratio * ratio * ratio * ratio);
}

/// MOBIL: whether to change to another lane, from accelerations before and after of oneself and of the two who would be or
/// were behind (A. Kesting, M. Treiber, D. Helbing, Transp. Res. Rec. 1999, 86, 2007). Nobody: 0 and 0.
struct LaneChangeCase {
  double own_before = 0, own_after = 0;
  double new_follower_before = 0, new_follower_after = 0;
  double old_follower_before = 0, old_follower_after = 0;
  double bias = 0;  ///< what the other lane is worth for other reasons, m/s^2
};
inline bool PaysToChange(const Driver& driver, const LaneChangeCase& c) {
  constexpr double kSafeBraking = 3, kThreshold = 0.2;  // m/s^2
  if (c.new_follower_after < -kSafeBraking || c.own_after < -kSafeBraking) return false;
  const double others = c.new_follower_before - c.new_follower_after + c.old_follower_before - c.old_follower_after;
  return c.own_after - c.own_before + c.bias > driver.politeness * others + kThreshold;
}

}  // namespace airsim360
