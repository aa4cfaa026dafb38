#include "airsim360/planning/certificate.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace airsim360 {
namespace {

constexpr double kFar = 8;       // metres beyond the radius that exact queries look
constexpr double kRoomy = 0.75;  // metres beyond the radius at which a coarse bound is good enough to step by

double Bound(const ClearanceQuery& world, Vec3d p, double radius) {
  return world.LowerBound(p, radius + kRoomy, radius + kFar);
}

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

}  // namespace

Certificate Certify(const PolynomialTrajectory& trajectory, const TrajectoryPeaks& peaks,
                    const ClearanceQuery& world, double radius, TimeSpan span) {
  const double end = std::min(span.to, trajectory.duration());
  Certificate result;
  result.least_clearance = std::numeric_limits<double>::infinity();
  for (double t = span.from;;) {
    const TrajectoryPoint point = trajectory.At(t);
    const double clearance = Bound(world, point.p, radius);
    ++result.queries;
    result.least_clearance = std::min(result.least_clearance, clearance);
    if (!(clearance >= radius + kCertificateSlack)) {
      result.violation_time = t;
      return result;
    }
    if (t >= end) break;
    // Half of the slack stays, for the rounding of positions and times.
    const double way = clearance - radius - 0.5 * kCertificateSlack;
    t = std::min(t + TimeToGo(way, Norm(point.v), peaks), end);
  }
  result.certified = true;
  return result;
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
