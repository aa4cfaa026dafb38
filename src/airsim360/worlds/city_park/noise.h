// Value noise of points of the plane, for everything in the park that varies from place to place.
#pragma once

#include <cmath>
#include <cstdint>

#include "airsim360/base/scramble.h"
#include "airsim360/math/vector.h"

namespace airsim360::internal::park {

/// Well mixed hash of integers, and the same in [0, 1).
inline uint32_t HashCell(int x, int y, int seed) {
  return Scramble(static_cast<uint32_t>(x) * 73856093u ^
                  Scramble(static_cast<uint32_t>(y) * 19349663u ^ Scramble(static_cast<uint32_t>(seed) * 83492791u + 17u)));
}
inline float Unit(uint32_t h) { return static_cast<float>(h >> 8) * 0x1p-24f; }

inline float Mix(float a, float b, float t) { return a + (b - a) * t; }
inline Vec3f Mix(Vec3f a, Vec3f b, float t) { return a + (b - a) * t; }
/// 0 at a, 1 at b, smooth between; b may be the smaller.
inline float Ramp(float a, float b, float x) {
  float t = (x - a) / (b - a);
  t = t < 0 ? 0 : t > 1 ? 1 : t;
  return t * t * (3 - 2 * t);
}

/// In [0, 1], cells of 1.
float Noise(float x, float y, int seed);
/// One to four `octaves` of Noise, each turned and twice as fine, weights halving; in [0, 1], mean 0.5.
float Fractal(float x, float y, int octaves, int seed);
/// Distances to the nearest and second nearest of random points, one a cell, and the nearest one's hash.
struct Cells {
  float first, second;
  uint32_t id;
};
Cells Voronoi(float x, float y, int seed);

}  // namespace airsim360::internal::park
