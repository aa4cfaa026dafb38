// Crosswalks of built-in towns.
#include <cmath>

#include "airsim360/worlds/town/street_markings.h"

namespace airsim360::internal {

void LayCrosswalk(Ground& ground, const StreetStretch& street, bool at_start, const std::string& name) {
  const float hw = street.line.half_width;
  const float from = at_start ? street.s0 + kCrosswalkStart : street.s1 - kCrosswalkStart - kCrosswalkWidth;
  ground.Begin("crosswalk " + name, "ground/crosswalk", Surface::kPaintWhite);
  const int bars = static_cast<int>((2 * hw - 0.8f) / 1.0f);
  const float first = -0.5f * static_cast<float>(bars) + 0.25f;
  for (int i = 0; i < bars; ++i) {
    const float d = first + static_cast<float>(i);
    StreetRect(ground, street, from, from + kCrosswalkWidth, d, d + 0.5f, kPaintLift);
  }
}

void LayLinedCrosswalk(Ground& ground, const StreetStretch& street, bool at_start, const std::string& name) {
  constexpr float kLine = 0.22f;
  const float from = at_start ? street.s0 + kCrosswalkStart : street.s1 - kCrosswalkStart - kCrosswalkWidth, to = from + kCrosswalkWidth,
              reach = std::floor(2 * street.line.half_width - 0.8f) / 2;
  ground.Begin("crosswalk " + name, "ground/crosswalk", Surface::kPaintWhite);
  StreetRect(ground, street, from, from + kLine, -reach, reach, kPaintLift);
  StreetRect(ground, street, to - kLine, to, -reach, reach, kPaintLift);
  ground.Use(Surface::kAsphaltOld);
  StreetRect(ground, street, from + kLine, to - kLine, -reach, reach, 0.75f * kPaintLift);  // over wear and repairs
}

}  // namespace airsim360::internal
