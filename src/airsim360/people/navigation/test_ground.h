// Small worlds of boxes for tests: floors and walls at given places.
#pragma once

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "airsim360/scene/scene.h"

namespace airsim360::internal {

/// Collects axis-aligned boxes, ramps and free quads.
class TestGround {
 public:
  explicit TestGround(std::string name = "test ground") : builder_(std::move(name)) { builder_.AddMaterial({}); }
  SceneBuilder& builder() { return builder_; }

  /// A flat or sloping sheet: corners counter-clockwise seen from above.
  EntityId Sheet(const char* category, Vec3f a, Vec3f b, Vec3f c, Vec3f d) {
    Mesh mesh;
    mesh.positions = {a, b, c, d};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    return Add(category, std::move(mesh));
  }
  EntityId Floor(const char* category, float x0, float y0, float x1, float y1, float z = 0) {
    return Sheet(category, {x0, y0, z}, {x1, y0, z}, {x1, y1, z}, {x0, y1, z});
  }
  EntityId Box(const char* category, Vec3f low, Vec3f high) {
    Mesh mesh;
    AddBox(mesh, low, high);
    return Add(category, std::move(mesh));
  }
  /// Of 0.5 m to the south (-y), with a back rest to the north; (x, y): its south-western corner.
  EntityId Seat(const char* category, float x, float y, float width) {
    Mesh mesh;
    AddBox(mesh, {x, y, 0}, {x + width, y + 0.45f, 0.45f});
    AddBox(mesh, {x, y + 0.4f, 0.45f}, {x + width, y + 0.5f, 0.9f});
    return Add(category, std::move(mesh));
  }
  /// A bench with a back and arms, 2 m wide and 0.5 m deep, its middle at (x, y), turned to the left by `yaw` from one that is
  /// sat on from the south.
  EntityId Bench(float x, float y, float yaw) {
    Mesh mesh;
    AddBox(mesh, {-1, -0.25f, 0}, {1, 0.17f, 0.45f});
    AddBox(mesh, {-1, 0.17f, 0.45f}, {1, 0.25f, 0.9f});
    for (const float side : {-1.0f, 0.92f}) AddBox(mesh, {side, -0.25f, 0.45f}, {side + 0.08f, 0.2f, 0.68f});
    return Add("furniture/seating/bench", std::move(mesh), PlaceUpright({x, y, 0}, yaw));
  }
  /// A wall 3 m high and 0.2 m thick around the segment.
  void Wall(float x0, float y0, float x1, float y1) {
    Box("construction/wall", {std::min(x0, x1) - 0.1f, std::min(y0, y1) - 0.1f, -0.2f},
        {std::max(x0, x1) + 0.1f, std::max(y0, y1) + 0.1f, 3});
  }
  std::shared_ptr<const Scene> Build() { return builder_.Build(); }

 private:
  static void AddBox(Mesh& mesh, Vec3f low, Vec3f high) {
    constexpr Vec3u kFaces[] = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                                {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    const auto first = static_cast<uint32_t>(mesh.positions.size());
    for (int i = 0; i < 8; ++i) mesh.positions.push_back({i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z});
    for (const Vec3u t : kFaces) mesh.triangles.push_back({t.x + first, t.y + first, t.z + first});
  }
  EntityId Add(const char* category, Mesh mesh, const AffineTransform& X_WM = {}) {
    const EntityId entity = builder_.AddEntity(category, builder_.tree().At(category));
    const MeshId id = builder_.AddMesh(std::move(mesh));
    builder_.AddInstance({.mesh = id, .X_WM = X_WM, .entity = entity});
    return entity;
  }
  SceneBuilder builder_;
};

}  // namespace airsim360::internal
