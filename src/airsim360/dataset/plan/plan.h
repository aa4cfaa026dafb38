// A dataset before it is made: a recipe, a seed, and what the worlds were when it was planned. Frame i is a pure function of
// the plan and i.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "airsim360/dataset/plan/recipe.h"
#include "airsim360/scene/environment.h"
#include "airsim360/scene/semantics.h"

namespace airsim360 {

/// What a plan knows of a world, so that every machine uses the same one.
struct WorldFacts {
  std::string hash;  ///< SHA-256 of the scene with its world seed; empty: the world did not exist
  int64_t entities = 0;
  int64_t triangles = 0;
  std::vector<std::string> categories;    ///< paths of those that its entities have
  std::vector<std::string> attributions;  ///< Scene::attributions

  bool exists() const { return !hash.empty(); }
};

/// A category that few viewpoints see, and the share of frames that are placed to see it.
struct Aim {
  std::string category;
  double share = 0;
};

struct DatasetPlan {
  Recipe recipe;
  uint64_t seed = 0;
  std::map<std::string, WorldFacts> worlds;      ///< by WorldKey
  std::map<std::string, std::vector<Aim>> aims;  ///< by row; of rows of viewpoints
  std::string hash;                              ///< of everything above and the format

  int64_t frames() const { return recipe.frames(); }
  const WorldFacts& facts(const RecipeRow& row) const;
};
inline constexpr char kPlanFormat[] = "airsim360-plan-1";

/// Name of a row's world in the plan: with its seed, unless that is 0.
std::string WorldKey(const RecipeRow& row);

/// The file of a plan, with its hash; ends with a line feed.
std::string PlanJson(const DatasetPlan& plan);
/// Fills `hash`.
void SealPlan(DatasetPlan& plan);
/// InputError if it is no plan, of another format, or was edited (its hash is not that of its content).
DatasetPlan ReadPlan(const std::filesystem::path& file);
/// The same from memory; `name` stands for the file in messages.
DatasetPlan ParsePlan(std::string_view text, const std::string& name);
/// Whether a file looks like a plan rather than a recipe.
bool IsPlanFile(const std::filesystem::path& file);

/// Where a frame is in its plan.
struct FramePlace {
  size_t row = 0;
  int64_t in_row = 0;  ///< index in the row
};
FramePlace PlaceOf(const DatasetPlan& plan, int64_t frame);
/// First frame of a row.
int64_t FirstFrame(const DatasetPlan& plan, size_t row);

/// Frames of one row that follow one another under one sky.
struct FrameBlock {
  size_t row = 0;
  int64_t number = 0;            ///< in the row
  int64_t first = 0, count = 0;  ///< frames of the plan
  uint64_t seed = 0;             ///< of its frames' noise and samples
};
FrameBlock BlockOf(const DatasetPlan& plan, int64_t frame);

/// What the frames of a block share.
struct PlannedSky {
  Environment environment;
  double exposure_ev = 0;  ///< stops on top of those of the picture
};
/// The sky of a block, drawn from its row's mixture over the world's own.
PlannedSky SkyOf(const DatasetPlan& plan, const FrameBlock& block, const Environment& world);

/// Frames whose worlds exist, ascending, as [first, last) runs.
std::vector<std::pair<int64_t, int64_t>> RunsThatExist(const DatasetPlan& plan);
/// The frames of shard `index` of `count`: of all frames whose worlds exist, in order, an even part that follow one another,
/// so that a shard opens few worlds and skies.
std::vector<int64_t> FramesOfShard(const DatasetPlan& plan, int64_t index, int64_t count);

/// Ids that a person has at most: the body and what it can carry.
inline constexpr int64_t kEntitiesOfPerson = 5;

/// Where the entity ids of a world and of a row's people begin in a dataset of the plan.
struct EntityBase {
  int64_t world = 0;   ///< added to ids of the world's own entities
  int64_t people = 0;  ///< added to the number of an entity of people, from 0, gives the id less one
};
EntityBase EntityBaseOf(const DatasetPlan& plan, size_t row);
/// Number of ids of a dataset of the plan.
int64_t EntityCount(const DatasetPlan& plan);

}  // namespace airsim360
