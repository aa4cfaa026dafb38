// Scores of runs with intervals, and pages about them.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "airsim360/vln/flights/run_episodes.h"

namespace airsim360 {

/// Means of kVlnFigures and of what flights cost (decisions, yaw, seconds), 95 % bootstrap intervals, and the same by difficulty.
/// One JSON object: keys as of `eval vln`, `intervals`, `episodes`, `collision_rate`, `decisions`, `yaw_turned_deg`, `faults`, …
std::string ScoresJson(const std::vector<VlnResult>& results);

/// One run of a report.
struct VlnRun {
  std::string name;  ///< of its file
  std::vector<VlnResult> results;
};

/// JPEG panoramas of failures by run and episode (failure_pictures.h).
using FailurePictures = std::map<std::pair<std::string, std::string>, std::string>;

/// A table of all runs, success by difficulty and by instruction, how many decisions success took, maps of the flights, and every
/// failure with its reason. Two forms of the same; a pure function of the runs; pictures
/// are part of the page.
std::string ReportMarkdown(const std::vector<VlnRun>& runs);
std::string ReportHtml(const std::vector<VlnRun>& runs, const FailurePictures& pictures = {});

}  // namespace airsim360
