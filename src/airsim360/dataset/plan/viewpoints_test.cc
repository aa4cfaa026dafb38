#include "airsim360/dataset/plan/viewpoints.h"

#include <gtest/gtest.h>

#include <cmath>

namespace airsim360 {
namespace {

// A level square around (x, y), and below it nothing.
Mesh Square(const char* name, float x, float y, float half) {
  Mesh mesh;
  mesh.name = name;
  mesh.positions = {{x - half, y - half, 0}, {x + half, y - half, 0}, {x + half, y + half, 0}, {x - half, y + half, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

// Posts every 6 m over 400 m x 400 m, on a ground of 120 m x 120 m and what is called `outside` around it.
std::shared_ptr<const Scene> Town(const char* outside) {
  SceneBuilder builder("town");
  builder.AddSky();
  const MaterialId material = builder.AddMaterial({});
  (void)material;
  const EntityId inner = builder.AddEntity("pavement", builder.tree().At("ground/sidewalk")),
                 outer = builder.AddEntity("far pavement", builder.tree().At("ground/sidewalk"));
  builder.AddInstance({builder.AddMesh(Square("ground", 0, 0, 60)), {}, inner});
  for (const auto& [x, y] : {std::pair{-130.0f, 0.0f}, {130.0f, 0.0f}, {0.0f, -130.0f}, {0.0f, 130.0f}})
    builder.AddInstance({builder.AddMesh(Square(outside, x, y, 70)), {}, outer});
  const MeshId post = builder.AddMesh(Square("post", 0, 0, 0.1f));
  for (int j = -33; j <= 33; ++j) {
    for (int i = -33; i <= 33; ++i) {
      AffineTransform X_WM;
      X_WM.p = {6.0f * static_cast<float>(i), 6.0f * static_cast<float>(j), 0.3f};
      builder.AddInstance({post, X_WM, builder.AddEntity("post", builder.tree().At("traffic/bollard"))});
    }
  }
  return builder.Build();
}

int Outside(const char* name, std::vector<std::string> area = {}) {
  const RayTracer tracer(Town(name));
  RecipeRow row;
  row.name = "views";
  row.area = std::move(area);
  const ViewpointSampler sampler(tracer, row, 3, {{"traffic/bollard", 0.5}});
  int outside = 0;
  for (int64_t k = 0; k < 300; ++k) {
    const Vec3d p = sampler.Pose(k).p;
    outside += std::abs(p.x) > 73 || std::abs(p.y) > 73;  // a cell of 12 m more than the ground
  }
  return outside;
}

TEST(Viewpoints, AreNotAmongTheBlocksOfABackdrop) { EXPECT_EQ(Outside("backdrop"), 0); }

TEST(Viewpoints, AreEverywhereWhereASceneTellsNoBackdropApart) { EXPECT_GT(Outside("ground"), 100); }

TEST(Viewpoints, AreInTheBackdropWhereARowAsksForIt) { EXPECT_EQ(Outside("backdrop", {"90", "-20", "120", "20"}), 300); }

// A house of two storeys of 3 m, 8 m x 8 m, on a lawn; its first viewpoint is in it or before it.
std::shared_ptr<const Scene> House(bool enter) {
  SceneBuilder builder("house");
  builder.AddSky();
  builder.SetSpawn(enter ? Vec3f{0, 0, 1.6f} : Vec3f{20, 0, 1.6f});
  const auto add = [&](const char* category, float z, float half) {
    AffineTransform X_WM;
    X_WM.p = {0, 0, z};
    builder.AddInstance({builder.AddMesh(Square(category, 0, 0, half)), X_WM, builder.AddEntity(category, builder.tree().At(category))});
  };
  add("ground/grass", -0.1f, 60);
  for (const float floor : {0.0f, 3.2f}) add("ground/floor", floor, 4), add("construction/ceiling", floor + 3, 4);
  return builder.Build();
}

TEST(Viewpoints, AreInTheRoomsOfABuildingThatIsEnteredAtItsFirstViewpoint) {
  RecipeRow row;
  row.name = "rooms";
  row.clearance = 0.3;
  for (const bool enter : {true, false}) {
    const RayTracer tracer(House(enter));
    const ViewpointSampler sampler(tracer, row, 3, {});
    int inside = 0, upstairs = 0;
    for (int64_t k = 0; k < 200; ++k) {
      const Vec3d p = sampler.Pose(k).p;
      inside += std::abs(p.x) < 4 && std::abs(p.y) < 4 && p.z < 6.2;
      upstairs += p.z > 3.2 + row.lowest - 1e-6;
      EXPECT_TRUE(!enter || (p.z > 1.59 && p.z < 2.71) || (p.z > 4.79 && p.z < 5.91)) << p.z;
    }
    EXPECT_TRUE(enter ? inside == 200 && upstairs > 75 && upstairs < 125 : inside < 100) << inside << ", " << upstairs;
  }
}

}  // namespace
}  // namespace airsim360
