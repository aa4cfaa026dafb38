// Splits of Omni360-Human share nothing, and what shares something is found.
#include "airsim360/dataset/people/human_splits.h"

#include <gtest/gtest.h>

#include <set>

#include "airsim360/base/error.h"
#include "airsim360/base/file.h"
#include "airsim360/opening/world_loader.h"
#include "airsim360/people/navigation/test_ground.h"
#include "airsim360/sim/people/populate.h"

namespace airsim360 {
namespace {

namespace fs = std::filesystem;

HumanRecipe OneScene(uint64_t subsets) {
  HumanRecipe recipe;
  recipe.scenes = {{.scene = "lot",
                    .world = "lot",
                    .subsets = subsets,
                    .least_width = 10,
                    .least_depth = 10,
                    .most_width = 16,
                    .most_depth = 16,
                    .least_people = 3,
                    .most_people = 6,
                    .frames = 100}};
  return recipe;
}

bool Near(const HumanArea& a, const HumanArea& b) {
  return a.low.x < b.high.x + kSplitGap && b.low.x < a.high.x + kSplitGap && a.low.y < b.high.y + kSplitGap &&
         b.low.y < a.high.y + kSplitGap;
}

TEST(HumanSplits, TrainAndTestOfThePapersTableHaveEveryPitch) {
  std::set<std::pair<std::string, double>> kinds;
  int64_t test = 0, all = 0;
  for (const HumanSubset& subset : SubsetsOf(PaperHumanRecipe())) {
    kinds.emplace(subset.split, subset.pitch_deg);
    all += subset.frames;
    test += subset.split == "test" ? subset.frames : 0;
  }
  for (const char* split : {"train", "test"}) {
    for (const double pitch : {0, 20, 45}) EXPECT_TRUE(kinds.contains({split, pitch})) << split << " " << pitch;
  }
  EXPECT_NEAR(static_cast<double>(test) / static_cast<double>(all), 0.2, 0.05);
}

TEST(HumanSplits, PlacesOfDifferentSplitsAreApart) {
  internal::TestGround ground;
  ground.Floor("ground/pavement", -60, -60, 60, 60);
  const auto scene = ground.Build();
  const auto mesh = NavMesh::Build(*scene);
  const std::vector<HumanSubset> subsets = SubsetsOf(OneScene(10));
  const std::vector<PlacedSubset> placed = PlaceSubsets(*scene, *mesh, subsets, 5);
  ASSERT_EQ(placed.size(), subsets.size());
  for (size_t i = 0; i < placed.size(); ++i) {
    EXPECT_EQ(placed[i].subset.name, subsets[i].name);
    EXPECT_EQ(placed[i].subset.split, subsets[i].split);
    for (size_t k = 0; k < i; ++k) {
      if (placed[i].subset.split == placed[k].subset.split) continue;
      EXPECT_FALSE(Near(placed[i].area, placed[k].area)) << i << " " << k;
    }
  }
  EXPECT_NE(PeopleSeedOf(subsets[0], 1), PeopleSeedOf(subsets[1], 1));
}

TEST(HumanSplits, ASubsetWithoutAPlaceOfItsOwnIsInNoSplit) {
  internal::TestGround ground;
  ground.Floor("ground/pavement", -9, -9, 9, 9);  // room for one
  const auto scene = ground.Build();
  const auto mesh = NavMesh::Build(*scene);
  const std::vector<HumanSubset> subsets = SubsetsOf(OneScene(5));
  int in_splits = 0;
  for (const PlacedSubset& placed : PlaceSubsets(*scene, *mesh, subsets, 5)) in_splits += placed.subset.split != "none";
  EXPECT_GE(in_splits, 1);
  EXPECT_LT(in_splits, 5);
}

TEST(HumanSplits, AMovingCameraFliesStraightThroughFreeAir) {
  HumanRecipe recipe = PaperHumanRecipe();
  recipe.highest = 3, recipe.frames_a_view = 3, recipe.interval = 0.2;
  const HumanSubset subset{.world = "box_room", .name = "box_room/01", .width = 8, .depth = 8, .people = 3, .frames = 12};
  const auto scene = LoadWorld({.world = "box_room"});
  const auto mesh = NavMesh::Build(*scene);
  const HumanArea area = PickArea(*scene, *mesh, subset, 1);
  const PopulatedScene populated = Populate(scene, {.count = 3, .warm_up = 0, .level = 2, .seed = 1, .navmesh = mesh});
  const RayTracer world(scene);
  const Flight flight = FilmSubset(recipe, subset, area, *populated.people, world, 1);
  int moving = 0;
  for (size_t i = 0; i < flight.shots.size(); ++i) {
    const Kinematics& body = flight.shots[i].body;
    EXPECT_GE(world.Clearance(VecCast<float>(body.X_WB.p), 2), 0.95);
    if (i % 3 == 0) {
      moving += Norm(body.v_WB) > 0;
      continue;
    }
    EXPECT_LT(Norm(body.X_WB.p - flight.shots[i - 1].body.X_WB.p - body.v_WB * 0.2), 1e-9);
  }
  EXPECT_GE(moving, 1);
  EXPECT_LE(moving, 2);  // half of the four views
}

std::string Line(int64_t t_ns, double stature) {
  return "{\"t_ns\":" + std::to_string(t_ns) +
         ",\"persons\":[{\"track_id\":1,\"character\":\"procedural\",\"stature_m\":" + std::to_string(stature) +
         ",\"age\":30,\"sex\":\"male\",\"outfit\":\"shirt\"}]}\n";
}

TEST(HumanSplits, WhatSplitsShareIsFound) {
  const fs::path folder = fs::temp_directory_path() / "airsim360_human_splits";
  const auto write = [&](const std::string& second_area, double second_stature) {
    for (const char* name : {"w/01", "w/02"}) fs::create_directories(folder / name);
    WriteFileAtomically(folder / "w/01/people.jsonl", Line(0, 1.7) + Line(1'500'000'000, 1.7));
    WriteFileAtomically(folder / "w/02/people.jsonl", Line(0, second_stature));
    WriteFileAtomically(folder / "subsets.json",
                        "[{\"subset\":\"w/01\",\"world\":\"w\",\"split\":\"train\",\"area\":[0,0,10,10]},"
                        "{\"subset\":\"w/02\",\"world\":\"w\",\"split\":\"test\",\"area\":" +
                            second_area +
                            "},"
                            "{\"subset\":\"w/03\",\"world\":\"w\",\"split\":\"test\"}]");
    return FindSplitLeaks(folder);
  };
  const SplitLeaks clean = write("[30,0,40,10]", 1.8);
  EXPECT_TRUE(clean.ok()) << clean.example;
  ASSERT_EQ(clean.splits.size(), 2u);
  EXPECT_EQ(clean.splits[1].pictures, 2);  // train after test
  EXPECT_EQ(write("[12,0,22,10]", 1.8).places, 1);
  EXPECT_EQ(write("[30,0,40,10]", 1.7).characters, 1);
  EXPECT_THROW(write("\"near\"", 1.7), InputError);
  WriteFileAtomically(folder / "subsets.json", std::string("{"));
  EXPECT_THROW(FindSplitLeaks(folder), InputError);
  fs::remove_all(folder);
}

}  // namespace
}  // namespace airsim360
