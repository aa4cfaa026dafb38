// New York as of the 1950s: what the time forbids is absent, what it asks for is there, the streets are those of today.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <tuple>

#include "airsim360/base/parallel.h"
#include "airsim360/scene/road_network.h"
#include "airsim360/scene/scene_archive.h"
#include "airsim360/worlds/built_in.h"
#include "airsim360/worlds/new_york_city/period.h"
#include "airsim360/worlds/osm/test_real_towns.h"
#include "airsim360/worlds/props/placer.h"
#include "airsim360/worlds/props/signs_1950s.h"
#include "airsim360/worlds/survey/world_floor.h"
#include "airsim360/worlds/texture/shop_signs.h"

namespace airsim360 {
namespace {

using internal::Period;
using internal::PeriodOf;

// Procedural props only, seed 0; each built once for all tests.
class NewYork1950s : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    WorldOptions options;
    options.city.style = CityStyle::k1950s;
    old_ = internal::BuildNewYorkCity(options, &placements_);
    present_ = internal::BuildNewYorkCity({});
  }
  static void TearDownTestSuite() {
    old_.reset();
    present_.reset();
  }

  static std::map<std::string, std::vector<const Entity*>> ByCategory(const Scene& scene) {
    std::map<std::string, std::vector<const Entity*>> groups;
    for (const Entity& entity : scene.entities) groups[scene.tree[entity.category].path].push_back(&entity);
    return groups;
  }
  static int Placed(std::string_view kind) {
    return static_cast<int>(std::ranges::count_if(placements_, [&](const Placement& p) { return p.kind == kind; }));
  }

  static inline std::shared_ptr<const Scene> old_, present_;
  static inline std::vector<Placement> placements_;
};

// Names of the materials that some triangle shows.
std::set<std::string> MaterialsSeen(const Scene& scene) {
  std::set<std::string> names;
  for (const Mesh& mesh : scene.meshes)
    for (const MeshPart& part : mesh.parts) names.insert(scene.materials[part.material].name);
  return names;
}

// How many instances show a mesh of that name.
int Shown(const Scene& scene, std::string_view mesh) {
  return static_cast<int>(
      std::ranges::count_if(scene.instances, [&](const Instance& instance) { return scene.meshes[instance.mesh].name == mesh; }));
}

TEST_F(NewYork1950s, HasNothingThatCameLater) {
  const auto groups = ByCategory(*old_);
  const auto now = ByCategory(*present_);
  for (const char* path : {"construction/rooftop/air_conditioner", "ground/bike_lane"}) {
    EXPECT_FALSE(groups.contains(path)) << path;
    EXPECT_TRUE(now.contains(path)) << path;
  }
  const std::set<std::string> seen = MaterialsSeen(*old_), today = MaterialsSeen(*present_);
  for (const char* material : {"glass blue", "bike lane", "bus lane", "tactile slabs", "road paint yellow"}) {
    EXPECT_FALSE(seen.contains(material)) << material;
    EXPECT_TRUE(today.contains(material)) << material;
  }
  // None of what stands in for something stands there itself.
  for (const auto& [kind, by] : PeriodOf(CityStyle::k1950s).props) {
    EXPECT_EQ(Shown(*old_, kind), 0) << kind;
    EXPECT_GT(Shown(*present_, kind), 0) << kind;
    EXPECT_EQ(Shown(*present_, by), 0) << by;
    // Who parks a vehicle draws among the individuals of what it stands in for: more would never be seen.
    if (FindPropKind(kind).category.starts_with("vehicle/")) {
      EXPECT_LE(FindPropKind(by).variants, FindPropKind(kind).variants) << by;
    }
  }
  for (const char* mesh : {"window air conditioner", "ac_unit"}) {
    EXPECT_EQ(Shown(*old_, mesh), 0) << mesh;
    EXPECT_GT(Shown(*present_, mesh), 50) << mesh;
  }
}

TEST_F(NewYork1950s, HasNoTowersOfGlassNorOfConcrete) {
  const internal::Manhattan city = internal::PlanManhattan(PlanNewYorkCity(), {.style = CityStyle::k1950s});
  const internal::Manhattan today = internal::PlanManhattan(PlanNewYorkCity(), {});
  const auto modern = [](const BuildingPlan& plan) {
    return plan.style == FacadeStyle::kCurtainWall || plan.style == FacadeStyle::kBracedGlass || plan.style == FacadeStyle::kConcreteGrid;
  };
  EXPECT_EQ(std::ranges::count_if(city.buildings, modern), 0);
  EXPECT_GT(std::ranges::count_if(today.buildings, modern), 20);
  // Towers step back: a good part of what is high stands on something broader.
  const auto high = std::ranges::count_if(city.buildings, [](const BuildingPlan& plan) { return plan.height() > 45; });
  const auto stepped = std::ranges::count_if(city.buildings, [](const BuildingPlan& plan) { return plan.height() > 45 && plan.base > 0; });
  EXPECT_GT(high, 20);
  EXPECT_GT(2 * stepped, high);
}

// Terracotta under copper and glazed brick, on towers of the time and on none of today's.
TEST_F(NewYork1950s, HasOrnateTowersThatTodaysCityDoesNotHave) {
  const auto count = [](CityStyle time, FacadeStyle style) {
    const internal::Manhattan city = internal::PlanManhattan(PlanNewYorkCity(), {.style = time});
    return std::ranges::count_if(city.buildings, [&](const BuildingPlan& plan) { return plan.style == style; });
  };
  const std::set<std::string> seen = MaterialsSeen(*old_), today = MaterialsSeen(*present_);
  for (const FacadeStyle style : {FacadeStyle::kTerracotta, FacadeStyle::kGlazedDeco}) {
    EXPECT_GE(count(CityStyle::k1950s, style), 8);
    EXPECT_EQ(count(CityStyle::kPresent, style), 0);
  }
  for (const char* material : {"terracotta", "copper verdigris", "glazed brick cream", "glazed brick black", "glazed spandrel turquoise"}) {
    EXPECT_TRUE(seen.contains(material)) << material;
    EXPECT_FALSE(today.contains(material)) << material;
  }
}

TEST_F(NewYork1950s, HasWhatTheTimeAsksFor) {
  const auto groups = ByCategory(*old_);
  EXPECT_EQ(Shown(*old_, "street_light_1950s"), Shown(*present_, "street_light"));
  EXPECT_GE(Placed("street_light"), 80);
  EXPECT_GE(groups.at("construction/stairs").size(), 4u);
  EXPECT_GE(Placed("fire_alarm_box"), 12);
  EXPECT_GE(Placed("police_box"), 8);
  EXPECT_GE(Placed("parking_meter"), 60);
  EXPECT_GE(Placed("fire_hydrant"), 25);
  EXPECT_GE(groups.at("furniture/mail/post_box").size(), 10u);
  EXPECT_GE(groups.at("construction/rooftop/water_tank").size(), 20u);
  EXPECT_GE(groups.at("construction/rooftop/antenna").size(), 150u);
  EXPECT_GE(Shown(*old_, "fire escape"), 150);
  EXPECT_GT(Shown(*old_, "fire escape"), 2 * Shown(*present_, "fire escape"));
  EXPECT_GE(Shown(*old_, "billboard_1950s") + Shown(*old_, "light_box_1950s") + Shown(*old_, "banner_1950s"), 40);
  EXPECT_GE(Shown(*old_, "car_1950s"), 300);
  EXPECT_GE(Shown(*old_, "taxi_1950s"), 80);
  EXPECT_GE(Shown(*old_, "bus_1950s"), 5);
  EXPECT_GE(Shown(*old_, "traffic_light_1950s"), 60);
  // Entities go by the names that instructions and traffic know.
  const auto named = [&](std::string_view name) {
    return std::ranges::count_if(old_->entities,
                                 [&](const Entity& e) { return e.name == name || e.name.starts_with(std::string(name) + " "); });
  };
  for (const char* name : {"car", "taxi", "bus", "traffic_light", "street_light", "billboard"}) EXPECT_GT(named(name), 0) << name;
  for (const Entity& entity : old_->entities) EXPECT_EQ(entity.name.find("_1950s"), std::string::npos) << entity.name;
}

TEST_F(NewYork1950s, SignsSayWhatWasSoldThen) {
  std::vector<std::string> texts = internal::SignTexts1950s();
  for (int i = 0; i < kSignCount; ++i) texts.push_back(internal::ShopName(i, ShopSigns::k1950s));
  EXPECT_GT(texts.size(), 270u);
  std::set<std::string> shops(texts.end() - kSignCount, texts.end());
  EXPECT_EQ(shops.size(), static_cast<size_t>(kSignCount));
  int today = 0;
  const auto later = [](const std::string& text) {
    for (const char* word : {"PHONE",  "MOBILE", "CELL",    "WEB",    ".COM", "DIGITAL", "VIDEO", "YOGA", "SPA", "RAMEN",    "TACO",
                             "NOODLE", "JUICE",  "FITNESS", "ENERGY", "APP",  "LED",     "SUSHI", "24H",  "FM",  "CINEMA 3D"})
      if ((" " + text + " ").find(" " + std::string(word) + " ") != std::string::npos) return true;
    return false;
  };
  for (const std::string& text : texts) {
    EXPECT_FALSE(later(text)) << text;
    EXPECT_EQ(text.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789 .,-+!&%'/"), std::string::npos) << text;
    for (const char* year : {"196", "197", "198", "199", "200", "201", "202"}) EXPECT_EQ(text.find(year), std::string::npos) << text;
  }
  for (int i = 0; i < kSignCount; ++i) today += later(internal::ShopName(i));
  EXPECT_GT(today, 5);
}

TEST_F(NewYork1950s, ItsStreetsAreThoseOfToday) {
  const auto now = PeriodOf(CityStyle::kPresent).roles, then = PeriodOf(CityStyle::k1950s).roles;
  ASSERT_EQ(now.size(), then.size());
  for (size_t i = 0; i < now.size(); ++i) {
    EXPECT_EQ(std::tuple(now[i].column, now[i].block_row, now[i].row, now[i].index, now[i].use, std::string(now[i].name)),
              std::tuple(then[i].column, then[i].block_row, then[i].row, then[i].index, then[i].use, std::string(then[i].name)));
  }
  ASSERT_TRUE(old_->roads && present_->roads);
  // All lanes but those for bicycles, and the ways out of those.
  const std::vector<Lane>& lanes = present_->roads->lanes;
  std::vector<bool> of_cycles(lanes.size());
  for (size_t i = 0; i < lanes.size(); ++i) {
    if (!lanes[i].cycle) continue;
    of_cycles[i] = true;
    for (const LaneId next : lanes[i].next)
      if (lanes[next].junction >= 0) of_cycles[next] = true;
  }
  std::vector<std::vector<Vec3f>> ways;
  for (size_t i = 0; i < lanes.size(); ++i)
    if (!of_cycles[i]) ways.push_back(lanes[i].points);
  EXPECT_LT(ways.size(), lanes.size());
  ASSERT_EQ(old_->roads->lanes.size(), ways.size());
  for (size_t i = 0; i < ways.size(); ++i) {
    EXPECT_EQ(old_->roads->lanes[i].points, ways[i]);
    EXPECT_FALSE(old_->roads->lanes[i].cycle);
  }
  EXPECT_EQ(old_->roads->junctions.size(), present_->roads->junctions.size());
  EXPECT_EQ(*old_->spawn, *present_->spawn);
  // Ground to walk and to cross on: the same pieces with the same extent.
  std::map<std::string, Box3f> ground;
  for (const Entity& entity : present_->entities) {
    const std::string& path = present_->tree[entity.category].path;
    if (path == "ground/crosswalk" || entity.name.starts_with("pavement ")) ground[entity.name] = entity.bounds;
  }
  EXPECT_GT(ground.size(), 300u);
  size_t same = 0;
  for (const Entity& entity : old_->entities) {
    const auto it = ground.find(entity.name);
    if (it == ground.end() || entity.name.starts_with("far ")) continue;
    ++same;
    EXPECT_NEAR(entity.bounds.min.x, it->second.min.x, 0.3f) << entity.name;
    EXPECT_NEAR(entity.bounds.min.y, it->second.min.y, 0.3f) << entity.name;
    EXPECT_NEAR(entity.bounds.max.x, it->second.max.x, 0.3f) << entity.name;
    EXPECT_NEAR(entity.bounds.max.y, it->second.max.y, 0.3f) << entity.name;
  }
  EXPECT_GT(same, 200u);
}

TEST_F(NewYork1950s, HasEachLandmarkOfTheInstructionsOnce) {
  std::map<std::string, int> count;
  for (const Entity& entity : old_->entities) ++count[entity.name];
  for (const char* name : {"red telephone booth",
                           "orange mailbox",
                           "blue mailbox",
                           "food truck",
                           "small fountain",
                           "billboard BLACK & WHITE",
                           "billboard person in a blue suit",
                           "billboard red car",
                           "billboard black and white portrait",
                           "blue billboard",
                           "bank with the purple sign",
                           "giant cola bottle",
                           "tree with red leaves",
                           "yellow sunshade",
                           "blue barrier",
                           "red bridge",
                           "lake",
                           "island",
                           "american flag on a mast",
                           "similar tower 1",
                           "similar tower 2",
                           "similar tower 3"}) {
    EXPECT_EQ(count[name], 1) << name;
    EXPECT_EQ(count[std::string(name) + " 2"], 0) << name;
  }
  EXPECT_EQ(std::ranges::count_if(count, [](const auto& c) { return c.first == "glass slab" || c.first == "braced corner"; }), 0);
  Box3f curtains;
  int windows = 0;
  for (const Entity& entity : old_->entities) {
    if (!entity.name.starts_with("red curtains")) continue;
    curtains.Add(entity.bounds);
    ++windows;
  }
  EXPECT_GE(windows, 8);
  EXPECT_LE(curtains.size().z, 4);
}

TEST_F(NewYork1950s, AnnouncesItsCategoriesAndReachesTheFloorTable) {
  std::vector<std::string> present;
  for (const auto& [path, entities] : ByCategory(*old_)) present.push_back(path);
  const WorldInfo info = internal::NewYorkCity1950sInfo();
  EXPECT_EQ(present, info.categories);
  EXPECT_EQ(info.name, old_->name);
  const std::vector<FloorRow> rows = StructuralFloor(old_->name, SurveyWorld(*old_));
  EXPECT_GE(rows.size(), 15u);
  for (const FloorRow& row : rows) EXPECT_TRUE(row.reached()) << row.item << ": " << row.measured << " < " << row.at_least;
  EXPECT_LE(old_->Count().unique_triangles, 8'000'000u);
}

TEST_F(NewYork1950s, HeightsTreesAndLampsAreDistributedAsInRealTowns) {
  const StreetPlan plan = PlanNewYorkCity();
  std::vector<double> heights;
  for (const BuildingPlan& building : internal::PlanManhattan(plan, {.style = CityStyle::k1950s}).buildings) {
    if (!plan.reach().Contains(building.bounds().center())) continue;
    if (building.base == 0) heights.push_back(0);
    heights.back() = static_cast<double>(building.height());  // of the highest tier
  }
  std::vector<Vec2d> trees, lamps;
  for (const Placement& prop : placements_) {
    const bool tree = prop.kind.starts_with("tree_"), lamp = prop.kind == "street_light" || prop.kind == "lamp_post";
    if ((tree || lamp) && plan.reach().Contains({prop.p_W.x, prop.p_W.y})) (tree ? trees : lamps).push_back({prop.p_W.x, prop.p_W.y});
  }
  const auto real = internal::RealTowns();
  const std::map<std::string, std::vector<double>> ours = {{"building_height_m", heights},
                                                           {"tree_spacing_m", internal::NearestDistances(trees)},
                                                           {"lamp_spacing_m", internal::NearestDistances(lamps)}};
  for (const auto& [row, samples] : ours) {
    const double distance = internal::KolmogorovSmirnov(samples, real.at(row));
    EXPECT_LE(distance, 0.25) << row;
    RecordProperty(row, std::to_string(distance));
  }
}

TEST_F(NewYork1950s, NoTwoPropsShareGround) {
  ASSERT_GT(placements_.size(), 1500u);
  for (size_t i = 0; i < placements_.size(); ++i) {
    for (size_t k = i + 1; k < placements_.size(); ++k) {
      const Footprint &a = placements_[i].footprint, &b = placements_[k].footprint;
      if (std::hypot(a.center.x - b.center.x, a.center.y - b.center.y) > 20) continue;
      EXPECT_FALSE(a.Overlaps(b)) << placements_[i].kind << " and " << placements_[k].kind << " at " << a.center.x << " " << a.center.y;
    }
  }
}

TEST_F(NewYork1950s, IsTheSameByItsNameAndFromAnyNumberOfThreads) {
  const ThreadLimit one(1);
  const auto again = BuildWorld("new_york_city_1950s", {});
  EXPECT_TRUE(ArchiveScene(*again) == ArchiveScene(*old_));
  EXPECT_FALSE(ArchiveScene(*present_) == ArchiveScene(*old_));
}

}  // namespace
}  // namespace airsim360
