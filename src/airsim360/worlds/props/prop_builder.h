// Puts a Model together: bevelled, turned, swept and extruded shapes on top of MeshBuilder, materials without
// repeats.
#pragma once

#include <functional>
#include <span>
#include <string>

#include "airsim360/scene/model_source.h"
#include "airsim360/worlds/kit/mesh_builder.h"

namespace airsim360::internal {

/// True if two materials look the same (all fields, the name included).
bool SameMaterial(const Material& a, const Material& b);

/// Rotations about the axes through the origin, in degrees, for SetTransform; and a move.
AffineTransform Turn(float x_deg, float y_deg, float z_deg, Vec3f p = {});
inline AffineTransform Move(Vec3f p) { return Turn(0, 0, 0, p); }

/// Shapes go through the transform of mesh(); uv are metres unless said otherwise.
class PropBuilder {
 public:
  explicit PropBuilder(std::string name) : name_(std::move(name)) {}

  MeshBuilder& mesh() { return mesh_; }
  void Place(const AffineTransform& X) { mesh_.SetTransform(X); }
  /// What the following shapes are made of.
  void Use(const Material& material);
  /// Same, with a base colour texture (and a normal map) whose tile is `tile` metres wide and high; what shines shines in it.
  void Use(Material material, const Texture& base_color, Vec2f tile = {1, 1}, const Texture* normal = nullptr);

  /// Box with rounded-looking edges of width `bevel` (44 triangles).
  void BevelBox(Vec3f min, Vec3f max, float bevel);
  /// Surface of revolution about the vertical through `base`: (radius, height) from bottom to top; corners
  /// sharper than 40 degrees stay sharp. Ends with radius 0 are closed.
  void Lathe(std::span<const Vec2f> profile, int sides, Vec3f base = {});
  /// Round bar along a path with a radius per point (or one for all), with round-looking joints and flat
  /// caps.
  void Bar(std::span<const Vec3f> path, std::span<const float> radii, int sides);
  void Bar(std::span<const Vec3f> path, float radius, int sides) { Bar(path, std::span<const float>(&radius, 1), sides); }
  /// Extruded outline (counter-clockwise from above), closed, walls smooth at corners below 40 degrees.
  void Prism(std::span<const Vec2f> outline, float z0, float z1);
  /// Open surface at(u, v) over the unit square in nu x nv cells with smooth normals, its front where dat/du
  /// x dat/dv points; uv = (u, 1 - v) * `size`. A side may shrink to a point.
  void Sheet(int nu, int nv, const std::function<Vec3f(float u, float v)>& at, Vec2f size);
  /// Rectangle with uv 0..1, (0, 0) at the top left (d); a, b, c, d counter-clockwise from the lower left.
  void Picture(Vec3f a, Vec3f b, Vec3f c, Vec3f d);

  /// The model so far; the builder is empty afterwards.
  Model Finish();

 private:
  std::string name_;
  Model model_;
  MeshBuilder mesh_;
};

/// Rectangle with rounded corners, counter-clockwise, `steps` segments a corner.
std::vector<Vec2f> RoundedRectangle(Vec2f min, Vec2f max, float radius, int steps);

}  // namespace airsim360::internal
