// The ground of a map from a grid of heights.
#pragma once

#include <vector>

#include "airsim360/math/geodesy.h"
#include "airsim360/math/vector.h"
#include "airsim360/worlds/osm/osm_world.h"

namespace airsim360::internal {

/// Height of the ground over z = 0 of W: a surface of triangles, the squares of a lattice cut from corner to corner.
/// Whatever is split along the lattice before it is lifted lies on the ground exactly. Flat where there is no grid.
class Relief {
 public:
  Relief() = default;
  /// `origin` of W gets height 0. Unknown cells take the heights around them. `area` (m^2) is that of the map: it
  /// bounds how fine the lattice may be.
  Relief(HeightGrid grid, const GeoPoint& origin, double area);
  double At(Vec2d p) const;
  /// A triangle of the plane in convex pieces, each on one triangle of the ground; the triangle itself where flat.
  std::vector<std::vector<Vec2d>> Split(Vec2d a, Vec2d b, Vec2d c) const;
  /// The points where the ground bends under a segment, its ends included.
  std::vector<Vec2d> Split(Vec2d a, Vec2d b) const;
  bool flat() const { return grid_.heights.empty(); }
  double zero() const { return zero_; }  ///< the grid's height at z = 0

 private:
  double Raw(Vec2d p) const;
  HeightGrid grid_;
  GeoPoint origin_;
  double metres_per_lat_ = 1, metres_per_lon_ = 1, zero_ = 0, step_ = 1;
};

/// Gives unknown (NaN) cells the heights around them, smoothly; those of known ones stay.
void FillUnknown(std::vector<float>& heights, int columns, int rows);

}  // namespace airsim360::internal
