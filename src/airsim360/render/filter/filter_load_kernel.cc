// Kernel: images to planes, in loops that the compiler turns into vectors.
#include "airsim360/render/filter/filter_kernels.h"

namespace airsim360::internal::AIRSIM360_ISA {
namespace {

#define KERNEL static inline __attribute__((always_inline, unused))

KERNEL void Split(const float* __restrict from, int n, float* __restrict x, float* __restrict y, float* __restrict z) {
  for (int i = 0; i < n; ++i) {
    x[i] = from[3 * i];
    y[i] = from[3 * i + 1];
    z[i] = from[3 * i + 2];
  }
}

KERNEL void Position(const float* __restrict range, const double* __restrict column, double scale, double row, int n, float* __restrict p) {
  for (int i = 0; i < n; ++i) p[i] = static_cast<float>((column[i] * scale + row) * range[i]);
}

KERNEL void Ids(const float* __restrict range, const uint32_t* __restrict entity, const float* __restrict samples, int n,
                uint32_t* __restrict id, uint32_t* __restrict data_id) {
  for (int i = 0; i < n; ++i) {
    const uint32_t surface = range[i] > 0 ? entity[i] : kNoSurface;
    id[i] = surface;
    data_id[i] = range[i] > 0 && samples[i] > 0 ? surface : 0;
  }
}

/// `n` columns from canonical column c and image column x on. Where all are sky, ids say so and nothing else.
KERNEL void LoadPart(const FilterPlanes& f, int64_t row, const FilterSource& s, int c, int x, int n) {
  const int64_t i = row + c;
  if (s.samples != nullptr) {
    for (int k = 0; k < n; ++k) f.samples[i + k] = s.samples[x + k];
  } else {
    for (int k = 0; k < n; ++k) f.samples[i + k] = 1;
  }
  Ids(s.range + x, s.entity + x, f.samples + i, n, f.id + i, f.data_id[0] + i);
  bool surface = false;
  for (int k = 0; k < n; ++k) surface |= s.range[x + k] > 0;
  if (!surface) return;
  Split(s.normal + 3 * x, n, f.n[0] + i, f.n[1] + i, f.n[2] + i);
  if (s.geometric_normal != nullptr) Split(s.geometric_normal + 3 * x, n, f.g[0] + i, f.g[1] + i, f.g[2] + i);
  Split(s.light + 3 * x, n, f.light[0][0] + i, f.light[0][1] + i, f.light[0][2] + i);
  if (s.column_x == nullptr) return;
  Position(s.range + x, s.column_x + c, s.row_scale, s.row_x, n, f.p[0] + i);
  Position(s.range + x, s.column_y + c, s.row_scale, s.row_y, n, f.p[1] + i);
  Position(s.range + x, s.column_z + c, s.row_scale, s.row_z, n, f.p[2] + i);
}

KERNEL void LoadParts(const FilterPlanes& f, int64_t row, const FilterSource& s, int c, int x, int n) {
  constexpr int kPart = 128;
  for (int k = 0; k < n; k += kPart) LoadPart(f, row, s, c + k, x + k, n - k < kPart ? n - k : kPart);
}

}  // namespace

void LoadFilterRow(const FilterPlanes& f, int y, const FilterSource& s) {
  const int64_t row = int64_t{y} * f.stride;
  LoadParts(f, row, s, 0, f.width - s.column_shift, s.column_shift);
  LoadParts(f, row, s, s.column_shift, 0, f.width - s.column_shift);
}

}  // namespace airsim360::internal::AIRSIM360_ISA
