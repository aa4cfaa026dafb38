#pragma once

#include "airsim360/math/vector.h"

namespace airsim360 {

/// Luminance of linear sRGB (Rec. ITU-R BT.709), in the unit of its channels.
inline float Luminance(Vec3f c) { return 0.2126f * c.x + 0.7152f * c.y + 0.0722f * c.z; }

}  // namespace airsim360
