#include "airsim360/render/sky/noise.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>

#include "airsim360/base/disk_cache.h"
#include "airsim360/base/parallel.h"

namespace airsim360::internal {
namespace {

float Quintic(float t) { return t * t * t * (t * (t * 6 - 15) + 10); }
int Wrap(int i, int period) { return period > 0 ? ((i % period) + period) % period : i; }

// A coordinate of the lattice and the next, both wrapped: divisions, which take longer than all the rest, where they are needed alone.
struct Pair {
  Pair(int i, int period) {
    const bool inside = period <= 0 || (i >= 0 && i < period);
    of[0] = inside ? i : Wrap(i, period);
    of[1] = of[0] + 1 == period ? 0 : of[0] + 1;
  }
  int of[2];
};

// Component of a lattice gradient from ten bits of its hash, -1 … 1.
float Part(uint32_t hash, int shift) { return static_cast<float>((hash >> shift) & 1023) * (2.0f / 1023) - 1; }

// Gradient noise of a cube that wraps: hashes of its corners, those of the far faces are the near ones'.
struct Gradients {
  explicit Gradients(int period) : row(period + 1), of(static_cast<size_t>(row) * row * row) {
    for (int k = 0; k < row * row * row; ++k) of[k] = HashLattice(k % row % period, k / row % row % period, k / row / row % period + 5000);
  }
  // At p in [0, period).
  float At(Vec3f p) const {
    const int x = FloorToInt(p.x), y = FloorToInt(p.y), z = FloorToInt(p.z);
    const Vec3f f{p.x - static_cast<float>(x), p.y - static_cast<float>(y), p.z - static_cast<float>(z)};
    float corner[8];
    for (int k = 0; k < 8; ++k) {
      const int i = k & 1, j = k >> 1 & 1, l = k >> 2;
      const uint32_t h = of[(static_cast<size_t>(z + l) * row + y + j) * row + x + i];
      corner[k] = Part(h, 0) * (f.x - static_cast<float>(i)) + Part(h, 10) * (f.y - static_cast<float>(j)) +
                  Part(h, 20) * (f.z - static_cast<float>(l));
    }
    const float u = Quintic(f.x), v = Quintic(f.y), w = Quintic(f.z);
    return 1.1f * Mix(Mix(Mix(corner[0], corner[1], u), Mix(corner[2], corner[3], u), v),
                      Mix(Mix(corner[4], corner[5], u), Mix(corner[6], corner[7], u), v), w);
  }
  int row;
  std::vector<uint32_t> of;
};

// Random points, one a cell of a cube that wraps, relative to their cells' corners. A layer of cells around the cube repeats those of
// its other side.
struct Points {
  explicit Points(int cells) : row(cells + 2), of(static_cast<size_t>(row) * row * row) {
    for (int k = 0; k < row * row * row; ++k) {
      const int x = Wrap(k % row - 1, cells), y = Wrap(k / row % row - 1, cells), z = Wrap(k / row / row - 1, cells);
      const uint32_t h = HashLattice(x, y, z + 100 * cells);
      of[k] = {static_cast<float>(h & 1023) / 1024.0f, static_cast<float>((h >> 10) & 1023) / 1024.0f,
               static_cast<float>(h >> 20) / 4096.0f};
    }
  }
  // Distance from p in the cube, in cells. Rows of cells that are farther off than a point found already are left out.
  float Nearest(Vec3f p) const {
    constexpr int8_t kRows[9][2] = {{0, 0}, {-1, 0}, {1, 0}, {0, -1}, {0, 1}, {-1, -1}, {1, -1}, {-1, 1}, {1, 1}};
    constexpr float kRounding = 1e-4f;
    const int x = FloorToInt(p.x), y = FloorToInt(p.y), z = FloorToInt(p.z);
    const float v = p.y - static_cast<float>(y), w = p.z - static_cast<float>(z);
    const float off_y[] = {v * v, 0, (1 - v) * (1 - v)}, off_z[] = {w * w, 0, (1 - w) * (1 - w)};
    float best = 9;
    for (const auto& [j, l] : kRows) {
      if (off_y[j + 1] + off_z[l + 1] > best + kRounding) continue;
      const Vec3f* const q = &of[(static_cast<size_t>(z + l + 1) * row + y + j + 1) * row + x + 1];
      const auto fy = static_cast<float>(y + j), fz = static_cast<float>(z + l);
      for (int i = -1; i <= 1; ++i) {
        const Vec3f d{static_cast<float>(x + i) + q[i].x - p.x, fy + q[i].y - p.y, fz + q[i].z - p.z};
        best = std::min(best, Dot(d, d));
      }
    }
    return std::sqrt(best);
  }
  int row;
  std::vector<Vec3f> of;
};

}  // namespace

float ValueNoise(float x, float y, int seed, int period) {
  const int i = FloorToInt(x), j = FloorToInt(y);
  const float u = SmoothStep(0, 1, x - static_cast<float>(i)), v = SmoothStep(0, 1, y - static_cast<float>(j));
  const Pair column(i, period), row(j, period);
  const auto at = [&](int a, int b) { return HashUnit(column.of[a], row.of[b], seed); };
  return Mix(Mix(at(0, 0), at(1, 0), u), Mix(at(0, 1), at(1, 1), u), v);
}

float GradientNoise(float x, float y, int period, int seed) {
  const int i = FloorToInt(x), j = FloorToInt(y);
  const float fx = x - static_cast<float>(i), fy = y - static_cast<float>(j);
  const Pair column(i, period), row(j, period);
  const auto at = [&](int a, int b) {
    const uint32_t h = HashLattice(column.of[a], row.of[b], seed);
    return Part(h, 0) * (fx - static_cast<float>(a)) + Part(h, 10) * (fy - static_cast<float>(b));
  };
  const float u = Quintic(fx), v = Quintic(fy);
  return 1.6f * Mix(Mix(at(0, 0), at(1, 0), u), Mix(at(0, 1), at(1, 1), u), v);
}

float FractalNoise(float x, float y, int period, int octaves, int seed) {
  float sum = 0, weight = 1, total = 0;
  for (int i = 0; i < octaves; ++i) {
    sum += weight * GradientNoise(x, y, period, seed + 101 * i);
    total += weight;
    weight *= 0.5f;
    const float tx = period > 0 ? 2 * x : x * 1.62f - y * 1.18f + 3.1f, ty = period > 0 ? 2 * y : x * 1.18f + y * 1.62f + 7.7f;
    x = tx, y = ty, period *= 2;
  }
  return sum / total;
}

FractalRow::FractalRow(float y, int period, int octaves, int seed) {
  for (int k = 0; k < octaves; ++k, y = 2 * y, period *= 2) {
    const int j = FloorToInt(y);
    const float fy = y - static_cast<float>(j);
    const Pair row(j, period);
    Octave octave{period, Quintic(fy), {}, {}};
    for (int b = 0; b < 2; ++b) {
      for (int i = 0; i < period; ++i) {
        const uint32_t h = HashLattice(i, row.of[b], seed + 101 * k);
        octave.along[b].push_back(Part(h, 0));
        octave.across[b].push_back(Part(h, 10) * (fy - static_cast<float>(b)));
      }
    }
    octaves_.push_back(std::move(octave));
  }
}

float FractalRow::Octave::At(float x) const {
  const int i = FloorToInt(x);
  const float fx = x - static_cast<float>(i), u = Quintic(fx);
  const Pair column(i, period);
  const auto at = [&](int a, int b) { return along[b][column.of[a]] * (fx - static_cast<float>(a)) + across[b][column.of[a]]; };
  return 1.6f * Mix(Mix(at(0, 0), at(1, 0), u), Mix(at(0, 1), at(1, 1), u), v);
}

float FractalRow::At(float x) const {
  float sum = 0, weight = 1, total = 0;
  for (const Octave& octave : octaves_) {
    sum += weight * octave.At(x);
    total += weight;
    weight *= 0.5f, x = 2 * x;
  }
  return sum / total;
}

float PointDistance(float x, float y, int period, int seed) {
  const int cx = FloorToInt(x), cy = FloorToInt(y);
  const Pair left(cx - 1, period), right(cx, period), below(cy - 1, period), above(cy, period);
  const int column[] = {left.of[0], left.of[1], right.of[1]}, row[] = {below.of[0], below.of[1], above.of[1]};
  float best = 9;
  for (int k = 0; k < 9; ++k) {
    const int i = cx + k % 3 - 1, j = cy + k / 3 - 1;
    const uint32_t h = HashLattice(column[k % 3], row[k / 3], seed);
    const float dx = static_cast<float>(i) + static_cast<float>(h & 65535) / 65536.0f - x,
                dy = static_cast<float>(j) + static_cast<float>(h >> 16) / 65536.0f - y;
    best = std::min(best, dx * dx + dy * dy);
  }
  return std::sqrt(best);
}

const NoiseCube& NoiseCube::Billows() {
  static const NoiseCube cube(128, {5, 11, 23}, {0.55f, 0.28f, 0.17f}, 0.28f, 0.50f, 0.35f);
  return cube;
}

const NoiseCube& NoiseCube::Details() {
  static const NoiseCube cube(64, {6, 13}, {0.6f, 0.4f}, 0.25f, 0.55f, 0);
  return cube;
}

NoiseCube::NoiseCube(int size, std::vector<int> balls, std::vector<float> weights, float low, float range, float bend)
    : size_(size), mask_(size - 1), voxels_(static_cast<size_t>(size) * size * size) {
  // The same for every sky: most of a second of a processor where it is not kept.
  const DiskCache cache = DiskCache::OfUser();
  const CacheKey key = CacheKey("cloud_noise", 1).Add(size).AddProgram();
  const std::span<std::byte> bytes = std::as_writable_bytes(std::span(voxels_));
  if (const auto kept = cache.Load(key); kept && kept->bytes().size() == bytes.size()) {
    std::ranges::copy(kept->bytes(), bytes.begin());
    return;
  }
  Fill(balls, weights, low, range, bend);
  cache.Store(key, bytes);
}

void NoiseCube::Fill(const std::vector<int>& balls, const std::vector<float>& weights, float low, float range, float bend) {
  const int size = size_;
  const std::vector<Points> points(balls.begin(), balls.end());
  const Gradients coarse(4), middle(8), fine(16);
  ParallelFor(size, [&](int64_t k) {
    for (int i = 0; i < size * size; ++i) {
      const Vec3f p =
          Vec3f{static_cast<float>(i % size), static_cast<float>(i / size), static_cast<float>(k)} * (1.0f / static_cast<float>(size));
      float sum = 0;
      for (size_t b = 0; b < points.size(); ++b) sum += weights[b] * (1 - points[b].Nearest(p * static_cast<float>(balls[b])));
      float value = (sum - low) / range;
      if (bend > 0) {
        value += bend * (0.6f * coarse.At(p * 4.0f) + 0.3f * middle.At(p * 8.0f) + 0.2f * fine.At(p * 16.0f));
      }
      voxels_[static_cast<size_t>(k) * size * size + i] = static_cast<uint8_t>(std::clamp(value, 0.0f, 1.0f) * 255.0f + 0.5f);
    }
  });
}

float NoiseCube::At(Vec3f p) const {
  p = p * static_cast<float>(size_);
  const int x = FloorToInt(p.x), y = FloorToInt(p.y), z = FloorToInt(p.z);
  const float u = p.x - static_cast<float>(x), v = p.y - static_cast<float>(y), w = p.z - static_cast<float>(z);
  const int x0 = x & mask_, x1 = (x + 1) & mask_;
  const uint8_t* low = &voxels_[static_cast<size_t>(z & mask_) * size_ * size_];
  const uint8_t* high = &voxels_[static_cast<size_t>((z + 1) & mask_) * size_ * size_];
  const int y0 = (y & mask_) * size_, y1 = ((y + 1) & mask_) * size_;
  const auto row = [&](const uint8_t* at) {
    const auto a = static_cast<float>(at[x0]), b = static_cast<float>(at[x1]);
    return a + (b - a) * u;
  };
  return Mix(Mix(row(low + y0), row(low + y1), v), Mix(row(high + y0), row(high + y1), v), w) * (1 / 255.0f);
}

}  // namespace airsim360::internal
