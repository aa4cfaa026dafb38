// Frames of a plan one at a time and in any order: what `dataset run` would write, without files.
#pragma once

#include <filesystem>
#include <list>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "airsim360/base/disk_cache.h"
#include "airsim360/dataset/encode.h"
#include "airsim360/dataset/plan/frame_source.h"
#include "airsim360/dataset/plan/plan_block.h"
#include "airsim360/dataset/stored_pictures.h"

namespace airsim360 {

struct PlanFramesOptions {
  DatasetSpec pictures;               ///< of SpecOfPicture
  EnvironmentFlags environment = {};  ///< over the sky of every frame
  DeviceChoice device = {};
  std::filesystem::path cache = {};  ///< folder of frames that were drawn before; empty: none are kept
  uint64_t cache_bytes = uint64_t{2} << 30;
};

/// A frame, drawn or from the cache.
struct PlanFrame {
  std::string about;  ///< PlannedFrameJson, with "persons" (entries of people.jsonl) in rows of people
  std::vector<StoredPicture> pictures;
};

/// Any thread may ask; one frame is drawn at a time, on all threads. Keeps the last worlds and the last sky.
class PlanFrames {
 public:
  static constexpr size_t kMostWorlds = 3, kMostRows = 8;  ///< kept open

  /// Opens nothing yet. InputError for an environment that makes no sense.
  PlanFrames(DatasetPlan plan, const PlanFramesOptions& options);
  ~PlanFrames();

  const DatasetPlan& plan() const { return plan_; }
  /// Whether a GPU draws.
  bool uses_gpu() const { return uses_gpu_; }
  /// meta.json of a dataset of these frames.
  std::string MetaText() const;
  /// Categories of these frames.
  SemanticTree Categories() const { return labels_.scene().tree; }
  struct Thing {
    EntityId id = kNoEntity;
    std::string name, category;
    bool countable = true;
  };
  /// Everything that has a name by now: of worlds that were opened.
  std::vector<Thing> Things();
  /// Frames of each sky whose worlds exist, as [first, last), in order.
  std::vector<std::pair<int64_t, int64_t>> Blocks() const;
  /// Opens worlds until kMostWorlds are, so that processes forked from this one share them.
  void Open();

  /// PlannedFrameJson of a frame. InputError if its world did not exist when this was planned, or is another one now.
  std::string Describe(int64_t frame);
  PlanFrame Take(int64_t frame);

 private:
  struct OpenRow;
  OpenRow& Enter(size_t row);
  OpenRow& Prepare(int64_t frame);  // the take of a frame is at hand
  std::shared_ptr<Stage> StageOf(const RecipeRow& row);
  PlannedSky SkyOf(OpenRow& row, const FrameBlock& block);
  PlanFrame Draw(int64_t frame);
  std::string PersonsJson(const OpenRow& row, const FrameLabels& people) const;

  const DatasetPlan plan_;
  const PlanFramesOptions options_;
  const DatasetSpec spec_;  // of a dataset of the plan
  PlanLabels labels_;
  const bool wide_;
  const std::vector<View> views_;
  const bool uses_gpu_;
  const DiskCache cache_;
  std::string key_;  // of everything in a cached frame but its number

  std::mutex mutex_;                                                  // of what follows
  std::list<OpenRow> rows_;                                           // the last used first
  std::list<std::pair<std::string, std::shared_ptr<Stage>>> worlds_;  // by key, the last used first
  SkyRenderer renderer_;
  std::vector<Capture> captures_;  // their memory is used again
};

}  // namespace airsim360
