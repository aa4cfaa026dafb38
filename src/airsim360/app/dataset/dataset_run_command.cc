// airsim360 dataset run, merge, status: the frames of a plan.
#include <algorithm>
#include <cstdio>
#include <memory>

#include "airsim360/app/dataset/collect_processes.h"
#include "airsim360/app/dataset/dataset_plan_command.h"
#include "airsim360/app/flags/arguments.h"
#include "airsim360/app/flags/config_flags.h"
#include "airsim360/base/error.h"
#include "airsim360/dataset/plan/find_plan.h"
#include "airsim360/dataset/plan/plan_spec.h"

namespace airsim360 {
namespace {

namespace fs = std::filesystem;

struct RunArguments {
  std::string plan, out, shard = "0/1";
  RecipePicture picture;
  ProcessArguments processes;
};

bool IsGiven(const CLI::App& command, std::string flag) {
  std::ranges::replace(flag, '_', '-');
  for (const std::string& spelling : {"--" + flag, "--no-" + flag}) {
    const CLI::Option* option = command.get_option_no_throw(spelling);
    if (option && option->count() > 0) return true;
  }
  return false;
}

// The fields of flags that were given, with their values as JSON. Flags of a group have the names of its fields.
std::map<std::string, std::string> GivenFields(const CLI::App& command, const RecipePicture& picture) {
  std::map<std::string, std::string> given;
  const auto fields = nlohmann::ordered_json::parse(PictureJson(picture));
  for (const auto& [name, value] : fields.items()) {
    if (!value.is_object()) {
      if (IsGiven(command, name)) given[name] = value.dump();
      continue;
    }
    nlohmann::ordered_json inner = nlohmann::ordered_json::object();
    for (const auto& [field, entry] : value.items()) {
      if (IsGiven(command, field)) inner[field] = entry;
    }
    if (!inner.empty()) given[name] = inner.dump();
  }
  return given;
}

void PrintReport(const CollectResult& result, const RunArguments& arguments, const GlobalOptions& globals) {
  const double written = result.written > 0 ? static_cast<double>(result.written) : 1;
  const double fps = result.wall_ms > 0 ? 1000 * static_cast<double>(result.written) / result.wall_ms : 0;
  if (globals.json) {
    return PrintJson({{"out", arguments.out},
                      {"frames", result.frames},
                      {"frames_written", result.written},
                      {"already_complete", result.already_complete},
                      {"render_ms", result.render_ms / written},
                      {"write_ms", result.write_ms / written},
                      {"wall_ms", result.wall_ms},
                      {"frames_per_second_written", fps},
                      {"peak_rss_mib", PeakRssMib()}});
  }
  if (result.already_complete) {
    std::printf("%s is complete already: %lld frames; nothing changed\n", arguments.out.c_str(), static_cast<long long>(result.frames));
    return;
  }
  std::printf("%s: %lld frames (%lld written now), %.1f ms rendering a frame, %.2f frames/s with worlds and skies\n", arguments.out.c_str(),
              static_cast<long long>(result.frames), static_cast<long long>(result.written), result.render_ms / written, fps);
}

void RunShard(const RunArguments& arguments, const CLI::App& command, GlobalOptions& globals) {
  if (arguments.processes.is_worker()) BecomeWorker(arguments.processes, globals);
  const int processes = arguments.processes.is_worker() ? 1 : CountProcesses(arguments.processes, globals);
  // What is meant to be a plan's file is never taken for the name of a recipe.
  const bool is_file = fs::path(arguments.plan).extension() == ".json";
  const DatasetPlan plan =
      is_file ? ReadPlan(arguments.plan) : FindPlan({.name = arguments.plan, .seed = globals.seed}, {globals.device, globals.gpu});
  const DatasetSpec spec = SpecOfPictures(plan.recipe.picture, GivenFields(command, arguments.picture));
  const Shard shard = ParseShard(arguments.shard);
  const PlanRun run{plan, spec, arguments.out, shard.index, shard.count, WorldOpener({globals.device, globals.gpu})};
  if (arguments.processes.is_worker()) {
    return RunWorker(
        [&](std::span<const int64_t> frames, const std::function<void(int64_t)>& done) { return RunPlanPart(run, frames, done); });
  }
  PrintReport(processes == 1 ? RunPlan(run) : RunPlan(run, RenderInProcesses(processes, Dealing::kRuns)), arguments, globals);
}

struct MergeArguments {
  std::vector<std::string> folders;
  std::string out;
};

struct StatusArguments {
  std::string plan;
  std::vector<std::string> folders;
  int64_t array = 0;
};

std::vector<fs::path> Paths(const std::vector<std::string>& names) { return {names.begin(), names.end()}; }

void RunMerge(const MergeArguments& arguments, const GlobalOptions& globals) {
  const CollectResult result = MergeShards(Paths(arguments.folders), arguments.out);
  if (globals.json) return PrintJson({{"out", arguments.out}, {"frames", result.frames}, {"frames_merged", result.written}});
  std::printf("%s: %lld frames of %zu folders\n", arguments.out.c_str(), static_cast<long long>(result.frames), arguments.folders.size());
}

// "0-3,7": as sbatch --array takes them.
std::string RunsText(const std::vector<std::pair<int64_t, int64_t>>& runs, size_t most) {
  std::string text;
  for (size_t i = 0; i < std::min(runs.size(), most); ++i) {
    text += (text.empty() ? "" : ",") + std::to_string(runs[i].first);
    if (runs[i].second > runs[i].first + 1) text += "-" + std::to_string(runs[i].second - 1);
  }
  return text + (runs.size() > most ? ",…" : "");
}

void RunStatus(const StatusArguments& arguments, const GlobalOptions& globals) {
  const DatasetPlan plan = ReadPlan(arguments.plan);
  const PlanStatus status = StatusOf(plan, Paths(arguments.folders));
  std::vector<std::pair<int64_t, int64_t>> shards;
  if (arguments.array > 0) {
    for (const int64_t shard : MissingShards(plan, Paths(arguments.folders), arguments.array)) {
      if (!shards.empty() && shards.back().second == shard)
        ++shards.back().second;
      else
        shards.emplace_back(shard, shard + 1);
    }
  }
  if (globals.json) {
    nlohmann::ordered_json json = {{"hash", plan.hash},         {"frames", status.frames},
                                   {"done", status.done},       {"missing", status.missing},
                                   {"waiting", status.waiting}, {"missing_frames", RunsText(status.missing_runs, 1000)}};
    if (arguments.array > 0) json["missing_shards"] = RunsText(shards, SIZE_MAX);
    return PrintJson(json);
  }
  if (arguments.array > 0) {
    std::printf("%s\n", RunsText(shards, SIZE_MAX).c_str());
    return;
  }
  std::printf("%lld of %lld frames are done, %lld missing, %lld wait for worlds that do not exist yet\n",
              static_cast<long long>(status.done), static_cast<long long>(status.frames), static_cast<long long>(status.missing),
              static_cast<long long>(status.waiting));
  if (status.missing > 0) std::printf("missing: %s\n", RunsText(status.missing_runs, 20).c_str());
}

}  // namespace

void AddDatasetRun(CLI::App& dataset, GlobalOptions& globals) {
  CLI::App* command = dataset.add_subcommand("run", "make the frames of a plan; run again to finish what was interrupted");
  auto arguments = std::make_shared<RunArguments>();
  command->add_option("PLAN", arguments->plan, "file of airsim360 dataset plan, or a recipe, of which the plan with --seed is made")
      ->required();
  command->add_option("--out", arguments->out, "folder of the dataset, or of this shard of it")->required();
  command->add_option("--shard", arguments->shard, "I/N: part I of N of the frames, which follow one another (default 0/1)");
  RecipePicture& picture = arguments->picture;
  AddConfigFlags(*command, [&picture](ConfigVisitor& v) { picture.settings.Visit(v); });
  command->add_option("--size", picture.size, "WxH, twice as wide as high (default: as the recipe says, like all flags of pictures)");
  command->add_option("--products", picture.products, "beside rgb,range,semantic,entity: normal,position,albedo,sky,flow,coverage,radiance")
      ->delimiter(',')
      ->allow_extra_args(false);
  arguments->processes.AddTo(*command);
  command->callback([arguments, command, &globals] { RunShard(*arguments, *command, globals); });
}

void AddDatasetMerge(CLI::App& dataset, GlobalOptions& globals) {
  CLI::App* command = dataset.add_subcommand("merge", "one dataset of the finished shards of a plan");
  auto arguments = std::make_shared<MergeArguments>();
  command->add_option("DIR", arguments->folders, "folders of shards")->required();
  command->add_option("--out", arguments->out, "folder of the dataset")->required();
  command->callback([arguments, &globals] { RunMerge(*arguments, globals); });
}

void AddDatasetStatus(CLI::App& dataset, GlobalOptions& globals) {
  CLI::App* command = dataset.add_subcommand("status", "which frames of a plan are there");
  auto arguments = std::make_shared<StatusArguments>();
  command->add_option("PLAN", arguments->plan, "file of airsim360 dataset plan")->required();
  command->add_option("DIR", arguments->folders, "folders of shards, finished or not, there or not");
  command->add_option("--array", arguments->array, "name the shards of so many that are not finished, as sbatch --array takes them")
      ->check(CLI::Range(int64_t{1}, int64_t{1'000'000}));
  command->callback([arguments, &globals] { RunStatus(*arguments, globals); });
}

}  // namespace airsim360
