// What the colours of a picture mean, drawn: swatches with words, in columns.
#pragma once

#include <string>
#include <vector>

#include "airsim360/image/image.h"

namespace airsim360 {

class ColorLegend {
 public:
  struct Entry {
    Rgb8 color;
    std::string text;  ///< ASCII
  };
  /// Columns as wide as the longest text needs, as many as fit into `width` pixels.
  ColorLegend(std::vector<Entry> entries, int width);
  int height() const { return rows_ * kLine; }
  /// With its top left corner at (0, top).
  void Draw(int top, Image<Rgb8>& canvas) const;

  static constexpr int kSwatch = 12, kLine = 16, kGap = 4;  ///< pixels

 private:
  std::vector<Entry> entries_;
  int column_ = 1, columns_ = 1, rows_ = 0;
};

}  // namespace airsim360
