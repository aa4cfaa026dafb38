// Convex polygons and the openings between them: where someone is, and how far they can go in a straight line.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "airsim360/people/navigation/navmesh.h"

namespace airsim360::internal {

inline constexpr int kMaxPolygonCorners = 6;

/// Opening of an edge towards a neighbour, from `t0` to `t1` along the edge.
struct NavPortal {
  uint32_t neighbour;
  float t0, t1;
};

struct NavPolygon {
  uint32_t reference = 0;  ///< of the path finder
  uint8_t corners = 0;
  GroundKind kind = GroundKind::kPavement;
  Vec2d corner[kMaxPolygonCorners];  ///< counter-clockwise
  float z[kMaxPolygonCorners];
  uint32_t first_portal[kMaxPolygonCorners + 1];  ///< into NavGraph::portals, by edge corner i -> i + 1
  Vec2d min, max;
  uint32_t component = 0;
  double area = 0;
};

/// Buckets of indices over a rectangle.
class BucketGrid {
 public:
  BucketGrid() = default;
  BucketGrid(Vec2d min, Vec2d max, double cell);
  /// Calls made twice with the same items: first counts, then places.
  void Add(uint32_t item, Vec2d min, Vec2d max);
  void Finish();
  std::span<const uint32_t> At(Vec2d p) const;
  /// Buckets that a rectangle touches, in order.
  template <class Visit>
  void Each(Vec2d min, Vec2d max, const Visit& visit) const {
    const int c0 = Column(min.x), c1 = Column(max.x), r0 = Row(min.y), r1 = Row(max.y);
    for (int r = r0; r <= r1; ++r)
      for (int c = c0; c <= c1; ++c)
        for (uint32_t k = first_[Index(c, r)]; k < first_[Index(c, r) + 1]; ++k) visit(items_[k]);
  }
  /// To and from an archive, when finished.
  template <class Archive>
  void Visit(Archive& archive) {
    archive(min_, cell_, columns_, rows_, first_, items_);
  }
  size_t memory_bytes() const { return (first_.size() + items_.size()) * sizeof(uint32_t); }

 private:
  int Column(double x) const;
  int Row(double y) const;
  size_t Index(int c, int r) const { return static_cast<size_t>(r) * static_cast<size_t>(columns_) + static_cast<size_t>(c); }
  struct Entry {
    uint32_t bucket, item;
  };
  Vec2d min_;
  double cell_ = 1;
  int columns_ = 0, rows_ = 0;
  std::vector<Entry> entries_;
  std::vector<uint32_t> first_, items_;
};

struct NavGraph {
  std::vector<NavPolygon> polygons;
  std::vector<NavPortal> portals;
  std::vector<NavWall> walls;
  uint32_t components = 0;
  BucketGrid polygon_grid, wall_grid;
  Vec2d min, max;

  /// Fills everything but polygons' corners, kinds and portals. Openings that one side alone knows are added to the other: Detour
  /// joins an edge to no more than four of another tile.
  void Finish();
  double HeightIn(uint32_t polygon, Vec2d p) const;
  bool Inside(uint32_t polygon, Vec2d p) const;
  NavPoint Nearest(Vec3d p, double reach) const;
  /// The opening of edge i that p lies in or at most `tolerance` metres beside; null: a wall.
  const NavPortal* OpeningAt(const NavPolygon& polygon, int i, Vec2d p, double tolerance) const;
  /// Walks from p in `polygon` towards the target; sliding or, if not, stopping at the first wall (`stopped`).
  NavPoint Walk(uint32_t polygon, Vec2d p, Vec2d target, bool slide, bool* stopped) const;

 private:
  void OpenBothSides();
  void Measure();         // boxes, areas, the whole extent
  void FindComponents();  // what hangs together
  void FindWalls();       // what of an edge is not open
};

}  // namespace airsim360::internal
