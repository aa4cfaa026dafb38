// Where people can walk: a navigation mesh of any scene (Recast builds it, Detour finds the ways), with exact
// heights of the ground. Immutable; every query is const and may run on many threads at once.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "airsim360/base/random.h"
#include "airsim360/math/box.h"
#include "airsim360/math/vector.h"
#include "airsim360/scene/scene.h"

namespace airsim360 {

class DiskCache;
namespace internal {
struct TileGrid;
}

/// What the ground is for someone on foot. Ways avoid what costs more: see GroundCost.
enum class GroundKind : uint8_t { kNone, kPavement, kPath, kFloor, kStairs, kCrossing, kGrass, kParking, kRoad, kCount };
const char* GroundKindName(GroundKind kind);
/// Metres of pavement that one metre of this ground is worth.
double GroundCost(GroundKind kind);
/// Kind of a category; kNone: nobody walks on it (it is an obstacle).
GroundKind GroundKindOf(const SemanticTree& tree, CategoryId category);

struct NavMeshOptions {
  double cell = 0.1;                 ///< metres: raster of the ground
  double person_radius = 0.2;        ///< the mesh keeps that far from everything solid
  double person_height = 1.9;        ///< of free space that is needed
  double step_height = 0.28;         ///< highest step
  double steepest_deg = 38;          ///< slope
  double tile = 24;                  ///< metres: edge of what is rastered at a time, which bounds memory
  int search_nodes = 60000;          ///< polygons that one search for a way may look at, 64 … 65,535; a longer way takes several
  std::optional<Box3f> region = {};  ///< only this part of the world (x and y count); default: up to 400 m around
                                     ///< its spawn or its middle
};

/// What of the world NavMesh::Build covers at least (x and y count): tiles are whole. InputError if the world is empty, or the
/// region lies outside of it or has more than 2.25 km2.
Box3f NavMeshRegion(const Scene& scene, const NavMeshOptions& options);

/// A place on the mesh.
struct NavPoint {
  uint32_t polygon = UINT32_MAX;
  Vec3d p_W;
  bool valid() const { return polygon != UINT32_MAX; }
};

/// A way: corners from start to goal, pulled taut. `complete`: it ends at the goal, not at the nearest
/// place that can be reached.
struct NavPath {
  std::vector<Vec3d> corners;
  double length = 0;  ///< metres
  bool complete = false;
};

/// An edge of the mesh that nobody crosses; the walkable side is to the left of a -> b.
struct NavWall {
  Vec2d a, b;
  double za = 0, zb = 0;  ///< heights of the ground at its ends
};

/// Where to draw places from.
struct NavArea {
  std::vector<Vec2d> outline;
  std::vector<uint32_t> polygons;
  std::vector<double> cumulative;  ///< square metres up to and with each polygon, whole polygons
  double square_metres = 0;        ///< inside the outline, about
  uint32_t component = 0;
};

class NavMesh {
 public:
  /// InputError of NavMeshRegion, or if no ground of the region can be walked on. Scenes with a cache_key have
  /// their meshes kept in the disk cache of the user, or in `cache`; the mesh is the same either way.
  static std::shared_ptr<const NavMesh> Build(const Scene& scene, const NavMeshOptions& options = {});
  static std::shared_ptr<const NavMesh> Build(const Scene& scene, const NavMeshOptions& options, const DiskCache& cache);
  ~NavMesh();

  /// The place of the mesh nearest to p, at most `reach` metres away over the ground and 2 m up or down.
  NavPoint Nearest(Vec3d p_W, double reach = 2) const;
  /// From `start` in a straight line towards (x, y), sliding along walls; never leaves the mesh. `p_W.z` of the
  /// result is GroundHeight.
  NavPoint Move(const NavPoint& start, Vec2d target) const;
  /// How far one gets from `start` in a straight line towards (x, y): there, or at the first wall.
  NavPoint Along(const NavPoint& start, Vec2d target) const;
  /// Whether a straight line from `start` to (x, y) stays on the mesh.
  bool Straight(const NavPoint& start, Vec2d target) const;
  NavPath FindPath(const NavPoint& start, const NavPoint& goal) const;
  /// Number of the connected part of the mesh; there is a way between places of one part.
  uint32_t Component(const NavPoint& point) const;
  GroundKind Kind(const NavPoint& point) const;
  /// Crossing (index into crossings()) that a place is on; -1 = none.
  int CrossingAt(Vec2d p) const;

  /// Height of the drawn ground at (x, y) for someone who stands at height z: the highest at most 0.4 m above and
  /// 0.6 m below z; z where there is none.
  double GroundHeight(double x, double y, double z) const;
  /// Share of the disc of 1.5 m around (x, y) that is walkable ground, in [0.1, 1].
  double OpenShare(Vec2d p) const;
  /// Indices of all walls() within 2 m of p over the ground, and of some farther ones.
  std::span<const uint32_t> WallsNear(Vec2d p) const;

  /// The part of the mesh inside a polygon (empty = everywhere) whose kinds are in `kinds` (bit 1 << kind) and
  /// that hangs together: the largest such part. May be empty.
  NavArea AreaOf(std::span<const Vec2d> outline, uint32_t kinds) const;
  /// All such parts of at least `least` square metres, the largest first; 0: the largest alone.
  std::vector<NavArea> AreasOf(std::span<const Vec2d> outline, uint32_t kinds, double least) const;
  /// Uniform over an area that is not empty.
  NavPoint Pick(const NavArea& area, RngStream& rng) const;

  /// Painted way over a road.
  struct Crossing {
    std::vector<Vec2d> outline;  ///< convex, counter-clockwise
    EntityId entity = kNoEntity;
    bool signal = false;  ///< traffic lights stand by it
    uint8_t phase = 0;    ///< crossings of phase 0 and 1 have green by turns
  };
  std::span<const Crossing> crossings() const;
  std::span<const NavWall> walls() const;
  Box3f bounds() const;
  /// Convex polygons, for pictures and tests.
  size_t polygon_count() const;
  std::vector<Vec3d> PolygonOutline(uint32_t polygon) const;
  size_t memory_bytes() const;

 private:
  struct Impl;
  static std::unique_ptr<Impl> BuildAnew(const Scene& scene, const internal::TileGrid& grid, const NavMeshOptions& options,
                                         std::vector<std::byte>* archive);
  static std::unique_ptr<Impl> FromArchive(const Scene& scene, const internal::TileGrid& grid, const NavMeshOptions& options,
                                           std::span<const std::byte> bytes);
  explicit NavMesh(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace airsim360
