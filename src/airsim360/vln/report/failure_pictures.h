// What a drone saw where a flight failed.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "airsim360/vln/report/vln_report.h"

namespace airsim360 {

struct FailurePictureOptions {
  int width = 1024;  ///< of panoramas, pixels
  size_t most = 24;  ///< of a run
  RenderSettings picture = {};
  std::function<std::shared_ptr<Stage>(const std::string& world, uint64_t seed, int64_t people)> open = {};
};

/// A level panorama, JPEG, for the first failures of each run: at the last place, in the direction of the last move, with a ring where
/// the goal is. By run and episode. Failures whose episode is not in `episodes` have none.
FailurePictures DrawFailures(const std::vector<VlnRun>& runs, const std::vector<LanguageEpisode>& episodes,
                             const FailurePictureOptions& options);

}  // namespace airsim360
