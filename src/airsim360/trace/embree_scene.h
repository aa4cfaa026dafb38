// The Embree scene of a Scene, and what its ids mean.
//
// A mesh used once is attached to the top-level scene, its vertices baked into W unless its transform is the
// identity. A mesh used several times becomes a scene of its own with an instance for each use. The
// alpha-tested triangles of a mesh are a geometry apart: only they pay for the filter. So are clear panes:
// they have a mask bit of their own.
#pragma once

#include <embree3/rtcore.h>

#include <memory>
#include <string>
#include <vector>

#include "airsim360/scene/scene.h"
#include "airsim360/trace/alpha_filter.h"
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
  unsigned mask = kMaskSolid;
};

class EmbreeScene {
 public:
  /// Builds everything, in parallel. RuntimeError if Embree refuses (no memory, unknown isa).
  EmbreeScene(const Scene& scene, const std::string& isa);

  RTCScene top() const { return top_.get(); }
  bool has_instances() const { return has_instances_; }
  bool has_clear_panes() const { return has_clear_panes_; }
  const std::vector<HitSlot>& slots() const { return slots_; }
  const std::vector<uint32_t>& first_slots() const { return first_slots_; }

 private:
  // Groups of one mesh, opaque first, in the order of their Embree geometry ids in a scene of their own.
  using MeshGroups = std::vector<std::unique_ptr<MeshGeometry>>;

  void SplitMeshes(const Scene& scene, const std::vector<uint32_t>& uses);
  void BuildSubScenes(const Scene& scene, const std::vector<uint32_t>& uses);
  void AttachInstances(const Scene& scene, const std::vector<uint32_t>& uses);
  void AttachInstance(unsigned id, RTCScene sub_scene, const AffineTransform& X_WM);
  void AttachGeometry(RTCScene target, unsigned id, const MeshGeometry& geometry, const Vec3f* vertices,
                      size_t count, RTCBuildQuality quality) const;
  const Vec3f* PaddedVertices(const Mesh& mesh, const AffineTransform* X_WM, std::vector<Vec3f>& own) const;
  void ThrowOnError() const;

  DeviceHandle device_;
  std::vector<MeshGroups> groups_;                     // by mesh
  std::vector<std::vector<Vec3f>> mesh_vertices_;      // by mesh: padded copy, where one was needed
  std::vector<std::vector<Vec3f>> instance_vertices_;  // by instance: baked or padded copy
  std::vector<SceneHandle> sub_scenes_;                // by mesh; null where not instanced
  SceneHandle top_;
  bool has_instances_ = false, has_clear_panes_ = false;
  std::vector<HitSlot> slots_;
  std::vector<uint32_t> first_slots_;
};

}  // namespace airsim360::internal
