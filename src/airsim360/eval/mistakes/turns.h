// Pictures that were mirrored, rolled or turned upside down.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace airsim360::internal {

/// A regular grid of a picture's pixels.
struct SampleGrid {
  /// At most so many columns and rows.
  SampleGrid(int picture_width, int picture_height, int most_columns = 128, int most_rows = 64);
  int picture_width, picture_height, width, height;
  std::vector<int> columns, rows;  ///< of the picture
  std::vector<size_t> pixels;      ///< row-major indices in the picture
};

/// What was done to a prediction: mirrored or flipped, then rolled by columns of the picture to the right.
struct Turn {
  bool mirrored = false, flipped = false;
  int roll = 0;
};
/// The pixels of which the predictions at the grid's pixels are, if they were turned so.
std::vector<size_t> TruthsOf(const SampleGrid& grid, const Turn& turn);

/// How a prediction is compared with its truth at the pixels of one grid.
struct TurnComparison {
  /// Errors against the truths at `places`, one a pixel of the grid: 0 to 1, NaN where the two cannot be compared.
  std::function<std::vector<double>(std::span<const size_t> places)> errors;
  /// Whether the truths at a[i] and b[i] are the same.
  std::function<std::vector<uint8_t>(std::span<const size_t> a, std::span<const size_t> b)> same;
};

struct LikelyTurn {
  std::string words;  ///< "" where no turn is likely
  bool sure = false;  ///< nine tenths of the prediction are right (an error below ln 1.25) when it is turned back
  double right = 0;   ///< that share
};
/// The turn that explains most of the errors where it changes the truth. A coarse grid decides whether the fine one is looked at.
LikelyTurn FindTurn(int width, int height, bool panorama, const std::function<TurnComparison(const SampleGrid&)>& compare);

}  // namespace airsim360::internal
