// The Embree scene of a Scene, and what its ids mean.
//
// A mesh used once is attached to the top-level scene, its vertices baked into W unless its transform is the
// identity. A mesh used several times becomes a scene of its own with an instance for each use. The
// alpha-tested triangles of a mesh are a geometry apart: only they pay for the filter. Triangles on which the
// texture is all solid count as opaque, those on which it is all hole are left out. Clear panes are a
// geometry apart too: they have mask bits of their own.
//
// What moves is hidden from the rays of dynamic tracers by ray masks, so that nothing is built again. A mask
// has two bits for each generation of tracers, kMaskSolid and kMaskClearPanes shifted by twice its number; a
// geometry holds those of the generations that see it. A new generation begins when something moves for the
// first time; 0 is the scene as built.
#pragma once

#include <embree3/rtcore.h>

#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <vector>

#include "airsim360/scene/scene.h"
#include "airsim360/trace/alpha_filter.h"
#include "airsim360/trace/point_query.h"
#include "airsim360/trace/ray_tracer.h"

namespace airsim360::internal {

/// Embree objects, released with their owner.
struct DeviceDeleter {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct SceneDeleter {
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
using DeviceHandle = std::unique_ptr<RTCDeviceTy, DeviceDeleter>;
using SceneHandle = std::unique_ptr<RTCSceneTy, SceneDeleter>;

/// The triangles of one mesh that form one Embree geometry.
struct MeshGeometry {
  const Mesh* mesh = nullptr;
  std::vector<uint32_t> triangles;  // primitive -> triangle of the mesh; empty = the same number
  std::vector<Vec3u> indices;       // own index buffer where `triangles` is not empty
  uint32_t primitive_count = 0;
  std::unique_ptr<AlphaGeometry> alpha;  // set where the triangles are alpha-tested
  unsigned mask = kMaskSolid;            // of generation 0
};

/// Everything that has ever moved, and how rays of tracers that show it must be marked.
struct Movers {
  std::vector<uint32_t> instances;  // ascending
  uint32_t generation = 0;
  bool all = false;  // every instance is a mover: the static scene is not traced at all
};

class EmbreeScene {
 public:
  /// Builds everything, in parallel. RuntimeError if Embree refuses (no memory, unknown isa).
  EmbreeScene(const Scene& scene, const RayTracerOptions& options);

  RTCScene top() const { return top_.get(); }
  /// Whatever has clear panes, under the same ids and masks; nullptr if nothing has. Small, so that looking
  /// for panes alone costs little.
  RTCScene panes() const { return panes_.get(); }
  bool has_instances() const { return has_instances_; }
  bool has_clear_panes() const { return has_clear_panes_; }
  const std::vector<HitSlot>& slots() const { return slots_; }
  const std::vector<uint32_t>& first_slots() const { return first_slots_; }

  /// Adds instances to what has ever moved; they are hidden from the rays of later tracers, not from those of
  /// earlier ones. May be called while others trace.
  Movers Move(std::span<const uint32_t> instances);
  /// Id of an instance in the top-level scene (of its first geometry, if it is baked); kMiss = it has no
  /// triangles.
  uint32_t TopId(uint32_t instance) const { return top_ids_[instance]; }
  /// A scene of one mesh, in its own frame; made when first needed. May be called while others trace.
  RTCScene SubScene(const Mesh& mesh, MeshId id);
  /// A scene of one mesh with other vertices, of one more element than the mesh has; for refitting.
  SceneHandle MakeDeformable(MeshId id, const Vec3f* vertices, size_t count);
  unsigned GroupCount(MeshId id) const { return static_cast<unsigned>(groups_[id].size()); }
  /// The scene as built, for point queries; made when first needed. May be called while others trace.
  const PointQueryScene& PointQueries(const Scene& scene);
  RTCDevice device() const { return device_.get(); }
  void ThrowOnError() const;

 private:
  // Groups of one mesh, opaque first, in the order of their Embree geometry ids in a scene of their own.
  using MeshGroups = std::vector<std::unique_ptr<MeshGeometry>>;

  void SplitMeshes(const Scene& scene, const std::vector<uint32_t>& uses, bool sort_alpha);
  void BuildSubScenes(const Scene& scene, const std::vector<uint32_t>& uses);
  void AttachInstances(const Scene& scene, const std::vector<uint32_t>& uses);
  void AttachInstance(unsigned id, RTCScene sub_scene, const AffineTransform& X_WM, unsigned mask);
  void AttachGeometry(RTCScene target, unsigned id, const MeshGeometry& geometry, const Vec3f* vertices, size_t count,
                      RTCBuildQuality quality);
  void AttachPanes(RTCGeometry geometry, unsigned id);
  void BuildSubScene(const Mesh& mesh, MeshId id);
  const Vec3f* PaddedVertices(const Mesh& mesh, const AffineTransform* X_WM, std::vector<Vec3f>& own) const;

  DeviceHandle device_;
  std::vector<MeshGroups> groups_;                     // by mesh
  std::vector<uint8_t> foliage_;                       // by mesh: 1 = mostly leaves, traced without robustness
  std::vector<std::vector<Vec3f>> mesh_vertices_;      // by mesh: padded copy, where one was needed
  std::vector<std::vector<Vec3f>> instance_vertices_;  // by instance: baked or padded copy
  std::vector<SceneHandle> sub_scenes_;                // by mesh; null where not instanced
  SceneHandle top_, panes_;
  bool has_instances_ = false, has_clear_panes_ = false;
  std::vector<HitSlot> slots_;
  std::vector<uint32_t> first_slots_;
  std::vector<uint32_t> top_ids_;    // by instance
  std::vector<uint32_t> top_masks_;  // by id in the top-level scene, before anything moves

  std::once_flag point_queries_once_;
  std::unique_ptr<PointQueryScene> point_queries_;
  std::mutex mutex_;  // of the following and of sub-scenes made late
  Movers movers_;
};

}  // namespace airsim360::internal
