// Distance from a point to the nearest triangle of a scene with instances.
//
// rtcPointQuery of Embree 3.13.5 misses surfaces of instances with a uniform scale below one (it takes the
// radius of W for that of the instance: 4 to 6 % of random queries were wrong), so instances are asked one by
// one, each in its own frame with a radius that covers the ball in W.
#pragma once

#include <embree3/rtcore.h>

#include <span>
#include <vector>

#include "airsim360/math/box.h"
#include "airsim360/math/transform.h"
#include "airsim360/trace/ray_tracer.h"

namespace airsim360::internal {

/// The best triangle of a point query so far.
struct NearestTriangle {
  float distance;                        // metres in W; before the first find: how far to look
  Vec3f offset = {};                     // from the point asked for to the nearest point of the triangle, in W
  uint32_t instance = kMiss;             // index into Scene::instances; kMiss = none found
  uint32_t geometry = 0, primitive = 0;  // ids of Embree
  bool placed = false;                   // the geometry counts within the mesh, not within the top scene
};

/// What Embree reads of one triangle geometry.
struct TriangleBuffers {
  const Vec3f* vertices = nullptr;
  const Vec3u* triangles = nullptr;
};
TriangleBuffers BuffersOf(RTCGeometry geometry);
/// Of geometries 0 … count - 1 of a scene.
std::vector<TriangleBuffers> BuffersOf(RTCScene scene, unsigned count);

/// A scene of one mesh and its place in W.
class PlacedMesh {
 public:
  /// `groups` by geometry id; both must outlive this.
  PlacedMesh(uint32_t instance, RTCScene scene, const std::vector<TriangleBuffers>& groups, const AffineTransform& X_WM);

  uint32_t instance() const { return instance_; }
  const Box3f& bounds() const { return bounds_; }
  /// Looks for a triangle nearer to p_W than `best`.
  void Find(Vec3f p_W, NearestTriangle& best) const;

 private:
  static bool VisitTriangle(RTCPointQueryFunctionArguments* args);

  uint32_t instance_;
  RTCScene scene_;
  const std::vector<TriangleBuffers>* groups_;
  AffineTransform X_WM_;
  Mat3f to_mesh_;  // inverse of the linear part; identity where there is none
  float stretch_;  // at least the factor by which to_mesh_ lengthens any vector; infinite where no inverse
  Box3f bounds_;   // in W
};

/// Distance from a point to a box; 0 inside.
float DistanceToBox(Vec3f p, const Box3f& box);

/// Everything that an EmbreeScene holds, arranged for point queries. Immutable.
class PointQueryScene {
 public:
  struct Baked {
    unsigned id;                             // of the geometry in `top`
    uint32_t instance, vertices, triangles;  // of which instance, and how many
  };
  struct Instanced {
    uint32_t instance;
    RTCScene scene;  // of its mesh
    uint32_t mesh;
    unsigned groups;
    AffineTransform X_WM;
  };
  /// Shares the buffers of the geometries of `top`. RuntimeError if Embree refuses.
  PointQueryScene(RTCDevice device, RTCScene top, const std::vector<Baked>& baked, const std::vector<Instanced>& instanced, size_t meshes);
  ~PointQueryScene();
  PointQueryScene(const PointQueryScene&) = delete;
  PointQueryScene& operator=(const PointQueryScene&) = delete;

  /// Looks for a triangle nearer to p_W than `best`, leaving out instances in `left_out`.
  void Find(Vec3f p_W, std::span<const MovedInstance> left_out, NearestTriangle& best) const;

 private:
  struct Query;
  static bool Visit(RTCPointQueryFunctionArguments* args);

  std::vector<TriangleBuffers> baked_;  // by geometry id of the top scene
  std::vector<uint32_t> instances_;     // by the same id
  std::vector<std::vector<TriangleBuffers>> mesh_groups_;
  std::vector<PlacedMesh> placed_;
  unsigned placed_id_ = 0;  // geometry whose primitives are placed_
  RTCScene scene_ = nullptr;
};

}  // namespace airsim360::internal
