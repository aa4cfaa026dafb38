// The recipe of Omni360-Human.
#include <gtest/gtest.h>

#include "airsim360/base/error.h"
#include "airsim360/base/file.h"
#include "airsim360/dataset/people/human_set.h"
#include "airsim360/sim/people/populate.h"
#include "airsim360/sim/world_loader.h"

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
  }
}

TEST(HumanRecipe, ASubsetIsFilmedInFreeSpaceWithItsPeople) {
  HumanRecipe recipe = PaperHumanRecipe();
  recipe.highest = 4;
  recipe.frames_a_view = 2;
  HumanSubset subset{.world = "box_room", .name = "box_room/01", .width = 8, .depth = 10, .people = 4, .pitch_deg = 20, .frames = 4};
  const auto scene = LoadWorld({.world = "box_room"});
  const auto mesh = NavMesh::Build(*scene);
  const HumanArea area = PickArea(*mesh, subset, 1);
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
  EXPECT_THROW(PickArea(*mesh, subset, 1), InputError);
}

}  // namespace
}  // namespace airsim360
