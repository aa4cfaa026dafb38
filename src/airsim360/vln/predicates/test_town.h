// A small made-up town of boxes for tests: every answer can be told by hand.
#pragma once

#include <memory>
#include <string>

#include "airsim360/scene/scene.h"

namespace airsim360 {

class TestTown {
 public:
  TestTown() : builder_("test town") { builder_.AddMaterial({}); }
  /// A box of `size` metres standing on z = `base`.
  EntityId Box(const std::string& name, const char* category, Vec3f at, Vec3f size, float base = 0) {
    return Boxes(name, category, 1, {at.x, at.y, base}, {}, size);
  }
  /// One thing of `count` boxes standing at `at`, `at + step`, …
  EntityId Boxes(const std::string& name, const char* category, int count, Vec3f at, Vec3f step, Vec3f size) {
    const EntityId entity = builder_.AddEntity(name, builder_.tree().At(category));
    for (int k = 0; k < count; ++k) {
      const Vec3f foot = at + step * static_cast<float>(k);
      Mesh mesh;
      for (int i = 0; i < 8; ++i)
        mesh.positions.push_back(
            {foot.x + (i & 1 ? 0.5f : -0.5f) * size.x, foot.y + (i & 2 ? 0.5f : -0.5f) * size.y, foot.z + (i & 4 ? size.z : 0)});
      mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                        {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
      mesh.parts = {{0, 12, 0, kNoEntity}};
      builder_.AddInstance({builder_.AddMesh(std::move(mesh)), {}, entity});
    }
    return entity;
  }
  std::shared_ptr<const Scene> Build() {
    builder_.AddSky();
    return builder_.Build();
  }
  /// Without a sky.
  std::shared_ptr<const Scene> BuildRoom() { return builder_.Build(); }

 private:
  SceneBuilder builder_;
};

}  // namespace airsim360
