#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <string_view>

#include "airsim360/base/parallel.h"
#include "airsim360/worlds/built_in.h"
#include "airsim360/worlds/city_park/layout.h"
#include "airsim360/worlds/kit/test_scene_hash.h"
#include "airsim360/worlds/props/placer.h"

namespace airsim360 {
namespace {

using internal::park::Layout;

/// The world of seed 0, built once for all tests, and where its props stand.
struct Park {
  std::vector<Placement> placements;
  std::shared_ptr<const Scene> scene = internal::BuildCityPark({.seed = 0}, &placements);
};
const Park& SharedPark() {
  static const Park park;
  return park;
}

std::map<std::string, std::vector<const Entity*>> ByCategory(const Scene& scene) {
  std::map<std::string, std::vector<const Entity*>> groups;
  for (const Entity& entity : scene.entities) groups[scene.tree[entity.category].path].push_back(&entity);
  return groups;
}

// What the paper's table lists for City Park.
constexpr const char* kPaperCategories[] = {"barrier/fence/circle_fence",
                                            "construction/building",
                                            "furniture/lighting/lamp_post",
                                            "furniture/recreation/playground",
                                            "furniture/seating/bench",
                                            "furniture/seating/chair",
                                            "furniture/shade/umbrella",
                                            "furniture/table/cafe_table",
                                            "furniture/vending/food_stall",
                                            "furniture/waste/trash_can",
                                            "ground/road",
                                            "ground/sidewalk/pool_edge",
                                            "ground/terrain/landscape",
                                            "nature/rock",
                                            "sky",
                                            "traffic/barrier/road_block",
                                            "traffic/control/traffic_light",
                                            "traffic/temporary/traffic_barrel",
                                            "vegetation/climber/ivy",
                                            "vegetation/shrub/bush",
                                            "vegetation/tree/broadleaf/amur_cork",
                                            "vegetation/tree/broadleaf/elm",
                                            "vegetation/tree/broadleaf/maple",
                                            "vegetation/tree/broadleaf/weeping_willow",
                                            "water/water_plane"};

TEST(CityPark, HasThePapersCategoriesAndAnnouncesExactlyWhatItHas) {
  const auto scene = SharedPark().scene;
  const auto groups = ByCategory(*scene);
  EXPECT_EQ(std::size(kPaperCategories), 25u);
  for (const std::string path : kPaperCategories) {
    const auto it = groups.find(path);
    ASSERT_NE(it, groups.end()) << path;
    EXPECT_GE(it->second.size(), path == "sky" || path == "water/water_plane" ? 1u : 3u) << path;
  }
  std::vector<std::string> present;
  for (const auto& [path, entities] : groups) present.push_back(path);
  EXPECT_EQ(present, internal::CityParkInfo().categories);

  // The floor that a park of 80 hectares needs; the lengths are those of main road, pavements and paths.
  EXPECT_GE(internal::CityParkInfo().area_m2, 800000);
  EXPECT_GE(groups.at("construction/building").size(), 40u);
  EXPECT_GE(groups.at("furniture/lighting/lamp_post").size() + groups.at("furniture/lighting/lamp_post/type_b").size(), 400u);
  EXPECT_GE(groups.at("vehicle/car").size(), 150u);
  size_t trees = 0, meshes = 0;
  for (const auto& [path, entities] : groups) {
    if (!path.starts_with("vegetation/tree/")) continue;
    trees += static_cast<size_t>(
        std::count_if(entities.begin(), entities.end(), [](const Entity* e) { return !e->name.starts_with("wood of"); }));
    ++meshes;
  }
  EXPECT_GE(trees, 3000u);
  EXPECT_GE(meshes, 6u);
  const SceneCounts counts = scene->Count();
  EXPECT_GE(counts.entities, 10000u);
  EXPECT_GE(counts.instances, 200000u);
  EXPECT_GE(counts.instanced_triangles, 1'000'000'000u);
  EXPECT_LE(counts.unique_triangles, 6'000'000u);
}

TEST(CityPark, IsAFunctionOfItsSeedAlone) {
  const ThreadLimit one(1);
  EXPECT_EQ(internal::SceneHash(*SharedPark().scene), internal::SceneHash(*internal::BuildCityPark({.seed = 0}, nullptr)));
}

TEST(CityPark, NothingFloatsSharesGroundOrStandsInTheSpawn) {
  const std::vector<Placement>& placements = SharedPark().placements;
  const auto scene = SharedPark().scene;
  const Layout layout;
  ASSERT_GT(placements.size(), 3000u);
  for (const Placement& prop : placements) {
    const Vec2f p{prop.p_W.x, prop.p_W.y};
    // On a carriageway, a pavement, or the ground, sunk a little at most.
    const float beyond = layout.BeyondRoad(p), ground = beyond < 0 ? layout.Base(p) : layout.Ground(p);
    EXPECT_GE(prop.p_W.z, ground - 0.2f) << prop.kind << " at " << p.x << " " << p.y;
    EXPECT_LE(prop.p_W.z, ground + 0.2f) << prop.kind << " at " << p.x << " " << p.y;
  }
  for (size_t i = 0; i < placements.size(); ++i) {
    for (size_t k = i + 1; k < placements.size(); ++k) {
      const Footprint &a = placements[i].footprint, &b = placements[k].footprint;
      if (std::abs(a.center.x - b.center.x) > 12 || std::abs(a.center.y - b.center.y) > 12) continue;
      EXPECT_FALSE(a.Overlaps(b)) << placements[i].kind << " and " << placements[k].kind << " at " << a.center.x << " " << a.center.y;
    }
  }
  // Trees have their foot off roads, paths and water; nothing is within 3 m of the spawn.
  ASSERT_TRUE(scene->spawn);
  EXPECT_NEAR(scene->spawn_yaw_deg, 90, 1e-6);
  for (const Instance& instance : scene->instances) {
    if (instance.entity == kNoEntity) continue;
    const Vec3f foot = instance.X_WM.p;
    EXPECT_GT(Norm(foot - *scene->spawn), 3.0f);
    const Entity& entity = scene->entity(instance.entity);
    if (!scene->tree[entity.category].path.starts_with("vegetation/tree")) continue;
    const Vec2f p{foot.x, foot.y};
    EXPECT_GT(layout.BeyondRoad(p), 1) << entity.name;
    EXPECT_TRUE(layout.Lake(p) > 1 || layout.Island(p) > 0.5f) << entity.name;
    EXPECT_GT(layout.PathDistance(p, 10), internal::park::kPathHalf + 0.2f) << entity.name;
    EXPECT_NEAR(foot.z, layout.Ground(p), 0.3f) << entity.name;
  }
  for (const Entity& entity : scene->entities) {
    if (entity.id != scene->sky_entity) {
      ASSERT_FALSE(entity.bounds.empty()) << entity.name;
    }
  }
}

}  // namespace
}  // namespace airsim360
