// What usually went wrong when predictions are far from the truth: a guess in words, from the numbers alone.
#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace airsim360 {

struct LikelyMistake {
  std::string text;   ///< names it; "" where none is likely
  bool sure = false;  ///< no honest prediction looks so, however noisy, blurred or constantly scaled; else it is merely probable
};

struct DepthLook {
  bool panorama = true;  ///< equirectangular over the whole width and height: rolls and the cosines of rays are looked for
  double png_scale = 0;  ///< metres a unit of predictions that are 16-bit PNGs; 0 = they are none
};

/// Another unit, depth along an axis for range along the ray (in panoramas the ratio follows the cosine), inverse or normalised depth,
/// logarithms, and pictures that are mirrored, rolled or upside down. Looks at a regular grid of pixels, row-major, width x height. A turn is
/// judged where it changes the truth, so that a symmetric scene shows none.
LikelyMistake LikelyDepthMistake(std::span<const double> prediction, std::span<const double> truth, int width, int height,
                                 const DepthLook& look = {});

/// The same of label pictures: another numbering (off by one, any other), one label everywhere, mirrored, rolled or upside down. Pixels whose
/// truth is `void_label` do not count.
LikelyMistake LikelyLabelMistake(std::span<const uint32_t> prediction, std::span<const uint32_t> truth, int width, int height,
                                 uint32_t void_label, bool panorama = true);

/// A sentence where many truths share the largest value, as sky or what is out of reach is written; "" otherwise. Truths up to `max_depth`.
std::string SharedMaximum(std::span<const double> truth, double max_depth);

}  // namespace airsim360
