// Measures and triangles of patches: no third party needed.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "airsim360/worlds/osm/patches.h"

namespace airsim360::internal {
namespace {

double Turn(Vec2d a, Vec2d b, Vec2d c) { return (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y); }

bool InTriangle(Vec2d a, Vec2d b, Vec2d c, Vec2d p) {
  return Turn(a, b, p) >= 0 && Turn(b, c, p) >= 0 && Turn(c, a, p) >= 0;
}

// One closed chain through the outline and all holes (corner indices; bridges are walked both ways).
std::vector<uint32_t> Chain(const Patch& patch, const std::vector<Vec2d>& points) {
  std::vector<uint32_t> chain(patch.outer.size());
  std::iota(chain.begin(), chain.end(), 0u);
  // Holes from right to left, each joined to what lies right of its rightmost corner (Eberly's method).
  struct Hole {
    uint32_t first, count, rightmost;
  };
  std::vector<Hole> holes;
  auto next = static_cast<uint32_t>(patch.outer.size());
  for (const Ring& ring : patch.holes) {
    Hole hole{next, static_cast<uint32_t>(ring.size()), next};
    for (uint32_t i = 0; i < hole.count; ++i)
      if (points[next + i].x > points[hole.rightmost].x) hole.rightmost = next + i;
    holes.push_back(hole);
    next += hole.count;
  }
  std::stable_sort(holes.begin(), holes.end(), [&](const Hole& a, const Hole& b) {
    return points[a.rightmost].x > points[b.rightmost].x;
  });
  for (const Hole& hole : holes) {
    const Vec2d m = points[hole.rightmost];
    // The nearest edge to the right at the height of m.
    size_t edge = chain.size();
    double best = 1e18;
    for (size_t i = 0; i < chain.size(); ++i) {
      const Vec2d a = points[chain[i]], b = points[chain[(i + 1) % chain.size()]];
      if ((a.y > m.y) == (b.y > m.y) && !(a.y == m.y || b.y == m.y)) continue;
      const double x = a.y == b.y ? std::max(a.x, b.x) : a.x + (b.x - a.x) * (m.y - a.y) / (b.y - a.y);
      if (x >= m.x - 1e-9 && x < best) {
        best = x;
        edge = i;
      }
    }
    size_t bridge = 0;
    if (edge < chain.size()) {
      const size_t k = (edge + 1) % chain.size();
      bridge = points[chain[edge]].x > points[chain[k]].x ? edge : k;
      // A corner inside the triangle m, foot, candidate hides the candidate: take the one seen flattest.
      const Vec2d foot{best, m.y}, candidate = points[chain[bridge]];
      const bool above = candidate.y > m.y;
      double flattest = 1e18;
      for (size_t i = 0; i < chain.size(); ++i) {
        const Vec2d p = points[chain[i]];
        if (p.x < m.x || p == candidate) continue;
        const bool hides = above ? InTriangle(m, foot, candidate, p) : InTriangle(m, candidate, foot, p);
        if (!hides) continue;
        const double slope = std::abs(p.y - m.y) / std::max(p.x - m.x, 1e-12);
        const double far = std::hypot(p.x - m.x, p.y - m.y);
        if (slope + far * 1e-9 < flattest) {
          flattest = slope + far * 1e-9;
          bridge = i;
        }
      }
    }
    std::vector<uint32_t> insert;
    for (uint32_t i = 0; i <= hole.count; ++i)
      insert.push_back(hole.first + (hole.rightmost - hole.first + i) % hole.count);
    insert.push_back(chain[bridge]);
    chain.insert(chain.begin() + static_cast<std::ptrdiff_t>(bridge) + 1, insert.begin(), insert.end());
  }
  return chain;
}

}  // namespace

double SignedArea(std::span<const Vec2d> ring) {
  double twice = 0;
  for (size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++)
    twice += (ring[j].x - ring[0].x) * (ring[i].y - ring[0].y) - (ring[i].x - ring[0].x) * (ring[j].y - ring[0].y);
  return ring.size() < 3 ? 0 : twice / 2;
}

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

bool Inside(std::span<const Vec2d> ring, Vec2d p) {
  bool inside = false;
  for (size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) {
    const Vec2d a = ring[i], b = ring[j];
    if ((a.y > p.y) != (b.y > p.y) && p.x < (b.x - a.x) * (p.y - a.y) / (b.y - a.y) + a.x) inside = !inside;
  }
  return inside;
}

bool Inside(const Patch& patch, Vec2d p) {
  return Inside(patch.outer, p) &&
         std::none_of(patch.holes.begin(), patch.holes.end(), [&](const Ring& hole) { return Inside(hole, p); });
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
  return min.x <= other.max.x + margin && other.min.x <= max.x + margin && min.y <= other.max.y + margin &&
         other.min.y <= max.y + margin;
}

Bounds2d BoundsOf(std::span<const Vec2d> ring) {
  Bounds2d box;
  for (Vec2d p : ring) box.Add(p);
  return box;
}

std::vector<uint32_t> Triangulate(const Patch& patch) {
  std::vector<Vec2d> points = patch.outer;
  for (const Ring& hole : patch.holes) points.insert(points.end(), hole.begin(), hole.end());
  std::vector<uint32_t> chain = Chain(patch, points), triangles;
  // A linked list; only reflex corners can lie in an ear.
  const size_t n = chain.size();
  std::vector<size_t> before(n), after(n);
  for (size_t i = 0; i < n; ++i) {
    before[i] = (i + n - 1) % n;
    after[i] = (i + 1) % n;
  }
  const auto at = [&](size_t i) { return points[chain[i]]; };
  const auto reflex = [&](size_t i) { return Turn(at(before[i]), at(i), at(after[i])) <= 0; };
  std::vector<size_t> reflexes;
  for (size_t i = 0; i < n; ++i)
    if (reflex(i)) reflexes.push_back(i);
  std::vector<bool> gone(n, false);
  const auto is_ear = [&](size_t i) {
    const Vec2d a = at(before[i]), b = at(i), c = at(after[i]);
    if (Turn(a, b, c) <= 0) return false;
    const Vec2d low{std::min({a.x, b.x, c.x}), std::min({a.y, b.y, c.y})},
        high{std::max({a.x, b.x, c.x}), std::max({a.y, b.y, c.y})};
    for (size_t k : reflexes) {
      if (gone[k]) continue;
      const Vec2d p = at(k);
      if (p.x < low.x || p.x > high.x || p.y < low.y || p.y > high.y) continue;
      if (p == a || p == b || p == c) continue;
      if (InTriangle(a, b, c, p)) return false;
    }
    return true;
  };
  size_t left = n, i = 0, misses = 0;
  while (left >= 3) {
    const bool stuck = misses > left;
    const double turn = Turn(at(before[i]), at(i), at(after[i]));
    // A corner on a straight line goes without a triangle once nothing else is left to cut.
    if (!is_ear(i) && !stuck) {
      i = after[i];
      ++misses;
      continue;
    }
    if (turn > 0) {
      triangles.insert(triangles.end(), {chain[before[i]], chain[i], chain[after[i]]});
    }
    gone[i] = true;
    after[before[i]] = after[i];
    before[after[i]] = before[i];
    i = after[after[i]];
    --left;
    misses = 0;
    if (reflexes.size() > 64 && left % 64 == 0)
      std::erase_if(reflexes, [&](size_t k) { return gone[k] || !reflex(k); });
  }
  return triangles;
}

}  // namespace airsim360::internal
