#include "airsim360/app/dataset/collect_human.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

#include "airsim360/app/flags/arguments.h"
#include "airsim360/app/flags/session.h"
#include "airsim360/app/flags/world_flags.h"
#include "airsim360/base/choice.h"
#include "airsim360/base/error.h"
#include "airsim360/base/file.h"
#include "airsim360/base/log.h"
#include "airsim360/dataset/index.h"
#include "airsim360/dataset/people/human_splits.h"
#include "airsim360/dataset/record/rig_file.h"
#include "airsim360/worlds/worlds.h"

namespace airsim360 {
namespace {

namespace fs = std::filesystem;

bool Exists(const std::string& world) {
  if (fs::exists(world)) return true;
  const std::vector<WorldInfo>& infos = ListWorlds();
  return std::ranges::any_of(infos, [&](const WorldInfo& info) { return info.name == world; });
}

/// A world with what all its subsets share.
struct HumanWorld {
  std::shared_ptr<Stage> stage;
  std::shared_ptr<const NavMesh> mesh;
  std::vector<PlacedSubset> placed;  ///< all subsets of the world, made now or not
};

HumanWorld OpenHumanWorld(const std::string& name, std::span<const HumanSubset> subsets, const HumanRun& run,
                          const GlobalOptions& globals) {
  HumanWorld world;
  world.stage = std::make_shared<Stage>(StageOptionsOf(name, globals, run.environment));
  world.mesh = NavMesh::Build(world.stage->scene());
  std::vector<HumanSubset> of_world;
  std::ranges::copy_if(subsets, std::back_inserter(of_world), [&](const HumanSubset& subset) { return subset.world == name; });
  world.placed = PlaceSubsets(world.stage->scene(), *world.mesh, of_world, globals.seed);
  return world;
}

CollectResult CollectSubset(const HumanRun& run, const HumanRecipe& recipe, const HumanSubset& subset, const HumanArea& area,
                            const HumanWorld& world, uint64_t seed) {
  // The file that the people are made of is kept: the subset can be made again, or changed, by hand.
  const fs::path folder = fs::path(run.out) / subset.name;
  const fs::path people_file = folder.string() + ".people.yaml";
  CreateWritableFolder(folder);
  WriteFileAtomically(people_file, PeopleFileOf(area, subset.people));
  PeopleArguments people = run.people;
  people.people = people_file.string();
  PeopleRequest request = people.Request(PeopleSeedOf(subset, seed));
  request.navmesh = world.mesh;
  Stage stage(world.stage, request);

  DatasetSpec spec = run.spec;
  spec.world = subset.world;
  spec.seed = seed;
  spec.frames = subset.frames;
  char text[160];
  std::snprintf(text, sizeof text, "%s: %.1f x %.1f m, pitch %g", subset.name.c_str(), subset.width, subset.depth, subset.pitch_deg);
  spec.route = text;
  spec.people = std::to_string(subset.people) + " in the area";
  spec.environment = DescribeEnvironment(stage.environment());
  const Flight flight = FilmSubset(recipe, subset, area, *stage.people(), *world.stage->tracer(), seed);
  const CollectResult result = Collect(InputOf(stage, spec, flight, folder), stage.renderer(spec.tier));
  // What subsets.json says of it, also when other runs make the others.
  WriteFileAtomically(
      folder.string() + ".subset.json",
      nlohmann::ordered_json{{"split", subset.split}, {"area", {area.low.x, area.low.y, area.high.x, area.high.y}}}.dump() + "\n");
  return result;
}

// The recipe's rig, unless flags say what is looked through.
void TakeCameras(const HumanRecipe& recipe, HumanRun& run) {
  if (recipe.cameras.empty() || !run.spec.cameras.empty()) return;
  if (run.has_camera) throw InputError("--projection, --size, --fov: the recipe has cameras of its own; give --cameras, or leave them out");
  run.spec.cameras = ReadRigFile(recipe.cameras);
}

// The table as it was made: with splits and areas of the subsets that there are.
nlohmann::ordered_json ListOf(std::span<const HumanSubset> subsets, const fs::path& out) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const HumanSubset& subset : subsets) {
    nlohmann::ordered_json entry = {{"subset", subset.name},         {"world", subset.world},   {"exists", Exists(subset.world)},
                                    {"width", subset.width},         {"depth", subset.depth},   {"people", subset.people},
                                    {"pitch_deg", subset.pitch_deg}, {"frames", subset.frames}, {"split", subset.split}};
    const fs::path made = (out / subset.name).string() + ".subset.json";
    if (fs::exists(made)) entry.update(nlohmann::ordered_json::parse(ReadTextFile(made, 1 << 16)));
    list.push_back(entry);
  }
  return list;
}

// Of the recipe's subsets and worlds, if one is asked for.
void CheckChoice(const std::vector<HumanSubset>& subsets, const HumanRun& run) {
  std::vector<std::string> names, worlds;
  for (const HumanSubset& subset : subsets) {
    names.push_back(subset.name);
    if (std::ranges::count(worlds, subset.world) == 0) worlds.push_back(subset.world);
  }
  if (!run.subset.empty() && std::ranges::count(names, run.subset) == 0)
    throw InputError("--subset: " + UnknownChoiceMessage("subset", run.subset, names));
  if (!run.world.empty() && std::ranges::count(worlds, run.world) == 0)
    throw InputError("--world: " + UnknownChoiceMessage("world of the recipe", run.world, worlds));
}

}  // namespace

void CollectHumanSets(const HumanRun& run, const GlobalOptions& globals) {
  const std::vector<std::string> built_in = {"omni360-human"};
  const fs::path file = run.recipe;
  // A word without an ending is a name.
  if (!fs::exists(file) && !file.has_extension() && !file.has_parent_path()) ParseChoice("recipe", run.recipe, built_in, "--recipe");
  const HumanRecipe recipe = run.recipe == built_in.front() ? PaperHumanRecipe() : ReadHumanRecipe(run.recipe);
  std::vector<HumanSubset> subsets = SubsetsOf(recipe);
  CheckChoice(subsets, run);
  HumanRun one = run;
  one.spec.shard = 0, one.spec.shards = 1;
  TakeCameras(recipe, one);
  CreateWritableFolder(run.out);

  std::map<std::string, HumanWorld> worlds;
  if (run.frames > 0) {
    for (HumanSubset& subset : subsets) subset.frames = std::min(subset.frames, run.frames);
  }
  int64_t frames = 0, written = 0, skipped = 0, people = 0;
  PeopleTotals seen;
  for (size_t i = 0; i < subsets.size(); ++i) {
    const HumanSubset& subset = subsets[i];
    const bool wanted = (run.subset.empty() || run.subset == subset.name) && (run.world.empty() || run.world == subset.world) &&
                        static_cast<int64_t>(i) % run.spec.shards == run.spec.shard;
    if (!wanted) continue;
    if (!Exists(subset.world)) {
      ++skipped;
      continue;
    }
    if (!worlds.contains(subset.world)) {
      worlds.clear();  // one world at a time
      worlds[subset.world] = OpenHumanWorld(subset.world, subsets, run, globals);
    }
    const HumanWorld& world = worlds.at(subset.world);
    const PlacedSubset& placed = *std::ranges::find(world.placed, subset.name, [](const PlacedSubset& p) { return p.subset.name; });
    LogInfo(subset.name + ": " + std::to_string(subset.frames) + " frames, " + std::to_string(subset.people) + " people");
    const CollectResult result = CollectSubset(one, recipe, placed.subset, placed.area, world, globals.seed);
    frames += result.frames;
    written += result.written;
    const PeopleTotals totals = DatasetIndex(fs::path(run.out) / subset.name, DatasetIndex::Mode::kRead).CountPeople();
    people += static_cast<int64_t>(subset.people);
    seen.persons_seen += totals.persons_seen;
    seen.persons_large += totals.persons_large;
  }
  WriteFileAtomically(fs::path(run.out) / "subsets.json", ListOf(subsets, run.out).dump(1) + "\n");
  if (globals.json) {
    PrintJson({{"out", run.out},
               {"subsets", subsets.size()},
               {"subsets_without_world", skipped},
               {"frames", frames},
               {"frames_written", written},
               {"people", people},
               {"people_seen", seen.persons_seen},
               {"people_seen_100px", seen.persons_large}});
    return;
  }
  std::printf("%s: %lld frames (%lld written now); %lld subsets wait for their worlds\n", run.out.c_str(), static_cast<long long>(frames),
              static_cast<long long>(written), static_cast<long long>(skipped));
  std::printf("people: %lld of %lld have pixels, %lld of them %lld or more in some picture\n", static_cast<long long>(seen.persons_seen),
              static_cast<long long>(people), static_cast<long long>(seen.persons_large), static_cast<long long>(kLargePerson));
}

}  // namespace airsim360
