// Walls of every style, of every kind and detail: closed to rays from the street, within their building,
// repeatable.
#include "airsim360/worlds/building/facade.h"

#include <gtest/gtest.h>

#include "airsim360/worlds/building/facade_bays.h"
#include "airsim360/worlds/kit/test_mesh.h"
#include "airsim360/worlds/texture/test_surfaces.h"
#include "airsim360/worlds/worlds.h"

namespace airsim360 {
namespace {

using namespace internal;

constexpr float kDeepest = 1.25f;  // metres behind the wall: doors of shops are set back by 0.98
constexpr float kProud = 2.0f;     // metres before it: the stoop of a brownstone

const std::set<MaterialId>& Panes() {
  static const std::set<MaterialId> panes{TestMaterial(Surface::kGlassDark),      TestMaterial(Surface::kGlassBlue),
                                          TestMaterial(Surface::kGlassBlind),     TestMaterial(Surface::kGlassLit),
                                          TestMaterial(Surface::kGlassBlack),     TestMaterial(Surface::kGlassCurtain),
                                          TestMaterial(Surface::kGlassRedCurtain)};
  return panes;
}

// A building of 21 x 15 m over the origin, all of its edges of one kind.
BuildingPlan House(FacadeStyle style, EdgeKind kind = EdgeKind::kStreet, uint64_t seed = 5, float width = 21) {
  BuildingPlan plan;
  plan.outline = {{0, 0}, {width, 0}, {width, 15}, {0, 15}};
  plan.edges.assign(4, kind);
  plan.party_height.assign(4, 0);
  plan.style = style;
  plan.seed = seed;
  return plan;
}

struct Walls {
  Mesh mesh;
  EntityId building = kNoEntity;
};
struct Fitting {
  float base = 0, stretch = 1, reach = 1;
};
Walls Build(const BuildingPlan& plan, FacadeDetail detail, Fitting fit = {}) {
  SceneBuilder builder("facade");
  const Surfaces surfaces = AddTestSurfaces(builder);
  MeshBuilder mesh;
  FacadeContext context{builder, surfaces, mesh, AddBalconyMesh(builder, surfaces), AddWindowBoxMesh(builder, surfaces)};
  context.base = fit.base;
  context.stretch = fit.stretch;
  context.reach = fit.reach;
  Walls walls;
  walls.building = builder.AddEntity("building", builder.tree().At("construction/building"));
  BuildFacades(context, plan, walls.building, std::vector<FacadeDetail>(plan.edges.size(), detail));
  walls.mesh = mesh.Finish("facade");
  return walls;
}

using Case = std::tuple<FacadeStyle, EdgeKind, FacadeDetail>;

std::string NameOf(const Case& c) {
  static constexpr const char* kKinds[] = {"street", "rear", "party"};
  static constexpr const char* kDetails[] = {"full", "simple", "flat"};
  return FacadeStyleNames()[static_cast<size_t>(std::get<0>(c))] + "_" + kKinds[static_cast<size_t>(std::get<1>(c))] + "_" +
         kDetails[static_cast<size_t>(std::get<2>(c))];
}

std::vector<FacadeStyle> AllStyles() {
  std::vector<FacadeStyle> styles;
  for (int i = 0; i < static_cast<int>(FacadeStyle::kCount); ++i) styles.push_back(static_cast<FacadeStyle>(i));
  return styles;
}

class EveryFacade : public testing::TestWithParam<Case> {
 protected:
  FacadeStyle style() const { return std::get<0>(GetParam()); }
  EdgeKind kind() const { return std::get<1>(GetParam()); }
  FacadeDetail detail() const { return std::get<2>(GetParam()); }
  BuildingPlan plan(uint64_t seed = 5) const { return House(style(), kind(), seed); }
};

INSTANTIATE_TEST_SUITE_P(Facades, EveryFacade,
                         testing::Combine(testing::ValuesIn(AllStyles()),
                                          testing::Values(EdgeKind::kStreet, EdgeKind::kRear, EdgeKind::kParty),
                                          testing::Values(FacadeDetail::kFull, FacadeDetail::kSimple, FacadeDetail::kFlat)),
                         [](const auto& info) { return NameOf(info.param); });

// Rays from the street, straight on and from both sides, end at the wall or in its openings.
TEST_P(EveryFacade, HasNoHoleThatARayFromTheStreetGoesThrough) {
  const BuildingPlan house = plan();
  const TestRays walls(Build(house, detail()).mesh);
  const float top = house.height() + ParapetHeight(house);
  int holes = 0;
  for (float x = 3.031f; x < 18; x += 0.613f) {
    for (float z = 0.053f; z < top - 0.05f; z += 0.487f) {
      for (float slant : {-0.55f, 0.0f, 0.55f}) {
        const Vec3f d = Normalized(Vec3f{slant, 1, 0.03f}), at{x, 0, z};
        const auto hit = walls.First(at - d * (12 / d.y), d, 30);
        const float y = hit ? hit->t * d.y - 12 : 1e9f;
        if (y >= -kProud && y <= kDeepest) continue;
        if (++holes <= 5) ADD_FAILURE() << "hole at x " << x << ", z " << z << ", slant " << slant << ", y " << y;
      }
    }
  }
  EXPECT_EQ(holes, 0);
}

TEST_P(EveryFacade, HasSoundNumbersAndMaterialsOfTheList) {
  const Walls walls = Build(plan(), detail());
  EXPECT_EQ(FaultOf(walls.mesh), "");
  for (const MeshPart& part : walls.mesh.parts) {
    EXPECT_LT(part.material, static_cast<MaterialId>(Surface::kCount));
    EXPECT_NE(part.entity, kNoEntity);
  }
}

TEST_P(EveryFacade, StaysWithinItsBuilding) {
  const BuildingPlan house = plan();
  const Box3f box = Build(house, detail()).mesh.Bounds();
  EXPECT_GE(box.min.x, -kProud);
  EXPECT_LE(box.max.x, 21 + kProud);
  EXPECT_GE(box.min.y, -kProud);
  EXPECT_LE(box.max.y, 15 + kProud);
  EXPECT_GE(box.min.z, -0.01f);
  // A chimney on a bare wall rises up to 1.2 m over the parapet.
  EXPECT_LE(box.max.z, house.height() + ParapetHeight(house) + 1.2f);
  EXPECT_GE(box.max.z, house.height() + ParapetHeight(house) - 0.01f);
}

TEST_P(EveryFacade, FollowsFromItsSeed) {
  const Mesh one = Build(plan(5), detail()).mesh, again = Build(plan(5), detail()).mesh, other = Build(plan(6), detail()).mesh;
  EXPECT_TRUE(SameBytes(one, again));
  const bool picture = detail() == FacadeDetail::kFlat && kind() != EdgeKind::kParty;
  EXPECT_EQ(SameBytes(one, other), picture);
}

// Maps stand their houses on slopes and stretch them to the tagged height.
TEST_P(EveryFacade, IsLiftedAndStretchedAsAWhole) {
  const Mesh plain = Build(plan(), detail()).mesh, moved = Build(plan(), detail(), {7, 1.25f, 1}).mesh;
  ASSERT_EQ(plain.triangles.size(), moved.triangles.size());
  const Box3f a = plain.Bounds(), b = moved.Bounds();
  EXPECT_NEAR(b.min.z, 7 + 1.25f * a.min.z, 1e-3);
  EXPECT_NEAR(b.max.z, 7 + 1.25f * a.max.z, 1e-3);
  EXPECT_NEAR(b.min.y, a.min.y, 1e-4);
}

// A tier begins at its base, where the one below ends.
TEST_P(EveryFacade, OfATierBeginsAtItsBase) {
  BuildingPlan tier = plan();
  tier.base = 20;
  const Mesh mesh = Build(tier, detail()).mesh;
  const TestRays walls(mesh);
  EXPECT_NEAR(mesh.Bounds().min.z, 20, 0.75f);  // braces and brackets may reach a little lower
  for (float x = 3.031f; x < 18; x += 1.7f)
    for (float z = 20.03f; z < tier.height(); z += 0.9f) {
      const auto hit = walls.First({x, -12, z}, {0, 1, 0});
      EXPECT_TRUE(hit && hit->t < 12 + kDeepest) << "x " << x << ", z " << z;
    }
}

class EveryStyle : public testing::TestWithParam<FacadeStyle> {};

INSTANTIATE_TEST_SUITE_P(Facades, EveryStyle, testing::ValuesIn(AllStyles()),
                         [](const auto& info) { return FacadeStyleNames()[static_cast<size_t>(info.param)]; });

TEST_P(EveryStyle, IsAsHighAsItsStoreys) {
  const StyleMetrics& metrics = MetricsOf(GetParam());
  for (int floors : {0, 1, 4, 30}) {
    BuildingPlan plan = House(GetParam());
    plan.floors = floors;
    EXPECT_FLOAT_EQ(plan.height(), metrics.ground_height + static_cast<float>(floors) * metrics.floor_height);
    plan.base = 33;
    EXPECT_FLOAT_EQ(plan.height(), 33 + static_cast<float>(floors) * metrics.floor_height);
  }
  EXPECT_EQ(StylesOf({FacadeStyleNames()[static_cast<size_t>(GetParam())]}), std::vector<FacadeStyle>{GetParam()});
}

// Twice as many bays have twice as much glass; twice as many storeys too.
TEST_P(EveryStyle, HasGlassInProportionToItsBaysAndStoreys) {
  const float bay = MetricsOf(GetParam()).bay, ground = MetricsOf(GetParam()).ground_height;
  for (FacadeDetail detail : {FacadeDetail::kFull, FacadeDetail::kSimple}) {
    const auto glass = [&](int bays, int floors) {
      BuildingPlan plan = House(GetParam(), EdgeKind::kStreet, 5, bay * static_cast<float>(bays));
      plan.floors = floors;
      plan.edges = {EdgeKind::kStreet, EdgeKind::kParty, EdgeKind::kParty, EdgeKind::kParty};
      plan.party_height = {0, 1e3f, 1e3f, 1e3f};
      return AreaOf(Build(plan, detail).mesh, Panes(), ground - 0.01f);
    };
    const double few = glass(6, 3);
    EXPECT_GT(few, 6 * 3 * 0.8);
    EXPECT_NEAR(glass(12, 3), 2 * few, 0.12 * few);
    EXPECT_NEAR(glass(6, 6), 2 * few, 0.12 * few);
  }
}

TEST_P(EveryStyle, HasAsManyPalettesAsItSaysAndTheyDiffer) {
  std::vector<Mesh> built;
  for (int palette = 0; palette < MetricsOf(GetParam()).palettes; ++palette) {
    BuildingPlan plan = House(GetParam());
    plan.palette = palette;
    built.push_back(Build(plan, FacadeDetail::kFull).mesh);
    std::set<MaterialId> used;
    for (const MeshPart& part : built.back().parts) used.insert(part.material);
    EXPECT_TRUE(used.contains(TestMaterial(WallSurfaceOf(plan))));
    for (int other = 0; other < palette; ++other) EXPECT_FALSE(SameBytes(built.back(), built[static_cast<size_t>(other)]));
  }
}

TEST_P(EveryStyle, HidesAPartyWallUpToItsNeighboursRoof) {
  for (float neighbour : {4.0f, 9.5f, 60.0f}) {
    BuildingPlan plan = House(GetParam(), EdgeKind::kParty);
    plan.party_height.assign(4, neighbour);
    const Mesh mesh = Build(plan, FacadeDetail::kFull).mesh;
    if (neighbour > plan.height() + ParapetHeight(plan)) {
      EXPECT_TRUE(mesh.triangles.empty());
    } else {
      EXPECT_NEAR(mesh.Bounds().min.z, neighbour, 1e-4);
    }
  }
}

// Maps scale what stands proud: cornices, stoops, handrails and braces with it, their ends around the corner
// too.
TEST_P(EveryStyle, WithoutReachOnlyPiersAndPipesStandProudOfTheWall) {
  BuildingPlan plan = House(GetParam());
  plan.awnings = plan.canopies = plan.shops = plan.fire_escapes = false;
  plan.edges = {EdgeKind::kStreet, EdgeKind::kParty, EdgeKind::kParty, EdgeKind::kParty};
  plan.party_height = {0, 1e3f, 1e3f, 1e3f};
  const Box3f box = Build(plan, FacadeDetail::kFull, {0, 1, 0}).mesh.Bounds();
  EXPECT_GE(box.min.y,
            GetParam() == FacadeStyle::kBracedGlass ? -0.36f : -0.15f);  // half a brace, a downpipe
  EXPECT_GE(box.min.x, -0.39f);
  EXPECT_LE(box.max.x, 21.39f);
}

// Openings lie within their bays whatever its width.
TEST_P(EveryStyle, OpeningsLieWithinTheirBays) {
  const StyleMetrics& metrics = MetricsOf(GetParam());
  for (float width : {0.75f, 1.0f, 1.45f}) {
    const Bay bay{3, 3 + metrics.bay * width, 8, 8 + metrics.floor_height, 1, 4};
    const Opening o = OpeningOf(GetParam(), bay);
    EXPECT_GE(o.x0, bay.x0);
    EXPECT_LE(o.x1, bay.x1);
    EXPECT_GE(o.z0, bay.z0);
    EXPECT_LE(o.z1, bay.z1);
    EXPECT_GT(o.x1 - o.x0, 0.5f);
    EXPECT_GT(o.z1 - o.z0, 1.0f);
    EXPECT_GT(o.depth, 0.05f);
  }
}

// The red curtains that flights look for hang in every bay of their storey and nowhere else.
TEST_P(EveryStyle, RedCurtainsHangInTheirStoreyAlone) {
  BuildingPlan plan = House(GetParam());
  plan.curtain_floor = 2;
  const StyleMetrics& metrics = MetricsOf(GetParam());
  const float z0 = metrics.ground_height + 2 * metrics.floor_height;
  const Mesh mesh = Build(plan, FacadeDetail::kFull).mesh, bare = Build(House(GetParam()), FacadeDetail::kFull).mesh;
  const std::set<MaterialId> red{TestMaterial(Surface::kGlassRedCurtain), TestMaterial(Surface::kAwningRed)};
  const auto storey = [&](const Mesh& m) { return AreaOf(m, red, z0 - 0.01f, z0 + metrics.floor_height + 0.01f); };
  EXPECT_GT(storey(mesh), storey(bare) + 5);
  EXPECT_NEAR(AreaOf(mesh, red, metrics.ground_height) - storey(mesh), AreaOf(bare, red, metrics.ground_height) - storey(bare), 1e-3);
}

enum class PenFace { kFront, kLeft, kRight, kUp, kDown };

class EveryFaceOfThePen : public testing::TestWithParam<std::tuple<PenFace, int>> {};

INSTANTIATE_TEST_SUITE_P(FacadePen, EveryFaceOfThePen,
                         testing::Combine(testing::Values(PenFace::kFront, PenFace::kLeft, PenFace::kRight, PenFace::kUp, PenFace::kDown),
                                          testing::Range(0, 8)));

// Seen from outside, x runs to the right along any wall; every rectangle looks the way its name says.
TEST_P(EveryFaceOfThePen, LooksTheWayItsNameSaysOnAnyWall) {
  const float angle = 0.785398f * static_cast<float>(std::get<1>(GetParam()));
  const Vec3f along{std::cos(angle), std::sin(angle), 0}, out{along.y, -along.x, 0};
  SceneBuilder builder("pen");
  const Surfaces surfaces = AddTestSurfaces(builder);
  MeshBuilder mesh;
  FacadePen pen(mesh, surfaces);
  pen.SetWall({5, 6}, {5 + 10 * along.x, 6 + 10 * along.y});
  EXPECT_NEAR(pen.length(), 10, 1e-5);
  Vec3f n;
  switch (std::get<0>(GetParam())) {
    case PenFace::kFront:
      pen.Front(1, 3, 2, 4, -0.5f), n = out;
      break;
    case PenFace::kLeft:
      pen.Left(1, -0.5f, 1, 2, 4), n = -along;
      break;
    case PenFace::kRight:
      pen.Right(1, -0.5f, 1, 2, 4), n = along;
      break;
    case PenFace::kUp:
      pen.Up(1, 3, -0.5f, 1, 2), n = {0, 0, 1};
      break;
    case PenFace::kDown:
      pen.Down(1, 3, -0.5f, 1, 2), n = {0, 0, -1};
      break;
  }
  const Mesh built = mesh.Finish("pen");
  EXPECT_EQ(FaultOf(built), "");
  for (Vec3f normal : built.normals) EXPECT_GT(Dot(normal, n), 0.999f);
  for (Vec3f p : built.positions) {
    const Vec3f v = p - Vec3f{5, 6, 0};
    EXPECT_NEAR(Dot(v, along), 2, 1.01);
    EXPECT_GE(-Dot(v, out), -0.501f);
    EXPECT_LE(-Dot(v, out), 1.001f);
  }
}

}  // namespace
}  // namespace airsim360
