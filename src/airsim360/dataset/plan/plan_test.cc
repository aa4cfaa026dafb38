#include "airsim360/dataset/plan/plan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <numeric>
#include <set>

#include "airsim360/base/error.h"
#include "airsim360/base/file.h"
#include "airsim360/dataset/plan/cluster_jobs.h"
#include "airsim360/dataset/plan/plan_labels.h"

namespace airsim360 {
namespace {

// The paper's recipe with worlds as if they were there; sf_city is not.
DatasetPlan ScenePlan(uint64_t seed = 3) {
  DatasetPlan plan;
  plan.recipe = FindRecipe("omni360-scene"), plan.seed = seed;
  for (const RecipeRow& row : plan.recipe.rows) {
    WorldFacts& world = plan.worlds[WorldKey(row)];
    if (row.world == "sf_city") continue;
    world.hash = std::string(64, row.world[0] == 'c' ? 'c' : 'd');
    world.entities = 100 + static_cast<int64_t>(row.world.size());
    world.categories = {"sky", "construction/building"};
  }
  plan.aims["city_park"] = {{"sky", 0.045}};
  SealPlan(plan);
  return plan;
}

TEST(Recipe, ScalingKeepsProportionsAndTheTotal) {
  for (const int64_t frames : {4, 5, 100, 1999, 61'000, 1'000'000}) {
    const Recipe scaled = Scaled(FindRecipe("omni360-scene"), frames);
    EXPECT_EQ(scaled.frames(), frames);
    for (size_t i = 0; i < scaled.rows.size(); ++i) {
      const double exact = static_cast<double>(FindRecipe("omni360-scene").rows[i].frames) / 61'000 * static_cast<double>(frames);
      EXPECT_NEAR(static_cast<double>(scaled.rows[i].frames), exact, 2) << frames;
      EXPECT_GE(scaled.rows[i].frames, 1u);
    }
  }
  EXPECT_THROW(Scaled(FindRecipe("omni360-scene"), 3), InputError);
}

TEST(Recipe, TheHumanRecipeIsThePapersTable) {
  const Recipe recipe = FindRecipe("omni360-human");
  EXPECT_EQ(recipe.rows.size(), 61u);
  EXPECT_EQ(recipe.frames(), 100'700);
  EXPECT_EQ(WithWorlds(recipe, {"rome"}).frames(), 20'500);
  EXPECT_EQ(WithWorlds(recipe, {"new_york_city", "roof"}).rows.size(), 21u);
}

TEST(Plan, ItsFileReadsBackAsTheSamePlanAndNothingElse) {
  const DatasetPlan plan = ScenePlan();
  const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / "airsim360_plan_test.json";
  WriteFileAtomically(file, PlanJson(plan));
  EXPECT_EQ(PlanJson(ReadPlan(file)), PlanJson(plan));
  EXPECT_LT(PlanJson(plan).size(), 20'000u);
  for (const auto& [from, to] : {std::pair{"25600", "25601"}, {"\"seed\": 3", "\"seed\": 4"}, {"0.045", "0.046"}, {"cccc", "cccd"}}) {
    std::string text = PlanJson(plan);
    ASSERT_NE(text.find(from), std::string::npos);
    WriteFileAtomically(file, text.replace(text.find(from), std::string(from).size(), to));
    EXPECT_THROW(ReadPlan(file), InputError) << from;
  }
  std::filesystem::remove(file);
}

TEST(Plan, ItsHashChangesWithEverythingInIt) {
  std::set<std::string> hashes = {ScenePlan(3).hash, ScenePlan(4).hash};
  DatasetPlan plan = ScenePlan(3);
  EXPECT_TRUE(hashes.contains(plan.hash));
  plan.recipe.rows[0].highest = 119;
  SealPlan(plan);
  hashes.insert(plan.hash);
  plan.worlds["sf_city"].hash = std::string(64, 'e');
  SealPlan(plan);
  hashes.insert(plan.hash);
  plan.recipe.skies[0].choices[0].weight += 0.5;
  SealPlan(plan);
  hashes.insert(plan.hash);
  EXPECT_EQ(hashes.size(), 5u);
}

TEST(Plan, ShardsDivideTheFramesThatCanBeMade) {
  const DatasetPlan plan = ScenePlan();
  const std::vector<int64_t> all = FramesOfShard(plan, 0, 1);
  EXPECT_EQ(all.size(), 61'000u - 22'000u);
  for (const int64_t count : {1, 2, 7, 1000, 50'000}) {
    std::vector<int64_t> together;
    for (int64_t i = 0; i < count; ++i) {
      const std::vector<int64_t> shard = FramesOfShard(plan, i, count);
      EXPECT_LE(std::abs(static_cast<int64_t>(shard.size()) - static_cast<int64_t>(all.size()) / count), 1);
      together.insert(together.end(), shard.begin(), shard.end());
    }
    EXPECT_EQ(together, all) << count;
  }
}

TEST(Plan, BlocksDivideEveryRowAndFramesOfABlockShareItsSky) {
  const DatasetPlan plan = ScenePlan();
  std::set<std::string> skies;
  int64_t blocks = 0;
  for (int64_t frame = 0; frame < plan.frames(); ++blocks) {
    const FrameBlock block = BlockOf(plan, frame);
    ASSERT_EQ(block.first, frame);
    EXPECT_EQ(BlockOf(plan, frame + block.count - 1).first, frame);
    EXPECT_EQ(BlockOf(plan, frame + block.count - 1).seed, block.seed);
    EXPECT_EQ(PlaceOf(plan, frame + block.count - 1).row, block.row);
    skies.insert(DescribeEnvironment(SkyOf(plan, block, {}).environment));
    frame += block.count;
  }
  // Nearly every block has a sky of its own.
  EXPECT_GT(static_cast<int64_t>(skies.size()), blocks * 9 / 10);
  EXPECT_THROW(PlaceOf(plan, plan.frames()), InputError);
  EXPECT_THROW(PlaceOf(plan, -1), InputError);
}

TEST(Plan, SkiesAreDrawnByTheirWeightsAndWithinTheirRanges) {
  DatasetPlan plan = ScenePlan();
  plan.recipe.skies = {
      {"varied", 1, {{.weight = 3, .weather = "clear", .settings = {{"turbidity", 2, 6}}}, {.weather = "overcast", .settings = {}}}}};
  int overcast = 0;
  double turbidity = 0;
  constexpr int kFrames = 4000;
  for (int64_t frame = 0; frame < kFrames; ++frame) {
    const Environment sky = SkyOf(plan, BlockOf(plan, frame), {}).environment;
    if (sky.cloud_cover == 1) {
      ++overcast;
      continue;
    }
    EXPECT_GE(sky.turbidity, 2);
    EXPECT_LE(sky.turbidity, 6);
    turbidity += sky.turbidity;
  }
  EXPECT_NEAR(overcast / double{kFrames}, 0.25, 0.03);
  EXPECT_NEAR(turbidity / (kFrames - overcast), 4, 0.1);
}

TEST(Plan, ExposureIsDrawnWithTheSkyAndLeavesItAsItIs) {
  DatasetPlan plan = ScenePlan();
  plan.recipe.picture.settings.auto_exposure = false;
  plan.recipe.skies = {{"varied", 1, {{.weather = "clear", .settings = {{"turbidity", 2, 6}}}}}};
  DatasetPlan exposed = plan;
  exposed.recipe.skies[0].choices[0].settings.push_back({"exposure", -1.5, 0.5});
  double sum = 0;
  constexpr int kFrames = 2000;
  for (int64_t frame = 0; frame < kFrames; ++frame) {
    const PlannedSky sky = SkyOf(plan, BlockOf(plan, frame), {}), same = SkyOf(exposed, BlockOf(exposed, frame), {});
    EXPECT_EQ(sky.exposure_ev, 0);
    EXPECT_EQ(DescribeEnvironment(same.environment), DescribeEnvironment(sky.environment));
    EXPECT_GE(same.exposure_ev, -1.5);
    EXPECT_LE(same.exposure_ev, 0.5);
    EXPECT_EQ(SkyOf(exposed, BlockOf(exposed, frame), {}).exposure_ev, same.exposure_ev);
    sum += same.exposure_ev;
  }
  EXPECT_NEAR(sum / kFrames, -0.5, 0.05);
  // Not both: each picture's own exposure and one that is drawn. A photo is metered, and the stops come on top.
  exposed.recipe.picture.settings.auto_exposure = true;
  EXPECT_THROW(CheckRecipe(exposed.recipe, "r.yaml"), InputError);
  exposed.recipe.picture.settings.look = Look::kPhoto;
  EXPECT_NO_THROW(CheckRecipe(exposed.recipe, "r.yaml"));
}

TEST(Plan, EntitiesOfWorldsAndOfPeopleHaveIdsOfTheirOwn) {
  DatasetPlan plan = ScenePlan();
  plan.recipe.rows[0].people = 5;
  plan.recipe.rows.push_back(plan.recipe.rows[0]);
  plan.recipe.rows.back().name = "again";
  plan.recipe.rows.back().people = 7;
  const PlanLabels labels(plan);
  std::set<EntityId> ids;
  for (const size_t row : {0, 1, 3, 4}) {
    const auto renumber = labels.Renumbering(row);
    const auto own = static_cast<EntityId>(plan.facts(plan.recipe.rows[row]).entities);
    // Row 4 shows the things of row 0, but other people.
    if (row == 4) {
      EXPECT_EQ(renumber(1), labels.Renumbering(0)(1));
    }
    for (EntityId id = row == 4 ? own + 1 : 1; id <= own + kEntitiesOfPerson * plan.recipe.rows[row].people; ++id)
      EXPECT_TRUE(ids.insert(renumber(id)).second);
  }
  EXPECT_EQ(static_cast<int64_t>(ids.size()), EntityCount(plan));
  EXPECT_EQ(*ids.begin(), 1u);
  EXPECT_EQ(static_cast<int64_t>(*ids.rbegin()), EntityCount(plan));
}

TEST(ClusterScript, QuotesWhatAShellWouldTakeApart) {
  const ClusterJob job{.name = "My set!",
                       .hash = std::string(64, 'a'),
                       .program = "/opt/it's/airsim360",
                       .plan = "/a b/plan.json",
                       .out = "/out $HOME",
                       .flags = {},
                       .shards = 12,
                       .remote = {},
                       .image = "a\"b",
                       .claim = "c",
                       .secret = {},
                       .plan_text = {}};
  const std::string slurm = ClusterScript(ClusterBackend::kSlurm, job);
  EXPECT_NE(slurm.find("--job-name=my-set\n"), std::string::npos);
  EXPECT_NE(slurm.find("--array=0-11\n"), std::string::npos);
  EXPECT_NE(slurm.find(R"(PROGRAM='/opt/it'\''s/airsim360' PLAN='/a b/plan.json' OUT='/out $HOME')"), std::string::npos);
  const std::string kubernetes = ClusterScript(ClusterBackend::kKubernetes, job);
  EXPECT_NE(kubernetes.find("completions: 12\n"), std::string::npos);
  EXPECT_NE(kubernetes.find(R"(image: "a\"b")"), std::string::npos);
  for (const ClusterBackend backend : {ClusterBackend::kSlurm, ClusterBackend::kKubernetes, ClusterBackend::kXargs})
    EXPECT_EQ(ClusterScript(backend, job).find('@', 0) == std::string::npos, true) << ClusterScript(backend, job);
}

}  // namespace
}  // namespace airsim360
