// What tier `high` keeps of a frame between its passes. Images are in canonical columns (camera_rays.h): so
// nothing depends on which way the camera is turned until the last copy.
#pragma once

#include <cstdint>
#include <vector>

#include "airsim360/base/table_vector.h"
#include "airsim360/image/image.h"
#include "airsim360/math/vector.h"
#include "airsim360/render/frame/tile_kernel.h"
#include "airsim360/render/high/gloss_filter.h"
#include "airsim360/render/high/high_shading.h"

namespace airsim360::internal {

struct HighBuffers {
  Image<float> range;  ///< 0 = nothing hit
  Image<EntityId> entity;
  Image<Vec3f> normal;  ///< shading normal
  Image<Rgb32f> light;  ///< irradiance, of the samples and then filtered
  Image<uint8_t> light_samples;
  Image<float> sun_seen, sun_smooth;  ///< share of the disc: of the rays; of tiles with penumbrae, smoothed in these
  Image<uint8_t> penumbra;            ///< as HighTile::penumbra
  Image<uint8_t> luma, edges;
  TableVector<LightTerms> terms;  ///< of each tile
  std::vector<uint8_t> smooth;    ///< of each tile: not 0 if it has penumbrae
  GlossPlanes gloss;              ///< where there are rooms

  void Resize(int width, int height);
  /// Share of the disc at the `pixel`-th pixel of the images, smoothed where there are penumbrae.
  float Sun(int64_t pixel) const {
    const int64_t tile_column = pixel % range.width() / kTileSize, tile_row = pixel / range.width() / kTileSize;
    const bool smoothed = smooth[static_cast<size_t>(tile_row * across() + tile_column)] != 0;
    return (smoothed ? sun_smooth : sun_seen).pixels()[static_cast<size_t>(pixel)];
  }
  int across() const { return (range.width() + kTileSize - 1) / kTileSize; }
  int down() const { return (range.height() + kTileSize - 1) / kTileSize; }
};

}  // namespace airsim360::internal
