// The recipe of Omni360-Human.
#include <gtest/gtest.h>

#include "airsim360/base/error.h"
#include "airsim360/base/file.h"
#include "airsim360/dataset/people/human_set.h"
#include "airsim360/opening/world_loader.h"
#include "airsim360/people/navigation/test_ground.h"
#include "airsim360/sim/people/populate.h"

namespace airsim360 {
namespace {

TEST(HumanRecipe, ThePapersTableHasItsTotals) {
  const std::vector<HumanSubset> subsets = SubsetsOf(PaperHumanRecipe());
  EXPECT_EQ(subsets.size(), 61u);
  int64_t frames = 0;
  for (const HumanSubset& subset : subsets) frames += subset.frames;
  EXPECT_EQ(frames, 100'700);
  EXPECT_EQ(subsets.front().people, 15u);
  EXPECT_EQ(subsets[13].people, 45u);
  EXPECT_EQ(subsets.back().width, 50);
  EXPECT_EQ(subsets.back().depth, 30);
  EXPECT_EQ(subsets[1].pitch_deg, 20);
}

TEST(HumanRecipe, TheFileOfTheRepositoryIsTheBuiltInOne) {
  const auto file = SubsetsOf(ReadHumanRecipe("data/omni360_human.yaml")), built_in = SubsetsOf(PaperHumanRecipe());
  ASSERT_EQ(file.size(), built_in.size());
  for (size_t i = 0; i < file.size(); ++i) {
    EXPECT_EQ(file[i].name, built_in[i].name);
    EXPECT_EQ(file[i].width, built_in[i].width);
    EXPECT_EQ(file[i].people, built_in[i].people);
    EXPECT_EQ(file[i].frames, built_in[i].frames);
    EXPECT_EQ(file[i].pitch_deg, built_in[i].pitch_deg);
    EXPECT_EQ(file[i].split, built_in[i].split);
  }
  EXPECT_EQ(ReadHumanRecipe("data/omni360_human.yaml").moving, PaperHumanRecipe().moving);
}

TEST(HumanRecipe, ARigIsFoundBesideItsRecipe) {
  EXPECT_EQ(ReadHumanRecipe("data/omni360_human_rigs.yaml").cameras, "data/rigs/pedestrian_rig.yaml");
}

TEST(HumanRecipe, ASubsetIsFilmedInFreeSpaceWithItsPeople) {
  HumanRecipe recipe = PaperHumanRecipe();
  recipe.highest = 4;
  recipe.frames_a_view = 2;
  HumanSubset subset{.world = "box_room", .name = "box_room/01", .width = 8, .depth = 10, .people = 4, .pitch_deg = 20, .frames = 4};
  const auto scene = LoadWorld({.world = "box_room"});
  const auto mesh = NavMesh::Build(*scene);
  const HumanArea area = PickArea(*scene, *mesh, subset, 1);
  EXPECT_NEAR(area.high.x - area.low.x, 8, 1e-9);
  const PopulatedScene populated = Populate(scene, {.count = 4, .warm_up = 0, .level = 2, .seed = 1, .navmesh = mesh});
  const RayTracer world(scene);
  const Flight flight = FilmSubset(recipe, subset, area, *populated.people, world, 1);
  ASSERT_EQ(flight.shots.size(), 4u);
  for (const Shot& shot : flight.shots) {
    EXPECT_GE(world.Clearance(VecCast<float>(shot.body.X_WB.p), 2), 1);
    EXPECT_NEAR(std::asin(shot.body.X_WB.R.m[2][0]), -20 * 3.14159265 / 180, 1e-6);
    EXPECT_EQ(shot.people->crowd.t_ns, shot.t_ns);
  }
  EXPECT_NE(flight.shots[0].body.X_WB.p.x, flight.shots[2].body.X_WB.p.x);
  // Too many for the place.
  subset.people = 400;
  EXPECT_THROW(PickArea(*scene, *mesh, subset, 1), InputError);
}

// A pillar as wide as a hut stands in the middle of the area, and nothing sees inside of it.
TEST(HumanRecipe, AnAreaWhoseMiddleIsBuiltOverIsFilmedAllTheSame) {
  internal::TestGround ground;
  ground.builder().AddSky();
  ground.Floor("ground/pavement", -12, -12, 12, 12);
  ground.Box("construction/building", {-3, -3, 0}, {3, 3, 9});
  const auto scene = ground.Build();
  const auto mesh = NavMesh::Build(*scene);
  const HumanRecipe recipe = PaperHumanRecipe();
  const HumanSubset subset{.world = "lot", .name = "lot/01", .width = 16, .depth = 16, .people = 12, .frames = 2};
  const PopulatedScene populated = Populate(scene, {.count = 12, .warm_up = 0, .level = 2, .seed = 1, .navmesh = mesh});
  const RayTracer world(scene);
  const HumanArea area{{-8, -8}, {8, 8}, 0};
  for (uint64_t seed = 0; seed < 3; ++seed) {
    const Flight flight = FilmSubset(recipe, subset, area, *populated.people, world, seed);
    ASSERT_EQ(flight.shots.size(), 2u);
    for (const Shot& shot : flight.shots) EXPECT_GE(world.Clearance(VecCast<float>(shot.body.X_WB.p), 2), 1);
  }
}

// A bare lot, and a corner of it where a street has its things.
TEST(HumanRecipe, PlacesAreWhereThingsStand) {
  internal::TestGround ground;
  ground.Floor("ground/pavement", -60, -60, 60, 60);
  const char* things[] = {"traffic/temporary/cone",
                          "furniture/waste/trash_can",
                          "furniture/seating/bench",
                          "furniture/mail/post_box",
                          "furniture/utility/fire_hydrant",
                          "signage/poster_stand",
                          "vehicle/car",
                          "furniture/lighting/street_light"};
  for (int i = 0; i < 8; ++i) {
    const float x = 30.0f + 3 * static_cast<float>(i);
    ground.Box(things[i], {x, 40, 0}, {x + 0.5f, 40.5f, 1});
  }
  const auto scene = ground.Build();
  const auto mesh = NavMesh::Build(*scene);
  for (uint64_t seed = 0; seed < 5; ++seed) {
    const HumanArea area = PickArea(*scene, *mesh, {.world = "lot", .name = "lot/01", .width = 12, .depth = 12, .people = 8}, seed);
    EXPECT_GT(area.high.x, 15) << seed;
    EXPECT_GT(area.high.y, 25) << seed;
  }
}

}  // namespace
}  // namespace airsim360
