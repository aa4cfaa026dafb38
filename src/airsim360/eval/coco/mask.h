// Binary masks as run lengths, as COCO's files hold them. Pure functions; InputError for damage.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace airsim360 {

/// Lengths of runs in column-major order (down the first column, then the second …), in turn of pixels outside and inside
/// the mask, beginning outside (a first length of 0 where the first pixel is inside). They sum to width * height.
struct RleMask {
  uint32_t width = 0, height = 0;
  std::vector<uint32_t> counts;
  friend bool operator==(const RleMask&, const RleMask&) = default;
};

/// InputError unless the lengths sum to the number of pixels, of which there must be at most kMaxPixels (image/codecs.h).
void CheckMask(const RleMask& mask);

/// Row-major pixels, non-zero = inside.
RleMask EncodeMask(std::span<const uint8_t> pixels, int width, int height);
std::vector<uint8_t> DecodeMask(const RleMask& mask);

/// COCO's compressed string: each length after the third as the difference to the one two before, in groups of five bits
/// of a two's complement number, low group first, plus 32 where more follow, plus 48.
RleMask ParseCompressedRle(std::string_view text, int width, int height);
std::string CompressRle(const RleMask& mask);

/// What lies inside a closed polygon [x0, y0, x1, y1, …] in pixels, where (0, 0) is the top left corner of the picture:
/// COCO's rule. Its outline is drawn on a grid five times finer, where columns' centres cross it a run begins or ends.
/// InputError for fewer than two points or points farther than 100,000 pixels away.
RleMask RasterizePolygon(std::span<const double> polygon, int width, int height);
/// The rectangle [x, y, width, height] as such a polygon.
RleMask RasterizeBox(const std::array<double, 4>& box, int width, int height);

/// What is inside any of the masks, which have the same size.
RleMask UniteMasks(std::span<const RleMask> masks);

/// The mask as it was before each row was moved `columns` to the right, the seam joined.
RleMask RollMaskBack(const RleMask& mask, int columns);

uint64_t MaskArea(const RleMask& mask);
/// The number of pixels inside both.
uint64_t SharedArea(const RleMask& a, const RleMask& b);
/// [x, y, width, height] of the tightest box, zeros for an empty mask.
std::array<double, 4> MaskBox(const RleMask& mask);

/// Sums of weights of rows, for areas that are not counts of pixels: all pixels of a row weigh the same.
class RowSums {
 public:
  /// One weight a row.
  explicit RowSums(std::span<const double> weights);
  /// Of the first `count` pixels in column-major order.
  double Before(uint64_t count) const { return static_cast<double>(count / height_) * sums_.back() + sums_[count % height_]; }

 private:
  uint64_t height_;
  std::vector<double> sums_;  // of the first rows of a column
};
double WeighedArea(const RleMask& mask, const RowSums& sums);
double WeighedSharedArea(const RleMask& a, const RleMask& b, const RowSums& sums);

}  // namespace airsim360
