// What the denoiser's passes share (only for *_kernel.cc files): planes as vectors, neighbours on the sphere,
// likeness of two pixels.
//
// Every weight is h max(0, 1 - x / 8)^8, close to h exp(-x), with x = x_plane + x_normal + x_light and h of
// the wavelet. Differences to the centre are summed, not values, so that constant light stays as it is.
#pragma once

#include <initializer_list>

#include "airsim360/render/filter/filter_planes.h"
#include "airsim360/render/shared/shading_simd.h"

namespace airsim360::internal::AIRSIM360_ISA {

#define KERNEL static inline __attribute__((always_inline, unused))

using uids = stdx::rebind_simd_t<uint32_t, real>;

KERNEL real At(const float* plane, int64_t i) { return real(plane + i, stdx::element_aligned); }
KERNEL real3 At3(float* const* planes, int64_t i) { return {At(planes[0], i), At(planes[1], i), At(planes[2], i)}; }
KERNEL void Put(float* plane, int64_t i, real v) { v.copy_to(plane + i, stdx::element_aligned); }
KERNEL mask_t SameId(uids a, uids b) { return stdx::__proposed::static_simd_cast<mask_t>(a == b); }
/// The surface of lanes that have light, else 0.
KERNEL uids DataIds(mask_t found, uids surface, uids before) {
  stdx::where(stdx::__proposed::static_simd_cast<uids::mask_type>(found), before) = surface;
  stdx::where(before == kNoSurface, before) = 0u;
  return before;
}
KERNEL uids Ids(const uint32_t* plane, int64_t i) { return uids(plane + i, stdx::element_aligned); }

/// Whether a vector of pixels shows nothing but sky: no pass has anything to do there.
KERNEL bool NoSurface(const FilterPlanes& f, int64_t i) { return stdx::all_of(Ids(f.id, i) == kNoSurface); }

/// Column `x` counted beyond the borders of a row.
KERNEL int Wrapped(int x, int wrap) { return x < 0 ? x + wrap : x >= wrap ? x - wrap : x; }

/// A row counted beyond the poles: its first element and by how many columns it is turned; first < 0: none.
struct RowPlace {
  int64_t first;
  int turn;
};
KERNEL RowPlace FindRow(const FilterPlanes& f, int y) {
  if (y >= 0 && y < f.height) return {int64_t{y} * f.stride, 0};
  const int over = y < 0 ? -1 - y : 2 * f.height - 1 - y;
  if (!f.sphere || over < 0 || over >= f.height) return {-1, 0};
  return {int64_t{over} * f.stride, f.width / 2};
}

/// Asks for what the taps of the lowest row will meet, of positions, normals and the planes given: they are too
/// many for the processor to foresee by itself.
KERNEL void FetchAhead(const FilterPlanes& f, const RowPlace& row, int x, std::initializer_list<const void*> planes) {
  constexpr int kAhead = 128;
  if (row.first < 0) return;
  const int64_t i = row.first + x + kAhead;
  for (int k = 0; k < 3; ++k) {
    __builtin_prefetch(f.p[k] + i);
    __builtin_prefetch(f.n[k] + i);
  }
  for (const void* plane : planes) __builtin_prefetch(static_cast<const float*>(plane) + i);
}

/// What a pixel compares its neighbours with.
struct Center {
  uids id;
  real3 g, normal;  // normal times its share of the exponent
  real base, plane, inverse_thickness;
};

KERNEL Center MakeCenter(const FilterPlanes& f, int64_t i, real loose, float step) {
  Center c;
  c.id = Ids(f.id, i);
  const real3 p = At3(f.p, i);
  c.g = At3(f.g, i);
  c.plane = dot3(c.g, p);
  const real sharpness = lerp1(real(kFilterLooseNormal / 8), real(kFilterNormal / 8), (1.0f - loose) * (1.0f - loose));
  c.normal = At3(f.n, i) * sharpness;
  c.base = 1.0f - sharpness;
  // Over the distance.
  const real thickness = (1.0f + (kFilterLoosePlane - 1.0f) * loose) * (f.cone_angle * (1.0f + f.plane_slope * step));
  c.inverse_thickness = (1.0f / 16) / rmax(dot3(p, p) * (thickness * thickness), real(kFilterThinnest));
  return c;
}

/// 1 - x / 8 of geometry alone.
KERNEL real Likeness(const FilterPlanes& f, const Center& c, int64_t i) {
  const real away = dot3(c.g, At3(f.p, i)) - c.plane;
  return c.base + dot3(c.normal, At3(f.n, i)) - away * away * c.inverse_thickness;
}

KERNEL real Power8(real t) {
  t = rmax(t, real(0.0f));
  t = t * t;
  t = t * t;
  return t * t;
}

KERNEL real If(mask_t m, real a) { return sel(m, a, real(0.0f)); }

/// Calls visit(index, corner) for the eight neighbours of the vector of columns at x.
template <class Visit>
KERNEL void ForNeighbours(const FilterPlanes& f, const RowPlace (&rows)[3], int x, int step_x, Visit&& visit) {
  for (int dy = 0; dy < 3; ++dy) {
    if (rows[dy].first < 0) continue;
    for (int dx = -1; dx <= 1; ++dx) {
      if (dx == 0 && dy == 1) continue;
      // Half a turn and a step stay within one and a half rows.
      const int column = Wrapped(Wrapped(x, f.wrap) + rows[dy].turn + dx * step_x, f.wrap);
      visit(rows[dy].first + column, dx != 0 && dy != 1);
    }
  }
}

KERNEL void FindRows(const FilterPlanes& f, int y, int step, RowPlace (&rows)[3]) {
  for (int k = 0; k < 3; ++k) rows[k] = FindRow(f, y + (k - 1) * step);
}

}  // namespace airsim360::internal::AIRSIM360_ISA
