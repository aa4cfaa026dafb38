// Making the frames of a plan: a client of the collector, block by block under one sky each.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "airsim360/dataset/collector.h"
#include "airsim360/dataset/plan/frame_source.h"

namespace airsim360 {

/// A run of one shard into one folder.
struct PlanRun {
  const DatasetPlan& plan;
  DatasetSpec spec;  ///< pictures alone; the rest is filled in from the plan
  std::filesystem::path out;
  int64_t shard = 0, shards = 1;
  OpenWorld open;
};

/// Makes the frames of the shard that are missing in the folder, here, or by `elsewhere` where that is given, and what
/// describes them. Worlds that do not exist are left out. InputError if the folder holds something else, or a world is not the
/// one that was planned with; RuntimeError if writing fails: what was done so far stays valid.
CollectResult RunPlan(const PlanRun& run, const RenderElsewhere& elsewhere = {});

/// Makes those of `frames` that are missing in a folder that RunPlan of another process has begun and will finish.
CollectResult RunPlanPart(const PlanRun& run, std::span<const int64_t> frames, const std::function<void(int64_t frame)>& done);

/// Frames that are done in a folder of the plan, finished or not; none if it does not exist. InputError if it is of another plan.
std::vector<int64_t> DoneFrames(const DatasetPlan& plan, const std::filesystem::path& folder);

struct PlanStatus {
  int64_t frames = 0;                                     ///< of the plan
  int64_t done = 0;                                       ///< in any of the folders
  int64_t missing = 0;                                    ///< of worlds that exist
  int64_t waiting = 0;                                    ///< of worlds that do not exist yet
  std::vector<std::pair<int64_t, int64_t>> missing_runs;  ///< [first, last)
};
PlanStatus StatusOf(const DatasetPlan& plan, const std::vector<std::filesystem::path>& folders);
/// Shards of `count` of which some frame is in none of the folders, or that are not finished in the folder of theirs.
std::vector<int64_t> MissingShards(const DatasetPlan& plan, const std::vector<std::filesystem::path>& folders, int64_t count);

/// One dataset of all frames of the folders, which are shards of one plan and finished: byte for byte what one run had made.
/// Pictures are linked where the file system can, else copied. InputError for folders of different plans or pictures, or
/// unfinished; RuntimeError if frames are missing in all of them.
CollectResult MergeShards(const std::vector<std::filesystem::path>& folders, const std::filesystem::path& out);

/// Name of the plan in the folder of a dataset.
inline constexpr char kPlanName[] = "plan.json";

}  // namespace airsim360
