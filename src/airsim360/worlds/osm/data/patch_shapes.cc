// Measures and triangles of patches: no third party needed.
#include <algorithm>
#include <cmath>

#include "airsim360/math/triangulate.h"
#include "airsim360/worlds/osm/data/patches.h"

namespace airsim360::internal {

double Area(const Patch& patch) {
  double area = std::abs(SignedArea(patch.outer));
  for (const Ring& hole : patch.holes) area -= std::abs(SignedArea(hole));
  return area;
}

double Area(std::span<const Patch> patches) {
  double sum = 0;
  for (const Patch& patch : patches) sum += Area(patch);
  return sum;
}

bool Inside(const Patch& patch, Vec2d p) {
  return InPolygon(patch.outer, p) &&
         std::none_of(patch.holes.begin(), patch.holes.end(), [&](const Ring& hole) { return InPolygon(hole, p); });
}

double DistanceToLine(std::span<const Vec2d> line, Vec2d p) {
  double best = line.size() == 1 ? std::hypot(line[0].x - p.x, line[0].y - p.y) : 1e18;
  for (size_t i = 0; i + 1 < line.size(); ++i) {
    const Vec2d a = line[i], v = line[i + 1] - a, w = p - a;
    const double t = std::clamp((w.x * v.x + w.y * v.y) / std::max(v.x * v.x + v.y * v.y, 1e-12), 0.0, 1.0);
    best = std::min(best, std::hypot(w.x - v.x * t, w.y - v.y * t));
  }
  return best;
}

double DistanceToRing(std::span<const Vec2d> ring, Vec2d p) {
  if (ring.empty()) return 1e18;
  const Vec2d ends[2] = {ring.back(), ring.front()};
  return std::min(DistanceToLine(ring, p), DistanceToLine(ends, p));
}

void Bounds2d::Add(Vec2d p) {
  min = {std::min(min.x, p.x), std::min(min.y, p.y)};
  max = {std::max(max.x, p.x), std::max(max.y, p.y)};
}

bool Bounds2d::Overlaps(const Bounds2d& other, double margin) const {
  return min.x <= other.max.x + margin && other.min.x <= max.x + margin && min.y <= other.max.y + margin && other.min.y <= max.y + margin;
}

Bounds2d BoundsOf(std::span<const Vec2d> ring) {
  Bounds2d box;
  for (Vec2d p : ring) box.Add(p);
  return box;
}

std::vector<uint32_t> Triangulate(const Patch& patch) {
  std::vector<Vec2d> points = patch.outer;
  std::vector<uint32_t> sizes{static_cast<uint32_t>(patch.outer.size())};
  for (const Ring& hole : patch.holes) {
    points.insert(points.end(), hole.begin(), hole.end());
    sizes.push_back(static_cast<uint32_t>(hole.size()));
  }
  return TriangulateRings(points, sizes);
}

}  // namespace airsim360::internal
