// Shadows' edges of tier `high` smoothed along surfaces, compiled per instruction set.
#pragma once

#include <cstdint>

#include "airsim360/base/kernel_isa.h"
#include "airsim360/math/vector.h"
#include "airsim360/render/frame/camera_rays.h"

namespace airsim360::internal {

/// Images in canonical columns.
struct SunPlanes {
  const float* range;
  const uint32_t* entity;
  const Vec3f* normal;
  const float* sun_seen;    ///< share of the disc, of a pixel's rays
  const uint8_t* penumbra;  ///< as HighTile::penumbra
  float* sun_smooth;
};

}  // namespace airsim360::internal

/// Fills `sun_smooth` of the tile whose corner is (column, row). Near the edge of a shadow it is the mean of the pixels
/// around that show the same surface, weighted by their distance along it; so far as the penumbra is wide. `cone_angle`
/// is a pixel's.
AIRSIM360_DECLARE_KERNEL(void SmoothSunTile(const SunPlanes& planes, const RayField& field, float cone_angle, int column, int row))
