#include "airsim360/trace/closest_point.h"

#include <algorithm>
#include <cmath>

namespace airsim360::internal {
namespace {

Vec3f ClosestPointOnSegment(Vec3f p, Vec3f a, Vec3f b) {
  const Vec3f ab = b - a;
  const float length2 = Dot(ab, ab);
  if (!(length2 > 0)) return a;
  return a + ab * std::clamp(Dot(p - a, ab) / length2, 0.0f, 1.0f);
}

float Distance2(Vec3f a, Vec3f b) { return Dot(a - b, a - b); }

}  // namespace

Vec3f ClosestPointOnTriangle(Vec3f p, Vec3f a, Vec3f b, Vec3f c) {
  // Inside the prism over the triangle the answer is the foot of the perpendicular, else it is on an edge.
  const Vec3f n = Cross(b - a, c - a);
  const float n2 = Dot(n, n);
  if (n2 > 0) {
    const float wa = Dot(Cross(b - p, c - p), n), wb = Dot(Cross(c - p, a - p), n), wc = Dot(Cross(a - p, b - p), n);
    if (wa >= 0 && wb >= 0 && wc >= 0) return p - n * (Dot(p - a, n) / n2);
  }
  const Vec3f candidates[3] = {ClosestPointOnSegment(p, a, b), ClosestPointOnSegment(p, b, c), ClosestPointOnSegment(p, c, a)};
  return *std::min_element(candidates, candidates + 3, [&](Vec3f x, Vec3f y) { return Distance2(p, x) < Distance2(p, y); });
}

}  // namespace airsim360::internal
