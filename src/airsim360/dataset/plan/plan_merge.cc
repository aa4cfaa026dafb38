// What is done in the folders of a plan, and one dataset of several of them.
#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "airsim360/base/error.h"
#include "airsim360/base/file.h"
#include "airsim360/base/hash.h"
#include "airsim360/base/log.h"
#include "airsim360/base/parallel.h"
#include "airsim360/dataset/folder.h"
#include "airsim360/dataset/index.h"
#include "airsim360/dataset/plan/plan_labels.h"
#include "airsim360/dataset/plan/plan_run.h"
#include "airsim360/dataset/plan/plan_spec.h"

namespace airsim360 {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

// Parameters of a dataset of a plan. InputError if it is none.
Json ParametersOf(const fs::path& folder) {
  const Json meta = Json::parse(ReadTextFile(folder / kMetaName), nullptr, false);
  if (!meta.is_object() || !meta.contains("parameters") || !meta["parameters"].contains("plan"))
    throw InputError("'" + folder.string() + "' is not a dataset of a plan; airsim360 dataset run makes them");
  return meta["parameters"];
}

void CheckPlan(const Json& parameters, const std::string& hash, const fs::path& folder) {
  if (parameters["plan"] == hash) return;
  throw InputError("'" + folder.string() + "' is of another plan: its hash is " + parameters["plan"].dump() + ", not \"" + hash + "\"");
}

// InputError naming the first file of a frame that is missing or not the one that its shard wrote.
void CheckFrameFiles(const fs::path& folder, const std::vector<FileRecord>& files) {
  std::vector<std::string> faults(files.size());
  ParallelFor(static_cast<int64_t>(files.size()), [&](int64_t i) {
    const FileRecord& file = files[static_cast<size_t>(i)];
    const fs::path path = folder / file.path;
    if (!fs::is_regular_file(path))
      faults[static_cast<size_t>(i)] = path.string() + ": missing";
    else if (Sha256HexOfFile(path) != file.sha256)
      faults[static_cast<size_t>(i)] = path.string() + ": damaged or cut off (its SHA-256 is not that of its shard's index)";
  });
  for (const std::string& fault : faults) {
    if (!fault.empty()) throw InputError(fault + "; delete it and run its shard again, then merge");
  }
}

// The file of one dataset in another: the same bytes, on disk once where it can be. What a merge that failed left
// there is replaced.
void LinkFile(const fs::path& from, const fs::path& to) {
  std::error_code error;
  fs::remove(to, error);
  fs::create_hard_link(from, to, error);
  if (!error) return;
  const fs::path temporary = to.string() + ".tmp";
  fs::copy_file(from, temporary, fs::copy_options::overwrite_existing, error);
  if (!error) fs::rename(temporary, to, error);
  if (error) throw RuntimeError(to.string() + ": cannot write: " + error.message());
}

void CheckAllFramesAreThere(const DatasetPlan& plan, const std::vector<fs::path>& folders) {
  const PlanStatus status = StatusOf(plan, folders);
  if (status.missing == 0) return;
  const auto [first, last] = status.missing_runs.front();
  throw RuntimeError("dataset merge: " + std::to_string(status.missing) + " frames are in none of these folders, the first " +
                     std::to_string(first) + " … " + std::to_string(last - 1) + "; run their shards first");
}

}  // namespace

std::vector<int64_t> DoneFrames(const DatasetPlan& plan, const fs::path& folder) {
  if (!fs::exists(folder / kMetaName)) return {};
  CheckPlan(ParametersOf(folder), plan.hash, folder);
  if (!fs::exists(folder / kIndexName)) return {};
  return DatasetIndex(folder, DatasetIndex::Mode::kRead).Frames();
}

PlanStatus StatusOf(const DatasetPlan& plan, const std::vector<fs::path>& folders) {
  std::vector<int64_t> done;
  for (const fs::path& folder : folders) {
    const std::vector<int64_t> frames = DoneFrames(plan, folder);
    done.insert(done.end(), frames.begin(), frames.end());
  }
  std::ranges::sort(done);
  done.erase(std::unique(done.begin(), done.end()), done.end());
  PlanStatus status;
  status.frames = plan.frames(), status.done = static_cast<int64_t>(done.size());
  status.waiting = status.frames;
  for (const auto& [first, last] : RunsThatExist(plan)) {
    status.waiting -= last - first;
    int64_t next = first;
    const auto miss = [&](int64_t until) {
      if (until > next) status.missing_runs.emplace_back(next, until);
      status.missing += std::max<int64_t>(0, until - next);
    };
    for (auto it = std::ranges::lower_bound(done, first); it != done.end() && *it < last; ++it) {
      miss(*it);
      next = *it + 1;
    }
    miss(last);
  }
  return status;
}

std::vector<int64_t> MissingShards(const DatasetPlan& plan, const std::vector<fs::path>& folders, int64_t count) {
  std::set<int64_t> finished;
  for (const fs::path& folder : folders) {
    if (!fs::exists(folder / kMetaName) || !fs::exists(folder / kChecksumsName)) continue;
    const Json parameters = ParametersOf(folder);
    CheckPlan(parameters, plan.hash, folder);
    if (parameters["shards"] == count) finished.insert(parameters["shard"].get<int64_t>());
  }
  std::vector<int64_t> missing;
  for (int64_t shard = 0; shard < count; ++shard) {
    if (!finished.contains(shard)) missing.push_back(shard);
  }
  return missing;
}

CollectResult MergeShards(const std::vector<fs::path>& folders, const fs::path& out) {
  if (folders.empty()) throw InputError("dataset merge: name the folders of shards");
  for (const fs::path& folder : folders) {
    if (!fs::exists(folder / kMetaName)) throw InputError("'" + folder.string() + "' is not a dataset: it has no " + kMetaName);
    if (!fs::exists(folder / kChecksumsName))
      throw InputError("'" + folder.string() + "' is not finished; run the same dataset run again to finish it");
  }
  const DatasetPlan plan = ReadPlan(folders.front() / kPlanName);
  const Json first = ParametersOf(folders.front());
  const DatasetSpec spec =
      SpecOfPlan(plan, SpecOfPictures(plan.recipe.picture, first.at("picture").get<std::map<std::string, std::string>>()), 0, 1);
  PlanLabels labels(plan);
  for (const fs::path& folder : folders) {
    const Json parameters = ParametersOf(folder);
    CheckPlan(parameters, plan.hash, folder);
    DatasetSpec shard = spec;
    shard.shard = parameters["shard"], shard.shards = parameters["shards"];
    const std::string difference = DescribeMetaDifference(ReadTextFile(folder / kMetaName), MetaJson(shard, labels.scene()));
    if (!difference.empty())
      throw InputError("'" + folder.string() + "' does not go with '" + folders.front().string() + "': " + difference);
    for (const DatasetIndex::NamedEntity& entity : DatasetIndex(folder, DatasetIndex::Mode::kRead).Entities())
      labels.Name(entity.id, entity.name, entity.category);
  }
  CheckAllFramesAreThere(plan, folders);

  const Flight nothing;
  CollectInput input{spec, labels.scene(), nothing, out};
  input.frames = FramesOfShard(plan, 0, 1);
  input.further_files[kPlanName] = PlanJson(plan);
  return Collect(input, [&](const std::vector<int64_t>& missing, const std::function<void()>& written, CollectResult&) {
    DatasetIndex index(out, DatasetIndex::Mode::kJournal);
    for (const fs::path& folder : folders) {
      const DatasetIndex part(folder, DatasetIndex::Mode::kRead);
      const std::vector<int64_t> taken = index.Frames();
      for (const int64_t frame : part.Frames()) {
        if (!std::ranges::binary_search(missing, frame) || std::ranges::binary_search(taken, frame)) continue;
        const std::vector<FileRecord> files = part.Files(frame);
        CheckFrameFiles(folder, files);
        for (const FileRecord& file : files) LinkFile(folder / file.path, out / file.path);
        written();
      }
      index.Take(folder);
    }
  });
}

}  // namespace airsim360
