// Towns of the town maker as scenes: what must be in them, what is never in pictures of them.
#include <gtest/gtest.h>

#include <map>
#include <memory>
#include <set>
#include <string>

#include "airsim360/base/random.h"
#include "airsim360/render/renderer.h"
#include "airsim360/scene/scene_archive.h"
#include "airsim360/trace/ray_tracer.h"
#include "airsim360/worlds/town_maker/town_build.h"

namespace airsim360 {
namespace {

using internal::BuildTownScene;

// A named town cut down to what builds fast.
TownSpec Small(std::string_view name) {
  TownSpec spec = internal::NamedTown(name);
  spec.width = 230;
  spec.depth = 220;
  spec.climb = std::min(spec.climb, 24.0);
  spec.squares = std::min<uint64_t>(spec.squares, 1);
  return spec;
}

std::map<std::string, int> CategoriesOf(const Scene& scene) {
  std::map<std::string, int> counts;
  for (const Entity& entity : scene.entities) ++counts[scene.tree[entity.category].path];
  return counts;
}

// Frames of labels at free places over the town.
long UnlabelledPixels(const std::shared_ptr<const Scene>& scene, const TownSpec& spec) {
  const auto tracer = std::make_shared<const RayTracer>(scene);
  const auto renderer = MakeCpuRenderer(tracer, {.tier = Tier::kLabels});
  RngStream rng(3, "poses");
  long unlabelled = 0;
  Frame frame;
  for (int made = 0, tries = 0; made < 8 && tries < 400; ++tries) {
    const Vec3f p{static_cast<float>(rng.Uniform(-0.5, 0.5) * spec.width), static_cast<float>(rng.Uniform(-0.5, 0.5) * spec.depth),
                  static_cast<float>(rng.Uniform(-10, 60))};
    if (tracer->Clearance(p, 1) < 1 || !tracer->Intersect(p, {0, 0, -1})) continue;
    ++made;
    RenderRequest request;
    request.camera = Equirectangular{256, 128};
    request.X_WC = BodyPose({p.x, p.y, p.z}, 0, 0, 0) * CameraInBody();
    request.tier = Tier::kLabels;
    renderer->Render(request, frame);
    for (int y = 0; y < 128; ++y)
      for (int x = 0; x < 256; ++x) unlabelled += frame.semantic(x, y) == kVoid || frame.entity(x, y) == kNoEntity;
  }
  return unlabelled;
}

struct Expected {
  const char* town;
  std::vector<const char*> categories;
};

TEST(NamedTowns, HaveWhatTheyAreKnownForAndLabelsEverywhere) {
  const Expected rows[] = {
      {"downtown_city", {"vehicle/car", "traffic/control/traffic_light", "furniture/shade/umbrella", "construction/building/backdrop"}},
      {"lisbon_downtown", {"vehicle/tram", "furniture/utility/wire", "ground/rail", "furniture/table/dining_table"}},
      {"rome", {"construction/column", "vegetation/tree/conifer/cypress", "furniture/vending/food_stall", "construction/building/part"}},
      {"roof", {"construction/rooftop/water_tank", "ground/floor", "barrier/railing/rail", "furniture/planter/pot"}},
      {"rural_cabins", {"vegetation/tree/conifer/pine", "vehicle/boat", "construction/bridge", "nature/mountain"}}};
  for (const Expected& row : rows) {
    const TownSpec spec = Small(row.town);
    const auto scene = BuildTownScene(row.town, spec, {});
    const std::map<std::string, int> counts = CategoriesOf(*scene);
    for (const char* category : row.categories) EXPECT_TRUE(counts.contains(category)) << row.town << ": " << category;
    EXPECT_GE(counts.at("construction/building"), 8) << row.town;
    EXPECT_EQ(UnlabelledPixels(scene, spec), 0) << row.town;
    ASSERT_TRUE(scene->spawn) << row.town;
    if (!spec.terrace) continue;
    // The roof begins on its deck, high over the streets.
    const auto below = RayTracer(scene).Intersect(*scene->spawn, {0, 0, -1});
    ASSERT_TRUE(below);
    EXPECT_NEAR(below->distance, 1.7, 0.1);
    EXPECT_GT(scene->spawn->z, 20);
  }
}

TEST(Towns, AreTheSameBytesEachTime) {
  TownSpec spec = Small("rome");
  spec.width = spec.depth = 140;
  EXPECT_EQ(ArchiveScene(*BuildTownScene("town", spec, {.seed = 4})), ArchiveScene(*BuildTownScene("town", spec, {.seed = 4})));
}

}  // namespace
}  // namespace airsim360
