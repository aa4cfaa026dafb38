// The two downtowns as users meet them: what is there, what can be seen, what instructions name.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <memory>
#include <numbers>
#include <set>

#include "airsim360/render/renderer.h"
#include "airsim360/trace/ray_tracer.h"
#include "airsim360/worlds/building/massing.h"
#include "airsim360/worlds/built_in.h"
#include "airsim360/worlds/kit/mesh_builder.h"
#include "airsim360/worlds/new_york_city/manhattan.h"
#include "airsim360/worlds/osm/test_real_towns.h"
#include "airsim360/worlds/props/placer.h"
#include "airsim360/worlds/survey/world_floor.h"
#include "airsim360/worlds/survey/world_survey.h"

namespace airsim360 {
namespace {

struct Built {
  std::shared_ptr<const Scene> scene;
  std::vector<Placement> placements;
  std::shared_ptr<const RayTracer> tracer;
  std::map<std::string, std::vector<const Entity*>> by_category;
};

void Index(Built& built) {
  built.tracer = std::make_shared<const RayTracer>(built.scene);
  for (const Entity& entity : built.scene->entities) built.by_category[built.scene->tree[entity.category].path].push_back(&entity);
}

// Procedural props only, seed 0; each world is built once for the program.
const Built& NewYork() {
  static const Built built = [] {
    Built b;
    b.scene = internal::BuildNewYorkCity({}, &b.placements);
    Index(b);
    return b;
  }();
  return built;
}
const Built& Downtown() {
  static const Built built = [] {
    Built b;
    b.scene = internal::BuildDowntownWest({}, &b.placements);
    Index(b);
    return b;
  }();
  return built;
}

// The 25 categories that the paper's table lists for New York City; the sky is the 25th.
constexpr const char* kNewYorkCategories[] = {"traffic/barrier/concrete_block",
                                              "furniture/misc",
                                              "traffic/temporary/cone",
                                              "barrier/fence/metal_fence",
                                              "construction/pillar",
                                              "furniture/lighting/street_light",
                                              "furniture/waste/trash_can",
                                              "furniture/mail/post_box",
                                              "furniture/shade/umbrella",
                                              "furniture/table",
                                              "furniture/seating/chair",
                                              "furniture/planter/green_pot",
                                              "traffic/bollard/road_column",
                                              "signage/billboard",
                                              "construction/awning",
                                              "construction/scaffolding",
                                              "signage/flag/usa",
                                              "vegetation/plant",
                                              "construction/rooftop/ventilation_tube",
                                              "construction/building",
                                              "furniture/vending/hotdog_cart",
                                              "ground/road",
                                              "ground/sidewalk",
                                              "ground/dirt"};

// And the 29 for Downtown West, again without the sky.
constexpr const char* kDowntownCategories[] = {"barrier/fence/wood_fence",
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
                                               "traffic/bollard/car_pillar",
                                               "vegetation/tree/broadleaf/generic",
                                               "vegetation/tree/broadleaf/narrowleaf",
                                               "vegetation/tree/conifer/pine"};

// Entities of a category in the picture from `p`.
struct Seen {
  size_t entities = 0;
  int unlabelled = 0;
};
Seen LookFrom(const Built& built, Renderer& renderer, Vec3f p, const std::string& path) {
  RenderRequest request;
  request.camera = Equirectangular{512, 256};
  request.X_WC = BodyPose({p.x, p.y, p.z}, 0, 0, 0) * CameraInBody();
  request.tier = Tier::kLabels;
  Frame frame;
  renderer.Render(request, frame);
  std::set<EntityId> found;
  Seen seen;
  for (int y = 0; y < 256; ++y) {
    for (int x = 0; x < 512; ++x) {
      const CategoryId category = frame.semantic(x, y);
      seen.unlabelled += category == kVoid || frame.entity(x, y) == kNoEntity;
      if (category != kVoid && built.scene->tree[category].path == path) found.insert(frame.entity(x, y));
    }
  }
  seen.entities = found.size();
  return seen;
}

// Looks at the places where entities of the category stand closest together, a few metres above them.
void ExpectThreeVisible(const Built& built, const std::string& path) {
  const auto it = built.by_category.find(path);
  ASSERT_NE(it, built.by_category.end()) << path;
  const auto& entities = it->second;
  ASSERT_GE(entities.size(), 3u) << path;
  static std::map<const Built*, std::unique_ptr<Renderer>> renderers;
  auto& renderer = renderers[&built];
  if (!renderer) renderer = MakeCpuRenderer(built.tracer, {.tier = Tier::kLabels});
  // Distance to the second-next of the same kind.
  std::vector<std::pair<float, const Entity*>> crowded;
  const size_t step = std::max<size_t>(1, entities.size() / 150);
  for (size_t i = 0; i < entities.size(); i += step) {
    float best[2] = {1e9f, 1e9f};
    for (const Entity* other : entities) {
      if (other == entities[i]) continue;
      const float d = Norm(other->bounds.center() - entities[i]->bounds.center());
      if (d < best[0])
        best[1] = std::exchange(best[0], d);
      else
        best[1] = std::min(best[1], d);
    }
    crowded.emplace_back(best[1], entities[i]);
  }
  std::sort(crowded.begin(), crowded.end());
  size_t most = 0;
  for (size_t i = 0; i < std::min<size_t>(crowded.size(), 12) && most < 3; ++i) {
    const Box3f& box = crowded[i].second->bounds;
    for (Vec3f offset : {Vec3f{2.5f, 2.5f, 2}, Vec3f{-3, 3, 3}, Vec3f{3, -5, 8}, Vec3f{-6, -6, 25}}) {
      const Vec3f c = box.center();
      const Seen seen = LookFrom(built, *renderer, {c.x + offset.x, c.y + offset.y, box.max.z + offset.z}, path);
      EXPECT_EQ(seen.unlabelled, 0) << path;
      most = std::max(most, seen.entities);
      if (most >= 3) break;
    }
  }
  EXPECT_GE(most, 3u) << path;
}

TEST(NewYorkCity, ShowsThreeEntitiesOfEveryCategoryOfThePaperInSomeFrame) {
  for (const char* path : kNewYorkCategories) ExpectThreeVisible(NewYork(), path);
  EXPECT_EQ(std::size(kNewYorkCategories) + NewYork().by_category.count("sky"), 25u);
}

TEST(DowntownWest, ShowsThreeEntitiesOfEveryCategoryOfThePaperInSomeFrame) {
  for (const char* path : kDowntownCategories) ExpectThreeVisible(Downtown(), path);
  EXPECT_EQ(std::size(kDowntownCategories) + Downtown().by_category.count("sky"), 29u);
}

TEST(NewYorkCity, AnnouncesExactlyTheCategoriesThatItHas) {
  std::vector<std::string> present;
  for (const auto& [path, entities] : NewYork().by_category) present.push_back(path);
  EXPECT_EQ(present, internal::NewYorkCityInfo().categories);
}

TEST(NewYorkCity, ItsUniqueGeometryFitsIntoLittleMemory) { EXPECT_LE(NewYork().scene->Count().unique_triangles, 8'000'000u); }

// How many entities carry a name, repeats (" 2", " 3", …) included.
int CountNamed(const Scene& scene, const std::string& name) {
  return static_cast<int>(std::count_if(scene.entities.begin(), scene.entities.end(), [&](const Entity& entity) {
    if (entity.name == name) return true;
    return entity.name.starts_with(name + " ") && entity.name.find_first_not_of("0123456789", name.size() + 1) == std::string::npos;
  }));
}

// Red curtains: many windows, all of one storey of one building.
void ExpectRedCurtainsOnOneStorey(const Built& built, int least) {
  Box3f all;
  int windows = 0;
  for (const Entity& entity : built.scene->entities) {
    if (!entity.name.starts_with("red curtains")) continue;
    ++windows;
    all.Add(entity.bounds);
  }
  EXPECT_GE(windows, least);
  EXPECT_LE(all.size().z, 4);
  EXPECT_LE(std::max(all.size().x, all.size().y), 40);
}

/// The landmarks of both cities and those of this one.
void ExpectLandmarksOnce(const Scene& scene, std::vector<const char*> names) {
  for (const char* name :
       {"red telephone booth", "orange mailbox", "blue mailbox", "food truck", "small fountain", "billboard BLACK & WHITE",
        "billboard person in a blue suit", "billboard red car", "billboard black and white portrait", "blue billboard",
        "bank with the purple sign", "giant cola bottle", "tree with red leaves", "yellow sunshade", "blue barrier", "red bridge", "lake",
        "island", "american flag on a mast"})
    names.push_back(name);
  for (const char* name : names) EXPECT_EQ(CountNamed(scene, name), 1) << name;
}

TEST(NewYorkCity, HasEachLandmarkOfTheInstructionsOnce) {
  ExpectLandmarksOnce(*NewYork().scene, {"similar tower 1", "similar tower 2", "similar tower 3"});
  ExpectRedCurtainsOnOneStorey(NewYork(), 8);
  // One street, the boulevard at x = 0, has green bike lanes.
  for (const Entity* entity : NewYork().by_category.at("ground/bike_lane"))
    EXPECT_LE(std::abs(entity->bounds.center().x), 13) << entity->name;
}

TEST(DowntownWest, HasEachLandmarkOfTheInstructionsOnce) {
  ExpectLandmarksOnce(*Downtown().scene, {"fountain", "similar building 1", "similar building 2", "similar building 3"});
  ExpectRedCurtainsOnOneStorey(Downtown(), 6);
  // The green bike lane is that of one street.
  Box3f lane;
  for (const Entity* entity : Downtown().by_category.at("ground/bike_lane")) lane.Add(entity->bounds);
  EXPECT_LE(std::min(lane.size().x, lane.size().y), 14);
}

// Kolmogorov-Smirnov distances of what can be reached to real towns (data/osm/distributions.csv).
struct Distances {
  double areas = 0, heights = 0, trees = 0, lamps = 0;
};
Distances CompareWithRealTowns(const char* name, const Built& built, const std::vector<BuildingPlan>& buildings, const GroundRect& reach) {
  std::vector<double> areas, heights;
  for (const BuildingPlan& plan : buildings) {
    if (!reach.Contains(plan.bounds().center())) continue;
    if (plan.base > 0) {
      heights.back() = static_cast<double>(plan.height());  // the tier above is the same building
      continue;
    }
    double twice = 0;
    for (size_t i = 0; i < plan.outline.size(); ++i) {
      const Vec2f a = plan.outline[i], b = plan.outline[(i + 1) % plan.outline.size()];
      twice += static_cast<double>(a.x) * b.y - static_cast<double>(b.x) * a.y;
    }
    areas.push_back(twice / 2);
    heights.push_back(static_cast<double>(plan.height()));
  }
  std::vector<Vec2d> trees, lamps;
  for (const Placement& prop : built.placements) {
    const bool tree = prop.kind.starts_with("tree_"), lamp = prop.kind == "street_light" || prop.kind == "lamp_post";
    if ((tree || lamp) && reach.Contains({prop.p_W.x, prop.p_W.y})) (tree ? trees : lamps).push_back({prop.p_W.x, prop.p_W.y});
  }
  const auto real = internal::RealTowns();
  const auto distance = [&](const std::vector<double>& samples, const char* row) {
    return internal::KolmogorovSmirnov(samples, real.at(row));
  };
  const Distances d{distance(areas, "building_area_m2"), distance(heights, "building_height_m"),
                    distance(internal::NearestDistances(trees), "tree_spacing_m"),
                    distance(internal::NearestDistances(lamps), "lamp_spacing_m")};
  std::printf("%s: %zu buildings, %zu trees, %zu lamps; Kolmogorov-Smirnov: area %.3f height %.3f trees %.3f lamps %.3f\n", name,
              areas.size(), trees.size(), lamps.size(), d.areas, d.heights, d.trees, d.lamps);
  return d;
}

TEST(DowntownWest, LotsHeightsTreesAndLampsAreDistributedAsInRealTowns) {
  const StreetPlan plan = PlanDowntownWest();
  const Distances d = CompareWithRealTowns("downtown_west", Downtown(), PlanBuildings(plan, 0), plan.reach());
  EXPECT_LE(d.areas, 0.25);
  EXPECT_LE(d.heights, 0.25);
  EXPECT_LE(d.trees, 0.25);
  EXPECT_LE(d.lamps, 0.25);
}

TEST(NewYorkCity, LotsHeightsTreesAndLampsAreDistributedAsInRealTowns) {
  const StreetPlan plan = PlanNewYorkCity();
  const Distances d = CompareWithRealTowns("new_york_city", NewYork(), internal::PlanManhattan(plan, {}).buildings, plan.reach());
  EXPECT_LE(d.areas, 0.25);
  EXPECT_LE(d.heights, 0.25);
  EXPECT_LE(d.trees, 0.25);
  EXPECT_LE(d.lamps, 0.25);
}

// A library that has every model: a box of a metre.
class BoxLibrary : public ModelSource {
 public:
  std::optional<Model> Load(std::string_view name) const override {
    MeshBuilder box;
    box.Box({-0.5f, -0.5f, 0}, {0.5f, 0.5f, 1});
    Model model{box.Finish(std::string(name)), {Material{}}, {}, "Box, nobody, CC0-1.0"};
    return model;
  }
};

TEST(DowntownWest, HasTheSameEntitiesWithAndWithoutALibraryOfModels) {
  const BoxLibrary library;
  const auto with = internal::BuildDowntownWest({.models = &library});
  const Scene& without = *Downtown().scene;
  EXPECT_FALSE(with->attributions.empty());
  EXPECT_TRUE(without.attributions.empty());
  ASSERT_EQ(with->entities.size(), without.entities.size());
  for (size_t i = 0; i < without.entities.size(); ++i) {
    ASSERT_EQ(with->entities[i].name, without.entities[i].name);
    ASSERT_EQ(with->entities[i].category, without.entities[i].category);
  }
}

// Ids of 17 bits reach the picture and the table of entities.
TEST(ManyEntities, MoreThanSixteenBitsCountAreToldApart) {
  constexpr int kRow = 266;
  SceneBuilder builder("many");
  MeshBuilder plate;
  plate.Box({-0.4f, -0.4f, 0}, {0.4f, 0.4f, 0.1f}, MeshBuilder::kTop);
  builder.AddMaterial({});
  const MeshId mesh = builder.AddMesh(plate.Finish("plate"));
  const CategoryId bench = builder.tree().At("furniture/seating/bench");
  for (int i = 0; i < kRow * kRow; ++i) {
    const Vec3f at{static_cast<float>(i % kRow), static_cast<float>(i / kRow), 0};
    builder.AddInstance({mesh, PlaceUpright(at), builder.AddEntity("plate", bench)});
  }
  builder.AddSky();
  const auto tracer = std::make_shared<const RayTracer>(builder.Build());
  RenderRequest request;
  request.camera = Equirectangular{512, 256};
  request.X_WC = BodyPose({kRow - 2.0, kRow - 2.0, 3}, 0, 0, 0) * CameraInBody();
  request.tier = Tier::kLabels;
  Frame frame;
  MakeCpuRenderer(tracer)->Render(request, frame);
  std::set<EntityId> seen;
  for (EntityId id : frame.entity.pixels()) seen.insert(id);
  EXPECT_GT(std::count_if(seen.begin(), seen.end(), [](EntityId id) { return id > 65536; }), 100);
  for (EntityId id : seen) EXPECT_EQ(tracer->scene().entity(id).id, id);
}

void ExpectFloorReached(const char* name, const Built& built) {
  const std::vector<FloorRow> rows = StructuralFloor(name, SurveyWorld(*built.scene));
  EXPECT_GE(rows.size(), 15u);
  for (const FloorRow& row : rows) EXPECT_TRUE(row.reached()) << name << " " << row.item << ": " << row.measured << " < " << row.at_least;
}

TEST(NewYorkCity, ReachesEveryRowOfTheFloorTable) { ExpectFloorReached("new_york_city", NewYork()); }
TEST(DowntownWest, ReachesEveryRowOfTheFloorTable) { ExpectFloorReached("downtown_west", Downtown()); }

TEST(NewYorkCity, NoTwoPropsShareGround) {
  const auto& placements = NewYork().placements;
  ASSERT_GT(placements.size(), 1500u);
  for (size_t i = 0; i < placements.size(); ++i) {
    for (size_t k = i + 1; k < placements.size(); ++k) {
      const Footprint &a = placements[i].footprint, &b = placements[k].footprint;
      if (std::hypot(a.center.x - b.center.x, a.center.y - b.center.y) > 20) continue;
      EXPECT_FALSE(a.Overlaps(b)) << placements[i].kind << " and " << placements[k].kind << " at " << a.center.x << " " << a.center.y;
    }
  }
}

TEST(NewYorkCity, NoPropStandsInABuilding) {
  const internal::Manhattan city = internal::PlanManhattan(PlanNewYorkCity(), {});
  for (const Placement& prop : NewYork().placements) {
    for (const BuildingPlan& building : city.buildings) {
      if (building.base > 0) continue;
      EXPECT_FALSE(building.bounds().Inset(0.05f).Contains({prop.p_W.x, prop.p_W.y}))
          << prop.kind << " " << prop.p_W.x << " " << prop.p_W.y;
    }
  }
}

TEST(Manhattan, IsAFunctionOfItsSeedAndTiersStandOnTheTierBelow) {
  const StreetPlan plan = PlanNewYorkCity();
  const internal::Manhattan a = internal::PlanManhattan(plan, {.seed = 3}), b = internal::PlanManhattan(plan, {.seed = 3}),
                            c = internal::PlanManhattan(plan, {.seed = 4});
  ASSERT_EQ(a.buildings.size(), b.buildings.size());
  bool differs = a.buildings.size() != c.buildings.size();
  for (size_t i = 0; i < a.buildings.size(); ++i) {
    EXPECT_EQ(a.buildings[i].outline, b.buildings[i].outline);
    EXPECT_EQ(a.buildings[i].floors, b.buildings[i].floors);
    if (i < c.buildings.size()) differs = differs || a.buildings[i].outline != c.buildings[i].outline;
    if (a.buildings[i].base == 0) continue;
    // Within the outline of the tier below, from its roof on.
    EXPECT_FLOAT_EQ(a.buildings[i].base, a.buildings[i - 1].height());
    EXPECT_EQ(a.buildings[i - 1].upper, a.buildings[i].outline);
    for (Vec2f p : a.buildings[i].outline) EXPECT_TRUE(a.buildings[i - 1].bounds().Contains(p));
  }
  EXPECT_TRUE(differs);
}

TEST(Manhattan, HousesAndTheirYardsKeepOffEachOther) {
  const internal::Manhattan city = internal::PlanManhattan(PlanNewYorkCity(), {.seed = 2});
  const auto meet = [](const GroundRect& a, const GroundRect& b) {
    return std::min(a.x1, b.x1) - std::max(a.x0, b.x0) > 0.02f && std::min(a.y1, b.y1) - std::max(a.y0, b.y0) > 0.02f;
  };
  EXPECT_GT(city.yards.size(), 50u);
  for (size_t i = 0; i < city.buildings.size(); ++i) {
    const BuildingPlan& a = city.buildings[i];
    EXPECT_EQ(a.edges.size(), a.outline.size());
    EXPECT_EQ(a.party_height.size(), a.outline.size());
    if (a.base > 0) continue;
    for (size_t k = i + 1; k < city.buildings.size(); ++k) {
      const BuildingPlan& b = city.buildings[k];
      if (b.block != a.block) break;
      EXPECT_FALSE(b.base == 0 && meet(a.bounds(), b.bounds())) << i << " " << k;
    }
    for (const internal::BackYard& yard : city.yards) EXPECT_FALSE(yard.block == a.block && meet(a.bounds(), yard.rect)) << i;
  }
}

// A wall is left out up to the neighbour's roof only where the neighbour stands: elsewhere one would look into the house.
TEST(Manhattan, NoWallIsHiddenWhereNoNeighbourStands) {
  const internal::Manhattan city = internal::PlanManhattan(PlanNewYorkCity(), {});
  for (const BuildingPlan& plan : city.buildings) {
    for (size_t e = 0; e < plan.edges.size(); ++e) {
      if (plan.edges[e] != EdgeKind::kParty || plan.party_height[e] <= plan.base) continue;
      const Vec2f a = plan.outline[e], v = plan.outline[(e + 1) % plan.outline.size()] - a;
      const Vec2f out = Vec2f{v.y, -v.x} * (0.5f / std::hypot(v.x, v.y));
      for (float t = 0.05f; t < 1; t += 0.1f) {
        const Vec2f p = a + v * t + out;
        EXPECT_TRUE(std::any_of(city.buildings.begin(), city.buildings.end(),
                                [&](const BuildingPlan& other) {
                                  return other.base == 0 && other.bounds().Contains(p) && other.height() >= plan.party_height[e] - 0.01f;
                                }))
            << p.x << " " << p.y;
      }
    }
  }
}

}  // namespace
}  // namespace airsim360
