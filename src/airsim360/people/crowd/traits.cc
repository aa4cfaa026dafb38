#include "airsim360/people/crowd/traits.h"

#include <algorithm>
#include <cmath>

namespace airsim360::internal {
namespace {

/// Median stature of a child, metres, by whole years from 3 to 17.
double ChildStature(double age) {
  constexpr double kMedian[] = {0.95, 1.02, 1.09, 1.15, 1.22, 1.28, 1.33, 1.38, 1.43, 1.49, 1.56, 1.64, 1.68, 1.70, 1.71};
  const double k = std::clamp(age - 3, 0.0, 14.0);
  const auto i = std::min<size_t>(13, static_cast<size_t>(k));
  return kMedian[i] + (kMedian[i + 1] - kMedian[i]) * (k - static_cast<double>(i));
}

}  // namespace

PersonTraits DrawTraits(uint64_t seed, uint32_t index, std::optional<double> age, std::optional<bool> female) {
  RngStream rng(seed, "traits of person", index);
  PersonTraits traits;
  traits.name = "person " + std::to_string(index + 1);
  traits.look = rng.Bits();
  const double child = rng.Uniform(), years = rng.Uniform(), sex = rng.Uniform();
  const double stature = std::clamp(rng.Normal(), -2.2, 2.2), speed = std::clamp(rng.Normal(), -1.8, 1.8);
  // One in eight is a child of 6 to 14.
  traits.age = age.value_or(child < 0.125 ? 6 + 8 * years : 18 + 62 * std::pow(years, 1.3));
  traits.female = female.value_or(sex < 0.5);
  if (traits.age < 18) {
    traits.stature = ChildStature(traits.age) * (1 + 0.04 * stature);
  } else {
    traits.stature = traits.female ? 1.63 + 0.064 * stature : 1.756 + 0.067 * stature;
  }
  // Equal Froude numbers for the small; a slow decline after 50 (Weidmann 1993, from memory).
  const double by_age = traits.age > 50 ? 1 - 0.007 * (traits.age - 50) : 1;
  traits.free_speed = std::clamp((1.34 + 0.2 * speed) * by_age * std::sqrt(traits.stature / 1.7), 0.6, 1.9);
  return traits;
}

}  // namespace airsim360::internal
