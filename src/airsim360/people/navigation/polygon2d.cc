#include "airsim360/people/navigation/polygon2d.h"

#include <algorithm>
#include <cmath>

#include "airsim360/math/plane.h"

namespace airsim360::internal {
namespace {}  // namespace

// Sutherland and Hodgman 1974, with the convex polygon as the window.
double ClippedArea(std::span<const Vec2d> polygon, std::span<const Vec2d> convex) {
  std::vector<Vec2d> rest(polygon.begin(), polygon.end()), next;
  for (size_t i = 0; i < convex.size() && !rest.empty(); ++i) {
    const Vec2d a = convex[i], edge = convex[(i + 1) % convex.size()] - a;
    next.clear();
    for (size_t k = 0; k < rest.size(); ++k) {
      const Vec2d p = rest[k], q = rest[(k + 1) % rest.size()];
      const double dp = Cross(edge, p - a), dq = Cross(edge, q - a);
      if (dp >= 0) next.push_back(p);
      if ((dp >= 0) != (dq >= 0)) next.push_back(p + (q - p) * (dp / (dp - dq)));
    }
    rest.swap(next);
  }
  return std::abs(SignedArea(rest));
}

Vec2d PointInFan(std::span<const Vec2d> convex, RngStream& rng) {
  double total = 0;
  for (size_t i = 1; i + 1 < convex.size(); ++i) total += Cross(convex[i] - convex[0], convex[i + 1] - convex[0]);
  double u = rng.Uniform() * total;
  size_t i = 1;
  for (; i + 2 < convex.size(); ++i) {
    const double area = Cross(convex[i] - convex[0], convex[i + 1] - convex[0]);
    if (u < area) break;
    u -= area;
  }
  double s = rng.Uniform(), t = rng.Uniform();
  if (s + t > 1) {
    s = 1 - s;
    t = 1 - t;
  }
  return convex[0] + (convex[i] - convex[0]) * s + (convex[i + 1] - convex[0]) * t;
}

// Andrew 1979.
std::vector<Vec2d> ConvexHull(std::vector<Vec2d> points) {
  std::sort(points.begin(), points.end(), [](Vec2d a, Vec2d b) { return a.x != b.x ? a.x < b.x : a.y < b.y; });
  std::vector<Vec2d> hull;
  for (int side = 0; side < 2; ++side) {
    const size_t first = hull.size();
    for (const Vec2d p : points) {
      while (hull.size() >= first + 2 && Cross(hull.back() - hull[hull.size() - 2], p - hull.back()) <= 0) hull.pop_back();
      hull.push_back(p);
    }
    if (!hull.empty()) hull.pop_back();
    std::reverse(points.begin(), points.end());
  }
  return hull;
}

}  // namespace airsim360::internal
