// Pictures that were mirrored, rolled or turned upside down.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace airsim360::internal {

/// A regular grid of a picture's pixels, at most 128x64.
struct SampleGrid {
  SampleGrid(int picture_width, int picture_height);
  int picture_width, picture_height, width, height;
  std::vector<size_t> pixels;  ///< row-major indices in the picture
};

/// Where the truth of a predicted pixel is if the prediction was turned so.
struct Turn {
  bool mirrored = false, flipped = false;
  int roll = 0;  ///< columns of the picture
  size_t From(const SampleGrid& grid, size_t pixel) const;
};

/// Errors of the predictions at a grid's pixels against the truths at Turn::From: 0 to 1, NaN where the two cannot be compared.
using TurnErrors = std::function<std::vector<double>(const Turn&)>;
/// Whether two pixels have the same truth.
using SameTruth = std::function<bool(size_t, size_t)>;

struct LikelyTurn {
  std::string words;  ///< "" where no turn is likely
  bool sure = false;
};
/// The turn that explains most of the errors where it changes the truth.
LikelyTurn FindTurn(const SampleGrid& grid, bool panorama, const TurnErrors& errors, const SameTruth& same);

}  // namespace airsim360::internal
