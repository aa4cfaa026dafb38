// Facades of city models: houses made of plain polygons get windows and stay closed, where they stand.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "airsim360/scene/scene_archive.h"
#include "airsim360/worlds/kit/mesh_builder.h"
#include "airsim360/worlds/osm/buildings/city_facades.h"

namespace airsim360 {
namespace {

// A house of 12 x 8 m with walls of 9 m and gables to 12 m at its short ends; `windows` adds one of its own.
std::shared_ptr<const Scene> House(bool windows = false, bool neighbour = false) {
  SceneBuilder builder("house");
  builder.AddSky();
  Material plain;
  plain.name = "Building";
  const MaterialId stone = builder.AddMaterial(plain);
  plain.name = "RoofSurface";
  const MaterialId tiles = builder.AddMaterial(plain);
  const auto house = [&](const std::string& name, float x) {
    const EntityId walls = builder.AddEntity(name, builder.tree().At("construction/building")),
                   roof = builder.AddEntity(name + "/roof", builder.tree().At("construction/building/roof"));
    MeshBuilder mesh;
    mesh.SetMaterial(stone);
    mesh.SetEntity(walls);
    mesh.Quad({x - 6, -4, 0}, {x + 6, -4, 0}, {x + 6, -4, 9}, {x - 6, -4, 9});
    mesh.Quad({x + 6, 4, 0}, {x - 6, 4, 0}, {x - 6, 4, 9}, {x + 6, 4, 9});
    for (float s : {-1.0f, 1.0f}) {
      mesh.Quad({x + 6 * s, -4 * s, 0}, {x + 6 * s, 4 * s, 0}, {x + 6 * s, 4 * s, 9}, {x + 6 * s, -4 * s, 9});
      mesh.Triangle({x + 6 * s, -4 * s, 9}, {x + 6 * s, 4 * s, 9}, {x + 6 * s, 0, 12});
    }
    mesh.SetMaterial(tiles);
    mesh.SetEntity(roof);
    mesh.Quad({x - 6, -4, 9}, {x + 6, -4, 9}, {x + 6, 0, 12}, {x - 6, 0, 12});
    mesh.Quad({x + 6, 4, 9}, {x - 6, 4, 9}, {x - 6, 0, 12}, {x + 6, 0, 12});
    builder.AddInstance({builder.AddMesh(mesh.Finish(name)), {}, kNoEntity});
  };
  house("a", 0);
  if (neighbour) house("b", 12);
  if (windows) {
    MeshBuilder mesh;
    mesh.SetEntity(builder.AddEntity("a/window", builder.tree().At("construction/window")));
    mesh.Quad({-1, -4, 3}, {1, -4, 3}, {1, -4, 5}, {-1, -4, 5});
    builder.AddInstance({builder.AddMesh(mesh.Finish("pane")), {}, kNoEntity});
  }
  return builder.Build();
}

struct Hit {
  double distance = 1e9;
  MaterialId material = 0;
  EntityId entity = kNoEntity;
};
Hit Trace(const Scene& scene, Vec3d p, Vec3d d) {
  Hit hit;
  for (const Instance& instance : scene.instances) {
    const Mesh& mesh = scene.meshes[instance.mesh];
    for (const MeshPart& part : mesh.parts)
      for (uint32_t i = part.first_triangle; i < part.first_triangle + part.triangle_count; ++i) {
        const auto at = [&](uint32_t k) { return VecCast<double>(instance.X_WM * mesh.positions[k]); };
        const Vec3d a = at(mesh.triangles[i].x), e1 = at(mesh.triangles[i].y) - a, e2 = at(mesh.triangles[i].z) - a, h = Cross(d, e2);
        const double det = Dot(e1, h);
        if (std::abs(det) < 1e-12) continue;
        const Vec3d s = p - a, q = Cross(s, e1);
        const double u = Dot(s, h) / det, v = Dot(d, q) / det, t = Dot(e2, q) / det;
        if (u >= -1e-9 && v >= -1e-9 && u + v <= 1 + 1e-9 && t > 0 && t < hit.distance)
          hit = {t, part.material, part.entity != kNoEntity ? part.entity : instance.entity};
      }
  }
  return hit;
}

// From `p` in steps along the wall and up: shares of glass, and whether all that is met is the house (or hangs on it) near its wall.
double GlassOn(const Scene& scene, Vec3d from, Vec3d along, Vec3d in, bool* closed) {
  int glass = 0, count = 0;
  for (double u = 0.11; u < 0.9; u += 0.053)
    for (double z = 0.15; z < 8.9; z += 0.41) {
      const Hit hit = Trace(scene, from + along * u + Vec3d{0, 0, z}, in);
      *closed = *closed && hit.distance > 4.3 && hit.distance < 5.7 && (hit.entity == 2 || hit.entity > 3);
      glass += hit.distance < 1e8 && scene.materials[hit.material].kind == SurfaceKind::kGlass;
      ++count;
    }
  return static_cast<double>(glass) / count;
}

TEST(CityFacades, PlainWallsGetWindowsAndStayClosed) {
  const auto plain = House();
  for (uint64_t seed : {0, 3}) {
    const auto scene = WithFacades(plain, seed);
    bool closed = true;
    const double front = GlassOn(*scene, {-6, -9, 0}, {12, 0, 0}, {0, 1, 0}, &closed),
                 side = GlassOn(*scene, {11, -4, 0}, {0, 8, 0}, {-1, 0, 0}, &closed);
    EXPECT_TRUE(closed) << seed;
    EXPECT_GT(front, 0.04) << seed;
    EXPECT_LT(front, 0.9) << seed;
    EXPECT_GT(side, 0.02) << seed;
    // The gable above stays, so do ids, names and the roof.
    EXPECT_EQ(Trace(*scene, {9, 0, 11}, {-1, 0, 0}).entity, 2u);
    ASSERT_GE(scene->entities.size(), plain->entities.size());  // awnings and flower pots follow
    for (size_t i = 0; i < plain->entities.size(); ++i) EXPECT_EQ(scene->entities[i].name, plain->entities[i].name);
    EXPECT_EQ(scene->sky_entity, plain->sky_entity);
    EXPECT_EQ(Trace(*scene, {0, -1, 20}, {0, 0, -1}).entity, 3u);
    EXPECT_NEAR(static_cast<double>(scene->entity(2).bounds.max.z), 12, 0.3);
    EXPECT_NEAR(static_cast<double>(scene->entity(2).bounds.min.y), -4, 1.2);
  }
  EXPECT_EQ(ArchiveScene(*WithFacades(plain, 7)), ArchiveScene(*WithFacades(plain, 7)));
}

TEST(CityFacades, WindowsOfTheFileAndPartyWallsStay) {
  const auto own = House(true);
  EXPECT_EQ(WithFacades(own, 0), own);
  // Between two houses wall to wall nothing is built.
  const auto scene = WithFacades(House(false, true), 0);
  bool closed = true;
  for (double y = -3.5; y < 3.6; y += 0.4)
    for (double z = 0.3; z < 8.8; z += 0.4) closed = closed && std::abs(Trace(*scene, {5.2, y, z}, {1, 0, 0}).distance - 0.8) < 1e-3;
  EXPECT_TRUE(closed);
}

}  // namespace
}  // namespace airsim360
