#include "airsim360/render/indoor/lamp_guide.h"

#include <algorithm>
#include <cmath>

namespace airsim360::internal {

void JoinFound(std::vector<FoundLamp>& found) {
  std::stable_sort(found.begin(), found.end(), [](const FoundLamp& a, const FoundLamp& b) { return a.lamp < b.lamp; });
  size_t count = 0;
  for (const FoundLamp& one : found) {
    if (count > 0 && found[count - 1].lamp == one.lamp)
      found[count - 1].squares += one.squares, found[count - 1].rays += one.rays;
    else
      found[count++] = one;
  }
  found.resize(count);
  found.shrink_to_fit();
}

LampGuide::LampGuide(const LampTally& tally) {
  float sum = 0;
  for (size_t lamp = 0; lamp < tally.by_lamp_.size(); ++lamp) {
    const LampTally::Entry& entry = tally.by_lamp_[lamp];
    if (!(entry.squares > 0)) continue;
    lamps_.push_back(static_cast<uint32_t>(lamp));
    up_to_.push_back(sum += std::sqrt(entry.squares / entry.rays));
  }
  for (float& up_to : up_to_) up_to /= sum;
}

float LampGuide::Probability(uint32_t lamp) const {
  const auto at = std::lower_bound(lamps_.begin(), lamps_.end(), lamp);
  if (at == lamps_.end() || *at != lamp) return 0;
  const auto k = static_cast<size_t>(at - lamps_.begin());
  return up_to_[k] - (k > 0 ? up_to_[k - 1] : 0);
}

LightTree::Choice LampGuide::Choose(float u) const {
  const auto k = static_cast<size_t>(std::upper_bound(up_to_.begin(), up_to_.end() - 1, u) - up_to_.begin());
  const float before = k > 0 ? up_to_[k - 1] : 0, own = up_to_[k] - before;
  return {lamps_[k], own, std::clamp((u - before) / own, 0.0f, 0.9999999f)};
}

}  // namespace airsim360::internal
