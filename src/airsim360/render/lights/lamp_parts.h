// Which triangles of a scene shine, and which of them hang together.
#pragma once

#include <memory>
#include <vector>

#include "airsim360/math/box.h"
#include "airsim360/render/lights/light_table.h"

namespace airsim360::internal {

/// Whether a material sends out light in this environment.
bool Shines(const Material& material, const Environment& environment);

/// Connected emitting triangles of a mesh (connected: sharing a corner, by position).
struct LampShape {
  std::vector<uint32_t> triangles;  ///< of the mesh, ascending
  std::vector<float> cumulative;    ///< share of the area up to and including each; the last is 1
};

/// All lamps of one mesh.
struct MeshLamps {
  std::vector<LampShape> shapes;
  std::vector<std::pair<uint32_t, uint32_t>> shape_of;  ///< (triangle, shape), sorted by triangle

  bool empty() const { return shapes.empty(); }
  /// Index into `shapes`; LightTable::kNoLamp where the triangle does not shine.
  uint32_t ShapeOf(uint32_t triangle) const;
};

/// Areas are measured after the linear map A: with a similarity they fit every instance of the mesh.
MeshLamps FindLamps(const Scene& scene, const Mesh& mesh, const Mat3f& A, const Environment& environment);

/// Corners of a triangle in W, and its unit normal on the side that `Instance::X_WM` leaves outside.
struct LampTriangle {
  Vec3f corner[3];
  Vec3f normal;
  float area;
};
LampTriangle PlaceTriangle(const Mesh& mesh, uint32_t triangle, const AffineTransform& X_WM);

/// A lamp with the bounds that choosing needs.
struct PlacedLamp {
  Lamp lamp;
  Box3f box;
  uint32_t shape = 0;  ///< index into the shapes of its mesh
};
/// Of a mesh that stands at X_WM and shines by the colour `glow`, its triangles and the turn of its beams as `record` has them.
/// Whose lamp it is, is left to the caller.
PlacedLamp PlaceLamp(const Mesh& mesh, const SurfaceTables& tables, const InstanceRecord& record, const AffineTransform& X_WM, Vec3f glow,
                     const LampShape& shape);

}  // namespace airsim360::internal
