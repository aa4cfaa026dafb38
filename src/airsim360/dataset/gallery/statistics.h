// What a finished dataset holds, counted.
#pragma once

#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "airsim360/dataset/export/native_dataset.h"

namespace airsim360::internal {

/// Upper ends of the bins of heights (z of the camera in W) and of median ranges, metres; a last bin holds the rest.
inline constexpr double kHeightBins[] = {2, 5, 10, 20, 40, 80, 120};
inline constexpr double kRangeBins[] = {2, 5, 10, 20, 50, 100, 200};

struct CategoryCount {
  int64_t frames = 0;  ///< that show it
  int64_t pixels = 0;
  double solid_angle = 0;  ///< steradians, over all pictures
};

/// What the frames of one world show.
struct WorldCount {
  int64_t frames = 0;
  std::map<CategoryId, int64_t> pixels;
  size_t richest = 0;        ///< position of the frame that shows the most categories, of equals the first
  size_t richest_count = 0;  ///< categories in it
};

struct DatasetStatistics {
  int64_t frames = 0, bytes = 0;  ///< bytes: of the frames' files
  int64_t pixels = 0;
  double solid_angle = 0;
  std::map<std::string, WorldCount> worlds;
  std::map<std::string, int64_t> environments;  ///< frames of each
  std::map<CategoryId, CategoryCount> categories;
  std::vector<int64_t> heights, ranges;          ///< kHeightBins, kRangeBins
  int64_t persons = 0, frames_with_persons = 0;  ///< persons: views of a person with pixels
  int64_t dropped = 0;                           ///< rows of dropped.csv
};

DatasetStatistics CountDataset(const NativeDataset& data);
/// The figures as a Markdown page.
std::string StatisticsMarkdown(const NativeDataset& data, const DatasetStatistics& statistics);
nlohmann::ordered_json StatisticsJson(const NativeDataset& data, const DatasetStatistics& statistics);

}  // namespace airsim360::internal
