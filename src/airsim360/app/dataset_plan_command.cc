// airsim360 dataset plan: a plan of a recipe, and what its frames are.
#include "airsim360/app/dataset_plan_command.h"

#include <cstdio>
#include <memory>

#include "airsim360/app/arguments.h"
#include "airsim360/app/world_flags.h"
#include "airsim360/base/error.h"
#include "airsim360/base/file.h"
#include "airsim360/dataset/record/record.h"
#include "airsim360/worlds/worlds.h"

namespace airsim360 {
namespace {

struct PlanArguments {
  std::string recipe, out, worlds, show;
  int64_t frames = 0;
  bool list = false;
};

bool WorldExists(const std::string& world) {
  if (std::filesystem::exists(world)) return true;
  for (const WorldInfo& info : ListWorlds()) {
    if (info.name == world) return true;
  }
  return false;
}

std::vector<std::string> SplitWords(const std::string& text) {
  std::vector<std::string> words;
  for (size_t begin = 0; begin <= text.size();) {
    const size_t end = std::min(text.find(',', begin), text.size());
    if (end > begin) words.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return words;
}

DatasetPlan PlanOf(const PlanArguments& arguments, const GlobalOptions& globals) {
  if (IsPlanFile(arguments.recipe)) {
    if (!arguments.worlds.empty() || arguments.frames > 0)
      throw InputError("--world, --frames: '" + arguments.recipe + "' is a plan already; give them with its recipe");
    return ReadPlan(arguments.recipe);
  }
  Recipe recipe = FindRecipe(arguments.recipe);
  if (!arguments.worlds.empty()) recipe = WithWorlds(std::move(recipe), SplitWords(arguments.worlds));
  if (arguments.frames > 0) recipe = Scaled(std::move(recipe), arguments.frames);
  return MakePlan(recipe, globals.seed, WorldExists, PlanWorldOpener(globals));
}

nlohmann::ordered_json SummaryOf(const DatasetPlan& plan) {
  nlohmann::ordered_json worlds = nlohmann::ordered_json::object();
  int64_t waiting = 0;
  for (const RecipeRow& row : plan.recipe.rows) {
    const WorldFacts& facts = plan.facts(row);
    worlds[WorldKey(row)] = facts.exists() ? nlohmann::ordered_json(facts.hash) : nlohmann::ordered_json(nullptr);
    if (!facts.exists()) waiting += static_cast<int64_t>(row.frames);
  }
  return {{"name", plan.recipe.name}, {"hash", plan.hash}, {"format", kPlanFormat}, {"seed", plan.seed},
          {"frames", plan.frames()},  {"waiting", waiting}, {"rows", plan.recipe.rows.size()}, {"worlds", worlds}};
}

// "7" or "0:100": frames of the plan, [first, last).
std::pair<int64_t, int64_t> ParseShow(const std::string& text, int64_t frames) {
  const size_t colon = text.find(':');
  const auto number = [&](const std::string& word) {
    int64_t value = -1;
    char rest = 0;
    if (word.size() > 18 || std::sscanf(word.c_str(), "%lld%c", reinterpret_cast<long long*>(&value), &rest) != 1) value = -1;
    return value;
  };
  const int64_t first = number(text.substr(0, colon));
  const int64_t last = colon == std::string::npos ? first + 1 : number(text.substr(colon + 1));
  if (first < 0 || last <= first || last > frames)
    throw InputError("--show: '" + text + "' is not a frame 0 … " + std::to_string(frames - 1) + " of the plan, or FIRST:LAST");
  return {first, last};
}

nlohmann::ordered_json FrameJsonOf(const DatasetPlan& plan, FrameSource& source, int64_t frame, const FrameBlock& block, const Shot& shot) {
  using Json = nlohmann::ordered_json;
  const RecipeRow& row = plan.recipe.rows[block.row];
  const PictureSettings& picture = plan.recipe.picture.settings;
  const RigidTransform X_WC = shot.body.X_WB * CameraInBody();
  const Quaternion q = ToQuaternion(X_WC.R);
  const Vec3d p = X_WC.p;
  const PlannedSky sky = SkyOf(plan, block, source.StageOf(block.row)->environment());
  return {{"index", frame},
          {"row", row.name},
          {"world", row.world},
          {"X_WC", {{"p", {p.x, p.y, p.z}}, {"q_wxyz", {q.w, q.x, q.y, q.z}}}},
          {"v_WB", {shot.body.v_WB.x, shot.body.v_WB.y, shot.body.v_WB.z}},
          {"environment", DescribeEnvironment(sky.environment)},
          {"exposure", HasOwnExposure(picture) ? Json("auto") : Json(picture.exposure_ev + sky.exposure_ev)},
          {"people", row.people},
          {"seed", block.seed},
          {"block", {block.first, block.first + block.count}}};
}

void ShowFrames(const DatasetPlan& plan, const std::string& show, const GlobalOptions& globals) {
  const auto [first, last] = ParseShow(show, plan.frames());
  FrameSource source(plan, PlanWorldOpener(globals));
  for (int64_t frame = first; frame < last;) {
    const FrameBlock block = BlockOf(plan, frame);
    const RecipeRow& row = plan.recipe.rows[block.row];
    if (!plan.facts(row).exists()) {
      if (last == first + 1)
        throw InputError("--show: frame " + std::to_string(frame) + " is of world '" + row.world + "', which did not exist when this was planned");
      frame = block.first + block.count;
      continue;
    }
    const Flight flight = last == first + 1 ? Flight{.shots = {source.ShotOf(frame)}, .trajectory = {}} : source.ShotsOf(block);
    const int64_t begin = last == first + 1 ? frame : block.first;
    for (; frame < std::min(last, block.first + block.count); ++frame) {
      const auto json = FrameJsonOf(plan, source, frame, block, flight.shots[static_cast<size_t>(frame - begin)]);
      if (last == first + 1) PrintJson(json);
      else std::printf("%s\n", json.dump().c_str());
    }
  }
}

void RunPlanCommand(const PlanArguments& arguments, const GlobalOptions& globals) {
  if (arguments.recipe.empty()) {
    for (const std::string& name : RecipeNames()) {
      const Recipe recipe = FindRecipe(name);
      std::printf("%-24s %9lld frames  %s\n", name.c_str(), static_cast<long long>(recipe.frames()), recipe.about.c_str());
    }
    return;
  }
  if (arguments.out.empty() && arguments.show.empty()) throw InputError("--out is required, or --show");
  const DatasetPlan plan = PlanOf(arguments, globals);
  if (!arguments.out.empty()) WriteFileAtomically(arguments.out, PlanJson(plan));
  if (!arguments.show.empty()) return ShowFrames(plan, arguments.show, globals);
  const nlohmann::ordered_json summary = SummaryOf(plan);
  if (globals.json) return PrintJson(summary);
  std::printf("%s: %lld frames of %zu rows, %lld of them of worlds that do not exist yet\nhash %s\n", arguments.out.c_str(),
              static_cast<long long>(plan.frames()), plan.recipe.rows.size(), static_cast<long long>(summary["waiting"].get<int64_t>()), plan.hash.c_str());
}

}  // namespace

OpenWorld PlanWorldOpener(const GlobalOptions& globals) {
  return [device = DeviceChoice{globals.device, globals.gpu}](const RecipeRow& row) {
    return std::make_shared<Stage>(StageOptions{.world = {.world = row.world, .seed = row.world_seed}, .device = device});
  };
}

void AddDatasetPlan(CLI::App& dataset, GlobalOptions& globals) {
  CLI::App* command = dataset.add_subcommand("plan", "a dataset before it is made: a small file from which every frame follows");
  auto arguments = std::make_shared<PlanArguments>();
  command->add_option("RECIPE", arguments->recipe, "name, YAML file (docs/guide/dataset_plans.md), or a plan to --show; without one the names are listed");
  command->add_option("--out", arguments->out, "file of the plan");
  command->add_option("--world", arguments->worlds, "only the rows of these worlds: name,name");
  command->add_option("--frames", arguments->frames, "scale all rows to so many frames in total")->check(CLI::Range(int64_t{1}, kMostPlanFrames));
  command->add_option("--show", arguments->show, "what frame I is, or frames FIRST:LAST, a JSON line each");
  command->callback([arguments, &globals] { RunPlanCommand(*arguments, globals); });
}

}  // namespace airsim360
