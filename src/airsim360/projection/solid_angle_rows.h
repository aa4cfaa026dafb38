// Solid angles of the pixels of whole rows.
#pragma once

#include <span>

#include "airsim360/projection/camera.h"

namespace airsim360::internal {

/// SolidAngle of each pixel of the rows [first, last), one row after the other, into `values`, which is as long; the rays of corners that
/// pixels share are computed once.
void SolidAnglesOfRows(const Camera& camera, int first, int last, std::span<double> values);

}  // namespace airsim360::internal
