#include "airsim360/render/sky/cloud_layer.h"

#include <algorithm>
#include <cmath>

#include "airsim360/render/sky/noise.h"

namespace airsim360::internal {
namespace {

constexpr int kCells = CloudLayer::kCells, kMask = kCells - 1;

float Clamp01(float x) { return x < 0 ? 0.0f : x > 1 ? 1.0f : x; }

}  // namespace

CloudLayer::CloudLayer(const Form& form, std::vector<Column> columns)
    : form_(form), texels_(columns.size()), coarse_((kCells / kCoarse) * (kCells / kCoarse)) {
  constexpr float kThin = 40;
  const auto top = [&](int i, int j) { return columns[static_cast<size_t>(j & kMask) * kCells + (i & kMask)].top; };
  float low = 0, high = 0;
  int64_t covered = 0;
  for (int j = 0; j < kCells; ++j) {
    for (int i = 0; i < kCells; ++i) {
      const Column& c = columns[static_cast<size_t>(j) * kCells + i];
      const float gx = (top(i + 1, j) - top(i - 1, j)) / (2 * form.cell), gy = (top(i, j + 1) - top(i, j - 1)) / (2 * form.cell);
      texels_[static_cast<size_t>(j) * kCells + i] = {c.top, c.base, 1 / std::sqrt(1 + gx * gx + gy * gy), 0};
      if (c.top <= 1) continue;
      low = std::min(low, c.base), high = std::max(high, c.base + c.top);
      covered += c.top > kThin;
      // Bilinear look-ups reach one cell further.
      for (int k = 0; k < 4; ++k) {
        const int ci = ((i - k % 2) & kMask) / kCoarse, cj = ((j - k / 2) & kMask) / kCoarse;
        coarse_[static_cast<size_t>(cj) * (kCells / kCoarse) + ci] = 1;
      }
    }
  }
  lowest_ = form.base + low, highest_ = form.base + high;
  cover_ = static_cast<float>(covered) / (static_cast<float>(kCells) * kCells);
}

bool CloudLayer::MayBeCloud(float x, float y) const {
  const float scale = 1 / (form_.cell * kCoarse);
  constexpr int kCount = kCells / kCoarse;
  const int i = FloorToInt((x + offset_x_) * scale) & (kCount - 1), j = FloorToInt((y + offset_y_) * scale) & (kCount - 1);
  return coarse_[static_cast<size_t>(j) * kCount + i] != 0;
}

float CloudLayer::Density(float x, float y, float altitude, bool detail) const {
  x += offset_x_, y += offset_y_;
  const float cx = x / form_.cell, cy = y / form_.cell;
  const int ix = FloorToInt(cx), iy = FloorToInt(cy);
  const float fx = cx - static_cast<float>(ix), fy = cy - static_cast<float>(iy);
  const int i0 = ix & kMask, i1 = (ix + 1) & kMask, j0 = (iy & kMask) * kCells, j1 = ((iy + 1) & kMask) * kCells;
  const Texel &a = texels_[j0 + i0], &b = texels_[j0 + i1], &c = texels_[j1 + i0], &d = texels_[j1 + i1];
  const float top = Mix(Mix(a.top, b.top, fx), Mix(c.top, d.top, fx), fy);
  if (top <= 1) return 0;
  const float z = altitude - form_.base - Mix(Mix(a.base, b.base, fx), Mix(c.base, d.base, fx), fy);
  if (z <= 0 || z >= top) return 0;
  const float slope = Mix(Mix(a.slope, b.slope, fx), Mix(c.slope, d.slope, fx), fy);
  // Depth below the body's surface before wear; above its base.
  const float below = (top - z) * slope;
  const float wear = std::min(form_.erosion, 0.75f * top + form_.least_erosion);
  if (below <= 0) return 0;

  // The noise is drawn out along the wind and leans with height.
  const float along = x * form_.wind.x + y * form_.wind.y - form_.shear * z, across = y * form_.wind.x - x * form_.wind.y;
  const Vec3f p{along / form_.stretch, across, altitude};
  const float low = SmoothStep(0, 160, z), edge = form_.edge * (2 - low);
  const auto depth_under = [&](float noise) { return std::min(below - wear * (1 - noise), 0.9f * (z - form_.base_erosion * (1 - noise))); };
  // Deep inside no noise thins the cloud, and far outside of what the coarse noise leaves the fine one adds none.
  if (depth_under(0) >= edge) return form_.extinction;
  float noise = NoiseCube::Billows().At(p * (1 / form_.billow)), fine = 0.55f;
  if (detail) {
    if (depth_under(noise) <= 0) return 0;
    const float finest = 0.22f + 0.35f * (1 - low);
    if (depth_under(Clamp01(noise - finest)) >= edge) return form_.extinction;
    fine = NoiseCube::Details().At(Vec3f{p.x / form_.stretch, p.y, p.z} * (1 / form_.detail));
    noise = Clamp01(noise - finest * (1 - fine));
  } else {
    noise = std::max(0.0f, noise - 0.10f);
  }
  const float depth = depth_under(noise);
  if (depth <= 0) return 0;
  // Thin towards the edge, and torn there.
  const float s = Clamp01(depth / edge), torn = Clamp01(s - 0.5f * (1 - fine) * (1 - s));
  return torn * (0.3f + 0.7f * torn) * form_.extinction;
}

}  // namespace airsim360::internal
