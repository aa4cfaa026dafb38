// A plan of a dataset in the browser: its frames are drawn when they are looked at.
#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>

#include "airsim360/dataset/plan/plan_frames.h"
#include "airsim360/view/drawn_frames.h"

namespace airsim360 {

class ViewedPlan : public DrawnFrames {
 public:
  /// Panoramas of at most 1024 columns, otherwise as the plan's recipe says. InputError for what is no plan.
  ViewedPlan(const std::filesystem::path& file, const DeviceChoice& device);

  /// Headers of frames are PlannedFrameJson with "p", "q" and "persons". InputError for a frame whose world did not exist when
  /// it was planned.
  std::optional<std::string> Made(std::string_view path) override;

 private:
  std::string Index() const;
  std::string Entities();
  std::string Frame(int64_t number);

  std::string name_;
  DatasetSpec spec_;
  PlanFrames frames_;
};

}  // namespace airsim360
