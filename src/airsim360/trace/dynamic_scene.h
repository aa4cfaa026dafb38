// What moves, as an Embree scene of its own beside the static one.
#pragma once

#include <map>
#include <vector>

#include "airsim360/scene/scene_state.h"
#include "airsim360/trace/embree_scene.h"

namespace airsim360::internal {

struct GeometryDeleter {
  void operator()(RTCGeometry geometry) const { rtcReleaseGeometry(geometry); }
};
using GeometryHandle = std::unique_ptr<RTCGeometryTy, GeometryDeleter>;

/// Every mover is an instance, under the id that it has in the static scene, so that hits of both scenes
/// resolve through the same tables.
class DynamicScene {
 public:
  /// Brings the scene to `state`, which names no other instances and no meshes of other instances than
  /// `movers`.
  void Update(EmbreeScene& statics, const Scene& scene, const SceneState& state, const Movers& movers);

  /// Looks for a triangle of what is shown nearer to p_W than `best`.
  void Find(Vec3f p_W, NearestTriangle& best) const;

  RTCScene top() const { return top_.get(); }
  const std::vector<MovedInstance>& moved() const { return moved_; }
  const std::vector<DeformedMesh>& deformed() const { return deformed_; }
  const std::vector<HitSlot>& slots() const { return slots_; }

 private:
  // A deformed mesh, kept for the next time its mesh is deformed.
  struct Body {
    std::vector<Vec3f> vertices;
    SceneHandle scene;
  };
  void SetMovers(EmbreeScene& statics, const Movers& movers);
  void Deform(EmbreeScene& statics, const Scene& scene, const SceneState& state);
  void Place(EmbreeScene& statics, const Scene& scene, const SceneState& state);

  SceneHandle top_;
  SceneHandle empty_;  // what hidden movers refer to
  std::vector<MovedInstance> moved_;
  std::vector<GeometryHandle> instances_;  // by mover
  std::vector<RTCScene> shown_;            // by mover: its sub-scene now
  std::vector<DeformedMesh> deformed_;
  std::map<MeshId, Body> bodies_;
  std::vector<HitSlot> slots_;
  std::map<RTCScene, std::vector<TriangleBuffers>> groups_;  // of what is shown
  std::vector<PlacedMesh> placed_;                           // what is shown
};

}  // namespace airsim360::internal
