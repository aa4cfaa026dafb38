#include "airsim360/planning/splines/trajectory_limits.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "airsim360/base/error.h"
#include "airsim360/math/standard_atmosphere.h"
#include "airsim360/planning/splines/bernstein.h"

namespace airsim360 {
namespace {

using internal::Bernstein;

/// Relative width of a certified maximum, and of its square; rounding of the control values is below 1e-13 of
/// the largest.
constexpr double kWidth = 1e-11, kRounding = 1e-13;

/// n-th derivative of one axis over a segment, in SI units, as a function of tau = t / T.
Bernstein Derivative(const PolynomialTrajectory& trajectory, size_t segment, int axis, int n) {
  const std::span<const double> c = trajectory.coefficients(segment, axis);
  const double duration = trajectory.durations()[segment];
  std::array<double, 8> powers = {};
  double power = 1;
  for (size_t k = static_cast<size_t>(n); k < c.size(); ++k, power *= duration) {
    double factor = 1;
    for (size_t f = k; f > k - static_cast<size_t>(n); --f) factor *= static_cast<double>(f);
    powers[k - static_cast<size_t>(n)] = factor * c[k] * power;
  }
  return Bernstein::FromPowers(powers.data(), static_cast<int>(c.size()) - 1 - n);
}

Bernstein SquaredNorm(const std::array<Bernstein, 3>& v) { return v[0] * v[0] + v[1] * v[1] + v[2] * v[2]; }

std::array<Bernstein, 3> Derivatives(const PolynomialTrajectory& trajectory, size_t segment, int n) {
  return {Derivative(trajectory, segment, 0, n), Derivative(trajectory, segment, 1, n), Derivative(trajectory, segment, 2, n)};
}

/// Maximum over the path of one polynomial per segment.
template <class Polynomial>
CertifiedPeak Maximum(const PolynomialTrajectory& trajectory, Polynomial polynomial) {
  double floor = -std::numeric_limits<double>::infinity(), bound = floor, time = 0;
  for (size_t segment = 0; segment < trajectory.segments(); ++segment) {
    const Bernstein p = polynomial(segment);
    double magnitude = 0, at = -1;
    for (int i = 0; i <= p.degree; ++i) magnitude = std::max(magnitude, std::abs(p.control[i]));
    const double tolerance = kWidth * std::max(magnitude * 1e-3, std::abs(floor) < magnitude ? std::abs(floor) : magnitude);
    bound = std::max(bound, internal::RaiseMaximum(p, tolerance, floor, at) + kRounding * magnitude);
    if (at >= 0) time = trajectory.start(segment) + at * trajectory.durations()[segment];
  }
  return {bound, time};
}

CertifiedPeak Root(CertifiedPeak squared) { return {std::sqrt(std::max(0.0, squared.value)), squared.time}; }

}  // namespace

CertifiedPeak PeakOfNorm(const PolynomialTrajectory& trajectory, int derivative) {
  return Root(Maximum(trajectory, [&](size_t segment) { return SquaredNorm(Derivatives(trajectory, segment, derivative)); }));
}

CertifiedPeak PeakAlong(const PolynomialTrajectory& trajectory, int derivative, Vec3d direction) {
  return Maximum(trajectory, [&](size_t segment) {
    const std::array<Bernstein, 3> d = Derivatives(trajectory, segment, derivative);
    return d[0] * direction.x + d[1] * direction.y + d[2] * direction.z;
  });
}

CertifiedPeak PeakOfAxis(const PolynomialTrajectory& trajectory, int derivative, int axis) {
  Vec3d direction;
  direction[axis] = 1;
  const CertifiedPeak up = PeakAlong(trajectory, derivative, direction);
  const CertifiedPeak down = PeakAlong(trajectory, derivative, -direction);
  return up.value >= down.value ? up : down;
}

CertifiedPeak PeakThrust(const PolynomialTrajectory& trajectory) {
  return Root(Maximum(trajectory, [&](size_t segment) {
    std::array<Bernstein, 3> a = Derivatives(trajectory, segment, 2);
    a[2] = Shifted(a[2], kGravity);
    return SquaredNorm(a);
  }));
}

CertifiedPeak PeakBodyRate(const PolynomialTrajectory& trajectory) {
  // rate^2 = |jerk x thrust|^2 / |thrust|^4. Dinkelbach's iteration: the numerator less rate^2 times the
  // denominator is a polynomial; where it is largest the quotient is nearer to its maximum.
  const auto excess = [&](double rate_squared) {
    return Maximum(trajectory, [&](size_t segment) {
      std::array<Bernstein, 3> c = Derivatives(trajectory, segment, 2);
      const std::array<Bernstein, 3> j = Derivatives(trajectory, segment, 3);
      c[2] = Shifted(c[2], kGravity);
      const std::array<Bernstein, 3> cross = {j[1] * c[2] - j[2] * c[1], j[2] * c[0] - j[0] * c[2], j[0] * c[1] - j[1] * c[0]};
      const Bernstein one = Shifted(Bernstein{.degree = 2}, 1), thrust = SquaredNorm(c);
      return SquaredNorm(cross) * one - thrust * thrust * rate_squared;
    });
  };
  const auto rate_at = [&](double t) {
    const TrajectoryPoint point = trajectory.At(t);
    const Vec3d thrust = point.a + Vec3d{0, 0, kGravity};
    const Vec3d cross = Cross(point.jerk, thrust);
    const double squared = Dot(thrust, thrust);
    return Dot(cross, cross) / (squared * squared);
  };
  CertifiedPeak peak = {0, 0};
  for (int i = 0; i < 20; ++i) {
    const CertifiedPeak worst = excess(peak.value * (1 + 1e-9));
    if (worst.value <= 0) break;
    const double next = rate_at(worst.time);
    // Free fall makes the attitude undefined and the rate unbounded.
    if (!std::isfinite(next)) return {std::numeric_limits<double>::infinity(), worst.time};
    peak = next > peak.value ? CertifiedPeak{next, worst.time} : CertifiedPeak{peak.value * (1 + 1e-6) + 1e-12, peak.time};
  }
  return {std::sqrt(peak.value * (1 + 1e-9)), peak.time};
}

void CheckLimits(const TrajectoryLimits& limits) {
  const auto check = [](double value, const char* name) {
    if (!(value > 0)) {
      throw InputError(std::string("limits: ") + name + " is " + std::to_string(value) + ", must be positive");
    }
  };
  check(limits.speed, "speed");
  check(limits.acceleration, "acceleration");
  for (int axis = 0; axis < 3; ++axis) {
    check(limits.axis_speed[axis], "axis speed");
    check(limits.axis_acceleration[axis], "axis acceleration");
  }
  check(limits.climb, "climb");
  check(limits.descent, "descent");
  check(limits.body_rate, "body rate");
  if (!(limits.thrust_per_mass > kGravity)) {
    throw InputError("limits: thrust per mass is " + std::to_string(limits.thrust_per_mass) + " m/s^2, must exceed gravity (9.80665)");
  }
}

namespace {

bool Finite(double value) { return value < TrajectoryLimits::kNone; }

/// The factor by which time must stretch for the limits that scale exactly; 0 if none is finite.
double ExactScale(const PolynomialTrajectory& trajectory, const TrajectoryLimits& limits) {
  double scale = 0;
  const auto speed = [&](double peak, double limit) { scale = std::max(scale, peak / limit); };
  const auto acceleration = [&](double peak, double limit) { scale = std::max(scale, std::sqrt(std::max(0.0, peak) / limit)); };
  if (Finite(limits.speed) || Finite(limits.acceleration)) {
    const TrajectoryPeaks peaks = CertifiedPeaks(trajectory);
    speed(peaks.speed.value, limits.speed);
    acceleration(peaks.acceleration.value, limits.acceleration);
  }
  for (int axis = 0; axis < 3; ++axis) {
    if (Finite(limits.axis_speed[axis])) {
      speed(PeakOfAxis(trajectory, 1, axis).value, limits.axis_speed[axis]);
    }
    if (Finite(limits.axis_acceleration[axis])) {
      acceleration(PeakOfAxis(trajectory, 2, axis).value, limits.axis_acceleration[axis]);
    }
  }
  if (Finite(limits.climb)) speed(PeakAlong(trajectory, 1, {0, 0, 1}).value, limits.climb);
  if (Finite(limits.descent)) speed(PeakAlong(trajectory, 1, {0, 0, -1}).value, limits.descent);
  return scale;
}

bool WithinDroneLimits(const PolynomialTrajectory& trajectory, const TrajectoryLimits& limits) {
  return (!Finite(limits.thrust_per_mass) || PeakThrust(trajectory).value <= limits.thrust_per_mass) &&
         (!Finite(limits.body_rate) || PeakBodyRate(trajectory).value <= limits.body_rate);
}

}  // namespace

bool WithinLimits(const PolynomialTrajectory& trajectory, const TrajectoryLimits& limits) {
  return ExactScale(trajectory, limits) <= 1 && WithinDroneLimits(trajectory, limits);
}

PolynomialTrajectory ScaleToLimits(const PolynomialTrajectory& trajectory, const TrajectoryLimits& limits) {
  CheckLimits(limits);
  // A hair slower than the exact factor, for the rounding of the scaled coefficients; certified again,
  // because two certificates of one path may differ by their width.
  double exact = ExactScale(trajectory, limits) * (1 + 0x1p-40);
  for (int i = 0; exact > 0 && i < 4; ++i) {
    const double again = ExactScale(Slowed(trajectory, exact), limits);
    if (again <= 1) break;
    exact *= again * (1 + 0x1p-40);
  }
  const bool drone = Finite(limits.thrust_per_mass) || Finite(limits.body_rate);
  double low = exact, high = exact > 0 ? exact : drone ? 1 : 0;
  if (high == 0) return trajectory;
  if (!drone || WithinDroneLimits(Slowed(trajectory, high), limits)) return Slowed(trajectory, high);
  while (!WithinDroneLimits(Slowed(trajectory, high), limits)) {
    low = high;
    high *= 2;
    if (high > 0x1p40 * std::max(exact, 1.0)) throw InputError("limits: no slowing down satisfies them");
  }
  while (high - low > 1e-9 * high) {
    const double middle = 0.5 * (low + high);
    (WithinDroneLimits(Slowed(trajectory, middle), limits) ? high : low) = middle;
  }
  return Slowed(trajectory, high);
}

PolynomialTrajectory SolveWithinLimits(const MinimumSnapProblem& problem, const TrajectoryLimits& limits) {
  CheckLimits(limits);
  MinimumSnapSolver solver;
  std::vector<double> durations(problem.durations.size());
  const auto solve = [&](double scale) {
    for (size_t i = 0; i < durations.size(); ++i) durations[i] = problem.durations[i] * scale;
    MinimumSnapProblem scaled = problem;
    scaled.durations = durations;
    solver.Solve(scaled);
    return solver.Trajectory();
  };
  constexpr double kLargest = 1024;
  double high = 1;
  while (!WithinLimits(solve(high), limits)) {
    high *= 2;
    if (high > kLargest) throw InputError("limits: not met by any durations up to 1024 times those given");
  }
  double low = high;
  while (low > 1 / kLargest && WithinLimits(solve(low), limits)) {
    high = low;
    low /= 2;
  }
  while (high - low > 1e-6 * high) {
    const double middle = 0.5 * (low + high);
    (WithinLimits(solve(middle), limits) ? high : low) = middle;
  }
  return solve(high);
}

}  // namespace airsim360
