#include "airsim360/flight/wind/dryden.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace airsim360 {
namespace internal {
namespace {

/// Integral of s^k e^(-2 s) from 0 to x < 1, by its series: no cancellation for small x.
double MomentSeries(int k, double x) {
  double term = std::pow(x, k + 1), sum = 0;
  for (int j = 0; std::abs(term) > 1e-18 * sum; ++j) {
    sum += term / (k + j + 1);
    term *= -2 * x / (j + 1);
  }
  return sum;
}

}  // namespace

FilterNoise NoiseOver(double x) {
  if (x < 1) return {MomentSeries(0, x), MomentSeries(1, x), MomentSeries(2, x)};
  const double e2 = std::exp(-2 * x);
  return {(1 - e2) / 2, 0.25 - e2 * (0.25 + x / 2), 0.25 - e2 * (0.25 + x / 2 + x * x / 2)};
}

}  // namespace internal

namespace {

constexpr double kFoot = 0.3048;
constexpr double kLeastAirspeed = 1;

/// First-order filter of unit variance over `x` time constants.
void StepFirst(double x, double normal, double& state) { state = std::exp(-x) * state + std::sqrt(-std::expm1(-2 * x)) * normal; }

/// The two states of the second-order filter, the noise correlated by Cholesky's factor.
void StepSecond(double x, double n1, double n2, double* state) {
  const internal::FilterNoise q = internal::NoiseOver(x);
  const double e = std::exp(-x), l11 = std::sqrt(q.q11), l21 = q.q12 / l11;
  const double l22 = std::sqrt(std::max(0.0, q.q22 - l21 * l21));
  state[1] = e * (state[1] + x * state[0]) + l21 * n1 + l22 * n2;
  state[0] = e * state[0] + l11 * n1;
}

/// (1 + sqrt(3) s) / (1 + s)^2, MIL-F-8785C's lateral and vertical filter, of unit variance.
double SecondOutput(const double* state) { return std::numbers::sqrt3 * state[0] + (1 - std::numbers::sqrt3) * state[1]; }

/// Steady state: variances 1/2 and 1/4, covariance 1/4.
void StartSecond(RngStream& random, double* state) {
  const double n1 = random.Normal(), n2 = random.Normal();
  state[0] = std::sqrt(0.5) * n1;
  state[1] = std::sqrt(0.125) * (n1 + n2);
}

void Start(const DrydenScales& scales, RngStream& random, DrydenState& state) {
  state.u = random.Normal();
  state.roll = random.Normal();
  StartSecond(random, state.v);
  StartSecond(random, state.w);
  state.v_slow = scales.sigma.y * SecondOutput(state.v);
  state.w_slow = scales.sigma.z * SecondOutput(state.w);
  state.started = true;
}

/// Low-pass over x time constants of a signal that goes straight from `from` to `to`.
void FollowSlowly(double x, double from, double to, double& slow) {
  const double e = std::exp(-x), share = -std::expm1(-x) / x;
  slow = e * slow + (share - e) * from + (1 - share) * to;
}

}  // namespace

DrydenScales LowAltitudeDryden(double height, double wind_6m) {
  const double feet = std::clamp(height / kFoot, 10.0, 1000.0);
  const double slope = 0.177 + 0.000823 * feet;
  const double across = feet / std::pow(slope, 1.2) * kFoot;
  const double vertical = 0.1 * wind_6m, horizontal = vertical / std::pow(slope, 0.4);
  return {{across, across, feet * kFoot}, {horizontal, horizontal, vertical}};
}

DrydenSample StepDryden(const DrydenScales& scales, double airspeed, double span, double dt, RngStream& random, DrydenState& state) {
  if (!state.started) Start(scales, random, state);
  const double speed = std::max(airspeed, kLeastAirspeed), way = speed * dt;
  const double old_v = scales.sigma.y * SecondOutput(state.v), old_w = scales.sigma.z * SecondOutput(state.w);

  // In this order, so that the stream's numbers always mean the same.
  const double n_u = random.Normal(), n_roll = random.Normal();
  const double n_v1 = random.Normal(), n_v2 = random.Normal();
  const double n_w1 = random.Normal(), n_w2 = random.Normal();
  StepFirst(way / scales.length.x, n_u, state.u);
  StepSecond(way / scales.length.y, n_v1, n_v2, state.v);
  StepSecond(way / scales.length.z, n_w1, n_w2, state.w);
  const double v = scales.sigma.y * SecondOutput(state.v), w = scales.sigma.z * SecondOutput(state.w);

  // Rates: p has its own noise; q and r are slopes of w and v along the way, smoothed over the span.
  constexpr double pi = std::numbers::pi;
  const double pitch_way = 4 * span / pi, yaw_way = 3 * span / pi;
  const double length = scales.length.z;
  const double roll_sigma = scales.sigma.z * std::sqrt(0.1 * pi * pi / span * std::cbrt(pi / (4 * span * length * length)));
  StepFirst(way / pitch_way, n_roll, state.roll);
  FollowSlowly(way / pitch_way, old_w, w, state.w_slow);
  FollowSlowly(way / yaw_way, old_v, v, state.v_slow);
  return {{scales.sigma.x * state.u, v, w}, {roll_sigma * state.roll, (w - state.w_slow) / pitch_way, (v - state.v_slow) / yaw_way}};
}

}  // namespace airsim360
