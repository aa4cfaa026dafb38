// What a recipe paints: colour, height and roughness fields of one square tile.
#pragma once

#include "airsim360/worlds/texture/texture_field.h"

namespace airsim360::internal {

struct SurfaceMaps {
  SurfaceMaps(int n, float tile_metres) : size(n), tile(tile_metres), red(n), green(n), blue(n), height(n), roughness(n, 0.6f) {}

  int size;
  float tile;              ///< metres a side
  Field red, green, blue;  ///< linear albedo
  Field height;            ///< metres
  Field roughness;

  size_t count() const { return height.count(); }
  float texels_per_metre() const { return static_cast<float>(size) / tile; }
  /// Lattice cells of about `metres` in a tile, at least 1.
  int Cells(float metres) const { return metres >= tile ? 1 : static_cast<int>(tile / metres + 0.5f); }
  Vec3f color(size_t i) const { return {red[i], green[i], blue[i]}; }
  void SetColor(size_t i, Vec3f c) { red[i] = c.x, green[i] = c.y, blue[i] = c.z; }
  /// Noise with features of about `metres` and `octaves` finer ones; mean 0, standard deviation 1.
  Field Noise(uint32_t seed, float metres, int octaves, float gain = 0.5f) const {
    return FractalField(size, seed, Cells(metres), octaves, gain);
  }
  /// paint(i, u, v) for every texel, u and v in [0, 1) of its centre.
  template <class F>
  void ForEach(F paint) {
    const float scale = 1 / static_cast<float>(size);
    size_t i = 0;
    for (int y = 0; y < size; ++y) {
      for (int x = 0; x < size; ++x, ++i) paint(i, (static_cast<float>(x) + 0.5f) * scale, (static_cast<float>(y) + 0.5f) * scale);
    }
  }
};

/// Takes out what is larger than about `radius` metres, so that no blot marks the tile: what is that large
/// belongs into the world (shading_ground.h).
void Flatten(SurfaceMaps& maps, float radius);
/// Root mean square of the slope of `height`.
double SlopeOf(const SurfaceMaps& maps);

}  // namespace airsim360::internal
