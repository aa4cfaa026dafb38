// Bodies of all kinds, for tests, benches and pictures of bodies alone; the people of a crowd are drawn in people/crowd/traits.h.
#pragma once

#include <algorithm>

#include "airsim360/base/random.h"
#include "airsim360/people/body/body.h"

namespace airsim360::internal {

/// Someone of any sex, age, stature and build. `child_share`: probability of an age below 16.
inline BodySpec DrawBodySpec(uint64_t seed, uint64_t person, double child_share = 0.12) {
  RngStream rng(seed, "people body", person);
  BodySpec spec;
  const bool child = rng.Chance(child_share);
  spec.sex = rng.Chance(0.5) ? Sex::kMale : Sex::kFemale;
  if (child) {
    // Medians of stature at 4, 6, 8, 10, 12, 14, 16 years; the spread is 4.5 %.
    constexpr double kMedian[] = {1.02, 1.15, 1.28, 1.38, 1.49, 1.64, 1.70};
    spec.age = rng.Uniform(5, 15.5);
    const double k = (spec.age - 4) / 2;
    const int i = static_cast<int>(k);
    spec.stature = (kMedian[i] + (kMedian[i + 1] - kMedian[i]) * (k - i)) * (1 + 0.045 * std::clamp(rng.Normal(), -2.0, 2.0));
  } else {
    spec.age = 18 + 65 * rng.Uniform() * rng.Uniform(0.35, 1);
    const double normal = std::clamp(rng.Normal(), -2.5, 2.5);
    spec.stature = spec.sex == Sex::kMale ? 1.756 + 0.067 * normal : 1.63 + 0.064 * normal;
  }
  spec.build = std::clamp(0.45 * rng.Normal(), -1.0, 1.0);
  spec.look = rng.Bits();
  return spec;
}

}  // namespace airsim360::internal
