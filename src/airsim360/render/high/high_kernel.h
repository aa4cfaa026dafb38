// Loops over the pixels of a tile of tier `high`, compiled per instruction set.
#pragma once

#include "airsim360/render/frame/tile_kernel.h"
#include "airsim360/render/high/high_shading.h"

namespace airsim360::internal {

/// Images, in canonical columns, of what other pixels will read.
struct HighPlanes {
  float* range;
  uint32_t* entity;
  Vec3f* normal;
  Rgb32f* light;
  uint8_t* light_samples;
  float* sun_seen;
  uint8_t* penumbra;
};

/// What CombineTile reads in canonical columns, and where it writes.
struct CombinedPlanes {
  const Rgb32f* light;  ///< irradiance
  const float* sun;     ///< share of the disc seen
  float exposure;
  Rgb32f* radiance;  ///< in the image's columns
  uint8_t* luma;     ///< in canonical columns: how light pixels will look, of 255; nullptr = not wanted
};

}  // namespace airsim360::internal

/// Writes a tile; returns other than 0 if it has penumbrae. Of `target` only the place counts.
AIRSIM360_DECLARE_KERNEL(uint8_t StoreHigh(const LabelTile& labels, const HighTile& shaded, const TileTarget& target,
                                           const HighPlanes& planes))
/// Radiance of the centres of a tile's pixels once their light is known. Of `target` only the place counts.
AIRSIM360_DECLARE_KERNEL(void CombineTile(const LightTerms& terms, const TileTarget& target, const CombinedPlanes& planes))
