#include "airsim360/render/shading/light_probes.h"

#include <gtest/gtest.h>

#include <cmath>

#include "airsim360/base/parallel.h"
#include "airsim360/math/angles.h"

namespace airsim360::internal {
namespace {

void AddQuad(Mesh& mesh, Vec3f a, Vec3f b, Vec3f c, Vec3f d) {
  const auto i = static_cast<uint32_t>(mesh.positions.size());
  for (Vec3f p : {a, b, c, d}) mesh.positions.push_back(p);
  mesh.triangles.push_back({i, i + 1, i + 2});
  mesh.triangles.push_back({i, i + 2, i + 3});
}

// Faces outwards, or inwards.
void AddBox(Mesh& mesh, Vec3f lo, Vec3f hi, bool inwards = false) {
  for (int axis = 0; axis < 3; ++axis) {
    for (int side = 0; side < 2; ++side) {
      Vec3f corner[4];
      for (int k = 0; k < 4; ++k) {
        corner[k][axis] = side ? hi[axis] : lo[axis];
        corner[k][(axis + 1) % 3] = k == 1 || k == 2 ? hi[(axis + 1) % 3] : lo[(axis + 1) % 3];
        corner[k][(axis + 2) % 3] = k >= 2 ? hi[(axis + 2) % 3] : lo[(axis + 2) % 3];
      }
      const bool forward = (side == 1) != inwards;
      if (forward)
        AddQuad(mesh, corner[0], corner[1], corner[2], corner[3]);
      else
        AddQuad(mesh, corner[3], corner[2], corner[1], corner[0]);
    }
  }
}

struct ProbeWorld {
  std::shared_ptr<const RayTracer> tracer;
  std::unique_ptr<SurfaceTables> tables;
  std::unique_ptr<Sky> sky;
  std::unique_ptr<LightProbes> probes;

  explicit ProbeWorld(Mesh mesh, float albedo = 0.2f, bool open = true, Vec3f interior = {}) {
    SceneBuilder builder("test");
    Material material;
    material.base_color = {albedo, albedo, albedo};
    builder.AddMaterial(material);
    const EntityId entity = builder.AddEntity("all", builder.tree().At("construction/building"));
    if (open) builder.AddSky();
    builder.SetInteriorLight(interior);
    builder.environment().cloud_cover = 0;
    builder.AddInstance({builder.AddMesh(std::move(mesh)), AffineTransform(), entity});
    tracer = std::make_shared<const RayTracer>(builder.Build());
    tables = std::make_unique<SurfaceTables>(tracer->scene());
    if (open) sky = std::make_unique<Sky>(tracer->scene().environment);
    probes = std::make_unique<LightProbes>(ProbeLight{*tracer, *tables, sky.get()}, LightProbes::Options{20000, 2.0f});
  }
};

Mesh Ground(float half = 30) {
  Mesh mesh;
  AddQuad(mesh, {-half, -half, 0}, {half, -half, 0}, {half, half, 0}, {-half, half, 0});
  return mesh;
}

TEST(LightProbes, OverAnEmptyPlaneTheyShowTheSky) {
  const ProbeWorld world(Ground(), 0.0f);
  const Vec3f above = world.probes->Irradiance({1, 2, 1}, {0, 0, 1}), sky = world.sky->Irradiance({0, 0, 1});
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(above[c] / sky[c], 1, 0.06) << c;
  // A black plane sends nothing up.
  EXPECT_LT(world.probes->Irradiance({1, 2, 1}, {0, 0, -1}).y, 0.15f * sky.y);
}

TEST(LightProbes, SunlitGroundLightsFromBelow) {
  const ProbeWorld world(Ground(), 0.5f);
  const Vec3f below = world.probes->Irradiance({1, 2, 1.5f}, {0, 0, -1});
  const float full = 0.5f * (world.sky->sun_irradiance().y * world.sky->to_sun().z + 0.5f * world.sky->Irradiance({0, 0, 1}).y);
  EXPECT_NEAR(below.y / full, 1, 0.25f);
}

TEST(LightProbes, InAClosedBoxItIsDarkAndUnderARoofHalfDark) {
  Mesh mesh = Ground();
  AddBox(mesh, {8, 8, 0.01f}, {20, 20, 9}, true);  // a room closed on all sides
  AddBox(mesh, {-20, -10, 4}, {-4, 10, 4.5f});     // a roof without walls
  const ProbeWorld world(mesh, 0.3f);
  const float open = world.probes->Irradiance({5, -15, 1}, {0, 0, 1}).y;
  const float closed = world.probes->Irradiance({14, 14, 4}, {0, 0, 1}).y;
  const float roofed = world.probes->Irradiance({-12, 0, 1}, {0, 0, 1}).y;
  EXPECT_LT(closed, 0.02f * open);
  EXPECT_LT(roofed, 0.55f * open);
  EXPECT_GT(roofed, 0.05f * open);
}

TEST(LightProbes, LightDoesNotLeakFromInsideSolids) {
  Mesh mesh = Ground();
  AddBox(mesh, {-6, -6, 0}, {6, 6, 12});
  const ProbeWorld world(mesh, 0.3f);
  // Close to the wall the probes inside count for nothing: about half the sky is seen, wherever the lattice
  // falls.
  const float open = world.probes->Irradiance({25, 0, 3}, {1, 0, 0}).y;
  for (float y : {-3.0f, -1.3f, 0.0f, 1.7f}) {
    const float wall = world.probes->Irradiance({6.9f, y, 5}, {1, 0, 0}).y;
    EXPECT_GT(wall, 0.6f * open) << y;
    EXPECT_LT(wall, 1.4f * open) << y;
  }
}

TEST(LightProbes, ClosedRoomsAreLitEvenlyAndDarkerInCorners) {
  Mesh mesh;
  AddBox(mesh, {-5, -5, 0}, {5, 5, 6}, true);
  const ProbeWorld world(mesh, 0.5f, false, {2, 2, 2});
  const auto mean = [&](Vec3f p) {
    float sum = 0;
    for (int k = 0; k < 6; ++k) {
      Vec3f n;
      n[k / 2] = k % 2 ? -1.0f : 1.0f;
      sum += world.probes->Irradiance(p, n).y / 6;
    }
    return sum;
  };
  const float middle = mean({0, 0, 3}), corner = mean({4.8f, 4.8f, 0.4f});
  EXPECT_GT(middle, 0.7f * 2 * kPiF);
  EXPECT_LE(middle, 1.01f * 2 * kPiF);
  EXPECT_LT(corner, middle);
}

TEST(LightProbes, AreTheSameWithAnyNumberOfThreads) {
  Mesh mesh = Ground(10);
  AddBox(mesh, {-3, -3, 0}, {3, 3, 5});
  const ProbeWorld many(mesh);
  const ThreadLimit one(1);
  const ProbeWorld single(mesh);
  ASSERT_EQ(many.probes->size(), single.probes->size());
  for (float x = -9; x < 9; x += 0.7f) {
    EXPECT_EQ(many.probes->Irradiance({x, 0.3f * x, 2}, {0, 0.6f, 0.8f}), single.probes->Irradiance({x, 0.3f * x, 2}, {0, 0.6f, 0.8f}));
  }
}

}  // namespace
}  // namespace airsim360::internal
