// The middle of several timings.
#pragma once

#include <algorithm>
#include <vector>

namespace airsim360 {

/// The upper one of the two in the middle of an even number; `values` is not empty.
inline double Median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

}  // namespace airsim360
