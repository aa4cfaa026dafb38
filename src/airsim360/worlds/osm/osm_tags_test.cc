// Every tag that the reader of maps knows, on small maps written here: what it becomes, where, and how large.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

#include "airsim360/math/angles.h"
#include "airsim360/worlds/kit/test_mesh.h"
#include "airsim360/worlds/osm/buildings/osm_areas.h"
#include "airsim360/worlds/osm/osm_dresser.h"
#include "airsim360/worlds/osm/osm_scene.h"
#include "airsim360/worlds/osm/test_map.h"

namespace airsim360::internal {
namespace {

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

}  // namespace
}  // namespace airsim360::internal
