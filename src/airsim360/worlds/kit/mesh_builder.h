// Puts meshes together from quads, boxes, cylinders and extruded outlines, with one material and entity at a
// time.
#pragma once

#include <map>
#include <span>
#include <utility>
#include <vector>

#include "airsim360/math/transform.h"
#include "airsim360/scene/mesh.h"

namespace airsim360 {

/// Triangles are collected by (material, entity) and come out as one part each. Positions pass through the
/// current transform. uv coordinates are metres on the surface, so that textures tile at their real size.
class MeshBuilder {
 public:
  /// What the following shapes are made of; kNoEntity = the entity of the instance.
  void SetMaterial(MaterialId material) { material_ = material; }
  void SetEntity(EntityId entity) { entity_ = entity; }
  /// Maps the following shapes (builder frame) to the mesh frame.
  void SetTransform(const AffineTransform& X) { X_ = X; }

  /// Counter-clockwise seen from outside; uv from 3D edge lengths, u along a->b, v downwards from the edge
  /// d-c to a-b.
  void Quad(Vec3f a, Vec3f b, Vec3f c, Vec3f d);
  void QuadUv(Vec3f a, Vec3f b, Vec3f c, Vec3f d, Vec2f uv_a, Vec2f uv_b, Vec2f uv_c, Vec2f uv_d);
  void Triangle(Vec3f a, Vec3f b, Vec3f c, Vec2f uv_a = {}, Vec2f uv_b = {}, Vec2f uv_c = {});
  /// Triangle with shading normals (builder frame).
  void SmoothTriangle(const Vec3f (&p)[3], const Vec3f (&n)[3], const Vec2f (&uv)[3]);
  /// Axis-aligned box; `sides` chooses faces.
  enum Side : unsigned { kLeft = 1, kRight = 2, kFront = 4, kBack = 8, kBottom = 16, kTop = 32, kAllSides = 63 };
  void Box(Vec3f min, Vec3f max, unsigned sides = kAllSides);
  /// Square bar of the given thickness from a to b.
  void Beam(Vec3f a, Vec3f b, float thickness);
  /// Cone frustum from a (radius ra) to b (radius rb) with smooth normals; caps where asked.
  void Tube(Vec3f a, Vec3f b, float ra, float rb, int sides, bool cap_a = true, bool cap_b = true);
  void Sphere(Vec3f center, Vec3f radii, int rings, int sides);
  /// Flat polygon at height z facing up (`up`) or down; simple outline, counter-clockwise from above; uv =
  /// (x, -y) metres.
  void Polygon(std::span<const Vec2f> outline, float z, bool up = true);
  /// Vertical walls of an outline (counter-clockwise from above, facing outwards) from z0 to z1.
  void Walls(std::span<const Vec2f> outline, float z0, float z1);

  bool empty() const { return groups_.empty(); }
  /// The mesh so far; the builder is empty afterwards.
  Mesh Finish(std::string name);

 private:
  struct Group {
    std::vector<Vec3f> positions, normals;
    std::vector<Vec2f> uvs;
  };
  void Emit(Vec3f p, Vec3f n, Vec2f uv);

  std::map<std::pair<MaterialId, EntityId>, Group> groups_;
  MaterialId material_ = 0;
  EntityId entity_ = kNoEntity;
  AffineTransform X_;
};

/// Triangles (indices into `outline`) of a simple counter-clockwise polygon, by ear clipping.
std::vector<Vec3u> TriangulatePolygon(std::span<const Vec2f> outline);

}  // namespace airsim360
