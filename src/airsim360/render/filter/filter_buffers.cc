#include "airsim360/render/filter/filter_buffers.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>

#include "airsim360/base/parallel.h"
#include "airsim360/render/filter/filter_kernels.h"
#include "airsim360/render/shared/shading_constants.h"

namespace airsim360::internal {
namespace {

constexpr int kFillRadius = 24;

// Planes a whole number of pages apart would fight for the same few lines of the cache: each starts three
// lines further into its page than the one before.
size_t PlaneSize(const FilterPlanes& f) {
  constexpr size_t kPage = 1024, kSkew = 3 * 16;
  return (static_cast<size_t>(f.stride) * f.height + kPage - 1) / kPage * kPage + kSkew;
}

template <class T>
void Repeat(T* row, int wrap) {
  for (int k = 0; k < kFilterPad; ++k) row[wrap + k] = row[k % wrap];
}

}  // namespace

int FilterBuffers::StepX(int y, int step) const {
  if (!planes_.sphere) return step;
  const int most = std::max(1, planes_.width / 8);
  return std::min(most, static_cast<int>(std::lround(std::min(1e6f, static_cast<float>(step) * across_[y]))));
}

int FilterBuffers::PixelsAcross(int y) const {
  if (!planes_.sphere) return 1;
  return std::max(1, static_cast<int>(std::lround(std::min(across_[y], static_cast<float>(planes_.width) / 4))));
}

void FilterBuffers::Resize(bool own_planes) {
  FilterPlanes& f = planes_;
  const size_t plane = PlaneSize(f);
  ids_.resize(3 * plane);
  floats_.resize((own_planes ? 20 : 17) * plane);
  uint32_t** ids[] = {&f.id, &f.data_id[0], &f.data_id[1]};
  for (size_t k = 0; k < 3; ++k) *ids[k] = ids_.data() + k * plane;
  float** floats[] = {&f.p[0],        &f.p[1],        &f.p[2],        &f.n[0],        &f.n[1],        &f.n[2],    &f.light[0][0],
                      &f.light[0][1], &f.light[0][2], &f.light[1][0], &f.light[1][1], &f.light[1][2], &f.samples, &f.window,
                      &f.own,         &f.loose,       &f.variance,    &f.g[0],        &f.g[1],        &f.g[2]};
  for (size_t k = 0; k < 20; ++k) *floats[k] = k >= 17 && !own_planes ? f.n[k - 17] : floats_.data() + k * plane;
}

void FilterBuffers::Load(const FilterGuides& guides, const LightSignal& signal, int max_step) {
  rays_.Update(*guides.camera, guides.X_WC.R);
  FilterPlanes& f = planes_;
  const RayField& field = rays_.field();
  f.width = field.width;
  f.height = field.height;
  f.sphere = field.separable;
  f.wrap = f.sphere ? f.width : f.width + std::max(max_step, kFilterPad);
  f.stride = (f.wrap + kFilterPad + 15) / 16 * 16;
  f.cone_angle = static_cast<float>(rays_.cone_angle());
  f.plane_slope = guides.geometric_normal != nullptr ? kFilterFlatSlope : kFilterSlope;
  Resize(guides.geometric_normal != nullptr);
  across_.resize(f.height);
  for (int y = 0; y < f.height; ++y) {
    across_[y] = f.sphere ? static_cast<float>(1 / std::cos(std::numbers::pi * (0.5 - (y + 0.5) / f.height))) : 1.0f;
  }
  ParallelFor(f.height, [&](int64_t y) { LoadRow(guides, signal, static_cast<int>(y)); });
}

int FilterBuffers::ImageColumn(int canonical) const {
  const int x = canonical - rays_.column_shift();
  return x < 0 ? x + planes_.width : x;
}

// Positions of a camera whose rays are a table.
void FilterBuffers::LoadPositions(const Image<float>& range, int y) {
  const FilterPlanes& f = planes_;
  const RayField& field = rays_.field();
  const double* R = field.R;
  for (int c = 0; c < f.width; ++c) {
    const size_t i = static_cast<size_t>(y) * f.stride + c, j = static_cast<size_t>(y) * field.stride + c;
    const double t = range(c, y), x = field.ray_x[j] * t, v = field.ray_y[j] * t, z = field.ray_z[j] * t;
    for (int k = 0; k < 3; ++k) f.p[k][i] = static_cast<float>(R[3 * k] * x + R[3 * k + 1] * v + R[3 * k + 2] * z);
  }
}

void FilterBuffers::LoadRow(const FilterGuides& guides, const LightSignal& signal, int y) {
  const FilterPlanes& f = planes_;
  const RayField& field = rays_.field();
  const auto* geometric = guides.geometric_normal;
  FilterSource source{guides.range->row(y).data(),
                      guides.entity->row(y).data(),
                      &guides.normal->row(y).data()->x,
                      geometric != nullptr ? &geometric->row(y).data()->x : nullptr,
                      &signal.light->row(y).data()->r,
                      signal.samples != nullptr ? signal.samples->row(y).data() : nullptr,
                      rays_.column_shift(),
                      nullptr,
                      nullptr,
                      nullptr,
                      0,
                      0,
                      0,
                      0};
  if (field.separable) {
    source.column_x = field.column_x, source.column_y = field.column_y, source.column_z = field.column_z;
    source.row_scale = field.row_scale[y];
    source.row_x = field.row_x[y], source.row_y = field.row_y[y], source.row_z = field.row_z[y];
  } else {
    LoadPositions(*guides.range, y);
  }
  AIRSIM360_SELECT_KERNEL(LoadFilterRow)(f, y, source);

  const size_t row = static_cast<size_t>(y) * f.stride;
  for (int c = f.width; c < f.wrap; ++c) {
    f.id[row + c] = kNoSurface;
    f.data_id[0][row + c] = 0;
  }
  Repeat(f.id + row, f.wrap);
  Repeat(f.samples + row, f.wrap);
  for (float* const* planes : {f.p, f.n, f.g}) {
    for (int k = 0; k < 3; ++k) Repeat(planes[k] + row, f.wrap);
  }
  RepeatLight(y, 0);
}

void FilterBuffers::RepeatLight(int y, int set) {
  const FilterPlanes& f = planes_;
  const size_t row = static_cast<size_t>(y) * f.stride;
  // A pass may have written beyond the last column of a picture that is no panorama.
  for (int c = f.width; c < f.wrap; ++c) f.data_id[set][row + c] = 0;
  Repeat(f.data_id[set] + row, f.wrap);
  for (int k = 0; k < 3; ++k) Repeat(f.light[set][k] + row, f.wrap);
}

void FilterBuffers::RepeatSamples(int y) { Repeat(planes_.samples + static_cast<size_t>(y) * planes_.stride, planes_.wrap); }

void FilterBuffers::RepeatStatistics(int y) {
  const FilterPlanes& f = planes_;
  const size_t row = static_cast<size_t>(y) * f.stride;
  for (float* plane : {f.window, f.own, f.loose}) Repeat(plane + row, f.wrap);
}

Rgb32f FilterBuffers::FillHole(int set, int x, int y) const {
  const FilterPlanes& f = planes_;
  const uint32_t id = f.id[static_cast<size_t>(y) * f.stride + x];
  for (const bool any_surface : {false, true}) {
    for (int r = 1; r <= kFillRadius; ++r) {
      Vec3d sum;
      int count = 0;
      const int step_x = StepX(y, r);
      for (int dy = -r; dy <= r; ++dy) {
        const bool whole = std::abs(dy) == r;
        int row = y + dy, column = x;
        if (row < 0 || row >= f.height) {
          if (!f.sphere) continue;
          row = row < 0 ? -1 - row : 2 * f.height - 1 - row;
          if (row < 0 || row >= f.height) continue;
          column += f.width / 2;
        }
        for (int k = -r; k <= r; k += whole ? 1 : 2 * r) {
          int c = column + k * step_x / r;
          if (!f.sphere && (c < 0 || c >= f.width)) continue;
          c = (c % f.wrap + f.wrap) % f.wrap;
          const size_t i = static_cast<size_t>(row) * f.stride + c;
          const uint32_t there = f.data_id[set][i];
          if (there == 0 || (!any_surface && there != id)) continue;
          sum += {f.light[set][0][i], f.light[set][1][i], f.light[set][2][i]};
          ++count;
        }
      }
      if (count == 0) continue;
      const Vec3f mean = VecCast<float>(sum / static_cast<double>(count));
      return {mean.x, mean.y, mean.z};
    }
  }
  const size_t i = static_cast<size_t>(y) * f.stride + x;
  return {f.light[set][0][i], f.light[set][1][i], f.light[set][2][i]};
}

void FilterBuffers::Store(int set, Image<Rgb32f>& light) const {
  const FilterPlanes& f = planes_;
  ParallelFor(f.height, [&](int64_t row) {
    const int y = static_cast<int>(row);
    const size_t first = static_cast<size_t>(y) * f.stride;
    const uint32_t *id = f.id + first, *data_id = f.data_id[set] + first;
    const float *r = f.light[set][0] + first, *g = f.light[set][1] + first, *b = f.light[set][2] + first;
    Rgb32f* out = light.row(y).data();
    for (int c = 0, x = ImageColumn(0); c < f.width; ++c, ++x) {
      if (x == f.width) x = 0;
      if (id[c] == kNoSurface) continue;
      out[x] = data_id[c] == 0 ? FillHole(set, c, y) : Rgb32f{r[c], g[c], b[c]};
    }
  });
}

}  // namespace airsim360::internal
