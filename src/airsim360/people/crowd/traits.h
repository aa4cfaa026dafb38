// Who people are: age, sex, stature and speed by published distributions.
#pragma once

#include <optional>

#include "airsim360/people/crowd/crowd.h"

namespace airsim360::internal {

/// Person `index`; age and sex as given, or drawn. Adults: stature 1.756 (0.067) m for men and 1.63 (0.064) m
/// for women; children by age (reference: ANSUR, CDC medians); walking speed 1.34 (0.26) m/s for adults
/// (Weidmann 1993), slower with age and for the small.
PersonTraits DrawTraits(uint64_t seed, uint32_t index, std::optional<double> age = {}, std::optional<bool> female = {});

}  // namespace airsim360::internal
