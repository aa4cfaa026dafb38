#include "airsim360/worlds/kit/street_plan.h"

#include <cmath>

namespace airsim360 {

GroundRect StreetPlan::reach() const {
  const float margin = blocks.front().pavement;
  const auto low = [&](const StreetLine& line) { return line.center - line.half_width - margin; };
  const auto high = [&](const StreetLine& line) { return line.center + line.half_width + margin; };
  const auto first = static_cast<size_t>(first_core), last = static_cast<size_t>(last_core);
  return {low(north_south[first]), low(east_west[first]), high(north_south[last]), high(east_west[last])};
}

float CarriagewayHeight(const StreetLine& line, float d) { return -0.13f + 0.018f * (line.half_width - std::abs(d)); }

}  // namespace airsim360
