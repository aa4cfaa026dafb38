// The value in the middle by size.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace airsim360 {

/// The element in the middle; of an even number the larger of the two. `values` must not be empty.
template <class T>
T UpperMedian(std::vector<T> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// The same; of an even number the smaller of the two, as torch.median has it.
template <class T>
T LowerMedian(std::vector<T> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>((values.size() - 1) / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace airsim360
