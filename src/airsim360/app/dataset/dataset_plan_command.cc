// airsim360 dataset plan: a plan of a recipe, and what its frames are.
#include "airsim360/app/dataset/dataset_plan_command.h"

#include <cstdio>
#include <memory>

#include "airsim360/app/flags/arguments.h"
#include "airsim360/app/flags/out_file.h"
#include "airsim360/base/error.h"
#include "airsim360/base/file.h"
#include "airsim360/dataset/plan/find_plan.h"
#include "airsim360/dataset/plan/plan_block.h"

namespace airsim360 {
namespace {

struct PlanArguments {
  std::string recipe, out, worlds, show;
  int64_t frames = 0;
};

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
  return FindPlan({.name = arguments.recipe, .worlds = SplitWords(arguments.worlds), .frames = arguments.frames, .seed = globals.seed},
                  {globals.device, globals.gpu});
}

nlohmann::ordered_json SummaryOf(const DatasetPlan& plan) {
  nlohmann::ordered_json worlds = nlohmann::ordered_json::object();
  int64_t waiting = 0;
  for (const RecipeRow& row : plan.recipe.rows) {
    const WorldFacts& facts = plan.facts(row);
    worlds[WorldKey(row)] = facts.exists() ? nlohmann::ordered_json(facts.hash) : nlohmann::ordered_json(nullptr);
    if (!facts.exists()) waiting += static_cast<int64_t>(row.frames);
  }
  return {{"name", plan.recipe.name}, {"hash", plan.hash},  {"format", kPlanFormat},           {"seed", plan.seed},
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

void ShowFrames(const DatasetPlan& plan, const std::string& show, const GlobalOptions& globals) {
  const auto [first, last] = ParseShow(show, plan.frames());
  FrameSource source(plan, WorldOpener({globals.device, globals.gpu}));
  for (int64_t frame = first; frame < last;) {
    const FrameBlock block = BlockOf(plan, frame);
    const RecipeRow& row = plan.recipe.rows[block.row];
    if (!plan.facts(row).exists()) {
      if (last == first + 1)
        throw InputError("--show: frame " + std::to_string(frame) + " is of world '" + row.world +
                         "', which did not exist when this was planned");
      frame = block.first + block.count;
      continue;
    }
    const Flight flight = last == first + 1 ? Flight{.shots = {source.ShotOf(frame)}, .trajectory = {}} : source.ShotsOf(block);
    const int64_t begin = last == first + 1 ? frame : block.first;
    const PlannedSky sky = SkyOf(plan, block, source.StageOf(block.row)->environment());
    for (; frame < std::min(last, block.first + block.count); ++frame) {
      const std::string json =
          PlannedFrameJson(plan, frame, flight.shots[static_cast<size_t>(frame - begin)], sky, plan.recipe.picture.settings);
      if (last == first + 1)
        PrintJson(nlohmann::ordered_json::parse(json));
      else
        std::printf("%s\n", json.c_str());
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
  CheckOutFile(arguments.out);
  const DatasetPlan plan = PlanOf(arguments, globals);
  if (!arguments.out.empty()) WriteFileAtomically(arguments.out, PlanJson(plan));
  if (!arguments.show.empty()) return ShowFrames(plan, arguments.show, globals);
  const nlohmann::ordered_json summary = SummaryOf(plan);
  if (globals.json) return PrintJson(summary);
  std::printf("%s: %lld frames of %zu rows, %lld of them of worlds that do not exist yet\nhash %s\n", arguments.out.c_str(),
              static_cast<long long>(plan.frames()), plan.recipe.rows.size(), static_cast<long long>(summary["waiting"].get<int64_t>()),
              plan.hash.c_str());
}

}  // namespace

void AddDatasetPlan(CLI::App& dataset, GlobalOptions& globals) {
  CLI::App* command = dataset.add_subcommand("plan", "a dataset before it is made: a small file from which every frame follows");
  auto arguments = std::make_shared<PlanArguments>();
  command->add_option(
      "RECIPE", arguments->recipe,
      "name, YAML file (docs/guide/dataset_plans.md), or a plan to --show; @HASH behind it: what its hash must be; without one the names are listed");
  command->add_option("--out", arguments->out, "file of the plan");
  command->add_option("--world", arguments->worlds, "only the rows of these worlds: name,name");
  command->add_option("--frames", arguments->frames, "scale all rows to so many frames in total")
      ->check(CLI::Range(int64_t{1}, kMostPlanFrames));
  command->add_option("--show", arguments->show, "what frame I is, or frames FIRST:LAST, a JSON line each");
  command->callback([arguments, &globals] { RunPlanCommand(*arguments, globals); });
}

}  // namespace airsim360
