#include "airsim360/worlds/city_park/noise.h"

namespace airsim360::internal::park {
namespace {

// Four lanes, as GCC and Clang have them on any machine; every lane holds the very floats of Noise.
using Floats __attribute__((vector_size(16))) = float;
using Ints __attribute__((vector_size(16))) = int32_t;
using Words __attribute__((vector_size(16))) = uint32_t;

Floats UnitLanes(Words h) { return __builtin_convertvector(reinterpret_cast<Ints>(h >> 8), Floats) * 0x1p-24f; }
Floats MixLanes(Floats a, Floats b, Floats t) { return a + (b - a) * t; }
Ints FloorLanes(Floats x) {
  const Ints toward_zero = __builtin_convertvector(x, Ints);
  return toward_zero + (__builtin_convertvector(toward_zero, Floats) > x);  // a lane that holds is -1
}

Floats NoiseLanes(Floats x, Floats y, Words seed) {
  const Ints i = FloorLanes(x), j = FloorLanes(y);
  Floats u = x - __builtin_convertvector(i, Floats), v = y - __builtin_convertvector(j, Floats);
  u = u * u * (3 - 2 * u);
  v = v * v * (3 - 2 * v);
  const Words s = Scramble(seed * 83492791u + 17u), row = reinterpret_cast<Words>(j) * 19349663u;
  const Words row0 = Scramble(row ^ s), row1 = Scramble((row + 19349663u) ^ s);
  const Words c0 = reinterpret_cast<Words>(i) * 73856093u, c1 = c0 + 73856093u;
  const Floats low = MixLanes(UnitLanes(Scramble(c0 ^ row0)), UnitLanes(Scramble(c1 ^ row0)), u);
  return MixLanes(low, MixLanes(UnitLanes(Scramble(c0 ^ row1)), UnitLanes(Scramble(c1 ^ row1)), u), v);
}

}  // namespace

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
  // Each octave is turned by 37 degrees and twice as fine. All four are made as lanes: three cost no more than two.
  const auto turn = [](Vec2f p) { return Vec2f{1.6f * p.x - 1.2f * p.y + 3.1f, 1.2f * p.x + 1.6f * p.y + 1.7f}; };
  const Vec2f a{x, y}, b = turn(a), c = turn(b), d = turn(c);
  const auto s = static_cast<uint32_t>(seed);
  const Floats n = NoiseLanes(Floats{a.x, b.x, c.x, d.x}, Floats{a.y, b.y, c.y, d.y}, Words{s, s + 7, s + 14, s + 21});
  const float one = 0.5f * n[0], two = one + 0.25f * n[1], three = two + 0.125f * n[2];
  switch (octaves) {
    case 1:
      return n[0];
    case 2:
      return two / 0.75f;
    case 3:
      return three / 0.875f;
    default:
      return (three + 0.0625f * n[3]) / 0.9375f;
  }
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
