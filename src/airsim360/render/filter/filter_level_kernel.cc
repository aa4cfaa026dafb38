// Kernel: the levels of the wavelet.
#include "airsim360/render/filter/filter_kernels.h"
#include "airsim360/render/filter/filter_simd.h"

namespace airsim360::internal::AIRSIM360_ISA {
namespace {

KERNEL void AtrousVector(const FilterPlanes& f, const RowPlace (&rows)[3], int64_t i, int x, int step, int step_x, int in) {
  if (NoSurface(f, i)) return uids(0u).copy_to(f.data_id[1 - in] + i, stdx::element_aligned);
  FetchAhead(f, rows[2], x, {f.data_id[in], f.light[in][0], f.light[in][1], f.light[in][2]});
  const uids own_id = Ids(f.data_id[in], i);
  const Center c = MakeCenter(f, i, At(f.loose, i), static_cast<float>(step));
  const mask_t known = SameId(own_id, c.id);
  const real3 base = At3(f.light[in], i);
  const real l = luminance(base), variance = At(f.variance, i);
  const real sharpness = If(known, 1.0f / (variance * (16 * kFilterSigmas * kFilterSigmas) + kFilterTiny));
  // Means of more samples count for more; after the first level all are mixed.
  const bool by_samples = step == 1;
  real weight = If(known, real(kFilterOwn) * (by_samples ? At(f.samples, i) : real(1.0f)));
  real squares = weight * weight;
  real3 sum = make3(real(0.0f), real(0.0f), real(0.0f));
  ForNeighbours(
      f, rows, x, step_x, [&](int64_t j, bool corner) __attribute__((always_inline)) {
        const mask_t same = SameId(Ids(f.data_id[in], j), c.id);
        if (stdx::none_of(same)) return;
        const real3 light = At3(f.light[in], j);
        const real d = luminance(light) - l;
        real w = If(same, Power8(Likeness(f, c, j) - d * d * sharpness) * (corner ? kFilterCorner : kFilterSide));
        if (by_samples) w = w * At(f.samples, j);
        sum = sum + (light - base) * w;
        weight = weight + w;
        squares = squares + w * w;
      });
  const real inverse = 1.0f / rmax(weight, real(kFilterLeastWeight));
  const real3 mean = base + sum * inverse;
  Put(f.light[1 - in][0], i, mean.x);
  Put(f.light[1 - in][1], i, mean.y);
  Put(f.light[1 - in][2], i, mean.z);
  Put(f.variance, i, variance * rmin(squares * (inverse * inverse), real(1.0f)));
  DataIds(weight > kFilterFound, c.id, own_id).copy_to(f.data_id[1 - in] + i, stdx::element_aligned);
}

}  // namespace

void AtrousRow(const FilterPlanes& f, int y, int step, int step_x, int in) {
  RowPlace rows[3];
  FindRows(f, y, step, rows);
  for (int x = 0; x < f.width; x += kLanes) AtrousVector(f, rows, rows[1].first + x, x, step, step_x, in);
}

}  // namespace airsim360::internal::AIRSIM360_ISA
