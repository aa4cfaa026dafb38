// Flat areas with holes, and their union, difference and intersection, exact on a grid of 1 mm.
#pragma once

#include <span>
#include <vector>

#include "airsim360/math/triangulate.h"
#include "airsim360/math/vector.h"

namespace airsim360::internal {

using Ring = std::vector<Vec2d>;  ///< corners in order, the first not repeated at the end

/// One connected area: outline counter-clockwise, holes clockwise (as the functions here return them).
struct Patch {
  Ring outer;
  std::vector<Ring> holes;
};
using Patches = std::vector<Patch>;

/// What any of the areas covers. Rings may be given in either direction and may cross themselves. Results hold
/// no patch below 2 dm^2 and come in a fixed order.
Patches Unite(std::span<const Patch> areas);
/// `from` without `what`.
Patches Subtract(std::span<const Patch> from, std::span<const Patch> what);
Patches Intersect(std::span<const Patch> a, std::span<const Patch> b);

/// The band along a polyline from `right` metres on its right-hand side (negative = on the left) to `left` on
/// its left; joints are mitred to twice the width at most and rounded beyond.
Patches Band(std::span<const Vec2d> line, double left, double right);

double Area(const Patch& patch);
double Area(std::span<const Patch> patches);
bool Inside(const Patch& patch, Vec2d p);
/// Metres from p to the nearest point of the ring (closed) or line.
double DistanceToRing(std::span<const Vec2d> ring, Vec2d p);
double DistanceToLine(std::span<const Vec2d> line, Vec2d p);

/// Axis-aligned box around.
struct Bounds2d {
  Vec2d min{1e18, 1e18}, max{-1e18, -1e18};
  void Add(Vec2d p);
  bool Overlaps(const Bounds2d& other, double margin = 0) const;
  bool Contains(Vec2d p) const { return p.x >= min.x && p.x <= max.x && p.y >= min.y && p.y <= max.y; }
};
Bounds2d BoundsOf(std::span<const Vec2d> ring);

/// Corner indices (three a triangle, counter-clockwise) over the corners of the outline and then of the holes;
/// ear clipping over bridges to the holes. Never fails; what crosses itself is covered as well as it can be.
std::vector<uint32_t> Triangulate(const Patch& patch);

}  // namespace airsim360::internal
