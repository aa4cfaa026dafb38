// Straight lines and boxes of a map in cells of a grid, to find what is near a point.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "airsim360/worlds/osm/data/patches.h"

namespace airsim360::internal {

/// Straight pieces of lines, each with an owner.
class LineIndex {
 public:
  void Add(Vec2d a, Vec2d b, uint32_t owner);
  void AddRing(const Ring& ring, uint32_t owner);
  struct Near {
    double distance = 1e18;
    uint32_t owner = UINT32_MAX;
    Vec2d point;      ///< of the line, nearest to the place asked for
    Vec2d direction;  ///< of the line there, unit
  };
  /// The nearest piece within `radius` but of `except`; owner UINT32_MAX where there is none.
  Near Find(Vec2d p, double radius, uint32_t except = UINT32_MAX) const;

 private:
  struct Piece {
    Vec2d a, b;
    uint32_t owner;
  };
  std::vector<Piece> pieces_;
  std::unordered_map<int64_t, std::vector<uint32_t>> cells_;  // looked up by key only
};

/// Boxes by cells: which may overlap a box.
class BoxIndex {
 public:
  void Add(const Bounds2d& box, uint32_t owner);
  /// Owners in growing order of being added.
  std::vector<uint32_t> Find(const Bounds2d& box) const;
  std::vector<uint32_t> Find(Vec2d p) const { return Find(Bounds2d{p, p}); }

 private:
  std::vector<std::pair<Bounds2d, uint32_t>> boxes_;
  std::vector<uint32_t> large_;  // boxes over more cells than are worth listing
  std::unordered_map<int64_t, std::vector<uint32_t>> cells_;
};

}  // namespace airsim360::internal
