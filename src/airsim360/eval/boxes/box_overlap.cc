#include "airsim360/eval/boxes/box_overlap.h"

#include <algorithm>
#include <cmath>

#include "airsim360/math/plane.h"
#include "airsim360/math/triangulate.h"

namespace airsim360 {
namespace {

std::array<Vec2d, 4> Footprint(const UprightBox& box) {
  const Vec2d along{std::cos(box.yaw) * box.length / 2, std::sin(box.yaw) * box.length / 2},
      across{-std::sin(box.yaw) * box.width / 2, std::cos(box.yaw) * box.width / 2}, centre{box.centre.x, box.centre.y};
  return {centre - along - across, centre + along - across, centre + along + across, centre - along + across};
}

double SharedFootprint(const UprightBox& a, const UprightBox& b) {
  const auto first = Footprint(a), second = Footprint(b);
  return std::abs(SignedArea(ClipConvex(first, second)));
}

std::vector<Vec2d> CounterClockwise(std::span<const Vec2d> polygon) {
  std::vector<Vec2d> ring(polygon.begin(), polygon.end());
  if (SignedArea(ring) < 0) std::reverse(ring.begin(), ring.end());
  return ring;
}

std::vector<std::array<Vec2d, 3>> Triangles(std::span<const Vec2d> polygon) {
  const std::vector<Vec2d> ring = CounterClockwise(polygon);
  const std::array<uint32_t, 1> sizes = {static_cast<uint32_t>(ring.size())};
  const std::vector<uint32_t> corners = TriangulateRings(ring, sizes);
  std::vector<std::array<Vec2d, 3>> triangles;
  for (size_t i = 0; i + 2 < corners.size(); i += 3) triangles.push_back({ring[corners[i]], ring[corners[i + 1]], ring[corners[i + 2]]});
  return triangles;
}

}  // namespace

std::vector<Vec2d> ClipConvex(std::span<const Vec2d> polygon, std::span<const Vec2d> convex) {
  std::vector<Vec2d> kept(polygon.begin(), polygon.end());
  for (size_t i = 0; i < convex.size() && !kept.empty(); ++i) {
    const Vec2d from = convex[i], edge = convex[(i + 1) % convex.size()] - from;
    std::vector<Vec2d> next;
    for (size_t k = 0; k < kept.size(); ++k) {
      const Vec2d a = kept[k], b = kept[(k + 1) % kept.size()];
      const double da = Cross(edge, a - from), db = Cross(edge, b - from);
      if (da >= 0) next.push_back(a);
      if ((da > 0 && db < 0) || (da < 0 && db > 0)) next.push_back(a + (b - a) * (da / (da - db)));
    }
    kept = std::move(next);
  }
  return kept;
}

double SharedPolygonArea(std::span<const Vec2d> a, std::span<const Vec2d> b) {
  double area = 0;
  const auto second = Triangles(b);
  for (const auto& one : Triangles(a)) {
    for (const auto& other : second) area += std::abs(SignedArea(ClipConvex(one, other)));
  }
  return area;
}

double FootprintOverlap(const UprightBox& a, const UprightBox& b) {
  const double shared = SharedFootprint(a, b);
  return shared / (a.length * a.width + b.length * b.width - shared);
}

double VolumeOverlap(const UprightBox& a, const UprightBox& b) {
  const double low = std::max(a.centre.z - a.height / 2, b.centre.z - b.height / 2),
               high = std::min(a.centre.z + a.height / 2, b.centre.z + b.height / 2);
  if (high <= low) return 0;
  const double shared = SharedFootprint(a, b) * (high - low);
  return shared / (a.length * a.width * a.height + b.length * b.width * b.height - shared);
}

double WrappedBoxOverlap(std::array<double, 4> d, std::array<double, 4> t, bool crowd, double columns) {
  const double height = std::min(d[1] + d[3], t[1] + t[3]) - std::max(d[1], t[1]);
  if (!(height > 0)) return 0;
  // Both begin in the first turn; they can meet there, or one a turn later.
  d[0] -= std::floor(d[0] / columns) * columns;
  t[0] -= std::floor(t[0] / columns) * columns;
  double width = 0;
  for (const double turn : {-columns, 0.0, columns})
    width += std::max(0.0, std::min(d[0] + d[2], t[0] + turn + t[2]) - std::max(d[0], t[0] + turn));
  const double shared = std::min({width, d[2], t[2]}) * height, area = d[2] * d[3];
  if (!(shared > 0)) return 0;
  return shared / (crowd ? area : area + t[2] * t[3] - shared);
}

}  // namespace airsim360
