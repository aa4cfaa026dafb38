// A picture of each world of a dataset: what it looks like, its categories, and what their colours mean.
#pragma once

#include <string>

#include "airsim360/dataset/gallery/statistics.h"

namespace airsim360::internal {

/// "legend_city_park.png": the file of a world, whose name may be a path.
std::string SceneLegendName(const std::string& world);
/// Of the frame of `world` that shows the most categories the colour picture (where the dataset has colours), below it the
/// semantic picture in the colours of meta.json, at most 1024 pixels wide, and every category seen in frames of the world, the
/// largest first, with its colour. `world` is one of statistics.worlds.
Image<Rgb8> DrawSceneLegend(const NativeDataset& data, const DatasetStatistics& statistics, const std::string& world);

}  // namespace airsim360::internal
