#include "airsim360/worlds/city_park/noise.h"

namespace airsim360::internal::park {

float Noise(float x, float y, int seed) {
  const float fx = std::floor(x), fy = std::floor(y);
  const auto i = static_cast<uint32_t>(static_cast<int>(fx)), j = static_cast<uint32_t>(static_cast<int>(fy));
  float u = x - fx, v = y - fy;
  u = u * u * (3 - 2 * u);
  v = v * v * (3 - 2 * v);
  // As HashCell, the inner hashes once for both columns.
  const uint32_t s = Scramble(static_cast<uint32_t>(seed) * 83492791u + 17u);
  const uint32_t row0 = Scramble(j * 19349663u ^ s), row1 = Scramble((j + 1) * 19349663u ^ s);
  const uint32_t c0 = i * 73856093u, c1 = (i + 1) * 73856093u;
  return Mix(Mix(Unit(Scramble(c0 ^ row0)), Unit(Scramble(c1 ^ row0)), u), Mix(Unit(Scramble(c0 ^ row1)), Unit(Scramble(c1 ^ row1)), u), v);
}

float Fractal(float x, float y, int octaves, int seed) {
  float sum = 0, weight = 0.5f, total = 0;
  for (int i = 0; i < octaves; ++i) {
    sum += weight * Noise(x, y, seed + 7 * i);
    total += weight;
    weight *= 0.5f;
    // A turn of 37 degrees and a scale of 2.
    const float t = 1.6f * x - 1.2f * y + 3.1f;
    y = 1.2f * x + 1.6f * y + 1.7f;
    x = t;
  }
  return sum / total;
}

Cells Voronoi(float x, float y, int seed) {
  const int i = static_cast<int>(std::floor(x)), j = static_cast<int>(std::floor(y));
  float first = 81, second = 81;
  uint32_t id = 0;
  for (int b = j - 1; b <= j + 1; ++b) {
    for (int a = i - 1; a <= i + 1; ++a) {
      const uint32_t h = HashCell(a, b, seed);
      const float dx = static_cast<float>(a) + Unit(h) - x, dy = static_cast<float>(b) + Unit(Scramble(h + 1)) - y;
      const float d = dx * dx + dy * dy;
      if (d < first) {
        second = first;
        first = d;
        id = h;
      } else if (d < second) {
        second = d;
      }
    }
  }
  return {std::sqrt(first), std::sqrt(second), id};
}

}  // namespace airsim360::internal::park
