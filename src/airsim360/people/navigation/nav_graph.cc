#include "airsim360/people/navigation/nav_graph.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

#include "airsim360/math/plane.h"

namespace airsim360::internal {
namespace {

// A gap of an edge narrower than that is rounding of the openings, not a wall.
constexpr double kSliver = 0.06;
// At a corner of a polygon, with rounding.
constexpr double kAtCorner = 1e-3;

uint32_t Root(std::vector<uint32_t>& parent, uint32_t i) {
  while (parent[i] != i) i = parent[i] = parent[parent[i]];
  return i;
}

Vec2d NearestOnSegment(Vec2d a, Vec2d b, Vec2d p) {
  const Vec2d d = b - a;
  const double n = Dot(d, d);
  const double t = n > 0 ? std::clamp(Dot(p - a, d) / n, 0.0, 1.0) : 0;
  return a + d * t;
}

// The opening of `other` that lies where one of `polygon` (number `index`) is, and its edge; nullopt: none lies there.
std::optional<std::pair<int, NavPortal>> OpeningBack(const NavPolygon& polygon, int edge, const NavPortal& portal, uint32_t index,
                                                     const NavPolygon& other) {
  const Vec2d from = polygon.corner[edge], along = polygon.corner[(edge + 1) % polygon.corners] - from;
  const Vec2d p = from + along * static_cast<double>(portal.t0), q = from + along * static_cast<double>(portal.t1), middle = (p + q) * 0.5;
  for (int i = 0; i < other.corners; ++i) {
    const Vec2d a = other.corner[i], d = other.corner[(i + 1) % other.corners] - a;
    const double n2 = Dot(d, d);
    if (n2 <= 0 || Dot(d, along) >= 0 || std::abs(Cross(d, middle - a)) > kSliver * std::sqrt(n2)) continue;
    const double t0 = std::clamp(Dot(q - a, d) / n2, 0.0, 1.0), t1 = std::clamp(Dot(p - a, d) / n2, 0.0, 1.0);
    if (t1 > t0) return std::pair{i, NavPortal{index, static_cast<float>(t0), static_cast<float>(t1)}};
  }
  return std::nullopt;
}

}  // namespace

BucketGrid::BucketGrid(Vec2d min, Vec2d max, double cell) : min_(min), cell_(cell) {
  columns_ = std::max(1, static_cast<int>(std::ceil((max.x - min.x) / cell)));
  rows_ = std::max(1, static_cast<int>(std::ceil((max.y - min.y) / cell)));
}

int BucketGrid::Column(double x) const { return static_cast<int>(std::clamp(std::floor((x - min_.x) / cell_), 0.0, columns_ - 1.0)); }
int BucketGrid::Row(double y) const { return static_cast<int>(std::clamp(std::floor((y - min_.y) / cell_), 0.0, rows_ - 1.0)); }

void BucketGrid::Add(uint32_t item, Vec2d min, Vec2d max) {
  for (int r = Row(min.y); r <= Row(max.y); ++r)
    for (int c = Column(min.x); c <= Column(max.x); ++c) entries_.push_back({static_cast<uint32_t>(Index(c, r)), item});
}

void BucketGrid::Finish() {
  std::stable_sort(entries_.begin(), entries_.end(), [](const Entry& a, const Entry& b) { return a.bucket < b.bucket; });
  first_.assign(static_cast<size_t>(columns_) * static_cast<size_t>(rows_) + 1, 0);
  for (const Entry& entry : entries_) ++first_[entry.bucket + 1];
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  items_.clear();
  for (const Entry& entry : entries_) items_.push_back(entry.item);
  entries_ = {};
}

std::span<const uint32_t> BucketGrid::At(Vec2d p) const {
  if (first_.empty()) return {};
  const size_t i = Index(Column(p.x), Row(p.y));
  return {items_.data() + first_[i], items_.data() + first_[i + 1]};
}

void NavGraph::Finish() {
  OpenBothSides();
  Measure();
  FindComponents();
  FindWalls();
  polygon_grid = BucketGrid(min, max, 4);
  for (uint32_t i = 0; i < polygons.size(); ++i) polygon_grid.Add(i, polygons[i].min, polygons[i].max);
  polygon_grid.Finish();
  wall_grid = BucketGrid(min, max, 2);
  for (uint32_t i = 0; i < walls.size(); ++i) {
    const NavWall& w = walls[i];
    wall_grid.Add(i, {std::min(w.a.x, w.b.x) - 2, std::min(w.a.y, w.b.y) - 2}, {std::max(w.a.x, w.b.x) + 2, std::max(w.a.y, w.b.y) + 2});
  }
  wall_grid.Finish();
}

void NavGraph::OpenBothSides() {
  // Openings by polygon and edge that are to be added.
  std::vector<std::pair<uint64_t, NavPortal>> missing;
  for (uint32_t i = 0; i < polygons.size(); ++i) {
    const NavPolygon& polygon = polygons[i];
    for (int edge = 0; edge < polygon.corners; ++edge)
      for (uint32_t k = polygon.first_portal[edge]; k < polygon.first_portal[edge + 1]; ++k) {
        const NavPolygon& other = polygons[portals[k].neighbour];
        const std::span<const NavPortal> back_ones(portals.data() + other.first_portal[0],
                                                   portals.data() + other.first_portal[other.corners]);
        if (std::ranges::find(back_ones, i, &NavPortal::neighbour) != back_ones.end()) continue;
        if (const auto back = OpeningBack(polygon, edge, portals[k], i, other))
          missing.push_back({uint64_t{portals[k].neighbour} * kMaxPolygonCorners + static_cast<uint64_t>(back->first), back->second});
      }
  }
  if (missing.empty()) return;
  std::stable_sort(missing.begin(), missing.end(), [](const auto& a, const auto& b) { return a.first < b.first; });

  // All openings anew, along each edge.
  std::vector<NavPortal> all;
  size_t next = 0;
  for (uint32_t i = 0; i < polygons.size(); ++i) {
    NavPolygon& polygon = polygons[i];
    std::array<uint32_t, kMaxPolygonCorners + 1> first{};
    for (int edge = 0; edge < polygon.corners; ++edge) {
      first[static_cast<size_t>(edge)] = static_cast<uint32_t>(all.size());
      all.insert(all.end(), portals.begin() + polygon.first_portal[edge], portals.begin() + polygon.first_portal[edge + 1]);
      for (; next < missing.size() && missing[next].first == uint64_t{i} * kMaxPolygonCorners + static_cast<uint64_t>(edge); ++next)
        all.push_back(missing[next].second);
      std::sort(all.begin() + first[static_cast<size_t>(edge)], all.end(),
                [](const NavPortal& a, const NavPortal& b) { return a.t0 != b.t0 ? a.t0 < b.t0 : a.neighbour < b.neighbour; });
    }
    for (int edge = polygon.corners; edge <= kMaxPolygonCorners; ++edge)
      first[static_cast<size_t>(edge)] = static_cast<uint32_t>(all.size());
    std::copy(first.begin(), first.end(), polygon.first_portal);
  }
  portals = std::move(all);
}

void NavGraph::Measure() {
  constexpr double kFar = std::numeric_limits<double>::max();
  min = {kFar, kFar};
  max = {-kFar, -kFar};
  for (NavPolygon& polygon : polygons) {
    polygon.min = {kFar, kFar};
    polygon.max = {-kFar, -kFar};
    polygon.area = 0;
    for (int i = 0; i < polygon.corners; ++i) {
      const Vec2d a = polygon.corner[i], b = polygon.corner[(i + 1) % polygon.corners];
      polygon.area += Cross(a - polygon.corner[0], b - polygon.corner[0]) / 2;
      polygon.min = {std::min(polygon.min.x, a.x), std::min(polygon.min.y, a.y)};
      polygon.max = {std::max(polygon.max.x, a.x), std::max(polygon.max.y, a.y)};
    }
    min = {std::min(min.x, polygon.min.x), std::min(min.y, polygon.min.y)};
    max = {std::max(max.x, polygon.max.x), std::max(max.y, polygon.max.y)};
  }
}

void NavGraph::FindComponents() {
  std::vector<uint32_t> parent(polygons.size());
  std::iota(parent.begin(), parent.end(), 0u);
  for (uint32_t i = 0; i < polygons.size(); ++i)
    for (uint32_t k = polygons[i].first_portal[0]; k < polygons[i].first_portal[polygons[i].corners]; ++k)
      parent[Root(parent, i)] = Root(parent, portals[k].neighbour);
  std::vector<uint32_t> number(polygons.size(), UINT32_MAX);
  components = 0;
  for (uint32_t i = 0; i < polygons.size(); ++i) {
    uint32_t& n = number[Root(parent, i)];
    if (n == UINT32_MAX) n = components++;
    polygons[i].component = n;
  }
}

void NavGraph::FindWalls() {
  walls.clear();
  for (const NavPolygon& polygon : polygons) {
    for (int i = 0; i < polygon.corners; ++i) {
      const int j = (i + 1) % polygon.corners;
      const Vec2d a = polygon.corner[i], d = polygon.corner[j] - a;
      const double length = std::sqrt(Dot(d, d)), dz = polygon.z[j] - polygon.z[i];
      if (length <= 0) continue;  // a corner that is there twice, at two heights: such a wall has no side
      double closed_from = 0;
      const auto wall = [&](double t0, double t1) {
        if ((t1 - t0) * length < kSliver && t1 - t0 < 0.999) return;
        walls.push_back({a + d * t0, a + d * t1, polygon.z[i] + dz * t0, polygon.z[i] + dz * t1});
      };
      for (uint32_t k = polygon.first_portal[i]; k < polygon.first_portal[i + 1]; ++k) {
        wall(closed_from, portals[k].t0);
        closed_from = std::max<double>(closed_from, portals[k].t1);
      }
      wall(closed_from, 1);
    }
  }
}

bool NavGraph::Inside(uint32_t index, Vec2d p) const {
  const NavPolygon& polygon = polygons[index];
  for (int i = 0; i < polygon.corners; ++i) {
    const Vec2d a = polygon.corner[i], b = polygon.corner[(i + 1) % polygon.corners];
    if (Cross(b - a, p - a) < -1e-9) return false;
  }
  return true;
}

// Height of the fan of triangles from corner 0.
double NavGraph::HeightIn(uint32_t index, Vec2d p) const {
  const NavPolygon& polygon = polygons[index];
  const Vec2d o = polygon.corner[0];
  for (int i = 1; i + 1 < polygon.corners; ++i) {
    const Vec2d u = polygon.corner[i] - o, v = polygon.corner[i + 1] - o;
    const double area = Cross(u, v);
    if (area <= 0) continue;
    const double b = Cross(p - o, v) / area, c = Cross(u, p - o) / area;
    if ((c <= 1e-9 - b + 1 && c >= -1e-6 && b >= -1e-6) || i + 2 == polygon.corners)
      return polygon.z[0] + std::clamp(b, 0.0, 1.0) * (polygon.z[i] - polygon.z[0]) +
             std::clamp(c, 0.0, 1.0) * (polygon.z[i + 1] - polygon.z[0]);
  }
  return polygon.z[0];
}

NavPoint NavGraph::Nearest(Vec3d p, double reach) const {
  const Vec2d q{p.x, p.y};
  NavPoint best;
  double best_cost = std::numeric_limits<double>::max();
  polygon_grid.Each({q.x - reach, q.y - reach}, {q.x + reach, q.y + reach}, [&](uint32_t i) {
    const NavPolygon& polygon = polygons[i];
    Vec2d at = q;
    double d2 = 0;
    if (!Inside(i, q)) {
      d2 = std::numeric_limits<double>::max();
      for (int k = 0; k < polygon.corners; ++k) {
        const Vec2d on = NearestOnSegment(polygon.corner[k], polygon.corner[(k + 1) % polygon.corners], q);
        const double on2 = Dot(on - q, on - q);
        if (on2 < d2) {
          d2 = on2;
          at = on;
        }
      }
      if (d2 > reach * reach) return;
    }
    const double z = HeightIn(i, at), up = std::abs(z - p.z);
    if (up > 2) return;
    const double cost = d2 + up * up;
    if (cost < best_cost) {
      best_cost = cost;
      best = {i, {at.x, at.y, z}};
    }
  });
  return best;
}

const NavPortal* NavGraph::OpeningAt(const NavPolygon& polygon, int i, Vec2d p, double tolerance) const {
  const Vec2d a = polygon.corner[i], edge = polygon.corner[(i + 1) % polygon.corners] - a;
  const double n2 = Dot(edge, edge);
  if (n2 <= 0) return nullptr;
  const double n = std::sqrt(n2), s = Dot(p - a, edge) / n2, beside = std::abs(Cross(edge, p - a)) / n;
  if (beside > tolerance) return nullptr;
  const NavPortal* opening = nullptr;
  double miss = tolerance / n;
  for (uint32_t k = polygon.first_portal[i]; k < polygon.first_portal[i + 1]; ++k) {
    const double out = std::max({0.0, portals[k].t0 - s, s - portals[k].t1});
    if (out < miss) {
      miss = out;
      opening = &portals[k];
    }
  }
  return opening;
}

NavPoint NavGraph::Walk(uint32_t index, Vec2d p, Vec2d target, bool slide, bool* stopped) const {
  if (stopped) *stopped = false;
  int slides = 0, hops = 0;
  uint32_t before = UINT32_MAX;
  for (int step = 0; step < 96; ++step) {
    // The edge through which the straight line leaves the polygon first.
    const NavPolygon& polygon = polygons[index];
    int exit = -1;
    double exit_t = 1;
    for (int i = 0; i < polygon.corners; ++i) {
      const Vec2d a = polygon.corner[i], edge = polygon.corner[(i + 1) % polygon.corners] - a;
      const double to = Cross(edge, target - a);
      if (to >= -1e-12) continue;
      const double from = std::max(0.0, Cross(edge, p - a));
      const double d = from - to, t = from / d;
      if (exit < 0 || t < exit_t) {
        exit = i;
        exit_t = t;
      }
    }
    if (exit < 0) return {index, {target.x, target.y, 0}};
    p = p + (target - p) * exit_t;

    // Through an opening, if there is one here; at a corner another edge may have it.
    const Vec2d a = polygon.corner[exit], edge = polygon.corner[(exit + 1) % polygon.corners] - a;
    const double n2 = Dot(edge, edge);
    if (const NavPortal* through = OpeningAt(polygon, exit, p, kSliver)) {
      before = index;
      index = through->neighbour;
      continue;
    }
    const NavPortal* around = nullptr;
    for (int i = 0; i < polygon.corners && !around && hops < 4; ++i) {
      if (i == exit) continue;
      around = OpeningAt(polygon, i, p, kAtCorner);
      if (around && around->neighbour == before) around = nullptr;
    }
    if (around) {
      ++hops;
      before = index;
      index = around->neighbour;
      continue;
    }

    // Along the wall with what is left of the way; a hand's breadth of rounding inside of it.
    if (stopped) *stopped = true;
    const double length = std::sqrt(n2);
    const Vec2d inward = Vec2d{-edge.y, edge.x} * (1e-6 / length);
    if (!slide || ++slides > 3) return {index, {p.x, p.y, 0}};
    // Openings have rounding, so that one may stand a little outside of a polygon: steps shorter than that would not get in.
    const double outside = -Cross(edge, p - a) / length;
    if (outside > kAtCorner) p = p + Vec2d{-edge.y, edge.x} * (outside / length);
    target = p + edge * (Dot(target - p, edge) / n2) + inward;
    p = p + inward;
  }
  return {index, {p.x, p.y, 0}};
}

}  // namespace airsim360::internal
