// The passes between light and picture, row by row: one copy per instruction set, bit for bit the same results.
#pragma once

#include <cstdint>

#include "airsim360/base/kernel_isa.h"
#include "airsim360/image/image.h"

namespace airsim360::internal {

/// Rows hold `width` numbers and kRowPad more on either side; pointers are to number 0, 64-byte aligned.
inline constexpr int kRowPad = 16;
struct ColorRow {
  float *r, *g, *b;
};
struct ConstColorRow {
  const float *r, *g, *b;
};

/// What exposure does to light, and the noise of it: amplitude sqrt(signal slope + floor) times a normal number of
/// variance 1.
struct ExposeRowTask {
  int width;
  float exposure, slope, floor;
  uint32_t key;  ///< of the row's noise
  float grain;   ///< columns of noise in a column of the picture, at most 1
};

/// From exposed light to encoded values: gains of the white balance, curve, saturation.
struct ToneRowTask {
  int width;
  float side;  ///< weight of either neighbour in the blur, both ways
  float gain[3];
  float clip_inverse;  ///< 1 / the light that becomes 1
  const float* curve;  ///< kCurveSize + 1 encoded values over the square root of light / clip; the nearest is taken
  float saturation;
};
inline constexpr int kCurveSize = 4096;

}  // namespace airsim360::internal

/// Sums a row of light, at most `most` in each channel, times `weight` onto `sum` (3 width numbers).
AIRSIM360_DECLARE_KERNEL(void AddRow(const Rgb32f* light, int width, float most, float weight, float* sum))
/// kept light + scattered, for columns `first` … of the row and then its beginning.
AIRSIM360_DECLARE_KERNEL(void LoadRow(const Rgb32f* light, int width, int first, float kept, ConstColorRow scattered, ColorRow out))
/// `cells` numbers of one row, linearly interpolated at `width` = cells or 2 cells columns: reads one number beyond
/// either end.
AIRSIM360_DECLARE_KERNEL(void SpreadRow(const float* from, int cells, int width, float* out))
/// In place.
AIRSIM360_DECLARE_KERNEL(void ExposeRow(const ExposeRowTask& task, ColorRow row))
/// Encoded values of the middle of three exposed rows, blurred by (side, 1 - 2 side, side) both ways, and their luminance.
AIRSIM360_DECLARE_KERNEL(void ToneRow(const ToneRowTask& task, const ConstColorRow* rows, ColorRow scratch, ColorRow out, float* luminance))
/// Codes of encoded values, with `amount` of the difference between luminance and its 5 x 5 blur (rows y - 2 … y + 2 of
/// luminance) added.
AIRSIM360_DECLARE_KERNEL(void SharpenRow(int width, float amount, ConstColorRow encoded, const float* const* luminance, float* scratch,
                                         Rgb8* out))
