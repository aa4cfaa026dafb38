// Roofs of every kind over houses of many shapes: closed to rain, between eaves and ridge, over their own
// ground.
#include "airsim360/worlds/building/roofs.h"

#include <gtest/gtest.h>

#include "airsim360/worlds/building/facade.h"
#include "airsim360/worlds/kit/test_mesh.h"
#include "airsim360/worlds/texture/test_surfaces.h"

namespace airsim360 {
namespace {

using namespace internal;

struct RoofCase {
  std::string name;
  RoofKind kind;
  std::vector<Vec2f> outline;
  std::vector<EdgeKind> edges;
};
void PrintTo(const RoofCase& c, std::ostream* out) { *out << c.name; }

std::vector<RoofCase> RoofCases() {
  using E = EdgeKind;
  std::vector<RoofCase> cases;
  const std::pair<const char*, RoofKind> kinds[] = {{"gravel", RoofKind::kFlatGravel},
                                                    {"bitumen", RoofKind::kFlatBitumen},
                                                    {"hip_tile", RoofKind::kHipTile},
                                                    {"hip_slate", RoofKind::kHipSlate}};
  const std::tuple<const char*, float, float> sizes[] = {{"wide", 18, 11}, {"deep", 6, 14.5f}, {"square", 12, 12}, {"narrow", 4.7f, 14.5f}};
  const std::pair<const char*, std::vector<E>> sides[] = {{"alone", {E::kStreet, E::kStreet, E::kStreet, E::kStreet}},
                                                          {"in_a_row", {E::kStreet, E::kParty, E::kRear, E::kParty}},
                                                          {"at_a_corner", {E::kStreet, E::kStreet, E::kParty, E::kParty}}};
  for (const auto& [kind_name, kind] : kinds)
    for (const auto& [size_name, x, y] : sizes)
      for (const auto& [side_name, edges] : sides)
        cases.push_back(
            {std::string(kind_name) + "_" + size_name + "_" + side_name, kind, {{3, 2}, {3 + x, 2}, {3 + x, 2 + y}, {3, 2 + y}}, edges});
  for (const auto& [kind_name, kind] : {kinds[0], kinds[1]})
    cases.push_back({std::string(kind_name) + "_chamfered",
                     kind,
                     {{6, 2}, {15, 2}, {15, 14}, {3, 14}, {3, 5}},
                     {E::kStreet, E::kParty, E::kParty, E::kStreet, E::kStreet}});
  return cases;
}

class EveryRoof : public testing::TestWithParam<RoofCase> {
 protected:
  bool hip() const { return GetParam().kind == RoofKind::kHipTile || GetParam().kind == RoofKind::kHipSlate; }
  BuildingPlan plan(uint64_t seed = 3) const {
    BuildingPlan plan;
    plan.outline = GetParam().outline;
    plan.edges = GetParam().edges;
    plan.party_height.assign(plan.edges.size(), 0);
    plan.roof = GetParam().kind;
    plan.seed = seed;
    return plan;
  }
  float overhang(size_t edge) const { return hip() && GetParam().edges[edge] != EdgeKind::kParty ? 0.45f : 0.0f; }
  struct Built {
    Mesh mesh;
    std::shared_ptr<const Scene> scene;
    EntityId building, roof;
  };
  Built Build(const BuildingPlan& plan, bool clutter) const {
    SceneBuilder builder("roof");
    const Surfaces surfaces = AddTestSurfaces(builder);
    PropShelf shelf(builder, nullptr, 1);
    MeshBuilder mesh;
    Built built;
    built.building = builder.AddEntity("building", builder.tree().At("construction/building"));
    built.roof = builder.AddEntity("roof", builder.tree().At("construction/building/roof"));
    BuildRoof(builder, mesh, surfaces, clutter ? &shelf : nullptr, plan, built.building, built.roof);
    built.mesh = mesh.Finish("roof");
    built.scene = builder.Build();
    return built;
  }
};

INSTANTIATE_TEST_SUITE_P(Roofs, EveryRoof, testing::ValuesIn(RoofCases()), [](const auto& info) { return info.param.name; });

TEST_P(EveryRoof, LetsNoRainInAndLiesBetweenEavesAndRidge) {
  const BuildingPlan house = plan();
  const TestRays roof(Build(house, false).mesh, 0);
  const GroundRect box = house.bounds();
  const float eaves = house.height(), half = std::min(box.width(), box.depth()) / 2 + 0.45f;
  const float top = hip() ? eaves + 0.06f + 0.62f * half + 1.31f : eaves + ParapetHeight(house) + 0.1f;  // chimney, coping
  for (float x = box.x0 + 0.021f; x < box.x1; x += 0.37f) {
    for (float y = box.y0 + 0.017f; y < box.y1; y += 0.41f) {
      const std::vector<Vec2f>& o = house.outline;
      bool inside = true;
      for (size_t i = 0; i < o.size(); ++i) {
        const Vec2f a = o[i], b = o[(i + 1) % o.size()];
        inside = inside && (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x) > 0;
      }
      if (!inside) continue;
      const auto hit = roof.First({x, y, 60}, {0, 0, -1});
      ASSERT_TRUE(hit) << "hole at " << x << ", " << y;
      EXPECT_GE(60 - hit->t, eaves - 0.001f) << x << ", " << y;
      EXPECT_LE(60 - hit->t, top) << x << ", " << y;
      EXPECT_GT(hit->n.z, 0) << x << ", " << y;
    }
  }
}

TEST_P(EveryRoof, HangsOverStreetAndYardButNotOverNeighbours) {
  const BuildingPlan house = plan();
  const Box3f box = Build(house, false).mesh.Bounds();
  for (size_t e = 0; e < house.outline.size(); ++e) {
    const Vec2f a = house.outline[e], b = house.outline[(e + 1) % house.outline.size()], v = b - a;
    if (std::abs(v.x) > 0.01f && std::abs(v.y) > 0.01f) continue;
    const float beyond =
        std::abs(v.y) < 0.01f ? (v.x > 0 ? a.y - box.min.y : box.max.y - a.y) : (v.y > 0 ? box.max.x - a.x : a.x - box.min.x);
    EXPECT_NEAR(beyond, hip() ? overhang(e) : 0.06f, 1e-3) << "edge " << e;
  }
}

TEST_P(EveryRoof, HasSoundNumbersAndTwoEntities) {
  const Built built = Build(plan(), false);
  EXPECT_EQ(FaultOf(built.mesh), "");
  std::set<EntityId> entities;
  for (const MeshPart& part : built.mesh.parts) entities.insert(part.entity);
  EXPECT_EQ(entities, (std::set<EntityId>{built.building, built.roof}));
}

TEST_P(EveryRoof, FollowsFromItsSeed) {
  EXPECT_TRUE(SameBytes(Build(plan(3), true).mesh, Build(plan(3), true).mesh));
  // A square hip roof has no ridge that its chimney could stand elsewhere on.
  if (!hip() || GetParam().name.find("square") == std::string::npos) {
    EXPECT_FALSE(SameBytes(Build(plan(3), true).mesh, Build(plan(8), true).mesh));
  }
}

// Tanks, machines and vents stand on the deck, not in the air beside it, and apart from the next tier.
TEST_P(EveryRoof, ItsClutterStandsOnTheDeckAndOffTheNextTier) {
  for (uint64_t seed = 1; seed < 8; ++seed) {
    BuildingPlan house = plan(seed);
    house.style = seed % 2 ? FacadeStyle::kDeco : FacadeStyle::kBrickLoft;
    const GroundRect box = house.bounds(), tier{box.x0 + 4, box.y0 + 4, box.x1 - 3, box.y1 - 3};
    if (seed > 4 && tier.width() > 0 && tier.depth() > 0) house.upper = tier.Outline();
    const Built built = Build(house, true);
    for (const Instance& instance : built.scene->instances) {
      const Vec3f p = instance.X_WM.p;
      EXPECT_FLOAT_EQ(p.z, house.height());
      EXPECT_TRUE(box.Contains({p.x, p.y})) << seed;
      EXPECT_FALSE(!house.upper.empty() && tier.Contains({p.x, p.y})) << seed;
    }
    const Box3f all = built.mesh.Bounds();
    EXPECT_GE(all.min.x, box.x0 - 0.46f);
    EXPECT_LE(all.max.x, box.x1 + 0.46f);
    EXPECT_GE(all.min.y, box.y0 - 0.46f);
    EXPECT_LE(all.max.y, box.y1 + 0.46f);
  }
}

}  // namespace
}  // namespace airsim360
