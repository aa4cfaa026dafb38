// Entity ids are 32 bits from end to end: a world of 90,000 things shows each of them, also those beyond 65,536.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "airsim360/base/error.h"
#include "airsim360/render/renderer.h"
#include "airsim360/scene/entity_table.h"
#include "airsim360/scene/scene.h"

namespace airsim360 {
namespace {

constexpr int kSide = 300;

// Tiles of 0.9 m on a grid of 1 m: half of them instances of one mesh, half parts of one merged mesh.
std::shared_ptr<const Scene> Field() {
  SceneBuilder builder("field");
  builder.AddSky();
  builder.AddMaterial({});
  const CategoryId rock = builder.tree().At("nature/rock");
  const auto tile = [](float x, float y, Mesh& mesh) {
    const auto first = static_cast<uint32_t>(mesh.positions.size());
    for (const auto& d : {Vec2f{-0.45f, -0.45f}, Vec2f{0.45f, -0.45f}, Vec2f{0.45f, 0.45f}, Vec2f{-0.45f, 0.45f}})
      mesh.positions.push_back({x + d.x, y + d.y, 0});
    mesh.triangles.push_back({first, first + 1, first + 2});
    mesh.triangles.push_back({first, first + 2, first + 3});
  };
  Mesh one, merged;
  tile(0, 0, one);
  const MeshId single = builder.AddMesh(std::move(one));
  for (int i = 0; i < kSide * kSide; ++i) {
    const auto x = static_cast<float>(i % kSide) + 0.5f, y = static_cast<float>(i / kSide) + 0.5f;
    const EntityId id = builder.AddEntity("tile", rock);
    if (i % 2 == 0) {
      builder.AddInstance({single, PlaceUpright({x, y, 0}), id});
    } else {
      merged.parts.push_back({static_cast<uint32_t>(merged.triangles.size()), 2, 0, id});
      tile(x, y, merged);
    }
  }
  builder.AddInstance({builder.AddMesh(std::move(merged)), {}, kNoEntity});
  return builder.Build();
}

TEST(ManyEntities, EachOfNinetyThousandIsSeenAsItself) {
  const auto scene = Field();
  ASSERT_EQ(scene->entities.size(), static_cast<size_t>(kSide * kSide + 1));
  const auto renderer = MakeCpuRenderer(std::make_shared<RayTracer>(scene));
  // Straight down from 1.5 m, over places all over the field: 25 tiles or so in each picture.
  std::set<EntityId> seen;
  int checked = 0;
  for (int k = 0; k < 60; ++k) {
    const double px = 3 + std::fmod(k * 71.3, kSide - 6), py = 3 + std::fmod(k * 37.7, kSide - 6);
    const RenderRequest request =
        MakeRequest(Equirectangular{64, 32}, BodyPose({px, py, 1.5}, 0.2, -0.1, 0) * CameraInBody(), Tier::kLabels, {.rgb = false});
    Frame frame;
    renderer->Render(request, frame);
    for (int y = 0; y < 32; ++y) {
      for (int x = 0; x < 64; ++x) {
        const Vec3d ray = request.X_WC.R * *PixelToRay(request.camera, {x + 0.5, y + 0.5});
        if (ray.z > -0.3) continue;
        // Where the ray meets z = 0, and whose tile that is.
        const double hx = px - ray.x / ray.z * 1.5, hy = py - ray.y / ray.z * 1.5;
        const double fx = hx - std::floor(hx), fy = hy - std::floor(hy);
        if (hx < 0 || hy < 0 || hx >= kSide || hy >= kSide) continue;
        if (std::abs(fx - 0.5) > 0.44 || std::abs(fy - 0.5) > 0.44) continue;
        const auto expected = static_cast<EntityId>(static_cast<int>(hy) * kSide + static_cast<int>(hx) + 2);  // 1 is the sky
        ASSERT_EQ(frame.entity(x, y), expected);
        seen.insert(expected);
        ++checked;
      }
    }
  }
  EXPECT_GT(*seen.rbegin(), 65536u);
  EXPECT_GT(checked, 20000);
}

TEST(ManyEntities, TheTableHoldsEachWithItsPlaceAndBox) {
  const auto scene = Field();
  const std::vector<EntityRow> rows = EntityTable(*scene);
  ASSERT_EQ(rows.size(), scene->entities.size());
  EXPECT_FALSE(rows[0].has_box);  // the sky
  for (const EntityId id : {2u, 3u, 65537u, 65538u, 90001u}) {
    const EntityRow& row = rows[id - 1];
    const int i = static_cast<int>(id) - 2;
    ASSERT_TRUE(row.has_box);
    EXPECT_EQ(row.id, id);
    EXPECT_EQ(row.path, "nature/rock");
    EXPECT_NEAR(row.X_WE.p.x, i % kSide + 0.5, 1e-4);
    EXPECT_NEAR(row.X_WE.p.y, i / kSide + 0.5, 1e-4);
    EXPECT_NEAR(static_cast<double>(row.box.size().x), 0.9, 1e-4);
  }
}

}  // namespace
}  // namespace airsim360
