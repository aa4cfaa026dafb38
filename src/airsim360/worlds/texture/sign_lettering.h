// Lettering of signs and billboards: bold sans-serif capitals drawn from strokes, so that they are smooth at any size.
#pragma once

#include <string_view>
#include <vector>

namespace airsim360::internal {

/// One line of capitals, digits and " .,-+!&%'/"; other characters leave a gap. Lengths in cap heights, x from the left edge
/// to the right, y from the top downwards.
class SignLettering {
 public:
  /// `weight`: thickness of the strokes, 0.10 (light) to 0.22 (heavy).
  explicit SignLettering(std::string_view text, float weight = 0.17f);
  float width() const { return width_; }
  bool Inked(float x, float y) const;

 private:
  struct Placed {
    char letter;
    float left, right;
  };
  std::vector<Placed> letters_;
  float half_, width_ = 0;
};

}  // namespace airsim360::internal
