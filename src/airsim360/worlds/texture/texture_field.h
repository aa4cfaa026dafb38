// Periodic fields on a square grid, the raw material of the texture recipes: fractal noise, cells with true
// edge distance, stamped stones, drips. Everything wraps at the border; everything follows from its seed.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "airsim360/math/vector.h"

namespace airsim360::internal {

/// One number per texel of a square tile; the side is a power of two.
struct Field {
  int size = 0;
  std::vector<float> values;

  Field() = default;
  explicit Field(int n, float value = 0) : size(n), values(static_cast<size_t>(n) * static_cast<size_t>(n), value) {}
  float& operator[](size_t i) { return values[i]; }
  float operator[](size_t i) const { return values[i]; }
  size_t count() const { return values.size(); }
  /// Texel with wrapped coordinates, and its index.
  size_t Index(int x, int y) const {
    return static_cast<size_t>(y & (size - 1)) * static_cast<size_t>(size) + static_cast<size_t>(x & (size - 1));
  }
  float At(int x, int y) const { return values[Index(x, y)]; }
};

/// Gradient noise of `octaves` octaves from `cells_x` by `cells_y` lattice cells on; every octave `gain`
/// times as strong. Mean 0, standard deviation 1. Octaves finer than two texels a cell are left out.
Field FractalField(int size, uint32_t seed, int cells_x, int cells_y, int octaves, float gain = 0.5f);
/// The same of equal cells.
inline Field FractalField(int size, uint32_t seed, int cells, int octaves, float gain = 0.5f) {
  return FractalField(size, seed, cells, cells, octaves, gain);
}
/// Uniform in [-1, 1], texel by texel.
Field WhiteField(int size, uint32_t seed);
/// Two box filters of about this radius in texels, in both directions.
Field Blurred(const Field& field, float radius);
/// Shifts and scales to mean 0 and standard deviation 1.
void Normalize(Field& field);

/// Jittered points, one a cell, and what lies around them (Worley 1996).
class CellPattern {
 public:
  /// `jitter` 0 is a lattice, 1 random; every second row is shifted by `shift` cells.
  CellPattern(int columns, int rows, float jitter, uint32_t seed, float shift = 0);
  struct Cell {
    float nearest, edge;  ///< distance to the point and to the border with its neighbours, in cells
    float x, y;           ///< from the point, in cells
    uint32_t id;
  };
  /// At (u, v) of the tile, any real numbers.
  Cell At(float u, float v) const;

 private:
  int columns_, rows_;
  uint32_t seed_;
  std::vector<float> x_, y_;
};

/// Stones of 6 to 7 random faces dropped on a height field until they would cover `cover` times its area.
struct StoneOptions {
  float smallest, largest;  ///< radii, metres
  float cover;
  float angular;          ///< 0 round … 1 broken
  float relief;           ///< height over radius
  float lowest, highest;  ///< of their feet, metres
  float tilt;             ///< standard deviation of the slope of their tops
};
struct StoneField {
  Field height;              ///< metres
  std::vector<uint32_t> id;  ///< 0 where no stone lies
  Field rim;                 ///< 0 in the middle of a stone, 1 on its rim and where there is none
};
StoneField DropStones(int size, float tile, float floor, const StoneOptions& options, uint32_t seed);

/// Runs of dirty water down a wall: separate drips, each with its start, length and fade. Mean 0, sd 1.
Field DripField(int size, float tile, float per_square_metre, float widest, float longest, uint32_t seed);

/// Calls paint(index, distance over `radius`) for the texels of a disc; centre and radius in texels.
void Stamp(const Field& grid, float x, float y, float radius, const std::function<void(size_t, float)>& paint);

/// Distance in metres, at most `reach`, to closed wandering lines across the tile: `count` of them.
Field LineField(int size, float tile, int count, float wander, float reach, uint32_t seed);

}  // namespace airsim360::internal
