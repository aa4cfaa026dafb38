// What usually went wrong when predicted ranges are far from the truth: a guess in words, from the numbers alone.
#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace airsim360 {

/// A sentence that names the likely mistake, or "" where none is likely: another unit (a ratio close to 100 or 1000), depth along an
/// axis for range along the ray (in panoramas the ratio follows the cosine), pictures that are mirrored, turned by 180 degrees or upside down.
/// Looks at a regular sample of the pixels with truths above 0; row-major, width x height. Mistakes are named only where undoing them
/// explains most of the error.
std::string LikelyDepthMistake(std::span<const double> prediction, std::span<const double> truth, int width, int height);

/// The same of label pictures: mirrored, turned or upside down, where undoing it gives more than twice as many equal pixels.
std::string LikelyLabelMistake(std::span<const uint32_t> prediction, std::span<const uint32_t> truth, int width, int height);

}  // namespace airsim360
