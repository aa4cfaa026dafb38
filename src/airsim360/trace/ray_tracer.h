// Ray casting against a scene: nearest hit, occlusion, closest surface. Embree stays inside this module.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "airsim360/scene/scene.h"
#include "airsim360/scene/scene_state.h"

namespace airsim360 {

/// Sixteen rays and their hits, structure of arrays, origin and direction in W. Fill every lane with finite
/// values, also those that are not active. Directions need not have unit length; distances are in units of
/// the direction's length.
struct alignas(64) RayHit16 {
  float origin_x[16], origin_y[16], origin_z[16];
  float t_near[16];
  float direction_x[16], direction_y[16], direction_z[16];
  float time[16];   // 0
  float t_far[16];  ///< in: farthest distance; out: distance of the hit
  uint32_t mask[16], id[16], flags[16];
  float normal_x[16], normal_y[16], normal_z[16];  ///< geometric normal, not unit length; frame: HitSlot
  float u[16], v[16];                              ///< barycentrics: p = (1 - u - v) p0 + u p1 + v p2
  uint32_t primitive[16], geometry[16],
      instance[16];  ///< resolve with RayTracer::Resolve; geometry kMiss = no hit
};
inline constexpr uint32_t kMiss = UINT32_MAX;

/// Values of RayHit16::mask. Camera rays meet everything; rays of light may leave clear panes out
/// (IsClearPane) and ask for them apart.
inline constexpr uint32_t kMaskAll = UINT32_MAX, kMaskSolid = 1, kMaskClearPanes = 2;

/// What a hit is in terms of the scene.
struct SurfaceRef {
  uint32_t instance;  ///< index into Scene::instances
  uint32_t triangle;  ///< index into Mesh::triangles
};

/// What one (geometry, instance) pair of ids in RayHit16 stands for, for loops that resolve many hits.
struct HitSlot {
  uint32_t instance = 0;  ///< index into Scene::instances
  uint32_t primitive_count = 0;
  const uint32_t* triangles = nullptr;  ///< primitive -> index into Mesh::triangles; nullptr = the same number
  bool normal_in_world = false;         ///< RayHit16 normals are in W already, else in the mesh frame
};

/// Nearest hit of one ray.
struct SurfaceHit {
  float distance;
  SurfaceRef surface;
  float u, v;
  Vec3f normal;  ///< unit geometric normal in W, on the side the ray came from
};

/// Nearest point of the surfaces to a point asked for.
struct NearestSurface {
  float distance;
  Vec3f offset;  ///< in W: the nearest point less the point asked for
  SurfaceRef surface;
};

struct RayTracerOptions {
  std::string isa;         ///< Embree instruction set, e.g. "avx2" to pin goldens; empty = best of this machine
  bool sort_alpha = true;  ///< false: every alpha-tested triangle pays for the test, for measuring
};

/// While it lives, this thread treats denormal numbers as zero (MXCSR FTZ and DAZ): what traversal is fastest
/// with. Put one around a tile of Intersect16 or Occluded16 calls, on every thread, so that results do not
/// depend on the thread.
class FlushDenormals {
 public:
  FlushDenormals();
  ~FlushDenormals();
  FlushDenormals(const FlushDenormals&) = delete;
  FlushDenormals& operator=(const FlushDenormals&) = delete;

 private:
  unsigned saved_;
};

/// Immutable after construction; all queries are const and may run concurrently. Surfaces are seen from both
/// sides; alpha-tested ones (AlphaMode::kMask) are holes where base alpha times texture alpha (bilinear,
/// level 0) < cutoff. Adjacent triangles of a mesh let no ray through between them.
class RayTracer {
 public:
  RayTracer(std::shared_ptr<const Scene> scene, const RayTracerOptions& options = {});
  ~RayTracer();

  const Scene& scene() const;
  /// Nearest hits of the lanes with valid[i] == -1 (0 = inactive, left as they are); needs no other
  /// preparation of the hit fields. `valid` is aligned to 64 bytes. `coherent`: neighbouring rays, as of a
  /// camera.
  void Intersect16(const int* valid, RayHit16& rays, bool coherent) const;
  /// Nearest clear panes: Intersect16 for rays whose masks are all kMaskClearPanes, at the cost of a scene of
  /// panes alone.
  void IntersectClearPanes16(const int* valid, RayHit16& rays) const;
  /// Sets occluded[i] for active lanes: whether [t_near, t_far] meets a surface (t_far is then minus
  /// infinity).
  void Occluded16(const int* valid, RayHit16& rays, bool* occluded, bool coherent) const;
  bool has_clear_panes() const;
  SurfaceRef Resolve(uint32_t geometry, uint32_t instance, uint32_t primitive) const;

  /// The slot of a hit is slots()[first_slots()[instance] + geometry], or slots()[first_slots()[geometry]]
  /// where instance == kMiss.
  std::span<const HitSlot> slots() const;
  std::span<const uint32_t> first_slots() const;

  std::optional<SurfaceHit> Intersect(Vec3f origin, Vec3f direction, float t_far = std::numeric_limits<float>::infinity()) const;
  /// True if the open segment between two points of W meets a surface.
  bool Occluded(Vec3f from, Vec3f to) const;
  /// Distance from a point of W to the nearest triangle (holes of alpha-tested ones count as solid), at most
  /// `max_distance`.
  float Clearance(Vec3f p_W, float max_distance) const;
  /// The point that Clearance measures to; nullopt where there is none nearer than `max_distance`.
  std::optional<NearestSurface> Nearest(Vec3f p_W, float max_distance) const;

  /// Instances that need not stand where the scene has them, by index, with their places now: empty unless a
  /// DynamicTracer made this tracer. Holds what has ever moved, so also what is back in its old place.
  std::span<const MovedInstance> moved() const;
  /// Meshes whose vertices are not those of the scene, by index.
  std::span<const DeformedMesh> deformed() const;
  /// Mesh frame to W of an instance now, and the vertices of a mesh now.
  const AffineTransform& Place(uint32_t instance) const;
  std::span<const Vec3f> Positions(MeshId mesh) const;

 private:
  friend class DynamicTracer;
  struct Impl;
  void IntersectIn(bool panes, const int* valid, RayHit16& rays, bool coherent) const;
  explicit RayTracer(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

/// Tracers of one scene at many instants. The static scene is built once and shared; what has ever moved is
/// traced apart, so that a new instant costs O(moved) and not O(scene). Not for use by several threads at
/// once; the tracers it gives are as immutable as any.
class DynamicTracer {
 public:
  explicit DynamicTracer(std::shared_ptr<const RayTracer> base);
  ~DynamicTracer();
  /// The scene at `state` (nullptr: as built, the base itself). Memory of earlier results that nobody holds
  /// any more is used again: transforms are set, deformed meshes refitted, every 30th time built anew.
  /// InputError for an index that the scene lacks, lists out of order, vertices that are too few, too many or
  /// not finite.
  std::shared_ptr<const RayTracer> At(const std::shared_ptr<const SceneState>& state);

 private:
  std::shared_ptr<const RayTracer> base_;
  std::vector<std::shared_ptr<RayTracer>> pool_;
};

}  // namespace airsim360
