// How far a figure could be off because the pictures are those and no others.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace airsim360 {

struct Interval {
  double low = 0, high = 0;
};

/// For each figure of `statistic`, the 2.5 and 97.5 percentiles (linear between order statistics) over `replicates` draws of `items`
/// items with replacement (Efron's percentile bootstrap). `statistic` takes how often each item is drawn and runs on several
/// threads at once; figures that are not finite are left out, an interval without any is NaN. The same seed gives the same
/// intervals with any number of threads. InputError for fewer than 1 or more than 100,000 replicates.
std::vector<Interval> BootstrapIntervals(size_t items, int replicates, uint64_t seed,
                                         const std::function<std::vector<double>(std::span<const uint32_t> draws)>& statistic);

}  // namespace airsim360
