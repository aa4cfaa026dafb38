#include "airsim360/planning/yaw_profile.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "airsim360/base/error.h"
#include "airsim360/math/angles.h"

namespace airsim360 {
namespace {

/// Shorter horizontal vectors (m/s or m) have no heading worth following.
constexpr double kShortest = 1e-3;
/// Steps by which the nearest moment with a heading is looked for.
constexpr int kSteps = 4096;
/// By which that moment is found between two steps.
constexpr int kHalvings = 40;

double Wrapped(double yaw) {
  const double wrapped = std::remainder(yaw, 2 * kPi);
  return wrapped <= -kPi ? wrapped + 2 * kPi : wrapped;
}

std::optional<double> Heading(Vec3d v) {
  if (std::hypot(v.x, v.y) < kShortest) return std::nullopt;
  return std::atan2(v.y, v.x);
}

/// heading(t), or that of the nearest time where there is one.
template <class F>
double NearestHeading(double t, double duration, F heading) {
  t = std::clamp(t, 0.0, duration);
  if (const std::optional<double> yaw = heading(t)) return *yaw;
  for (int i = 1; i <= kSteps; ++i) {
    const double step = duration / kSteps, away = step * i;
    for (const double sign : {-1.0, 1.0}) {
      const double near = t + sign * away;
      if (near < 0 || near > duration || !heading(near)) continue;
      // The moment itself, the same for every t around it: a vehicle at rest does not turn.
      double without = near - sign * step, with = near;
      for (int k = 0; k < kHalvings; ++k) {
        const double middle = 0.5 * (without + with);
        (heading(middle) ? with : without) = middle;
      }
      return *heading(with);
    }
  }
  return 0;
}

double Interpolate(const GivenYaw& given, double t) {
  const auto after = std::upper_bound(given.times.begin(), given.times.end(), t);
  if (after == given.times.begin()) return Wrapped(given.yaws.front());
  if (after == given.times.end()) return Wrapped(given.yaws.back());
  const size_t i = static_cast<size_t>(after - given.times.begin());
  const double share = (t - given.times[i - 1]) / (given.times[i] - given.times[i - 1]);
  return Wrapped(given.yaws[i - 1] + share * Wrapped(given.yaws[i] - given.yaws[i - 1]));
}

double Evaluate(const YawPowers& powers, const PolynomialTrajectory& path, double t) {
  t = std::clamp(t, 0.0, path.duration());
  size_t i = 0;
  while (i + 1 < path.segments() && t >= path.start(i + 1)) ++i;
  double yaw = 0;
  for (size_t k = powers.segments[i].size(); k-- > 0;) yaw = yaw * (t - path.start(i)) + powers.segments[i][k];
  return Wrapped(yaw);
}

void Check(const YawPowers& powers, const PolynomialTrajectory& path) {
  if (powers.segments.size() != path.segments()) {
    throw InputError("yaw: " + std::to_string(powers.segments.size()) + " polynomials for " + std::to_string(path.segments()) +
                     " segments");
  }
  for (size_t i = 0; i < powers.segments.size(); ++i) {
    for (const double c : powers.segments[i]) {
      if (!std::isfinite(c)) throw InputError("yaw: polynomial " + std::to_string(i) + " is not finite");
    }
  }
}

void Check(const GivenYaw& given) {
  if (given.times.empty() || given.times.size() != given.yaws.size()) {
    throw InputError("yaw: " + std::to_string(given.times.size()) + " times and " + std::to_string(given.yaws.size()) + " headings");
  }
  for (size_t i = 0; i < given.times.size(); ++i) {
    if (!std::isfinite(given.times[i]) || !std::isfinite(given.yaws[i])) {
      throw InputError("yaw: entry " + std::to_string(i) + " is not finite");
    }
    if (i > 0 && !(given.times[i] > given.times[i - 1])) {
      throw InputError("yaw: time " + std::to_string(i) + " does not come after the one before");
    }
  }
}

}  // namespace

YawProfile::YawProfile(const PolynomialTrajectory& trajectory, YawRule rule) : trajectory_(trajectory), rule_(std::move(rule)) {
  if (const auto* constant = std::get_if<ConstantYaw>(&rule_); constant && !std::isfinite(constant->yaw)) {
    throw InputError("yaw: the heading is not finite");
  }
  if (const auto* towards = std::get_if<YawTowards>(&rule_); towards && !std::isfinite(Norm(towards->point))) {
    throw InputError("yaw: the point to look at is not finite");
  }
  if (const auto* given = std::get_if<GivenYaw>(&rule_)) Check(*given);
  if (const auto* powers = std::get_if<YawPowers>(&rule_)) Check(*powers, trajectory_);
}

double YawProfile::At(double t) const {
  if (const auto* constant = std::get_if<ConstantYaw>(&rule_)) return Wrapped(constant->yaw);
  if (const auto* given = std::get_if<GivenYaw>(&rule_)) return Interpolate(*given, t);
  if (const auto* powers = std::get_if<YawPowers>(&rule_)) return Evaluate(*powers, trajectory_, t);
  const auto* towards = std::get_if<YawTowards>(&rule_);
  return NearestHeading(t, trajectory_.duration(), [&](double time) {
    const TrajectoryPoint point = trajectory_.At(time);
    return Heading(towards ? towards->point - point.p : point.v);
  });
}

std::array<double, 8> YawProfile::Powers(double from, double duration, double near) const {
  constexpr int kNodes = 8, kBetween = 16;  // samples from one node to the next, so that no turn is missed
  double place[kNodes], difference[kNodes];
  double yaw = near;
  for (int i = 0; i < kNodes; ++i) {
    place[i] = 0.5 * (1 - std::cos(kPi * i / (kNodes - 1)));
    for (int k = i == 0 ? kBetween : 1; k <= kBetween; ++k) {
      const double before = i == 0 ? 0 : place[i - 1];
      const double at = before + (place[i] - before) * k / kBetween;
      yaw += std::remainder(At(from + at * duration) - yaw, 2 * kPi);
    }
    difference[i] = yaw;
  }
  // Newton's divided differences, then his form expanded from the last node to the first.
  for (int order = 1; order < kNodes; ++order) {
    for (int i = kNodes - 1; i >= order; --i) {
      difference[i] = (difference[i] - difference[i - 1]) / (place[i] - place[i - order]);
    }
  }
  std::array<double, kNodes> powers = {};
  for (int node = kNodes - 1; node >= 0; --node) {
    for (int i = kNodes - 1; i >= 0; --i) powers[i] = (i > 0 ? powers[i - 1] : 0) - place[node] * powers[i];
    powers[0] += difference[node];
  }
  double scale = 1;
  for (double& power : powers) {
    power *= scale;
    scale /= duration;
  }
  return powers;
}

}  // namespace airsim360
