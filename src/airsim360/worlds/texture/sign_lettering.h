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
  /// A stroke in its letter's box, with all that does not depend on the point asked for.
  struct Stroke {
    bool arc, dot;
    float x, y;                              ///< start of a line, or middle of an ellipse
    float dx = 0, dy = 0, length = 0;        ///< of a line
    float before = 0, beyond = 0;            ///< how far it is inked past its ends
    float rx = 0, ry = 0, from = 0, to = 0;  ///< of an ellipse: radii, degrees
  };
  struct Placed {
    float left, right;
    std::vector<Stroke> strokes;
  };
  bool OnStroke(const Stroke& stroke, float x, float y) const;
  std::vector<Placed> letters_;
  float half_, width_ = 0;
};

}  // namespace airsim360::internal
