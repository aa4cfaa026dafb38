// Buildings and their roofs by their tags, without a scene: how high, of which shape, facing where.
#include <gtest/gtest.h>

#include <cmath>
#include <tuple>

#include "airsim360/math/angles.h"
#include "airsim360/worlds/kit/mesh_builder.h"
#include "airsim360/worlds/kit/test_mesh.h"
#include "airsim360/worlds/osm/buildings/osm_areas.h"
#include "airsim360/worlds/osm/buildings/osm_building_plans.h"
#include "airsim360/worlds/osm/osm_scene.h"
#include "airsim360/worlds/osm/test_map.h"

namespace airsim360::internal {
namespace {

// Buildings: what stands there from the tags alone, no scene needed.
struct BuildingTag {
  const char* kind;
  double low, high;  // metres without a tag for the height
  bool canopy;
};
void PrintTo(const BuildingTag& tag, std::ostream* out) { *out << tag.kind; }

constexpr BuildingTag kBuildings[] = {{"garage", 2.8, 2.8, false},
                                      {"garages", 2.8, 2.8, false},
                                      {"shed", 2.6, 2.6, false},
                                      {"hut", 2.8, 2.8, false},
                                      {"roof", 4.05, 4.95, true},
                                      {"carport", 2.7, 2.7, true},
                                      {"kiosk", 3.2, 3.2, false},
                                      {"bungalow", 4.05, 4.95, false},
                                      {"house", 6.75, 8.25, false},
                                      {"detached", 6.75, 8.25, false},
                                      {"terrace", 7.6, 9.4, false},
                                      {"residential", 9, 11, false},
                                      {"apartments", 14.4, 17.6, false},
                                      {"church", 14.4, 17.6, false},
                                      {"cathedral", 25.2, 30.8, false},
                                      {"chapel", 8.1, 9.9, false},
                                      {"school", 9, 11, false},
                                      {"industrial", 7.2, 8.8, false},
                                      {"warehouse", 8.1, 9.9, false},
                                      {"retail", 5.4, 6.6, false},
                                      {"supermarket", 5.8, 7.2, false},
                                      {"office", 16.2, 19.8, false},
                                      {"commercial", 12.6, 15.4, false},
                                      {"hotel", 18, 22, false},
                                      {"greenhouse", 3, 3, false},
                                      {"barn", 6.3, 7.7, false},
                                      {"stable", 3.6, 4.4, false},
                                      {"toilets", 3, 3, false},
                                      {"train_station", 9.9, 12.1, false},
                                      {"yes", 6.3, 10.5, false}};

struct Plans {
  OsmData data;
  std::vector<OsmArea> areas;
  std::vector<OsmBuilding> buildings;
  explicit Plans(const TestMap& map)
      : data(ReadOsm("test.osm", AsBytes(map.Text()))), areas(FindAreas(data)), buildings(PlanOsmBuildings(data, areas)) {}
};

class EveryBuildingTag : public testing::TestWithParam<BuildingTag> {};

INSTANTIATE_TEST_SUITE_P(OsmTags, EveryBuildingTag, testing::ValuesIn(kBuildings), [](const auto& info) { return info.param.kind; });

TEST_P(EveryBuildingTag, IsAsHighAsItsUseSuggestsUnlessTheMapKnowsBetter) {
  TestMap map(100, 100);
  const char* kind = GetParam().kind;
  map.Box({0, 0}, {20, 12}, {{"building", kind}});
  map.Box({30, 0}, {50, 12}, {{"building", kind}, {"height", "13.7"}});
  map.Box({0, 30}, {20, 42}, {{"building", kind}, {"building:levels", "5"}});
  map.Box({30, 30}, {50, 42}, {{"building", kind}, {"height", "20"}, {"min_height", "8"}});
  map.Box({60, 30}, {80, 42}, {{"building", kind}, {"height", "66 ft"}, {"building:levels", "2"}});
  const Plans plans(map);
  ASSERT_EQ(plans.buildings.size(), 5u);
  EXPECT_GE(plans.buildings[0].height, GetParam().low - 1e-6);
  EXPECT_LE(plans.buildings[0].height, GetParam().high + 1e-6);
  EXPECT_EQ(plans.buildings[0].source, HeightSource::kGuess);
  EXPECT_DOUBLE_EQ(plans.buildings[1].height, 13.7);
  EXPECT_EQ(plans.buildings[1].source, HeightSource::kTag);
  EXPECT_DOUBLE_EQ(plans.buildings[2].height, 16);
  EXPECT_EQ(plans.buildings[2].source, HeightSource::kLevels);
  EXPECT_DOUBLE_EQ(plans.buildings[3].volumes.at(0).bottom, 8);
  EXPECT_NEAR(plans.buildings[4].height, 66 * 0.3048, 1e-9);
  for (const OsmBuilding& building : plans.buildings) {
    EXPECT_NEAR(Area(building.outline), 240, 0.5);  // coordinates are written to the centimetre
    ASSERT_EQ(building.volumes.size(), 1u);
    EXPECT_EQ(building.volumes[0].canopy, GetParam().canopy);
  }
}

struct RoofShape {
  const char* value;
  OsmRoof roof;
};
void PrintTo(const RoofShape& shape, std::ostream* out) { *out << shape.value; }

constexpr RoofShape kRoofShapes[] = {{"flat", OsmRoof::kFlat},
                                     {"gabled", OsmRoof::kGabled},
                                     {"hipped", OsmRoof::kHipped},
                                     {"half-hipped", OsmRoof::kHalfHipped},
                                     {"half_hipped", OsmRoof::kHalfHipped},
                                     {"gambrel", OsmRoof::kGambrel},
                                     {"mansard", OsmRoof::kMansard},
                                     {"pyramidal", OsmRoof::kPyramidal},
                                     {"pyramid", OsmRoof::kPyramidal},
                                     {"cone", OsmRoof::kCone},
                                     {"conical", OsmRoof::kCone},
                                     {"dome", OsmRoof::kDome},
                                     {"onion", OsmRoof::kOnion},
                                     {"round", OsmRoof::kRound},
                                     {"skillion", OsmRoof::kSkillion},
                                     {"lean_to", OsmRoof::kSkillion},
                                     {"saltbox", OsmRoof::kSaltbox},
                                     {"sawtooth", OsmRoof::kSawtooth},
                                     {"spherical", OsmRoof::kDome},
                                     {"double_saltbox", OsmRoof::kSaltbox},
                                     {"quadruple_saltbox", OsmRoof::kMansard},
                                     {"crosspitched", OsmRoof::kHipped},
                                     {"many", OsmRoof::kFlat}};

struct Plot {
  const char* name;
  std::vector<Vec2d> ring;
};
void PrintTo(const Plot& plot, std::ostream* out) { *out << plot.name; }

std::vector<Vec2d> Round(int corners, double radius) {
  std::vector<Vec2d> ring;
  for (int i = 0; i < corners; ++i) ring.push_back({radius * std::cos(2 * kPi * i / corners), radius * std::sin(2 * kPi * i / corners)});
  return ring;
}
const Plot kPlots[] = {{"oblong", {{0, 0}, {18, 0}, {18, 10}, {0, 10}}},
                       {"square", {{0, 0}, {12, 0}, {12, 12}, {0, 12}}},
                       {"turned", {{0, 0}, {12, 9}, {6, 17}, {-6, 8}}},
                       {"l_shaped", {{0, 0}, {20, 0}, {20, 8}, {8, 8}, {8, 16}, {0, 16}}},
                       {"round", Round(16, 7)},
                       {"trapezium", {{0, 0}, {16, 0}, {12, 9}, {3, 9}}}};

class EveryRoofShape : public testing::TestWithParam<std::tuple<RoofShape, Plot>> {};

INSTANTIATE_TEST_SUITE_P(OsmTags, EveryRoofShape, testing::Combine(testing::ValuesIn(kRoofShapes), testing::ValuesIn(kPlots)),
                         [](const auto& info) {
                           return TestName(std::string(std::get<0>(info.param).value) + "_" + std::get<1>(info.param).name);
                         });

// Rain falls on the roof wherever the outline is, and nowhere beside it; it lies between eaves and the tagged
// height and reaches it.
TEST_P(EveryRoofShape, CoversItsOutlineBetweenEavesAndTop) {
  const auto& [shape, plot] = GetParam();
  TestMap map(100, 100);
  map.Ring(plot.ring, {{"building", "yes"}, {"height", "11"}, {"roof:height", "4"}, {"roof:shape", shape.value}});
  const Plans plans(map);
  ASSERT_EQ(plans.buildings.size(), 1u);
  ASSERT_EQ(plans.buildings[0].volumes.size(), 1u);
  const OsmVolume& volume = plans.buildings[0].volumes[0];
  EXPECT_EQ(volume.roof, shape.roof);
  EXPECT_DOUBLE_EQ(volume.top, 11);
  EXPECT_DOUBLE_EQ(volume.roof_height, shape.roof == OsmRoof::kFlat ? 0 : 4);
  MeshBuilder builder;
  BuildOsmRoof(builder, volume, 100, 1, 2, 3, 4);
  const Mesh mesh = builder.Finish("roof");
  EXPECT_EQ(FaultOf(mesh, false), "");
  const double eaves = 111 - volume.roof_height;
  for (Vec3f p : mesh.positions) {
    EXPECT_GE(static_cast<double>(p.z),
              eaves - (shape.roof == OsmRoof::kFlat ? 0.96 : 0.01));  // a deck below its rim
    EXPECT_LE(static_cast<double>(p.z), 111.001);
  }
  EXPECT_NEAR(static_cast<double>(mesh.Bounds().max.z), 111, 0.01);
  const TestRays rays(mesh, 0);
  const Patch& outline = volume.footprint[0];
  for (double x = -9.03; x < 21; x += 0.77)
    for (double y = -9.01; y < 19; y += 0.73) {
      const double edge = DistanceToRing(outline.outer, {x, y});
      if (edge < 0.15) continue;
      const auto hit = rays.First({static_cast<float>(x), static_cast<float>(y), 130}, {0, 0, -1}, 60);
      if (!Inside(outline, {x, y})) {
        // Onions bulge over their walls.
        EXPECT_FALSE(hit && !(shape.roof == OsmRoof::kOnion && edge < 2)) << x << ", " << y;
      } else {
        ASSERT_TRUE(hit) << "hole at " << x << ", " << y;
        EXPECT_GT(hit->n.z, 0) << x << ", " << y;
      }
    }
}

Mesh RoofOf(TestMap::Tags tags) {
  TestMap map(100, 100);
  map.Box({0, 0}, {18, 10}, tags);
  const Plans plans(map);
  MeshBuilder builder;
  BuildOsmRoof(builder, plans.buildings.at(0).volumes.at(0), 0, 1, 2, 3, 4);
  return builder.Finish("roof");
}

class EveryCompassDirection : public testing::TestWithParam<int> {};

INSTANTIATE_TEST_SUITE_P(OsmTags, EveryCompassDirection, testing::Range(0, 360, 30));

TEST_P(EveryCompassDirection, IsWhereASlopeWithItFaces) {
  const std::string degrees = std::to_string(GetParam());
  const Mesh mesh =
      RoofOf({{"building", "yes"}, {"height", "9"}, {"roof:height", "3"}, {"roof:shape", "skillion"}, {"roof:direction", degrees}});
  const double a = GetParam() * kPi / 180;
  int slopes = 0;
  ForTriangles(mesh, [&](const MeshPart& part, Vec3f p, Vec3f q, Vec3f r) {
    const Vec3f n = Normalized(Cross(q - p, r - p));
    if (part.entity != 2) return;
    EXPECT_NEAR(static_cast<double>(n.x) / std::hypot(n.x, n.y), std::sin(a), 0.01);
    EXPECT_NEAR(static_cast<double>(n.y) / std::hypot(n.x, n.y), std::cos(a), 0.01);
    ++slopes;
  });
  EXPECT_GE(slopes, 2);
  EXPECT_NEAR(mesh.Bounds().max.z, 9, 0.01);
  EXPECT_NEAR(mesh.Bounds().min.z, 6, 0.01);
}

TEST(OsmRoofTags, RidgesRunAlongTheHouseUnlessTheMapSaysAcross) {
  for (bool across : {false, true}) {
    Box3f ridge;
    const Mesh mesh = RoofOf({{"building", "yes"},
                              {"height", "9"},
                              {"roof:height", "3"},
                              {"roof:shape", "gabled"},
                              {"roof:orientation", across ? "across" : "along"}});
    for (Vec3f p : mesh.positions)
      if (p.z > 8.99f) ridge.Add(p);
    EXPECT_NEAR(ridge.size().x, across ? 0 : 18, 0.05);
    EXPECT_NEAR(ridge.size().y, across ? 10 : 0, 0.05);
    EXPECT_NEAR(ridge.center().x, 9, 0.05);
    EXPECT_NEAR(ridge.center().y, 5, 0.05);
  }
}

TEST(OsmRoofTags, HeightsAreTakenFromAngleAndLevelsToo) {
  TestMap map(100, 100);
  map.Box({0, 0}, {18, 10}, {{"building", "yes"}, {"height", "12"}, {"roof:shape", "gabled"}, {"roof:angle", "45"}});
  map.Box({30, 0}, {48, 10}, {{"building", "yes"}, {"height", "12"}, {"roof:shape", "skillion"}, {"roof:angle", "10"}});
  map.Box({0, 30}, {18, 40}, {{"building", "yes"}, {"height", "12"}, {"roof:shape", "hipped"}, {"roof:levels", "2"}});
  map.Box({30, 30}, {48, 40}, {{"building", "yes"}, {"height", "4"}, {"roof:shape", "dome"}, {"roof:height", "30"}});
  const Plans plans(map);
  const double expected[] = {5, 10 * std::tan(kPi / 18), 5.6, 4};  // the last: no more than there is
  for (size_t i = 0; i < 4; ++i) EXPECT_NEAR(plans.buildings.at(i).volumes.at(0).roof_height, expected[i], 0.02) << i;
}

}  // namespace
}  // namespace airsim360::internal
