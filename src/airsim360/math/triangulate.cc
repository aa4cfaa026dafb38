#include "airsim360/math/triangulate.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace airsim360 {
namespace {

double Turn(Vec2d a, Vec2d b, Vec2d c) { return (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y); }

bool InTriangle(Vec2d a, Vec2d b, Vec2d c, Vec2d p) { return Turn(a, b, p) >= 0 && Turn(b, c, p) >= 0 && Turn(c, a, p) >= 0; }

struct Hole {
  uint32_t first, count, rightmost;
};

// Holes from right to left.
std::vector<Hole> SortedHoles(std::span<const Vec2d> points, std::span<const uint32_t> sizes) {
  std::vector<Hole> holes;
  uint32_t next = sizes[0];
  for (uint32_t size : sizes.subspan(1)) {
    if (size == 0) continue;
    Hole hole{next, size, next};
    for (uint32_t i = 0; i < hole.count; ++i)
      if (points[next + i].x > points[hole.rightmost].x) hole.rightmost = next + i;
    holes.push_back(hole);
    next += hole.count;
  }
  std::stable_sort(holes.begin(), holes.end(), [&](const Hole& a, const Hole& b) { return points[a.rightmost].x > points[b.rightmost].x; });
  return holes;
}

// Where the nearest edge of the chain to the right of m is at m's height; edge = chain.size(): nowhere.
struct EdgeRight {
  size_t edge;
  double x;
};
EdgeRight FindEdgeRight(std::span<const Vec2d> points, const std::vector<uint32_t>& chain, Vec2d m) {
  EdgeRight nearest{chain.size(), 1e18};
  for (size_t i = 0; i < chain.size(); ++i) {
    const Vec2d a = points[chain[i]], b = points[chain[(i + 1) % chain.size()]];
    if ((a.y > m.y) == (b.y > m.y) && !(a.y == m.y || b.y == m.y)) continue;
    const double x = a.y == b.y ? std::max(a.x, b.x) : a.x + (b.x - a.x) * (m.y - a.y) / (b.y - a.y);
    if (x >= m.x - 1e-9 && x < nearest.x) nearest = {i, x};
  }
  return nearest;
}

// The corner of the chain that the bridge from m leads to.
size_t FindBridge(std::span<const Vec2d> points, const std::vector<uint32_t>& chain, Vec2d m) {
  const EdgeRight right = FindEdgeRight(points, chain, m);
  if (right.edge >= chain.size()) return 0;
  const size_t k = (right.edge + 1) % chain.size();
  size_t bridge = points[chain[right.edge]].x > points[chain[k]].x ? right.edge : k;
  // A corner inside the triangle m, foot, candidate hides the candidate: take the one seen flattest.
  const Vec2d foot{right.x, m.y}, candidate = points[chain[bridge]];
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
  return bridge;
}

// One closed chain through the outline and all holes (corner indices; bridges are walked both ways). Each hole is
// joined to what lies right of its rightmost corner (Eberly's method).
std::vector<uint32_t> Chain(std::span<const Vec2d> points, std::span<const uint32_t> sizes) {
  std::vector<uint32_t> chain(sizes[0]);
  std::iota(chain.begin(), chain.end(), 0u);
  for (const Hole& hole : SortedHoles(points, sizes)) {
    const size_t bridge = FindBridge(points, chain, points[hole.rightmost]);
    std::vector<uint32_t> insert;
    for (uint32_t i = 0; i <= hole.count; ++i) insert.push_back(hole.first + (hole.rightmost - hole.first + i) % hole.count);
    insert.push_back(chain[bridge]);
    chain.insert(chain.begin() + static_cast<std::ptrdiff_t>(bridge) + 1, insert.begin(), insert.end());
  }
  return chain;
}

}  // namespace

std::vector<uint32_t> TriangulateRings(std::span<const Vec2d> points, std::span<const uint32_t> sizes) {
  if (sizes.empty() || sizes[0] < 3) return {};
  std::vector<uint32_t> chain = Chain(points, sizes), triangles;
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
    const Vec2d low{std::min({a.x, b.x, c.x}), std::min({a.y, b.y, c.y})}, high{std::max({a.x, b.x, c.x}), std::max({a.y, b.y, c.y})};
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
    if (reflexes.size() > 64 && left % 64 == 0) std::erase_if(reflexes, [&](size_t k) { return gone[k] || !reflex(k); });
  }
  return triangles;
}

double SignedArea(std::span<const Vec2d> ring) {
  // Relative to the first corner: far from the origin the products would cancel.
  double twice = 0;
  for (size_t i = 1; i + 1 < ring.size(); ++i) {
    const Vec2d a = ring[i] - ring[0], b = ring[i + 1] - ring[0];
    twice += a.x * b.y - a.y * b.x;
  }
  return twice / 2;
}

bool InPolygon(std::span<const Vec2d> ring, Vec2d p) {
  bool inside = false;
  for (size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) {
    const Vec2d a = ring[i], b = ring[j];
    if ((a.y > p.y) != (b.y > p.y) && p.x < (b.x - a.x) * (p.y - a.y) / (b.y - a.y) + a.x) inside = !inside;
  }
  return inside;
}

}  // namespace airsim360
