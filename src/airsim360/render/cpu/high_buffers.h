// What tier `high` keeps of a frame between its passes. Images are in canonical columns (camera_rays.h): so
// nothing depends on which way the camera is turned until the last copy.
#pragma once

#include <cstdint>
#include <vector>

#include "airsim360/base/table_vector.h"
#include "airsim360/image/image.h"
#include "airsim360/math/vector.h"
#include "airsim360/render/cpu/tile_kernel.h"
#include "airsim360/render/shading/high_shading.h"

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

  void Resize(int width, int height);
  /// Share of the disc, smoothed where there are penumbrae.
  float Sun(int x, int y) const {
    const bool smoothed = smooth[static_cast<size_t>(y / kTileSize * across() + x / kTileSize)] != 0;
    return smoothed ? sun_smooth(x, y) : sun_seen(x, y);
  }
  int across() const { return (range.width() + kTileSize - 1) / kTileSize; }
  int down() const { return (range.height() + kTileSize - 1) / kTileSize; }
};

/// Direction of a canonical pixel's centre in W.
inline Vec3f PixelDirection(const RayField& f, int x, int y) {
  if (f.separable) {
    const double s = f.row_scale[y];
    return {static_cast<float>(s * f.column_x[x] + f.row_x[y]),
            static_cast<float>(s * f.column_y[x] + f.row_y[y]),
            static_cast<float>(s * f.column_z[x] + f.row_z[y])};
  }
  const int64_t i = static_cast<int64_t>(y) * f.stride + x;
  const double d[3] = {f.ray_x[i], f.ray_y[i], f.ray_z[i]};
  Vec3f out;
  for (int k = 0; k < 3; ++k)
    out[k] = static_cast<float>(f.R[3 * k] * d[0] + f.R[3 * k + 1] * d[1] + f.R[3 * k + 2] * d[2]);
  return out;
}

/// Share of the sun's disc seen from a pixel near the edge of a shadow: the mean of the pixels around that show the
/// same surface, weighted by their distance along it; so far as the penumbra is wide. `cone_angle` is a pixel's.
float SmoothSun(const HighBuffers& buffers, const RayField& field, float cone_angle, int x, int y);

}  // namespace airsim360::internal
