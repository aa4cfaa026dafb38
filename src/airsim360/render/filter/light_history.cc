#include "airsim360/render/filter/light_history.h"

#include "airsim360/base/parallel.h"
#include "airsim360/render/filter/filter_kernels.h"

namespace airsim360::internal {

void LightHistory::Accumulate(const FilterGuides& guides, FilterBuffers& buffers) {
  const FilterPlanes& f = buffers.planes();
  if (f.width == width_ && f.height == height_ && f.sphere == sphere_) Mix(guides, buffers);
  Keep(guides, buffers);
}

void LightHistory::Mix(const FilterGuides& guides, FilterBuffers& buffers) const {
  const FilterPlanes& f = buffers.planes();
  const Vec3f offset = VecCast<float>(guides.X_WC.p - p_);
  FilterPast past{pixels_.data(), stride_, {}, {offset.x, offset.y, offset.z}, nullptr, nullptr};
  for (int i = 0; i < 9; ++i) past.R[i] = static_cast<float>(R0_.m[i % 3][i / 3]);
  const auto recall = AIRSIM360_SELECT_KERNEL(RecallRow);
  ParallelFor(f.height, [&](int64_t row) {
    const int y = static_cast<int>(row);
    FilterPast found = past;
    if (!f.sphere) {
      float *x_px = f.light[1][0] + row * f.stride, *y_px = f.light[1][1] + row * f.stride;
      FindRow(f, y, past.offset, x_px, y_px);
      found.x = x_px, found.y = y_px;
    }
    recall(f, y, found);
    buffers.RepeatLight(y, 0);
    buffers.RepeatSamples(y);
  });
}

void LightHistory::Keep(const FilterGuides& guides, const FilterBuffers& buffers) {
  const FilterPlanes& f = buffers.planes();
  width_ = f.width, height_ = f.height, stride_ = f.stride, sphere_ = f.sphere;
  camera_ = *guides.camera;
  const double* R = buffers.rays().field().R;
  for (int i = 0; i < 9; ++i) R0_.m[i / 3][i % 3] = R[i];
  p_ = guides.X_WC.p;
  pixels_.resize(size_t{FilterPast::kFloats} * static_cast<size_t>(stride_) * static_cast<size_t>(height_));
  const auto keep = AIRSIM360_SELECT_KERNEL(KeepRow);
  ParallelFor(f.height, [&](int64_t y) { keep(f, static_cast<int>(y), pixels_.data()); });
}

// Of a camera that is no panorama.
void LightHistory::FindRow(const FilterPlanes& f, int y, const float* offset, float* x_px, float* y_px) const {
  const size_t row = static_cast<size_t>(y) * f.stride;
  const Mat3d R = R0_.transpose();
  for (int c = 0; c < f.width; ++c) {
    const size_t i = row + c;
    x_px[c] = y_px[c] = -10;
    if (f.id[i] == kNoSurface) continue;
    const Vec3f v = Vec3f{f.p[0][i], f.p[1][i], f.p[2][i]} + Vec3f{offset[0], offset[1], offset[2]};
    const auto pixel = RayToPixel(camera_, R * VecCast<double>(v));
    if (pixel) x_px[c] = static_cast<float>(pixel->x), y_px[c] = static_cast<float>(pixel->y);
  }
}

}  // namespace airsim360::internal
