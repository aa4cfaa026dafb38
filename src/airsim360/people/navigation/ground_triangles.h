// The triangles of a scene that people walk on or bump into, tile by tile.
#pragma once

#include <cstdint>
#include <vector>

#include "airsim360/people/navigation/navmesh.h"

namespace airsim360::internal {

struct GroundTriangle {
  Vec3f p[3];  // W
  GroundKind kind = GroundKind::kNone;
};

/// Square tiles over a rectangle, counted from its corner.
struct TileGrid {
  double x0 = 0, y0 = 0, edge = 24;
  int columns = 0, rows = 0;
  int count() const { return columns * rows; }
};

/// Knows for every tile what may reach into it; gathers triangles on demand, so that only one tile's are in
/// memory at a time. The scene must outlive it.
class GroundSource {
 public:
  GroundSource(const Scene& scene, const TileGrid& grid, double margin);
  /// Triangles whose boxes meet the tile widened by the margin: the ground, then what stands on it, up to
  /// `headroom` above the highest ground.
  void Gather(int tile, double headroom, std::vector<GroundTriangle>& ground, std::vector<GroundTriangle>& obstacles) const;
  /// Nothing of the scene has a category of ground: everything may be walked on.
  bool no_ground() const { return no_ground_; }

 private:
  struct Run {  // triangles of one part of an instance
    uint32_t instance, first, count;
    GroundKind kind;
  };
  struct Tile {
    std::vector<Run> runs;
  };
  void AddInstance(uint32_t index);
  void AddRun(const Run& run, const Box3f& box, bool split);
  template <class Visit>
  void Each(int tile, bool ground, const Visit& visit) const;

  const Scene& scene_;
  TileGrid grid_;
  double margin_;
  bool no_ground_ = false;
  std::vector<Tile> tiles_;
  std::vector<GroundKind> kinds_;  // by entity id; kCount: leave out altogether
  std::vector<Box3f> mesh_bounds_;
};

}  // namespace airsim360::internal
