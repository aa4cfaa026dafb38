// All lamps of a scene (emissive triangles in groups), and choosing among many of them.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "airsim360/render/lights/light_tree.h"
#include "airsim360/render/surface/surface_tables.h"
#include "airsim360/scene/environment.h"
#include "airsim360/scene/scene.h"

namespace airsim360::internal {

/// One lx.
inline constexpr float kLux = kNit;

/// A connected emitting part of one instance. Surfaces shine to their front side only (counter-clockwise
/// triangles face it), with the same radiance in all directions but for a beam.
struct Lamp {
  Vec3f center;           ///< mean of its area, in W
  float radius = 0;       ///< of the sphere about `center` that holds it
  Vec3f axis;             ///< unit, mean direction that it faces
  float spread = 0;       ///< largest angle between `axis` and a normal of it, radians; pi = all ways
  float area = 0;         ///< m^2
  Vec3f facing;           ///< integral of the unit normal over its area: length `area` where flat, 0 where closed
  Vec3f power;            ///< per channel: pi times the integral of radiance over its area
  Vec3f beam;             ///< axis in W times sharpness, see beam_shape (shading_shared.h); zero = shines to all sides alike
  uint32_t instance = 0;  ///< index into Scene::instances
};

/// A point on a lamp chosen for a shaded point.
struct LightSample {
  Vec3f p;         ///< in W
  Vec3f normal;    ///< unit, of the lamp there: it shines to this side only
  Vec3f radiance;  ///< towards the shaded point; visibility is the caller's to test
  float pdf;       ///< per area of the lamp, all choices included; 0 = no lamp matters here
  uint32_t lamp;   ///< its number in tree()
};

/// Immutable. Which emissive materials shine is fixed by the environment (Material::lamp). A lamp is chosen
/// by a tree of bounds of power, place and orientation (Conty Estevez & Kulla, HPG 2018), then a point
/// uniformly over its area. A lamp that can send light to (p, normal) never has density 0.
class LightTable {
 public:
  LightTable(const Scene& scene, const SurfaceTables& tables, const Environment& environment);
  ~LightTable();
  bool empty() const;
  size_t size() const;  ///< lamps
  std::span<const Lamp> lamps() const;
  /// Chooses by estimated contribution (power, distance, orientation); u in [0, 1)^3. A zero `normal` stands
  /// for surfaces that take light from all sides (leaves, fog).
  LightSample Sample(Vec3f p, Vec3f normal, Vec3f u) const;
  /// A point, by (u, v), of a lamp that tree() has chosen for some place near p.
  LightSample PointOf(const LightTree::Choice& choice, Vec3f p, float u, float v) const;
  /// Density, per area, with which Sample at (p, normal) gives a point of this triangle (Scene::instances and
  /// Mesh::triangles index); 0 if it is no lamp. For multiple importance sampling.
  float Pdf(Vec3f p, Vec3f normal, uint32_t instance, uint32_t triangle) const;
  /// Index into lamps() of the lamp that a triangle belongs to; kNoLamp if it does not shine.
  uint32_t LampOf(uint32_t instance, uint32_t triangle) const;
  static constexpr uint32_t kNoLamp = UINT32_MAX;
  /// For back ends that choose lamps themselves: the tree, and each lamp's triangles in ascending order with the share of the
  /// area up to and including each.
  const LightTree& tree() const;
  std::span<const uint32_t> TrianglesOf(uint32_t lamp) const;
  std::span<const float> SharesOf(uint32_t lamp) const;

 private:
  struct Impl;
  std::unique_ptr<const Impl> impl_;
};

}  // namespace airsim360::internal
