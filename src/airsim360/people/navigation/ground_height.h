// Exact heights of the ground: its triangles in buckets.
#pragma once

#include <span>
#include <vector>

#include "airsim360/people/navigation/ground_triangles.h"
#include "airsim360/people/navigation/nav_graph.h"

namespace airsim360::internal {

class GroundHeights {
 public:
  /// Those of one tile, in any order of tiles; steep ones are left out.
  void Add(std::span<const GroundTriangle> triangles);
  /// Those that came more than once are kept once.
  void Finish(Vec2d min, Vec2d max);
  /// Keeps or brings back what Finish made of them: call with an ArchiveWriter or an ArchiveReader.
  template <class Archive>
  void Visit(Archive& archive) {
    archive(triangles_);
    grid_.Visit(archive);
  }
  /// Height at (x, y) nearest to z and within `window` of it; z itself where there is none.
  double At(double x, double y, double z, double window) const;
  /// Where a step from height z leads: the highest at (x, y) up to `up` above z, and at most `down` below it; z
  /// itself where there is none. What lies inside of a flight of stairs does not count.
  double StepAt(double x, double y, double z, double up, double down) const;
  size_t memory_bytes() const { return triangles_.size() * sizeof(Triangle) + grid_.memory_bytes(); }

 private:
  struct Triangle {
    Vec3f a, b, c;
  };
  /// Calls look(height) for every triangle over or under (x, y).
  template <class Look>
  void Each(double x, double y, const Look& look) const;
  std::vector<Triangle> triangles_;
  BucketGrid grid_;
};

/// Walkable share of the disc of kRadius around places, on a raster.
class OpenShares {
 public:
  static constexpr double kRadius = 1.5, kStep = 0.5;
  void Build(const NavGraph& graph, double person_radius);
  double At(Vec2d p) const;
  template <class Archive>
  void Visit(Archive& archive) {
    archive(min_, columns_, rows_, shares_);
  }
  size_t memory_bytes() const { return shares_.size(); }

 private:
  Vec2d min_;
  int columns_ = 0, rows_ = 0;
  std::vector<uint8_t> shares_;
};

}  // namespace airsim360::internal
