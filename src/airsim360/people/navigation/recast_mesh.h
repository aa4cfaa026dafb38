// Recast and Detour behind one door: tiles of polygons from triangles, and ways over them. W in and out.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "airsim360/people/navigation/ground_triangles.h"
#include "airsim360/people/navigation/nav_graph.h"

namespace airsim360::internal {

struct TileInput {
  std::span<const GroundTriangle> ground, obstacles;
  std::span<const NavMesh::Crossing> crossings;
};

class RecastMesh {
 public:
  RecastMesh(const TileGrid& grid, const NavMeshOptions& options);
  ~RecastMesh();
  /// Rasters one tile; may run for different tiles at once.
  void BuildTile(int tile, const TileInput& input);
  /// A tile as bytes, and one made of such bytes; before Join. Empty: nothing to walk on.
  std::vector<std::byte> TileBytes(int tile) const;
  void SetTile(int tile, std::span<const std::byte> bytes);
  /// Joins the tiles and gives their polygons and openings. InputError for more polygons than Detour counts.
  NavGraph Join();
  /// Corners of the cheapest way between two places on polygons (by NavPolygon::reference). Many threads may
  /// ask at once.
  NavPath FindPath(uint32_t from, Vec3d start, uint32_t to, Vec3d goal) const;
  size_t memory_bytes() const;

 private:
  struct Impl;
  void AddTiles();
  std::unique_ptr<Impl> impl_;
};

}  // namespace airsim360::internal
