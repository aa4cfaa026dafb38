#include "airsim360/render/sky/noise.h"

#include <algorithm>

#include "airsim360/base/parallel.h"

namespace airsim360::internal {
namespace {

float Mix(float a, float b, float t) { return a + (b - a) * t; }
float Smooth(float t) { return t * t * (3.0f - 2.0f * t); }
int Wrap(int i, int period) { return period > 0 ? ((i % period) + period) % period : i; }

// 1 - distance to the nearest of the random points, one a cell.
float Worley(Vec3f p, int period) {
  const int x = static_cast<int>(std::floor(p.x)), y = static_cast<int>(std::floor(p.y)),
            z = static_cast<int>(std::floor(p.z));
  float best = 9;
  for (int k = 0; k < 27; ++k) {
    const int i = x + k % 3 - 1, j = y + k / 3 % 3 - 1, l = z + k / 9 - 1;
    const uint32_t h = HashLattice(Wrap(i, period), Wrap(j, period), Wrap(l, period));
    const Vec3f point{static_cast<float>(i) + static_cast<float>(h & 1023) / 1024.0f,
                      static_cast<float>(j) + static_cast<float>((h >> 10) & 1023) / 1024.0f,
                      static_cast<float>(l) + static_cast<float>((h >> 20) & 1023) / 1024.0f};
    best = std::min(best, Dot(point - p, point - p));
  }
  return 1.0f - std::min(1.0f, std::sqrt(best));
}

float ValueNoise3(Vec3f p, int period) {
  const float fx = std::floor(p.x), fy = std::floor(p.y), fz = std::floor(p.z);
  const int x = static_cast<int>(fx), y = static_cast<int>(fy), z = static_cast<int>(fz);
  const float u = Smooth(p.x - fx), v = Smooth(p.y - fy), w = Smooth(p.z - fz);
  const auto at = [&](int i, int j, int k) {
    return HashUnit(Wrap(x + i, period), Wrap(y + j, period), Wrap(z + k, period) + 1000);
  };
  return Mix(Mix(Mix(at(0, 0, 0), at(1, 0, 0), u), Mix(at(0, 1, 0), at(1, 1, 0), u), v),
             Mix(Mix(at(0, 0, 1), at(1, 0, 1), u), Mix(at(0, 1, 1), at(1, 1, 1), u), v), w);
}

}  // namespace

float ValueNoise(float x, float y, int seed, int period) {
  const float fx = std::floor(x), fy = std::floor(y);
  const int i = static_cast<int>(fx), j = static_cast<int>(fy);
  const float u = Smooth(x - fx), v = Smooth(y - fy);
  const auto at = [&](int a, int b) { return HashUnit(Wrap(i + a, period), Wrap(j + b, period), seed); };
  return Mix(Mix(at(0, 0), at(1, 0), u), Mix(at(0, 1), at(1, 1), u), v);
}

float FractalNoise(float x, float y, int octaves, int seed) {
  float sum = 0, weight = 0.5f, total = 0;
  for (int i = 0; i < octaves; ++i) {
    sum += weight * ValueNoise(x, y, seed + i);
    total += weight;
    weight *= 0.5f;
    const float turned = x * 1.62f - y * 1.18f + 3.1f;
    y = x * 1.18f + y * 1.62f + 7.7f;
    x = turned;
  }
  return sum / total;
}

CloudNoise::CloudNoise() : voxels_(static_cast<size_t>(kSize) * kSize * kSize) {
  ParallelFor(kSize, [&](int64_t k) {
    for (int j = 0; j < kSize; ++j) {
      for (int i = 0; i < kSize; ++i) {
        const Vec3f p =
            Vec3f{static_cast<float>(i), static_cast<float>(j), static_cast<float>(k)} * (1.0f / kSize);
        const float worley =
            0.55f * Worley(p * 4.0f, 4) + 0.27f * Worley(p * 8.0f, 8) + 0.18f * Worley(p * 16.0f, 16);
        const float value = 0.5f * ValueNoise3(p * 5.0f, 5) + 0.3f * ValueNoise3(p * 10.0f, 10) +
                            0.2f * ValueNoise3(p * 20.0f, 20);
        voxels_[(static_cast<size_t>(k) * kSize + j) * kSize + i] = 0.55f * worley + 0.45f * value;
      }
    }
  });
}

float CloudNoise::At(Vec3f p) const {
  p = p * static_cast<float>(kSize);
  const float fx = std::floor(p.x), fy = std::floor(p.y), fz = std::floor(p.z);
  const float u = p.x - fx, v = p.y - fy, w = p.z - fz;
  constexpr int kMask = kSize - 1;
  const int x0 = static_cast<int>(fx) & kMask, y0 = static_cast<int>(fy) & kMask,
            z0 = static_cast<int>(fz) & kMask;
  const int x1 = (x0 + 1) & kMask, y1 = (y0 + 1) & kMask, z1 = (z0 + 1) & kMask;
  const auto at = [&](int i, int j, int k) { return voxels_[(k * kSize + j) * kSize + i]; };
  return Mix(Mix(Mix(at(x0, y0, z0), at(x1, y0, z0), u), Mix(at(x0, y1, z0), at(x1, y1, z0), u), v),
             Mix(Mix(at(x0, y0, z1), at(x1, y0, z1), u), Mix(at(x0, y1, z1), at(x1, y1, z1), u), v), w);
}

}  // namespace airsim360::internal
