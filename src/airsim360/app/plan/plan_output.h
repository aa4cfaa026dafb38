// Writing a planned trajectory in the formats of `airsim360 plan`.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "airsim360/planning/export/export_qgc.h"
#include "airsim360/planning/export/export_text.h"
#include "airsim360/planning/export/trajectory_plot.h"

namespace airsim360 {

/// Names that --format takes.
const std::vector<std::string>& PlanFormats();

struct PlanOutput {
  std::filesystem::path out;
  std::vector<std::string> formats = {};  ///< empty: by the extension of `out`
  double interval = 0.1;                  ///< seconds between samples
  GeoPoint origin = {};                   ///< of W, for QGroundControl
  bool has_yaw = false;                   ///< a heading was asked for: QGroundControl gets it too
  PlotOptions plot = {};
};

/// Formats to write: those given, or the one that the extension of `out` stands for. InputError for an
/// extension that says nothing.
std::vector<std::string> FormatsToWrite(const PlanOutput& output);

/// One format: exactly `out`; several: `out` with the extension of each. Returns the files.
std::vector<std::filesystem::path> WritePlan(const PlanRecord& plan, const PlanOutput& output);

}  // namespace airsim360
