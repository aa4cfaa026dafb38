// How bright it is where there is light.
#pragma once

#include <algorithm>
#include <vector>

namespace airsim360::internal {

/// The irradiance of places such that half of all light falls on brighter ones: dark places, however many, do not count.
/// 0 without light.
inline float LightOfLitPlaces(std::vector<float> places) {
  std::sort(places.begin(), places.end());
  double sum = 0, below = 0;
  for (float e : places) sum += e;
  for (float e : places) {
    below += e;
    if (2 * below >= sum) return e;
  }
  return 0;
}

}  // namespace airsim360::internal
