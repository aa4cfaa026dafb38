#include "airsim360/dataset/color_legend.h"

#include <algorithm>
#include <utility>

#include "airsim360/image/draw.h"

namespace airsim360 {

ColorLegend::ColorLegend(std::vector<Entry> entries, int width) : entries_(std::move(entries)) {
  for (const Entry& entry : entries_) column_ = std::max(column_, kSwatch + 3 * kGap + TextWidth(entry.text, 1));
  columns_ = std::max(1, width / column_);
  rows_ = (static_cast<int>(entries_.size()) + columns_ - 1) / columns_;
}

void ColorLegend::Draw(int top, Image<Rgb8>& canvas) const {
  for (size_t i = 0; i < entries_.size(); ++i) {
    const int x = kGap + static_cast<int>(i) % columns_ * column_;
    const int y = top + static_cast<int>(i) / columns_ * kLine;
    FillRectangle(x, y, kSwatch, kSwatch, entries_[i].color, canvas);
    DrawText(entries_[i].text, x + kSwatch + kGap, y + 2, {0, 0, 0}, 1, canvas);
  }
}

}  // namespace airsim360
