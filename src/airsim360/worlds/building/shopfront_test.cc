// Ground floors of every width: closed, with a sign of their own, an awning that people walk under, one
// entity a thing.
#include "airsim360/worlds/building/shopfront.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "airsim360/worlds/kit/test_mesh.h"
#include "airsim360/worlds/texture/shop_signs.h"
#include "airsim360/worlds/texture/test_surfaces.h"

namespace airsim360::internal {
namespace {

using ShopCase = std::tuple<float, int>;  // width, seed

class EveryShopFront : public testing::TestWithParam<ShopCase> {
 protected:
  static constexpr float kHeight = 4.6f;
  struct Built {
    Mesh mesh;
    EntityId house = kNoEntity;
    std::map<EntityId, std::string> paths;
    std::vector<int> signs;
  };
  // A row of three shops, or three lobbies.
  Built Build(bool lobby, uint64_t seed) const {
    SceneBuilder builder("shop");
    const Surfaces surfaces = AddTestSurfaces(builder);
    MeshBuilder mesh;
    FacadeContext context{builder, surfaces, mesh, AddBalconyMesh(builder, surfaces), AddWindowBoxMesh(builder, surfaces)};
    FacadePen pen(mesh, surfaces);
    BuildingPlan plan;
    Built built;
    built.house = context.building = builder.AddEntity("house", builder.tree().At("construction/building"));
    const float w = std::get<0>(GetParam());
    pen.SetWall({0, 0}, {3 * w, 0});
    pen.UseEntity(built.house);
    const GroundFloor floor{plan, built.house, kHeight, Surface::kBrickRed, Surface::kTrimStone, Surface::kFrameDark};
    RngStream rng(seed, "shops");
    for (int i = 0; i < 3; ++i) {
      const float x = w * static_cast<float>(i);
      if (lobby) {
        BuildLobby(pen, floor, x, x + w);
      } else {
        BuildShop(context, pen, floor, x, x + w, rng);
        built.signs.push_back(context.next_sign);
      }
    }
    built.mesh = mesh.Finish("shop");
    const auto scene = builder.Build();
    for (const Entity& entity : scene->entities) built.paths[entity.id] = scene->tree[entity.category].path;
    return built;
  }
  Built Build(bool lobby = false) const { return Build(lobby, static_cast<uint64_t>(std::get<1>(GetParam()))); }
  float end() const { return 3 * std::get<0>(GetParam()); }
};

INSTANTIATE_TEST_SUITE_P(Shops, EveryShopFront, testing::Combine(testing::Values(2.7f, 3.4f, 4.9f, 7.3f), testing::Range(1, 7)),
                         [](const auto& info) {
                           return std::to_string(static_cast<int>(100 * std::get<0>(info.param))) + "cm_" +
                                  std::to_string(std::get<1>(info.param));
                         });

TEST_P(EveryShopFront, IsClosedToRaysFromTheStreet) {
  for (bool lobby : {false, true}) {
    const Built built = Build(lobby);
    EXPECT_EQ(FaultOf(built.mesh), "");
    const TestRays rays(built.mesh);
    for (float x = 0.9f; x < end() - 0.9f; x += 0.173f) {
      for (float z = 0.041f; z < kHeight - 0.02f; z += 0.197f) {
        for (float slant : {-0.5f, 0.0f, 0.5f}) {
          const Vec3f d = Normalized(Vec3f{slant, 1, -0.004f});
          const auto hit = rays.First(Vec3f{x, 0, z} - d * (9 / d.y), d);
          const float y = hit ? hit->t * d.y - 9 : 1e9f;
          ASSERT_LE(y, 1.0f) << (lobby ? "lobby" : "shop") << " x " << x << " z " << z << " slant " << slant;
        }
      }
    }
  }
}

TEST_P(EveryShopFront, SignsAreOnTheirShopsAndDifferFromTheirNeighbours) {
  const Built built = Build();
  std::map<EntityId, Box3f> boxes;
  std::map<EntityId, Box3f> signs;  // of texture coordinates
  for (const MeshPart& part : built.mesh.parts) {
    if (part.entity == built.house) continue;
    for (uint32_t k = part.first_triangle; k < part.first_triangle + part.triangle_count; ++k) {
      const Vec3u t = built.mesh.triangles[k];
      for (uint32_t i : {t.x, t.y, t.z}) {
        boxes[part.entity].Add(built.mesh.positions[i]);
        if (built.paths.at(part.entity) != "signage/shop_sign") continue;
        const Vec2f uv = built.mesh.uvs[i];
        signs[part.entity].Add(Vec3f{uv.x, uv.y, 0});
      }
    }
  }
  EXPECT_EQ(signs.size(), 3u);
  const float w = std::get<0>(GetParam());
  for (const auto& [entity, box] : boxes) {
    const auto shop = std::floor(box.center().x / w);
    EXPECT_GE(box.min.x, shop * w - 1e-3f);
    EXPECT_LE(box.max.x, (shop + 1) * w + 1e-3f);
    // People walk under it.
    EXPECT_GE(box.min.z, built.paths.at(entity) == "construction/awning" ? 1.95f : 3.1f);
    EXPECT_LE(box.max.z, 3.9f);
    EXPECT_GE(box.min.y, -1.6f);
  }
  // Each shows one sign of the sheet.
  for (const auto& [entity, box] : signs) {
    const bool found = std::any_of(built.signs.begin(), built.signs.end(), [&](int i) {
      const SignBox whole = ShopSignBox(i);
      return box.min.x >= whole.uv0.x && box.max.x <= whole.uv1.x && std::abs(box.min.y - whole.uv0.y) < 1e-6f &&
             std::abs(box.max.y - whole.uv1.y) < 1e-6f;
    });
    EXPECT_TRUE(found);
  }
  for (size_t i = 0; i + 1 < built.signs.size(); ++i) {
    EXPECT_NE(built.signs[i], built.signs[i + 1]);
    EXPECT_LT(built.signs[i], kSignCount);
  }
}

TEST(ShopSigns, NoTwoNamesAreAlikeAndAllCanBeLettered) {
  std::set<std::string> names;
  for (int i = 0; i < kSignCount; ++i) {
    const std::string name = ShopName(i);
    EXPECT_LE(name.size(), 26u);
    EXPECT_EQ(name.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789 .,-+!&%'/"), std::string::npos) << name;
    names.insert(name);
  }
  EXPECT_EQ(names.size(), static_cast<size_t>(kSignCount));
  EXPECT_GE(kSignCount, 200);
}

TEST(ShopSigns, AShopComesAgainOnlyAfterAllOthers) {
  SceneBuilder builder("street");
  const Surfaces surfaces = AddTestSurfaces(builder);
  std::set<int> seen;
  int next = 0;
  for (int i = 0; i < kSignCount; ++i) {
    MeshBuilder mesh;
    FacadeContext context{builder, surfaces, mesh, 0, 0};
    context.next_sign = next;
    FacadePen pen(mesh, surfaces);
    pen.SetWall({0, 0}, {5, 0});
    const BuildingPlan plan;
    const GroundFloor floor{plan, kNoEntity, 4.6f, Surface::kBrickRed, Surface::kTrimStone, Surface::kFrameDark};
    RngStream rng(3, "shop");
    BuildShop(context, pen, floor, 0, 5, rng);
    next = context.next_sign;
    EXPECT_TRUE(seen.insert(next).second);
  }
}

TEST_P(EveryShopFront, FollowsFromItsSeed) {
  const auto seed = static_cast<uint64_t>(std::get<1>(GetParam()));
  EXPECT_TRUE(SameBytes(Build(false, seed).mesh, Build(false, seed).mesh));
  EXPECT_FALSE(SameBytes(Build(false, seed).mesh, Build(false, seed + 100).mesh));
}

TEST(RepeatedFacadeMeshes, HaveTheirStatedSizes) {
  SceneBuilder builder("repeated");
  const Surfaces surfaces = AddTestSurfaces(builder);
  const Mesh& balcony = builder.mesh(AddBalconyMesh(builder, surfaces));
  const Box3f rail = balcony.Bounds();
  EXPECT_EQ(FaultOf(balcony), "");
  EXPECT_NEAR(rail.size().x, 1, 0.03f);
  EXPECT_NEAR(rail.max.z, 0.96f, 1e-5);
  EXPECT_LE(rail.max.y, 0);
  const Mesh& box = builder.mesh(AddWindowBoxMesh(builder, surfaces));
  EXPECT_EQ(FaultOf(box), "");
  EXPECT_NEAR(box.Bounds().size().x, 0.66f, 0.01f);
  for (bool mirrored : {false, true}) {
    const Mesh& escape = builder.mesh(AddFireEscapeMesh(builder, surfaces, mirrored));
    EXPECT_EQ(FaultOf(escape), "");
    EXPECT_NEAR(escape.Bounds().size().x, 4.4f, 0.05f);
    EXPECT_LE(escape.Bounds().max.y, 1e-5f);
  }
  for (float length : {4.7f, 6.0f, 7.5f, 12.0f}) {
    EXPECT_GT(StoopMiddle(length), 0.86f);
    EXPECT_LT(StoopMiddle(length), length - 0.86f);
  }
}

}  // namespace
}  // namespace airsim360::internal
