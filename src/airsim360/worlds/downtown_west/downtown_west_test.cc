#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <set>

#include "airsim360/base/parallel.h"
#include "airsim360/worlds/building/massing.h"
#include "airsim360/worlds/built_in.h"
#include "airsim360/worlds/kit/test_scene_hash.h"
#include "airsim360/worlds/props/placer.h"

namespace airsim360 {
namespace {

// Built once for all tests: procedural props only, seed 0.
class DowntownWest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() { scene_ = internal::BuildDowntownWest({}, &placements_); }
  static void TearDownTestSuite() { scene_.reset(); }

  // Entities by category path.
  static std::map<std::string, std::vector<const Entity*>> ByCategory() {
    std::map<std::string, std::vector<const Entity*>> groups;
    for (const Entity& entity : scene_->entities) groups[scene_->tree[entity.category].path].push_back(&entity);
    return groups;
  }
  static int CountWithin(const std::vector<const Entity*>& entities, const GroundRect& rect) {
    return static_cast<int>(std::count_if(entities.begin(), entities.end(), [&](const Entity* e) {
      const Vec3f c = e->bounds.center();
      return rect.Contains({c.x, c.y});
    }));
  }

  static inline std::shared_ptr<const Scene> scene_;
  static inline std::vector<Placement> placements_;
};

// The 29 categories that the paper's table lists for Downtown West.
constexpr const char* kPaperCategories[] = {"barrier/fence/wood_fence",
                                            "barrier/railing/pillar",
                                            "barrier/railing/rail",
                                            "construction/awning",
                                            "construction/building",
                                            "construction/building/roof",
                                            "furniture/lighting/lamp_post",
                                            "furniture/lighting/street_light",
                                            "furniture/planter/pot",
                                            "furniture/seating/bench/wood",
                                            "furniture/seating/chair",
                                            "furniture/shade/tarp",
                                            "furniture/shade/tarp_post",
                                            "furniture/shade/umbrella",
                                            "furniture/table/dining_table",
                                            "furniture/vending/food_cart",
                                            "furniture/waste/recycle_bin",
                                            "ground/path/park_walkway",
                                            "ground/pavement/modular",
                                            "ground/road",
                                            "ground/terrain/landscape",
                                            "nature/mountain",
                                            "nature/rock",
                                            "signage/poster_stand",
                                            "sky",
                                            "traffic/bollard/car_pillar",
                                            "vegetation/tree/broadleaf/generic",
                                            "vegetation/tree/broadleaf/narrowleaf",
                                            "vegetation/tree/conifer/pine"};

TEST_F(DowntownWest, HasEveryCategoryOfThePaper) {
  const auto groups = ByCategory();
  for (const std::string path : kPaperCategories) {
    const auto it = groups.find(path);
    ASSERT_NE(it, groups.end()) << path;
    EXPECT_GE(it->second.size(), path == "sky" ? 1u : 3u) << path;
  }
  EXPECT_EQ(std::size(kPaperCategories), 29u);
}

TEST_F(DowntownWest, AnnouncesExactlyTheCategoriesThatItHas) {
  std::vector<std::string> present;
  for (const auto& [path, entities] : ByCategory()) present.push_back(path);
  EXPECT_EQ(present, internal::DowntownWestInfo().categories);
}

TEST_F(DowntownWest, ReachesTheStructuralFloor) {
  const auto groups = ByCategory();
  const StreetPlan plan = PlanDowntownWest();
  const GroundRect reach = plan.reach();
  const auto within = [&](const char* path) { return CountWithin(groups.at(path), reach); };

  EXPECT_GE(within("construction/building"), 27);
  EXPECT_GE(groups.at("construction/building").size(), 27u + 60u);
  EXPECT_GE(within("furniture/lighting/lamp_post") + within("furniture/lighting/street_light"), 100);
  EXPECT_GE(within("vehicle/car"), 60);
  const auto& manholes = groups.at("ground/manhole");
  EXPECT_GE(std::count_if(manholes.begin(), manholes.end(), [](const Entity* e) { return e->name.starts_with("manhole"); }), 30);
  EXPECT_GE(
      within("vegetation/tree/broadleaf/generic") + within("vegetation/tree/broadleaf/narrowleaf") + within("vegetation/tree/conifer/pine"),
      150);
  std::set<FacadeStyle> styles;
  for (const BuildingPlan& building : PlanBuildings(plan, 0)) {
    if (reach.Contains(building.bounds().center())) styles.insert(building.style);
  }
  EXPECT_GE(styles.size(), 5u);

  const SceneCounts counts = scene_->Count();
  EXPECT_GE(counts.entities, 3000u);
  EXPECT_GE(counts.instances, 27000u);
  EXPECT_GE(counts.instanced_triangles, 2'000'000u);
  EXPECT_LE(counts.unique_triangles, 8'000'000u);

  // Streets between core crossings, pavements around the blocks of the core.
  double road = 0, pavement = 0;
  const auto first = static_cast<size_t>(plan.first_core), last = static_cast<size_t>(plan.last_core);
  for (size_t i = first; i < last; ++i) {
    const double ns = plan.north_south[i + 1].center - plan.north_south[i].center;
    const double ew = plan.east_west[i + 1].center - plan.east_west[i].center;
    road += (ns + ew) * static_cast<double>(last - first + 1);
  }
  for (const Block& block : plan.blocks) {
    if (block.kind != BlockKind::kBackdrop) pavement += 2.0 * (block.kerb.width() + block.kerb.depth());
  }
  EXPECT_GE(road, 1000);
  EXPECT_GE(pavement, 1900);
}

TEST_F(DowntownWest, IsAFunctionOfItsSeedAlone) {
  const std::string hash = internal::SceneHash(*scene_);
  std::string again;
  {
    const ThreadLimit one(1);
    again = internal::SceneHash(*BuildWorld("downtown_west", {.seed = 0}));
  }
  EXPECT_EQ(hash, again);
  EXPECT_NE(hash, internal::SceneHash(*BuildWorld("downtown_west", {.seed = 1})));
}

TEST_F(DowntownWest, EveryEntityButTheSkyIsSomewhereInTheWorld) {
  for (const Entity& entity : scene_->entities) {
    if (entity.id == scene_->sky_entity) continue;
    ASSERT_FALSE(entity.bounds.empty()) << entity.name;
    EXPECT_TRUE(scene_->bounds.Contains(entity.bounds.min) && scene_->bounds.Contains(entity.bounds.max)) << entity.name;
  }
}

TEST_F(DowntownWest, NoTwoPropsShareGround) {
  ASSERT_GT(placements_.size(), 1500u);
  for (size_t i = 0; i < placements_.size(); ++i) {
    const Footprint& a = placements_[i].footprint;
    for (size_t k = i + 1; k < placements_.size(); ++k) {
      const Footprint& b = placements_[k].footprint;
      if (std::hypot(a.center.x - b.center.x, a.center.y - b.center.y) > 20) continue;
      EXPECT_FALSE(a.Overlaps(b)) << placements_[i].kind << " and " << placements_[k].kind << " at " << a.center.x << " " << a.center.y;
    }
  }
}

TEST_F(DowntownWest, NoTreeGrowsIntoAWall) {
  const std::vector<BuildingPlan> buildings = PlanBuildings(PlanDowntownWest(), 0);
  for (const Entity& entity : scene_->entities) {
    if (!scene_->tree[entity.category].path.starts_with("vegetation/tree")) continue;
    // A twig may reach a little further than the bulk of the crown.
    const Vec3f c = entity.bounds.center(), h = entity.bounds.size() * 0.45f;
    for (const BuildingPlan& building : buildings) {
      const GroundRect b = building.bounds();
      const bool apart = c.x + h.x < b.x0 || c.x - h.x > b.x1 || c.y + h.y < b.y0 || c.y - h.y > b.y1;
      EXPECT_TRUE(apart) << entity.name << " at " << c.x << " " << c.y;
    }
  }
}

TEST_F(DowntownWest, NoPropStandsInABuilding) {
  const std::vector<BuildingPlan> buildings = PlanBuildings(PlanDowntownWest(), 0);
  for (const Placement& prop : placements_) {
    for (const BuildingPlan& building : buildings) {
      EXPECT_FALSE(building.bounds().Inset(0.05f).Contains({prop.p_W.x, prop.p_W.y})) << prop.kind;
    }
  }
}

// Surfaces of the ground mesh above points of a grid of 1 m over the reachable ground.
class GroundColumns {
 public:
  explicit GroundColumns(const Scene& scene, const GroundRect& area)
      : area_(area), width_(static_cast<int>(area.width())), height_(static_cast<int>(area.depth())) {
    surfaces_.resize(static_cast<size_t>(width_) * static_cast<size_t>(height_));
    for (const Mesh& mesh : scene.meshes) {
      if (mesh.name != "ground") continue;
      for (const MeshPart& part : mesh.parts) {
        for (uint32_t i = 0; i < part.triangle_count; ++i) {
          const Vec3u t = mesh.triangles[part.first_triangle + i];
          Add(mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z], part.entity);
        }
      }
    }
  }
  struct Surface {
    float z;
    EntityId entity;
  };
  int width() const { return width_; }
  int height() const { return height_; }
  Vec2f Center(int x, int y) const { return {area_.x0 + static_cast<float>(x) + 0.503f, area_.y0 + static_cast<float>(y) + 0.507f}; }
  /// Up-facing surfaces at a point, in no order.
  const std::vector<Surface>& At(int x, int y) const { return surfaces_[static_cast<size_t>(y) * width_ + x]; }

 private:
  void Add(Vec3f a, Vec3f b, Vec3f c, EntityId entity) {
    const Vec3f n = Cross(b - a, c - a);
    if (n.z <= 1e-9f) return;
    const auto cross = [](Vec3f p, Vec3f q, Vec2f r) { return (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x); };
    const int x0 = std::max(0, static_cast<int>(std::min({a.x, b.x, c.x}) - area_.x0) - 1);
    const int x1 = std::min(width_ - 1, static_cast<int>(std::max({a.x, b.x, c.x}) - area_.x0) + 1);
    const int y0 = std::max(0, static_cast<int>(std::min({a.y, b.y, c.y}) - area_.y0) - 1);
    const int y1 = std::min(height_ - 1, static_cast<int>(std::max({a.y, b.y, c.y}) - area_.y0) + 1);
    for (int y = y0; y <= y1; ++y) {
      for (int x = x0; x <= x1; ++x) {
        const Vec2f p = Center(x, y);
        if (cross(a, b, p) < 0 || cross(b, c, p) < 0 || cross(c, a, p) < 0) continue;
        surfaces_[static_cast<size_t>(y) * width_ + x].push_back({a.z - (n.x * (p.x - a.x) + n.y * (p.y - a.y)) / n.z, entity});
      }
    }
  }

  GroundRect area_;
  int width_, height_;
  std::vector<std::vector<Surface>> surfaces_;
};

// Second method for the area: cells of 1 m whose centre has ground under it and no building on it.
TEST_F(DowntownWest, GroundHasNoHoleAndTheAnnouncedArea) {
  const StreetPlan plan = PlanDowntownWest();
  const GroundColumns columns(*scene_, plan.reach());
  const std::vector<BuildingPlan> buildings = PlanBuildings(plan, 0);
  double area = 0;
  int holes = 0;
  for (int y = 0; y < columns.height(); ++y) {
    for (int x = 0; x < columns.width(); ++x) {
      const Vec2f p = columns.Center(x, y);
      if (std::any_of(buildings.begin(), buildings.end(), [&](const BuildingPlan& b) { return b.bounds().Contains(p); })) continue;
      if (columns.At(x, y).empty()) {
        ++holes;
      } else {
        area += 1;
      }
    }
  }
  EXPECT_EQ(holes, 0);
  EXPECT_GE(area, 60000);
  EXPECT_NEAR(area, internal::DowntownWestInfo().area_m2, 0.01 * area);
}

// Layers that lie on each other keep a gap, so that labels do not flicker with distance.
TEST_F(DowntownWest, NoTwoGroundEntitiesShareASurface) {
  const GroundColumns columns(*scene_, PlanDowntownWest().reach());
  for (int y = 0; y < columns.height(); ++y) {
    for (int x = 0; x < columns.width(); ++x) {
      const auto& at = columns.At(x, y);
      for (size_t i = 0; i < at.size(); ++i) {
        for (size_t k = i + 1; k < at.size(); ++k) {
          if (at[i].entity == at[k].entity) continue;
          EXPECT_GE(std::abs(at[i].z - at[k].z), 0.0019f)
              << scene_->entity(at[i].entity).name << " and " << scene_->entity(at[k].entity).name << " at " << columns.Center(x, y).x
              << " " << columns.Center(x, y).y;
        }
      }
    }
  }
}

}  // namespace
}  // namespace airsim360
