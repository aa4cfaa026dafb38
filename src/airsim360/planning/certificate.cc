#include "airsim360/planning/certificate.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace airsim360 {
namespace {

constexpr double kFarthest = 1e4;  // metres that are looked for the least clearance
constexpr double kFar = 8;         // metres beyond the radius that exact queries look
constexpr double kRoomy = 0.75;    // metres beyond the radius at which a coarse bound is good enough to step by

double Bound(const ClearanceQuery& world, Vec3d p, double radius) { return world.LowerBound(p, radius + kRoomy, radius + kFar); }

// The longest time in which a point that is now at `speed` cannot have gone farther than `way`: it goes at
// most speed t + acceleration t^2 / 2, and at most top_speed t.
double TimeToGo(double way, double speed, const TrajectoryPeaks& peaks) {
  const double a = peaks.acceleration.value;
  // The root of a t^2 / 2 + speed t = way in the form that does not cancel.
  const double by_acceleration = 2 * way / (speed + std::sqrt(speed * speed + 2 * a * way));
  const double by_speed = way / peaks.speed.value;
  const double t = std::max(by_acceleration, by_speed);
  return std::isnan(t) ? std::numeric_limits<double>::infinity() : t;  // a path that stands still
}

// The least clearance on a way of length `way` whose ends have clearances a and b: it changes by no more than
// the way.
double Between(double a, double b, double way) { return std::min({a, b, (a + b - way) / 2}); }

// Part of a path with the clearances of its ends, and what the clearance cannot fall below between.
struct Stretch {
  double from, to, clearance_from, clearance_to, bound;
  bool operator<(const Stretch& other) const { return bound > other.bound; }  // the least on top of a heap
};

}  // namespace

Certificate Certify(const PolynomialTrajectory& trajectory, const TrajectoryPeaks& peaks, const ClearanceQuery& world, double radius,
                    TimeSpan span) {
  const double end = std::min(span.to, trajectory.duration());
  Certificate result;
  result.least_clearance = std::numeric_limits<double>::infinity();
  double way = 0, last = result.least_clearance;  // gone since the clearance was `last`
  for (double t = span.from;;) {
    const TrajectoryPoint point = trajectory.At(t);
    const double clearance = Bound(world, point.p, radius);
    ++result.queries;
    // Half of the slack covers the rounding of the way.
    result.least_clearance = std::min({result.least_clearance, clearance, Between(last, clearance, way + 0.5 * kCertificateSlack)});
    if (!(clearance >= radius + kCertificateSlack)) {
      result.violation_time = t;
      result.least_clearance = clearance;
      return result;
    }
    if (t >= end) break;
    // Half of the slack stays, for the rounding of positions and times.
    way = clearance - radius - 0.5 * kCertificateSlack;
    last = clearance;
    t = std::min(t + TimeToGo(way, Norm(point.v), peaks), end);
  }
  result.certified = true;
  return result;
}

double LeastClearanceBound(const PolynomialTrajectory& trajectory, const TrajectoryPeaks& peaks, const ClearanceQuery& world, int queries) {
  constexpr double kRounding = 5e-5, kTolerance = 1e-4;  // metres
  const auto clearance = [&](double t) { return std::max(0.0, world.Clearance(trajectory.At(t).p, kFarthest) - kRounding); };
  const auto stretch = [&](double from, double to, double a, double b) {
    const double t = to - from, speed = std::min(Norm(trajectory.At(from).v), Norm(trajectory.At(to).v));
    const double way = std::min(peaks.speed.value * t, speed * t + 0.5 * peaks.acceleration.value * t * t);
    return Stretch{from, to, a, b, Between(a, b, way)};
  };
  std::vector<Stretch> stretches;
  double seen = clearance(0), at_start = seen;
  for (size_t i = 0; i < trajectory.segments(); ++i) {
    const double end = trajectory.start(i) + trajectory.durations()[i], at_end = clearance(end);
    stretches.push_back(stretch(trajectory.start(i), end, at_start, at_end));
    at_start = at_end;
    seen = std::min(seen, at_end);
  }
  // The stretch that may come nearest is halved, until it cannot come much nearer than what was met.
  std::make_heap(stretches.begin(), stretches.end());
  for (int i = static_cast<int>(stretches.size()); i < queries && stretches.front().bound < seen - kTolerance && seen > 0; ++i) {
    std::pop_heap(stretches.begin(), stretches.end());
    const Stretch whole = stretches.back();
    const double middle = 0.5 * (whole.from + whole.to), met = clearance(middle);
    if (!(whole.from < middle && middle < whole.to)) break;
    seen = std::min(seen, met);
    stretches.back() = stretch(whole.from, middle, whole.clearance_from, met);
    std::push_heap(stretches.begin(), stretches.end());
    stretches.push_back(stretch(middle, whole.to, met, whole.clearance_to));
    std::push_heap(stretches.begin(), stretches.end());
  }
  return std::max(0.0, std::ranges::min(stretches, {}, &Stretch::bound).bound);
}

bool SegmentIsClear(Vec3d a, Vec3d b, const ClearanceQuery& world, double radius) {
  const double length = Norm(b - a);
  for (double s = 0;;) {
    const Vec3d p = length > 0 ? a + (b - a) * (s / length) : a;
    const double clearance = Bound(world, p, radius);
    if (!(clearance >= radius + kCertificateSlack)) return false;
    if (s >= length) return true;
    s = std::min(s + clearance - radius - 0.5 * kCertificateSlack, length);
  }
}

}  // namespace airsim360
