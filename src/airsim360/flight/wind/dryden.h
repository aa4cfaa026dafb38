// Dryden turbulence of MIL-F-8785C (1980), discretised exactly: the variance and the correlation of the
// samples are those of the continuous spectra whatever the step.
#pragma once

#include "airsim360/base/random.h"
#include "airsim360/math/vector.h"

namespace airsim360 {

/// Lengths (metres) and standard deviations (m/s) along the mean wind, across it, and vertically.
struct DrydenScales {
  Vec3d length, sigma;
};

/// Scales at `height` metres above the ground for a mean wind of `wind_6m` m/s at 20 ft (6 m):
/// MIL-F-8785C 3.7.3.4, given there for 10 to 1000 ft; below and above, the values of the limits. Light,
/// moderate and severe turbulence are winds of 15, 30 and 45 knots.
DrydenScales LowAltitudeDryden(double height, double wind_6m);

/// Filters of one drone. Plain data; starts in the steady state at the first step.
struct DrydenState {
  bool started = false;
  double u = 0, roll = 0;         ///< unit variance
  double v[2] = {}, w[2] = {};    ///< of the filter 1 / (1 + s) and its square, driven by unit white noise
  double v_slow = 0, w_slow = 0;  ///< m/s: v and w as the span of the drone averages them
};

struct DrydenSample {
  Vec3d velocity;  ///< m/s: along the mean wind, across it to the left, up
  Vec3d rate;      ///< rad/s about the same axes
};

/// Advances by `dt` at `airspeed` m/s (below 1 m/s counts as 1: turbulence drifts past a drone that stands
/// still). `span` in metres is the drone's breadth, for the rates. Draws six normal numbers.
DrydenSample StepDryden(const DrydenScales& scales, double airspeed, double span, double dt, RngStream& random, DrydenState& state);

namespace internal {
/// Covariance over a time x of (x1, x2) with dx1 = -x1 + noise, dx2 = x1 - x2: what white noise adds.
struct FilterNoise {
  double q11, q12, q22;
};
FilterNoise NoiseOver(double x);
}  // namespace internal

}  // namespace airsim360
