// A plan of a dataset in the browser: its frames are drawn when they are looked at.
#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>

#include "airsim360/dataset/plan/plan_frames.h"

namespace airsim360 {

/// All functions may be called from several threads; one frame is drawn at a time.
class ViewedPlan {
 public:
  /// Panoramas of at most 1024 columns, otherwise as the plan's recipe says. InputError for what is no plan.
  ViewedPlan(const std::filesystem::path& file, const DeviceChoice& device);

  /// index.json: as that of ViewedDataset, without poses and times, with "planned": true and the world of each frame.
  /// entities.json: things of the worlds that were opened so far.
  /// frame/N: a plane message (view/planes.h) whose header is PlannedFrameJson with "p", "q" and "persons".
  /// nullopt for a path that is none; InputError for a frame whose world did not exist when it was planned.
  std::optional<std::string> Made(std::string_view path);

 private:
  std::string Index() const;
  std::string Entities();
  std::string Frame(int64_t number);

  std::string name_;
  DatasetSpec spec_;
  PlanFrames frames_;
};

}  // namespace airsim360
