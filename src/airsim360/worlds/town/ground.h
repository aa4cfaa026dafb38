// Ground geometry: carriageways with crown and gutters, junctions, markings, kerbs, pavements and laid
// polygons.
#pragma once

#include <functional>
#include <span>
#include <string>

#include "airsim360/scene/scene.h"
#include "airsim360/worlds/kit/mesh_builder.h"
#include "airsim360/worlds/kit/street_plan.h"
#include "airsim360/worlds/texture/surfaces.h"

namespace airsim360 {

/// Where ground geometry goes: one merged mesh, an entity per patch.
class Ground {
 public:
  Ground(SceneBuilder& builder, const Surfaces& surfaces) : builder_(builder), surfaces_(surfaces) {}

  /// Starts a patch: the following shapes belong to a new entity of category `path`.
  EntityId Begin(std::string name, std::string_view path, Surface surface);
  /// The following shapes have this surface; entity unchanged.
  void Use(Surface surface) { mesh_.SetMaterial(surfaces_[surface]); }
  void UseEntity(EntityId entity) { mesh_.SetEntity(entity); }

  /// Shapes with uv = (x, -y) of W, so that patterns run through. Corners counter-clockwise from above.
  void Quad(Vec3f a, Vec3f b, Vec3f c, Vec3f d);
  void Rect(const GroundRect& rect, float z);
  void Polygon(std::span<const Vec2f> outline, float z) { mesh_.Polygon(outline, z); }
  /// Flat ring sector around `center` from radius r0 to r1, angles a0 < a1 (radians).
  void RingSector(Vec2f center, float r0, float r1, float a0, float a1, float z, int steps);
  /// Vertical wall along a polyline; visible from its right-hand side.
  void Wall(std::span<const Vec2f> line, float z0, float z1);

  SceneBuilder& builder() { return builder_; }
  MeshBuilder& mesh() { return mesh_; }
  const Surfaces& surfaces() const { return surfaces_; }
  /// Finish puts meshes into the scene as `lay` returns them: over hills, say. Null = as they are.
  void SetLay(std::function<Mesh(const Mesh&)> lay) { lay_ = std::move(lay); }
  /// Adds everything so far to the scene as one mesh.
  void Finish(std::string name);

 private:
  std::function<Mesh(const Mesh&)> lay_;
  SceneBuilder& builder_;
  const Surfaces& surfaces_;
  MeshBuilder mesh_;
};

/// A stretch of street between two junctions, in street coordinates: s along the line, d across (left of +s
/// positive).
struct StreetStretch {
  StreetLine line;
  bool along_x;
  float s0, s1;  ///< between the kerb returns
  Vec3f At(float s, float d, float lift = 0) const;
};

/// Lays all carriageways, junctions, markings, crosswalks, gutters, patches, cracks and drains of the plan.
/// Returns the stretches of the core streets, out to the edge of the backdrop ring, for cars and manholes.
std::vector<StreetStretch> LayStreets(Ground& ground, const StreetPlan& plan, uint64_t seed);

/// Radius of the kerb returns of crossings, where stretches end.
inline constexpr float kCornerRadius = 6;

/// Where a crosswalk meets the kerb, measured along a block side from the end of the kerb return.
inline constexpr float kCrosswalkStart = 0.9f, kCrosswalkWidth = 3.0f;

/// Lays kerbs (0.13 m, dropped at crosswalks) and pavement fields around a block; `worn`: with gum, stains and replaced slabs.
void LayPavement(Ground& ground, const Block& block, Surface slabs, std::string_view category = "ground/pavement/modular",
                 bool worn = false);

/// Side `side` (0 south, 1 east, 2 north, 3 west) of a block: origin and directions of its kerb line.
struct BlockSide {
  Vec2f origin, along, inward;
  float length;
  Vec2f At(float s, float d) const { return origin + along * s + inward * d; }
};
BlockSide SideOf(const Block& block, int side);

}  // namespace airsim360
