// The vehicles of traffic in the frames of a dataset.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "airsim360/base/error.h"
#include "airsim360/dataset/export/export_job.h"

namespace airsim360::internal {

/// Whether the dataset was collected with traffic.
bool HasVehicles(const ExportJob& job);
/// The vehicles of each frame, as vehicles.jsonl has them. InputError naming file and line for what is none.
std::vector<Json> ReadVehicles(const ExportJob& job);

/// A vehicle and what a picture shows of it.
struct SeenVehicle {
  const Json* vehicle = nullptr;
  Segment segment;
};
/// Those that a picture of the frame shows, by entity. InputError as ReadVehicles.
std::vector<SeenVehicle> VehiclesSeen(const ExportJob& job, const NativeFrame& frame, const View& view, const Json& vehicles);

/// Runs `make` and turns errors of JSON into one that names the line of a frame in vehicles.jsonl.
template <class Make>
auto OfVehicles(const ExportJob& job, const NativeFrame& frame, const Make& make) {
  try {
    return make();
  } catch (const Json::exception& error) {
    throw InputError((job.data.folder() / "vehicles.jsonl").string() + ":" + std::to_string(frame.position + 1) + ": " + error.what());
  }
}

/// Whether a category is `path` or below it.
bool IsCategory(const std::string& category, const std::string& path);

/// A foreign format's word for a category path: that of the first pair whose path it is or lies below.
template <size_t N>
const char* WordFor(const std::string& category, const std::array<std::pair<const char*, const char*>, N>& words, const char* otherwise) {
  for (const auto& [path, word] : words) {
    if (IsCategory(category, path)) return word;
  }
  return otherwise;
}

}  // namespace airsim360::internal
