// What usually went wrong when predictions are far from the truth: a guess in words, from the numbers alone.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>

namespace airsim360 {

/// Bad predictions are no mistake. Sure is only what one other reading explains nearly completely (nine tenths of the pixels are right then) and
/// what no net predicts by being bad; all else that looks like a mistake is probable.
struct LikelyMistake {
  std::string text;  ///< names it; "" where none is likely
  bool sure = false;
};

namespace internal {

/// Surely a mistake is only a reading under which so many of the pixels are right.
inline constexpr double kNearlyAll = 0.9;
/// Fewer pixels say nothing.
inline constexpr size_t kLeastSamples = 50;

}  // namespace internal

struct DepthLook {
  bool panorama = true;  ///< equirectangular over the whole width and height: rolls and the cosines of rays are looked for
  double png_scale = 0;  ///< metres a unit of predictions that are 16-bit PNGs; 0 = they are none
};

/// Another unit, depth along an axis for range along the ray (in panoramas the ratio follows the cosine), inverse or normalised depth,
/// logarithms, and pictures that are mirrored, rolled or upside down. Looks at a regular grid of pixels, row-major, width x height. A turn is
/// judged where it changes the truth, so that a symmetric scene shows none. Right is within a factor of 1.25.
LikelyMistake LikelyDepthMistake(std::span<const double> prediction, std::span<const double> truth, int width, int height,
                                 const DepthLook& look = {});

struct LabelLook {
  uint32_t void_label = 0;  ///< truths of it do not count
  bool panorama = true;
  std::function<bool(uint32_t)> is_class = {};  ///< what a net could predict; empty = anything, and then no numbering is surely wrong
};

/// The same of label pictures: another numbering (off by one, any other), one label everywhere, mirrored, rolled or upside down.
LikelyMistake LikelyLabelMistake(std::span<const uint32_t> prediction, std::span<const uint32_t> truth, int width, int height,
                                 const LabelLook& look = {});

/// The same of optical flow, (dx, dy) a pixel, NaN = unknown: sign, exchanged axes, units, pictures that were mirrored or turned. Probable where
/// undoing it takes away half of the error of the pixels that it changes. Right is within a quarter of the flow's length.
LikelyMistake LikelyFlowMistake(std::span<const double> prediction, std::span<const double> truth, int width, int height, bool panorama);

/// A sentence where many truths share the largest value, as sky or what is out of reach is written; "" otherwise. Truths up to `max_depth`.
std::string SharedMaximum(std::span<const double> truth, double max_depth);

}  // namespace airsim360
