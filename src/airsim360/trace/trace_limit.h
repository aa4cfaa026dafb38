// What can be traced: Embree ends the process on rays beyond it.
#pragma once

#include "airsim360/math/transform.h"

namespace airsim360 {

/// What the coordinates of a ray's origin and direction may add up to, without their signs. A ray beyond it,
/// with a number that is none, or with t_near below 0 hits nothing, as a point beyond it is near nothing. The
/// vertices of worlds and all that users may ask for (kCoordinateLimit) are held below it.
inline constexpr float kTraceLimit = 1e10f;

namespace internal {

/// Inverse of a matrix; false if it has none.
bool Invert(const Mat3f& A, Mat3f& inverse);

/// Whether rays within the limit stay traceable in the frame of an instance: not of one that is squeezed to
/// next to nothing, which is not met at all.
bool IsTraceable(const Mat3f& A);

}  // namespace internal
}  // namespace airsim360
