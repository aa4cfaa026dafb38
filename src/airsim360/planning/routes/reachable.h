// The part of a mapped world that can be reached from a place.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "airsim360/planning/clearance_field.h"

namespace airsim360 {

/// Voxels with a bound of at least `radius` that hang together, face to face, with the one at `seed` (or the
/// nearest such voxel within 5 m of it). Immutable.
class ReachableSpace {
 public:
  /// `field` must outlive this.
  ReachableSpace(const ClearanceField& field, Vec3d seed, double radius);
  bool Contains(Vec3d p) const;
  /// Cubic metres.
  double volume() const { return static_cast<double>(count_) * std::pow(field_.voxel(), 3); }

 private:
  using Cell = std::array<int, 3>;

  void Fill(Cell first, double radius);

  const ClearanceField& field_;
  std::vector<uint8_t> reached_;
  size_t count_ = 0;
};

}  // namespace airsim360
