// Kernel: what is done before the levels: square pixels near the poles, statistics, noise.
#include "airsim360/render/filter/filter_kernels.h"
#include "airsim360/render/filter/filter_simd.h"

namespace airsim360::internal::AIRSIM360_ISA {
namespace {

KERNEL void GatherVector(const FilterPlanes& f, int64_t row, int x, int columns) {
  const int64_t i = row + x;
  if (NoSurface(f, i)) return;
  const Center c = MakeCenter(f, i, real(0.0f), static_cast<float>(columns) * 0.5f);
  const mask_t known = SameId(Ids(f.data_id[0], i), c.id);
  const real3 base = At3(f.light[0], i);
  real weight = If(known, At(f.samples, i));
  real3 sum = make3(real(0.0f), real(0.0f), real(0.0f));
  for (int k = 1; k < columns; ++k) {
    // 1, -1, 2, -2, …
    const int64_t j = row + Wrapped(x + (k & 1 ? (k + 1) / 2 : -k / 2), f.wrap);
    const mask_t same = SameId(Ids(f.data_id[0], j), c.id);
    if (stdx::none_of(same)) continue;
    const real w = If(same, Power8(Likeness(f, c, j)) * At(f.samples, j));
    sum = sum + (At3(f.light[0], j) - base) * w;
    weight = weight + w;
  }
  const real3 mean = base + sum * (1.0f / rmax(weight, real(kFilterTiny)));
  const mask_t found = weight > kFilterFound;
  Put(f.light[1][0], i, mean.x);
  Put(f.light[1][1], i, mean.y);
  Put(f.light[1][2], i, mean.z);
  // The other passes' planes serve as scratch: samples.
  Put(f.window, i, weight);
  DataIds(found, c.id, uids(0u)).copy_to(f.data_id[1] + i, stdx::element_aligned);
}

/// Moves what GatherVector made to set 0.
KERNEL void TakeVector(const FilterPlanes& f, int64_t i) {
  if (NoSurface(f, i)) return;
  for (int k = 0; k < 3; ++k) Put(f.light[0][k], i, At(f.light[1][k], i));
  Ids(f.data_id[1], i).copy_to(f.data_id[0] + i, stdx::element_aligned);
  Put(f.samples, i, At(f.window, i));
}

/// Sums of differences of luminance to a centre.
struct Moments {
  real n = real(0.0f), first = real(0.0f), second = real(0.0f);
  __attribute__((always_inline)) void Add(mask_t m, real d) {
    n = n + If(m, real(1.0f));
    first = first + If(m, d);
    second = second + If(m, d * d);
  }
  __attribute__((always_inline)) real Variance() const {
    return rmax(second - first * first / rmax(n, real(1.0f)), real(0.0f)) / rmax(n - 1.0f, real(1.0f));
  }
};

KERNEL void WindowVector(const FilterPlanes& f, const RowPlace (&rows)[3], int64_t i, int x, int step_x) {
  if (NoSurface(f, i)) return;
  FetchAhead(f, rows[2], x, {f.id, f.data_id[0], f.light[0][0], f.light[0][1], f.light[0][2]});
  const Center c = MakeCenter(f, i, real(0.0f), 1);
  const mask_t known = SameId(Ids(f.data_id[0], i), c.id);
  const real l = luminance(At3(f.light[0], i));
  Moments like, entity;
  like.Add(known, real(0.0f));
  entity.Add(known, real(0.0f));
  // The second of each end, too: where light is rare two such pixels often touch, and would vouch for each other.
  real alike = real(0.0f), low = real(1e30f), high = real(-1e30f), second_low = low, second_high = high;
  ForNeighbours(
      f, rows, x, step_x, [&](int64_t j, bool) __attribute__((always_inline)) {
        const mask_t surface = SameId(Ids(f.id, j), c.id), same = SameId(Ids(f.data_id[0], j), c.id);
        if (stdx::none_of(surface)) return;
        // x < 4: normals within 24 degrees, or three pixel widths off the plane.
        const mask_t close = Likeness(f, c, j) > 0.5f;
        alike = alike + If(surface && close, real(1.0f));
        const real m = luminance(At3(f.light[0], j));
        like.Add(same && close, m - l);
        entity.Add(same, m - l);
        second_low = sel(same, rmin(second_low, rmax(low, m)), second_low);
        second_high = sel(same, rmax(second_high, rmin(high, m)), second_high);
        low = sel(same, rmin(low, m), low);
        high = sel(same, rmax(high, m), high);
      });
  const mask_t enough = like.n > kFilterEnough;
  const real variance = sel(enough, like.Variance(), sel(entity.n > kFilterEnough, entity.Variance(), real(-1.0f)));
  const mask_t many = entity.n > kFilterMany;
  const real beyond = rmax(rmax(l - sel(many, second_high, high), sel(many, second_low, low) - l), real(0.0f));
  Put(f.window, i, variance);
  Put(f.own, i, If(known && (entity.n > kFilterSome), beyond * beyond));
  Put(f.loose, i, clamp01((4.0f - alike) * 0.5f));
}

KERNEL void VarianceVector(const FilterPlanes& f, const RowPlace (&rows)[3], int64_t i, int x, int step_x) {
  if (NoSurface(f, i)) return;
  FetchAhead(f, rows[2], x, {f.id, f.window});
  const Center c = MakeCenter(f, i, At(f.loose, i), 3);
  const real l = luminance(At3(f.light[0], i)), n = rmax(At(f.samples, i), real(1.0f));
  const real least = l * l * (kFilterAgreement / (n * n)) + kFilterTiny;
  real weight = real(0.0f), mean = real(0.0f), inverse = real(0.0f);
  const auto add = [&](real w, int64_t j) __attribute__((always_inline)) {
    const real v = At(f.window, j);
    const real used = If(v >= 0.0f, w);
    weight = weight + used;
    mean = mean + used * v;
    inverse = inverse + used / (rmax(v, real(0.0f)) + least);
  };
  add(real(1.0f), i);
  ForNeighbours(
      f, rows, x, step_x, [&](int64_t j, bool) __attribute__((always_inline)) {
        const mask_t same = SameId(Ids(f.id, j), c.id);
        if (stdx::any_of(same)) add(If(same, Power8(Likeness(f, c, j))), j);
      });
  const real typical = kFilterHarmonicBias * weight / rmax(inverse, real(kFilterLeastInverse));
  const real noise = rmax(rmax(typical, mean * kFilterLeastShare / rmax(weight, real(kFilterTiny))), least);
  Put(f.variance, i, sel(weight > kFilterFound, rmax(noise, At(f.own, i)), real(kFilterUnknown)));
}

}  // namespace

void GatherRow(const FilterPlanes& f, int y, int columns) {
  const int64_t row = int64_t{y} * f.stride;
  for (int x = 0; x < f.width; x += kLanes) GatherVector(f, row, x, columns);
  for (int x = 0; x < f.width; x += kLanes) TakeVector(f, row + x);
}

void WindowRow(const FilterPlanes& f, int y, int step_x) {
  RowPlace rows[3];
  FindRows(f, y, 1, rows);
  for (int x = 0; x < f.width; x += kLanes) WindowVector(f, rows, rows[1].first + x, x, step_x);
}

void VarianceRow(const FilterPlanes& f, int y, int step_x) {
  RowPlace rows[3];
  FindRows(f, y, 3, rows);
  for (int x = 0; x < f.width; x += kLanes) VarianceVector(f, rows, rows[1].first + x, x, step_x);
}

}  // namespace airsim360::internal::AIRSIM360_ISA
