// Every tag that the reader of maps knows, on small maps written here: what it becomes, where, and how large.
#include <gtest/gtest.h>

#include <cctype>
#include <cmath>
#include <map>
#include <set>

#include "airsim360/math/angles.h"
#include "airsim360/worlds/kit/test_mesh.h"
#include "airsim360/worlds/osm/osm_areas.h"
#include "airsim360/worlds/osm/osm_buildings.h"
#include "airsim360/worlds/osm/osm_dresser.h"
#include "airsim360/worlds/osm/osm_scene.h"
#include "airsim360/worlds/osm/test_map.h"

namespace airsim360::internal {
namespace {

// "natural=water" as the name of a test.
std::string TestName(const std::string& text) {
  std::string name;
  for (char c : text) name += std::isalnum(static_cast<unsigned char>(c)) ? std::string(1, c) : c == '-' ? "_dash_" : "_";
  return name;
}

// A map that has one row of a table in each cell of a grid, far enough apart, built once.
constexpr double kPitch = 40;
Vec2d CellOf(size_t i) { return {kPitch * (static_cast<double>(i % 8) - 3.5), kPitch * (static_cast<double>(i / 8) - 3)}; }

struct Named {
  std::shared_ptr<const Scene> scene;
  std::map<std::string, const Entity*> entities;
  explicit Named(std::shared_ptr<const Scene> built) : scene(std::move(built)) {
    for (const Entity& entity : scene->entities) entities[entity.name] = &entity;
  }
  const Entity* Find(const std::string& name) const {
    const auto it = entities.find(name);
    return it == entities.end() ? nullptr : it->second;
  }
  std::string Path(const std::string& name) const {
    const Entity* entity = Find(name);
    return entity ? scene->tree[entity->category].path : "nothing";
  }
  // An entity's part of the merged ground: its square metres from above, and its box.
  struct Laid {
    double area = 0;
    Box3f box;
  };
  Laid Ground(EntityId entity) const {
    Laid laid;
    for (const Mesh& mesh : scene->meshes) {
      if (mesh.name != "ground") continue;
      ForTriangles(mesh, [&](const MeshPart& part, Vec3f a, Vec3f b, Vec3f c) {
        if (part.entity != entity) return;
        laid.area += static_cast<double>(std::max(0.0f, Cross(b - a, c - a).z)) / 2;
        for (Vec3f p : {a, b, c}) laid.box.Add(p);
      });
    }
    return laid;
  }
};

struct AreaTag {
  const char *key, *value, *category;
};

constexpr AreaTag kAreaTags[] = {
    {"natural", "water", "water/lake"},
    {"waterway", "riverbank", "water/river"},
    {"waterway", "dock", "water/lake"},
    {"landuse", "reservoir", "water/lake"},
    {"landuse", "basin", "water/lake"},
    {"natural", "bay", "water/sea"},
    {"natural", "strait", "water/sea"},
    {"leisure", "swimming_pool", "water/pool"},
    {"amenity", "fountain", "water/pool"},
    {"leisure", "playground", "ground/sand"},
    {"leisure", "pitch", "ground/grass"},
    {"leisure", "garden", "ground/grass"},
    {"landuse", "grass", "ground/grass"},
    {"landuse", "village_green", "ground/grass"},
    {"landuse", "flowerbed", "ground/dirt"},
    {"natural", "grassland", "ground/grass"},
    {"natural", "scrub", "ground/terrain/landscape"},
    {"natural", "wood", "ground/terrain/landscape"},
    {"natural", "sand", "ground/sand"},
    {"natural", "beach", "ground/sand"},
    {"natural", "heath", "ground/terrain/landscape"},
    {"amenity", "parking", "ground/parking"},
    {"highway", "pedestrian", "ground/pavement/modular"},
    {"highway", "footway", "ground/pavement/modular"},
    {"highway", "rest_area", "ground/parking"},
    {"area:highway", "footway", "ground/sidewalk"},
    {"place", "square", "ground/pavement/modular"},
    {"man_made", "pier", "ground/pavement/modular"},
    {"man_made", "breakwater", "ground/gravel"},
    {"man_made", "groyne", "ground/gravel"},
    {"landuse", "meadow", "ground/grass"},
    {"landuse", "recreation_ground", "ground/grass"},
    {"landuse", "cemetery", "ground/grass"},
    {"landuse", "forest", "ground/terrain/landscape"},
    {"landuse", "orchard", "ground/terrain/landscape"},
    {"landuse", "farmland", "ground/dirt"},
    {"landuse", "allotments", "ground/terrain/landscape"},
    {"landuse", "construction", "ground/dirt"},
    {"landuse", "brownfield", "ground/dirt"},
    {"landuse", "greenfield", "ground/terrain/landscape"},
    {"landuse", "railway", "ground/gravel"},
    {"leisure", "common", "ground/terrain/landscape"},
    {"leisure", "park", "ground/terrain/landscape"},
    {"leisure", "dog_park", "ground/terrain/landscape"},
    {"leisure", "golf_course", "ground/grass"},
    {"leisure", "nature_reserve", "ground/terrain/landscape"},
    {"tourism", "zoo", "ground/terrain/landscape"},
};

class EveryAreaTag : public testing::TestWithParam<size_t> {
 protected:
  // An L of 24 x 18 m less 12 x 9 m in every cell; a park of half of it again over some.
  static const Named& World() {
    static const Named world = [] {
      TestMap map(180, 160);
      for (size_t i = 0; i < std::size(kAreaTags); ++i) {
        const Vec2d o = CellOf(i);
        map.Ring({o, o + Vec2d{24, 0}, o + Vec2d{24, 9}, o + Vec2d{12, 9}, o + Vec2d{12, 18}, o + Vec2d{0, 18}},
                 {{kAreaTags[i].key, kAreaTags[i].value}, {"area", "yes"}});
      }
      return Named(map.Build());
    }();
    return world;
  }
  const AreaTag& tag() const { return kAreaTags[GetParam()]; }
  std::string id() const { return "way/" + std::to_string(GetParam() + 1); }
};

INSTANTIATE_TEST_SUITE_P(OsmTags, EveryAreaTag, testing::Range<size_t>(0, std::size(kAreaTags)), [](const auto& info) {
  return TestName(std::string(kAreaTags[info.param].key) + "_" + kAreaTags[info.param].value);
});

TEST_P(EveryAreaTag, BecomesItsGroundWithItsAreaInItsPlace) {
  const Entity* entity = World().Find(id());
  ASSERT_NE(entity, nullptr);
  EXPECT_EQ(World().Path(id()), tag().category);
  EXPECT_FALSE(World().scene->tree[entity->category].thing);
  const auto [area, box] = World().Ground(entity->id);  // without the blades that grow over its edges
  EXPECT_NEAR(area, 24 * 18 - 12 * 9, 1.5);
  const Vec2d o = CellOf(GetParam());
  EXPECT_NEAR(static_cast<double>(box.min.x), o.x, 0.02);
  EXPECT_NEAR(static_cast<double>(box.min.y), o.y, 0.02);
  EXPECT_NEAR(static_cast<double>(box.max.x), o.x + 24, 0.02);
  EXPECT_NEAR(static_cast<double>(box.max.y), o.y + 18, 0.02);
  // Water lies lower than the ground, between banks.
  const bool water = std::string_view(tag().category).starts_with("water");
  EXPECT_NEAR(static_cast<double>(box.max.z), water ? -0.28 : 0, 0.01);
  EXPECT_EQ(World().Find(id() + "/bank") != nullptr, water);
}

struct NodeTag {
  const char *key, *value, *category;
};

constexpr NodeTag kNodeTags[] = {
    {"natural", "tree", "vegetation/tree"},
    {"highway", "street_lamp", "furniture/lighting"},
    {"amenity", "bench", "furniture/seating/bench"},
    {"amenity", "waste_basket", "*"},
    {"amenity", "waste_disposal", "*"},
    {"amenity", "recycling", "*"},
    {"amenity", "grit_bin", "*"},
    {"emergency", "fire_hydrant", "*"},
    {"amenity", "fire_hydrant", "*"},
    {"amenity", "post_box", "*"},
    {"highway", "bus_stop", "*"},
    {"highway", "stop", "*"},
    {"highway", "give_way", "*"},
    {"traffic_sign", "city_limit", "*"},
    {"highway", "speed_camera", "*"},
    {"man_made", "street_cabinet", "*"},
    {"amenity", "fountain", "*"},
    {"advertising", "column", "*"},
    {"tourism", "information", "*"},
    {"barrier", "bollard", "*"},
    {"barrier", "block", "*"},
    {"leisure", "picnic_table", "*"},
    {"natural", "stone", "*"},
    {"natural", "rock", "*"},
    {"playground", "swing", "*"},
    {"man_made", "manhole", "*"},
    {"man_made", "water_tower", "*"},
    {"man_made", "antenna", "*"},
    {"highway", "traffic_signals", "*"},
    {"amenity", "bicycle_parking", "vehicle/bicycle"},
    {"man_made", "flagpole", "construction/mast"},
    {"man_made", "surveillance", "furniture/utility/camera"},
    {"amenity", "vending_machine", "furniture/vending/machine"},
    {"historic", "memorial", "construction/statue"},
    {"historic", "monument", "construction/statue"},
    {"tourism", "artwork", "construction/statue"},
};

// The category of the prop that the table of the reader names; that of the row here for what it draws itself.
std::string ExpectedPath(const NodeTag& tag) {
  if (tag.category != std::string_view("*")) return tag.category;
  for (const NodeKind& row : NodeKinds())
    if (row.key == tag.key && (row.value == tag.value || row.value == "*")) return std::string(FindPropKind(row.kind).category);
  return tag.value == std::string_view("traffic_signals") ? std::string(FindPropKind("traffic_light").category) : "?";
}

class EveryNodeTag : public testing::TestWithParam<size_t> {
 protected:
  static const Named& World() {
    static const Named world = [] {
      TestMap map(180, 160);
      for (size_t i = 0; i < std::size(kNodeTags); ++i) map.Node(CellOf(i), {{kNodeTags[i].key, kNodeTags[i].value}});
      return Named(map.Build());
    }();
    return world;
  }
};

INSTANTIATE_TEST_SUITE_P(OsmTags, EveryNodeTag, testing::Range<size_t>(0, std::size(kNodeTags)), [](const auto& info) {
  return TestName(std::string(kNodeTags[info.param].key) + "_" + kNodeTags[info.param].value);
});

// Without a street near by, things stand where the map has them.
TEST_P(EveryNodeTag, BecomesItsThingInItsPlaceOnTheGround) {
  const NodeTag& tag = kNodeTags[GetParam()];
  const std::string name = "node/" + std::to_string(GetParam() + 1);
  const Entity* entity = World().Find(name);
  ASSERT_NE(entity, nullptr);
  EXPECT_TRUE(World().Path(name).starts_with(ExpectedPath(tag))) << World().Path(name);
  const Vec2d p = CellOf(GetParam());
  const Box3f& box = entity->bounds;
  EXPECT_TRUE(std::isfinite(box.min.x + box.max.x + box.min.y + box.max.y + box.min.z + box.max.z));
  EXPECT_TRUE(box.Contains({static_cast<float>(p.x), static_cast<float>(p.y), box.center().z}));
  EXPECT_LT(std::hypot(static_cast<double>(box.center().x) - p.x, static_cast<double>(box.center().y) - p.y), 3.5);
  EXPECT_GE(box.min.z, -0.4f);
  EXPECT_LE(box.min.z, 0.05f);
  EXPECT_LE(box.max.z, 25);
}

TEST(OsmTagTables, HoldEveryKindOfNodeThatTheReaderKnows) {
  for (const NodeKind& row : NodeKinds()) {
    if (row.kind.empty()) continue;
    const bool tested = std::any_of(std::begin(kNodeTags), std::end(kNodeTags),
                                    [&](const NodeTag& tag) { return row.key == tag.key && (row.value == tag.value || row.value == "*"); });
    EXPECT_TRUE(tested) << row.key << "=" << row.value;
    EXPECT_NO_THROW(FindPropKind(row.kind)) << row.kind;
  }
}

struct RoadTag {
  const char* highway;
  int rank;      // -1: for feet
  double width;  // without tags
  const char* category;
};

constexpr RoadTag kRoadTags[] = {
    {"motorway", 0, 4 * 3.6, "ground/road"},
    {"trunk", 1, 4 * 3.5, "ground/road"},
    {"primary", 1, 4 * 3.3, "ground/road"},
    {"secondary", 2, 3 * 3.3 + 2.2, "ground/road"},
    {"tertiary", 3, 2 * 3.2 + 4.2, "ground/road"},
    {"unclassified", 4, 9, "ground/road"},
    {"residential", 4, 9, "ground/road"},
    {"living_street", 5, 6, "ground/road"},
    {"busway", 4, 6.8, "ground/road"},
    {"road", 4, 6.2, "ground/road"},
    {"service", 6, 3, "ground/road"},
    {"motorway_link", 0, 3.8, "ground/road"},
    {"trunk_link", 1, 3.8, "ground/road"},
    {"primary_link", 1, 3.8, "ground/road"},
    {"secondary_link", 2, 3.8, "ground/road"},
    {"tertiary_link", 3, 3.6, "ground/road"},
    {"steps", -1, 2.4, "construction/stairs"},
    {"pedestrian", -1, 6, "ground/pavement/modular"},
    {"cycleway", -1, 2.2, "ground/bike_lane"},
    {"footway", -1, 2.4, "ground/path/park_walkway"},
    {"path", -1, 1.8, "ground/path/park_walkway"},
    {"track", -1, 2.6, "ground/dirt"},
    {"bridleway", -1, 2, "ground/path/park_walkway"},
    {"corridor", -1, 2, "ground/sidewalk"},
};

class EveryRoadTag : public testing::TestWithParam<size_t> {
 protected:
  static constexpr double kApart = 45;
  // Parallel ways of 300 m, each twice: as its class says, and with a width of its own.
  static const Named& World() {
    static const Named world = [] {
      TestMap map(220, kApart * std::size(kRoadTags) + 40);
      for (size_t i = 0; i < std::size(kRoadTags); ++i)
        for (int tagged = 0; tagged < 2; ++tagged) {
          const double y = YOf(i, tagged);
          if (tagged)
            map.Line({{-150, y}, {150, y}}, {{"highway", kRoadTags[i].highway}, {"width", "9.5"}});
          else
            map.Line({{-150, y}, {150, y}}, {{"highway", kRoadTags[i].highway}});
        }
      return Named(map.Build());
    }();
    return world;
  }
  static double YOf(size_t i, int tagged) {
    return kApart * (2 * static_cast<double>(i) + tagged - static_cast<double>(std::size(kRoadTags)));
  }
};

INSTANTIATE_TEST_SUITE_P(OsmTags, EveryRoadTag, testing::Range<size_t>(0, std::size(kRoadTags)),
                         [](const auto& info) { return kRoadTags[info.param].highway; });

TEST_P(EveryRoadTag, BecomesABandOfItsWidthAlongItsLine) {
  const RoadTag& tag = kRoadTags[GetParam()];
  EXPECT_EQ(RoadRank(tag.highway), tag.rank);
  for (int tagged = 0; tagged < 2; ++tagged) {
    const std::string name = "way/" + std::to_string(2 * GetParam() + 1 + static_cast<size_t>(tagged));
    const Entity* entity = World().Find(name);
    ASSERT_NE(entity, nullptr) << name;
    EXPECT_EQ(World().Path(name), tag.category);
    const double width = tagged ? 9.5 : tag.width, y = YOf(GetParam(), tagged);
    EXPECT_NEAR(World().Ground(entity->id).area, 300 * width, 0.02 * 300 * width);
    EXPECT_NEAR(static_cast<double>(entity->bounds.min.y), y - width / 2, 0.02 * width);
    EXPECT_NEAR(static_cast<double>(entity->bounds.max.y), y + width / 2, 0.02 * width);
    EXPECT_NEAR(static_cast<double>(entity->bounds.max.z), tag.rank < 0 ? 0 : -0.13, 0.02);
    // Pavements on both sides of streets, none along motorways and drives.
    const bool pavement = tag.rank > 0 && tag.rank < 6;
    for (const char* side : {"/pavement_left", "/pavement_right"})
      EXPECT_EQ(World().Path(name + side), pavement ? "ground/sidewalk" : "nothing");
  }
}

struct BarrierTag {
  const char *kind, *category;
  double low, high;  // of its top
};

constexpr BarrierTag kBarriers[] = {{"wall", "barrier/wall", 1.19, 1.21},
                                    {"retaining_wall", "barrier/wall", 1.19, 1.21},
                                    {"city_wall", "barrier/wall", 5.99, 6.01},
                                    {"hedge", "*hedge", 0.6, 2.2},
                                    {"fence", "*rail", 0.7, 1.4},
                                    {"handrail", "*rail", 0.7, 1.4},
                                    {"guard_rail", "*rail", 0.7, 1.4},
                                    {"chain", "*rail", 0.7, 1.4},
                                    {"railing", "*rail", 0.7, 1.4},
                                    {"kerb", "nothing", 0, 0},
                                    {"gate", "nothing", 0, 0}};

class EveryBarrierTag : public testing::TestWithParam<size_t> {
 protected:
  static const Named& World() {
    static const Named world = [] {
      TestMap map(180, 160);
      for (size_t i = 0; i < std::size(kBarriers); ++i) {
        const Vec2d o = CellOf(i);
        map.Line({o, o + Vec2d{20, 0}, o + Vec2d{20, 12}}, {{"barrier", kBarriers[i].kind}});
      }
      return Named(map.Build());
    }();
    return world;
  }
};

INSTANTIATE_TEST_SUITE_P(OsmTags, EveryBarrierTag, testing::Range<size_t>(0, std::size(kBarriers)),
                         [](const auto& info) { return kBarriers[info.param].kind; });

TEST_P(EveryBarrierTag, StandsAlongItsLine) {
  const BarrierTag& tag = kBarriers[GetParam()];
  const std::string name = "way/" + std::to_string(GetParam() + 1), category = tag.category;
  const std::string path = category[0] == '*' ? std::string(FindPropKind(category.substr(1)).category) : category;
  EXPECT_EQ(World().Path(name), path);
  const Entity* entity = World().Find(name);
  if (path == "nothing") return;
  ASSERT_NE(entity, nullptr);
  const Vec2d o = CellOf(GetParam());
  const Box3f& box = entity->bounds;
  EXPECT_NEAR(static_cast<double>(box.min.x), o.x, 1);
  EXPECT_NEAR(static_cast<double>(box.max.x), o.x + 20, 1);
  EXPECT_NEAR(static_cast<double>(box.min.y), o.y, 1);
  EXPECT_NEAR(static_cast<double>(box.max.y), o.y + 12, 1);
  EXPECT_GE(static_cast<double>(box.max.z), tag.low);
  EXPECT_LE(static_cast<double>(box.max.z), tag.high);
}

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
