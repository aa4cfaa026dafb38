#include "airsim360/render/filter/light_history.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "airsim360/base/parallel.h"
#include "airsim360/render/filter/filter_kernels.h"

namespace airsim360::internal {
namespace {

constexpr int kPlanes = 10;
// No more than so many frames count: what has changed since fades away.
constexpr float kMaxFrames = 16;
// A point is the same if it lies within so many pixel widths of the plane and its normal within 37 degrees.
constexpr float kThickness = 2, kMinCosine = 0.8f;
// Less than this share of the four pixels around says too little.
constexpr float kMinShare = 0.1f;

}  // namespace

struct LightHistory::Seen {
  Vec3f light;
  float samples = 0;  // 0: not seen
};

void LightHistory::Accumulate(const FilterGuides& guides, FilterBuffers& buffers) {
  const FilterPlanes& f = buffers.planes();
  const bool usable = f.width == width_ && f.height == height_ && f.sphere == sphere_;
  if (usable) {
    offset_ = VecCast<float>(guides.X_WC.p - p_);
    ParallelFor(f.height, [&](int64_t y) { MixRow(guides, buffers, static_cast<int>(y)); });
  }
  Keep(guides, buffers);
}

void LightHistory::Keep(const FilterGuides& guides, const FilterBuffers& buffers) {
  const FilterPlanes& f = buffers.planes();
  width_ = f.width, height_ = f.height, wrap_ = f.wrap, sphere_ = f.sphere;
  stride_ = static_cast<size_t>(f.stride);
  camera_ = *guides.camera;
  const double* R = buffers.rays().field().R;
  for (int i = 0; i < 9; ++i) R0_.m[i / 3][i % 3] = R[i];
  p_ = guides.X_WC.p;
  const size_t plane = stride_ * static_cast<size_t>(height_);
  id_.assign(f.data_id[0], f.data_id[0] + plane);
  planes_.resize(kPlanes * plane);
  const float* from[kPlanes] = {f.p[0], f.p[1],        f.p[2],        f.n[0],        f.n[1],
                                f.n[2], f.light[0][0], f.light[0][1], f.light[0][2], f.samples};
  for (size_t k = 0; k < kPlanes; ++k) std::copy_n(from[k], plane, planes_.data() + k * plane);
}

void LightHistory::FindRow(const FilterGuides& guides, const FilterPlanes& f, int y, float* x_px,
                           float* y_px) const {
  if (f.sphere) {
    ReprojectedRow then{{}, {offset_.x, offset_.y, offset_.z}, x_px, y_px};
    for (int i = 0; i < 9; ++i) then.R[i] = static_cast<float>(R0_.m[i % 3][i / 3]);
    AIRSIM360_SELECT_KERNEL(ReprojectRow)(f, y, then);
    return;
  }
  for (int c = 0; c < f.width; ++c) {
    const size_t i = static_cast<size_t>(y) * f.stride + c;
    const Vec3d v = VecCast<double>(Vec3f{f.p[0][i], f.p[1][i], f.p[2][i]} + offset_);
    const auto pixel = RayToPixel(*guides.camera, R0_.transpose() * v);
    x_px[c] = pixel ? static_cast<float>(pixel->x) : -10;
    y_px[c] = pixel ? static_cast<float>(pixel->y) : -10;
  }
}

LightHistory::Seen LightHistory::Look(const FilterPlanes& now, size_t i, float x_px, float y_px) const {
  Seen seen;
  if (!(x_px > -1 && x_px < static_cast<float>(width_ + 1) && y_px > -1 &&
        y_px < static_cast<float>(height_ + 1)))
    return seen;
  const size_t plane = stride_ * static_cast<size_t>(height_);
  const auto vec = [&](size_t first, size_t j) {
    const float* p = planes_.data() + first * plane + j;
    return Vec3f{p[0], p[plane], p[2 * plane]};
  };
  const Vec3f p{now.p[0][i], now.p[1][i], now.p[2][i]}, g{now.g[0][i], now.g[1][i], now.g[2][i]},
      n{now.n[0][i], now.n[1][i], now.n[2][i]};
  const float thickness = kThickness * now.cone_angle * Norm(p);
  const int x0 = static_cast<int>(std::floor(x_px - 0.5f)), y0 = static_cast<int>(std::floor(y_px - 0.5f));
  const float fx = x_px - 0.5f - static_cast<float>(x0), fy = y_px - 0.5f - static_cast<float>(y0);
  float share = 0;
  for (int k = 0; k < 4; ++k) {
    int x = x0 + (k & 1), y = y0 + (k >> 1);
    if (y < 0 || y >= height_) {
      if (!sphere_) continue;
      y = y < 0 ? -1 - y : 2 * height_ - 1 - y;
      x += width_ / 2;
    }
    if (!sphere_ && (x < 0 || x >= width_)) continue;
    const size_t j = static_cast<size_t>(y) * stride_ + static_cast<size_t>((x % wrap_ + wrap_) % wrap_);
    if (id_[j] == 0 || id_[j] != now.id[i] || Dot(vec(3, j), n) < kMinCosine) continue;
    if (std::abs(Dot(g, vec(0, j) - offset_ - p)) > thickness) continue;
    const float w = (k & 1 ? fx : 1 - fx) * (k >> 1 ? fy : 1 - fy);
    share += w;
    seen.light += vec(6, j) * w;
    seen.samples += planes_[9 * plane + j] * w;
  }
  if (share < kMinShare) return {};
  seen.light *= 1 / share;
  seen.samples /= share;
  return seen;
}

void LightHistory::MixRow(const FilterGuides& guides, FilterBuffers& buffers, int y) const {
  const FilterPlanes& f = buffers.planes();
  std::vector<float> x_px(f.stride), y_px(f.stride);
  FindRow(guides, f, y, x_px.data(), y_px.data());
  for (int c = 0; c < f.width; ++c) {
    const size_t i = static_cast<size_t>(y) * f.stride + c;
    if (f.id[i] == kNoSurface) continue;
    const Seen seen = Look(f, i, x_px[c], y_px[c]);
    if (seen.samples <= 0) continue;
    const float fresh = f.samples[i];
    const float kept = fresh > 0 ? std::min(seen.samples, (kMaxFrames - 1) * fresh) : seen.samples;
    const float weight = fresh / (fresh + kept);
    const float past[3] = {seen.light.x, seen.light.y, seen.light.z};
    for (int k = 0; k < 3; ++k) f.light[0][k][i] = past[k] + (f.light[0][k][i] - past[k]) * weight;
    f.samples[i] = fresh + kept;
    f.data_id[0][i] = f.id[i];
  }
  buffers.RepeatLight(y, 0);
  buffers.RepeatSamples(y);
}

}  // namespace airsim360::internal
