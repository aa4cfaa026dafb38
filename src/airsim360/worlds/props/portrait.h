// Studio portraits for posters: a head and shoulders of smooth shapes, traced and lit once, when the poster is painted.
#pragma once

#include "airsim360/math/vector.h"

namespace airsim360::internal {

/// Linear colours of who sits there.
struct Sitter {
  Vec3f skin, hair, iris, jacket, shirt, tie;
  float turn = 0;  ///< of the head, radians, to the viewer's right
};

/// The picture at (x, y): x to the right and y up from the point between the shoulders and the chin, in heads (the head is
/// about 1 high, the shoulders 2.3 wide). `background` where nobody is.
Vec3f PortraitColor(const Sitter& sitter, float x, float y, Vec3f background);

}  // namespace airsim360::internal
