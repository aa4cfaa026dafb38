// Discs on the ground in a grid: which of them a place touches.
#pragma once

#include <cstdint>
#include <vector>

#include "airsim360/math/vector.h"

namespace airsim360 {

/// Add all, then Sort once, then ask.
class DiscGrid {
 public:
  /// Places beyond 10,000 km or not finite are left out.
  void Add(Vec3d p, double radius);
  void Sort();
  bool empty() const { return discs_.empty(); }
  /// Whether a disc comes within `reach` metres of p on the ground and `height` above or below it.
  bool Meets(Vec3d p, double reach, double height) const;

 private:
  struct Disc {
    uint64_t cell = 0;
    Vec3d p;
    double radius = 0;
  };
  std::vector<Disc> discs_;  // by cell
  double widest_ = 0;        // metres: the largest radius
};

}  // namespace airsim360
