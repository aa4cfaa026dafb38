// Wind on one drone: a steady part, gusts and turbulence.
#pragma once

#include <cstdint>
#include <vector>

#include "airsim360/flight/wind/dryden.h"

namespace airsim360 {

/// A gust that swells as (1 - cos) / 2 (MIL-F-8785C 3.7.2.3), holds, and dies away likewise.
struct WindGust {
  double start = 0;  ///< seconds
  double rise = 1;   ///< seconds, > 0
  double hold = 0;   ///< seconds
  Vec3d velocity_W;  ///< m/s, added to the wind at its height
};

struct WindSettings {
  Vec3d mean_W;        ///< m/s
  double wind_6m = 0;  ///< m/s at 6 m above the ground, for the strength of turbulence (LowAltitudeDryden); 0 = none
  std::vector<WindGust> gusts;
};

/// Of one drone. Copyable with the simulation's state.
struct WindState {
  RngStream random;
  DrydenState turbulence;
};

/// The stream of drone `id` in a simulation of this seed.
WindState StartWind(uint64_t seed, uint64_t id);

struct WindSample {
  Vec3d velocity_W;  ///< DroneSurroundings::wind_W
  Vec3d rate_W;      ///< rad/s; R_WB^T of it is DroneSurroundings::wind_rate_B
};

/// Wind over the next step of `dt` seconds from time `t`, for a drone `height` metres above the ground with
/// velocity v_WB and breadth `span` metres. Turbulence along the horizontal direction of the mean wind, +X if
/// it has none.
WindSample StepWind(const WindSettings& settings, double t, double dt, double height, Vec3d v_WB, double span, WindState& state);

/// The part of the wind that a gust adds at time t.
Vec3d GustVelocity(const WindGust& gust, double t);

}  // namespace airsim360
