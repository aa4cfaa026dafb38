// Boost.GridPolygon's Booleans (sweep line on integers; BSL-1.0) lie behind this one file.
#include "airsim360/worlds/osm/data/patches.h"

#include <algorithm>
#include <boost/polygon/polygon.hpp>
#include <cmath>

namespace airsim360::internal {
namespace {

namespace gtl = boost::polygon;
using namespace boost::polygon::operators;
using Point = gtl::point_data<int>;
using GridPolygon = gtl::polygon_with_holes_data<int>;
using Set = gtl::polygon_set_data<int>;

constexpr double kGrid = 1000;        // units a metre
constexpr double kFarthest = 500000;  // metres; beyond, corners are moved in
constexpr double kSmallest = 0.02;    // m^2

Point Snap(Vec2d p) {
  const auto unit = [](double x) { return static_cast<int>(std::lround(std::clamp(x, -kFarthest, kFarthest) * kGrid)); };
  return {unit(p.x), unit(p.y)};
}

void Insert(Set& set, const Ring& ring, bool hole) {
  std::vector<Point> points;
  for (Vec2d p : ring) {
    const Point point = Snap(p);
    if (points.empty() || !(points.back() == point)) points.push_back(point);
  }
  while (points.size() > 1 && points.front() == points.back()) points.pop_back();
  if (points.size() < 3) return;
  gtl::polygon_data<int> polygon;
  polygon.set(points.begin(), points.end());
  set.insert(polygon, hole);
}

Set SetOf(std::span<const Patch> patches) {
  // Each area by itself first: its holes are its own.
  Set all;
  for (const Patch& patch : patches) {
    if (patch.holes.empty()) {
      Insert(all, patch.outer, false);
      continue;
    }
    Set one, holes;
    Insert(one, patch.outer, false);
    for (const Ring& hole : patch.holes) Insert(holes, hole, false);
    one -= holes;
    all.insert(one);
  }
  return all;
}

template <class Corners>
Ring RingOf(const Corners& begin, const Corners& end) {
  Ring ring;
  for (auto it = begin; it != end; ++it) ring.push_back({static_cast<double>(it->x()) / kGrid, static_cast<double>(it->y()) / kGrid});
  while (ring.size() > 1 && ring.front() == ring.back()) ring.pop_back();
  return ring;
}

Patches PatchesOf(const Set& set) {
  std::vector<GridPolygon> polygons;
  set.get(polygons);
  Patches patches;
  for (const GridPolygon& polygon : polygons) {
    Patch patch;
    patch.outer = RingOf(polygon.begin(), polygon.end());
    if (SignedArea(patch.outer) < 0) std::reverse(patch.outer.begin(), patch.outer.end());
    for (auto hole = polygon.begin_holes(); hole != polygon.end_holes(); ++hole) {
      Ring ring = RingOf(hole->begin(), hole->end());
      if (SignedArea(ring) > 0) std::reverse(ring.begin(), ring.end());
      if (ring.size() >= 3 && std::abs(SignedArea(ring)) > 0.001) patch.holes.push_back(std::move(ring));
    }
    if (patch.outer.size() >= 3 && Area(patch) >= kSmallest) patches.push_back(std::move(patch));
  }
  return patches;
}

}  // namespace

Patches Unite(std::span<const Patch> areas) { return PatchesOf(SetOf(areas)); }

Patches Subtract(std::span<const Patch> from, std::span<const Patch> what) {
  Set set = SetOf(from);
  set -= SetOf(what);
  return PatchesOf(set);
}

Patches Intersect(std::span<const Patch> a, std::span<const Patch> b) {
  Set set = SetOf(a);
  set &= SetOf(b);
  return PatchesOf(set);
}

Patches Band(std::span<const Vec2d> line, double left, double right) {
  Patches pieces;
  const size_t n = line.size();
  for (size_t i = 0; i + 1 < n; ++i) {
    const Vec2d v = line[i + 1] - line[i];
    const double length = std::hypot(v.x, v.y);
    if (length < 1e-6) continue;
    const Vec2d side{-v.y / length, v.x / length};
    pieces.push_back({{line[i] - side * right, line[i + 1] - side * right, line[i + 1] + side * left, line[i] + side * left}, {}});
    if (i + 2 >= n) continue;
    // The wedge on the outside of the bend.
    const Vec2d w = line[i + 2] - line[i + 1];
    const double next = std::hypot(w.x, w.y);
    if (next < 1e-6) continue;
    const double turn = (v.x * w.y - v.y * w.x) / (length * next), straight = (v.x * w.x + v.y * w.y) / (length * next);
    const double r = turn > 0 ? right : left, sign = turn > 0 ? -1 : 1;
    if (r <= 1e-6 || std::abs(turn) < 1e-4) continue;
    const Vec2d p = line[i + 1], other{-w.y / next, w.x / next};
    const Vec2d a = side * (sign * r), b = other * (sign * r);
    Ring wedge{p, p + a};
    if (straight > -0.5) {
      const Vec2d m = a + b;
      wedge.push_back(p + m * (2 * r * r / (m.x * m.x + m.y * m.y)));
    } else {
      const double a0 = std::atan2(a.y, a.x);
      double sweep = std::atan2(b.y, b.x) - a0;
      sweep -= 2 * M_PI * std::round(sweep / (2 * M_PI));
      for (int k = 1; k < 8; ++k) wedge.push_back(p + Vec2d{std::cos(a0 + sweep * k / 8), std::sin(a0 + sweep * k / 8)} * r);
    }
    wedge.push_back(p + b);
    pieces.push_back({std::move(wedge), {}});
  }
  return pieces.size() == 1 ? pieces : Unite(pieces);
}

}  // namespace airsim360::internal
