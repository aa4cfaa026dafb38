// A coarse map of a world: for every voxel a lower bound of the distance to the nearest surface.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "airsim360/planning/clearance.h"

namespace airsim360 {

/// Immutable. A voxel is occupied if a surface may touch it; the bound of a voxel is the distance between it
/// and the nearest occupied voxel (box to box), so that it holds for all points of the voxel. At most 24
/// voxels.
class ClearanceField {
 public:
  const Box3d& box() const { return box_; }
  double voxel() const { return voxel_; }
  /// Voxels along an axis.
  int size(int axis) const { return size_[axis]; }

  /// Lower bound of the clearance of p (surfaces outside the box do not count); 0 outside the box.
  double At(Vec3d p) const;
  bool Occupied(Vec3d p) const;
  bool Occupied(int x, int y, int z) const { return cells_[Index(x, y, z)] == 0; }
  double At(int x, int y, int z) const;
  Vec3d Center(int x, int y, int z) const;
  /// Height of the top of the highest occupied voxel of a column, and of the lowest; the bottom of the box
  /// where there is none.
  double TopOfColumn(int x, int y) const;
  double BottomOfColumn(int x, int y) const;

 private:
  friend class ClearanceFieldBuilder;
  size_t Index(int x, int y, int z) const { return (static_cast<size_t>(z) * size_[1] + y) * size_[0] + x; }
  // False outside the box.
  bool Find(Vec3d p, int (&cell)[3]) const;

  Box3d box_;
  double voxel_ = 1;
  int size_[3] = {0, 0, 0};
  std::vector<uint8_t> cells_;  // 0 = occupied, else 1 + bound in quarters of a voxel, rounded down
};

/// Collects triangles, then measures distances.
class ClearanceFieldBuilder {
 public:
  /// The box is grown to whole voxels. InputError for an empty box, or more than 2^28 voxels.
  ClearanceFieldBuilder(const Box3d& box, double voxel);
  /// Marks every voxel that the triangle touches (and perhaps a few more). May be called by several threads.
  void Add(Vec3d a, Vec3d b, Vec3d c);
  /// Marks every voxel that the box touches. May be called by several threads.
  void Add(const Box3d& box);
  /// The builder is empty afterwards.
  ClearanceField Build();

 private:
  ClearanceField field_;
};

}  // namespace airsim360
