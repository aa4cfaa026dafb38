// Kernel: the denoiser's passes over one row, a vector of columns at a time.
//
// Every weight is h max(0, 1 - x / 8)^8, close to h exp(-x), with x = x_plane + x_normal + x_light and h of
// the wavelet. Differences to the centre are summed, not values, so that constant light stays as it is.
#include "airsim360/render/filter/filter_kernels.h"
#include "airsim360/render/shading/shading_simd.h"

namespace airsim360::internal::AIRSIM360_ISA {
namespace {

#define KERNEL static inline __attribute__((always_inline, unused))

// x_normal = kNormal (1 - cos): a sixth is left at 16 degrees. Leaves only avoid opposite sides.
constexpr float kNormal = 48, kLooseNormal = 1.5f;
// How much thicker than a pixel's width a plane is where there are no like neighbours.
constexpr float kLooseThickness = 16;
// x_light = difference^2 / (2 (kSigmas sigma)^2).
constexpr float kSigmas = 3;
// A neighbourhood whose samples all agree has still an uncertain mean (rule of succession): variance of a
// pixel of n samples, about l^2 / (9 n) / n, halved.
constexpr float kAgreement = 0.5f / 9;
// A harmonic mean of variances of nine values is too small by (9 - 1 - 2) / (9 - 1).
constexpr float kHarmonicBias = 8.0f / 6.0f;
// The noise is never taken for less than this part of the mean variance around.
constexpr float kLeastShare = 1.0f / 32;

using uids = stdx::rebind_simd_t<uint32_t, real>;

KERNEL real At(const float* plane, int64_t i) { return real(plane + i, stdx::element_aligned); }
KERNEL real3 At3(float* const* planes, int64_t i) {
  return {At(planes[0], i), At(planes[1], i), At(planes[2], i)};
}
KERNEL void Put(float* plane, int64_t i, real v) { v.copy_to(plane + i, stdx::element_aligned); }
KERNEL mask_t SameId(uids a, uids b) { return stdx::__proposed::static_simd_cast<mask_t>(a == b); }
/// The surface of lanes that have light, else 0.
KERNEL uids DataIds(mask_t found, uids surface, uids before) {
  stdx::where(stdx::__proposed::static_simd_cast<uids::mask_type>(found), before) = surface;
  stdx::where(before == kNoSurface, before) = 0u;
  return before;
}
KERNEL uids Ids(const uint32_t* plane, int64_t i) { return uids(plane + i, stdx::element_aligned); }

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
  const real sharpness = lerp1(real(kLooseNormal / 8), real(kNormal / 8), (1.0f - loose) * (1.0f - loose));
  c.normal = At3(f.n, i) * sharpness;
  c.base = 1.0f - sharpness;
  const real thickness = rroot(dot3(p, p)) * (f.cone_angle * (1.0f + f.plane_slope * step)) *
                         (1.0f + (kLooseThickness - 1.0f) * loose);
  c.inverse_thickness = (1.0f / 16) / rmax(thickness * thickness, real(1e-12f));
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

/// Calls visit(index, h) for the eight neighbours of columns x …; h = 1 beside, 2 across a corner.
template <class Visit>
KERNEL void ForNeighbours(const FilterPlanes& f, const RowPlace (&rows)[3], int x, int step_x,
                          Visit&& visit) {
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

KERNEL void GatherVector(const FilterPlanes& f, int64_t row, int x, int columns) {
  const int64_t i = row + x;
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
  const real3 mean = base + sum * (1.0f / rmax(weight, real(1e-20f)));
  const mask_t found = weight > 1e-3f;
  Put(f.light[1][0], i, mean.x);
  Put(f.light[1][1], i, mean.y);
  Put(f.light[1][2], i, mean.z);
  // The other passes' planes serve as scratch: samples.
  Put(f.window, i, weight);
  DataIds(found, c.id, uids(0u)).copy_to(f.data_id[1] + i, stdx::element_aligned);
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
  const Center c = MakeCenter(f, i, real(0.0f), 1);
  const mask_t known = SameId(Ids(f.data_id[0], i), c.id);
  const real l = luminance(At3(f.light[0], i));
  Moments like, entity;
  like.Add(known, real(0.0f));
  entity.Add(known, real(0.0f));
  real alike = real(0.0f), low = real(1e30f), high = real(-1e30f);
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
        low = sel(same, rmin(low, m), low);
        high = sel(same, rmax(high, m), high);
      });
  const mask_t enough = like.n > 2.5f;
  const real variance = sel(enough, like.Variance(), sel(entity.n > 2.5f, entity.Variance(), real(-1.0f)));
  const real beyond = rmax(rmax(l - high, low - l), real(0.0f));
  Put(f.window, i, variance);
  Put(f.own, i, If(known && (entity.n > 3.5f), beyond * beyond));
  Put(f.loose, i, clamp01((4.0f - alike) * 0.5f));
}

KERNEL void VarianceVector(const FilterPlanes& f, const RowPlace (&rows)[3], int64_t i, int x, int step_x) {
  const Center c = MakeCenter(f, i, At(f.loose, i), 3);
  const real l = luminance(At3(f.light[0], i)), n = rmax(At(f.samples, i), real(1.0f));
  const real least = l * l * (kAgreement / (n * n)) + 1e-20f;
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
  const real typical = kHarmonicBias * weight / rmax(inverse, real(1e-30f));
  const real noise = rmax(rmax(typical, mean * kLeastShare / rmax(weight, real(1e-20f))), least);
  Put(f.variance, i, sel(weight > 1e-3f, rmax(noise, At(f.own, i)), real(1e20f)));
}

KERNEL void AtrousVector(const FilterPlanes& f, const RowPlace (&rows)[3], int64_t i, int x, int step,
                         int step_x, int in) {
  const uids own_id = Ids(f.data_id[in], i);
  const Center c = MakeCenter(f, i, At(f.loose, i), static_cast<float>(step));
  const mask_t known = SameId(own_id, c.id);
  const real3 base = At3(f.light[in], i);
  const real l = luminance(base), variance = At(f.variance, i);
  const real sharpness = If(known, 1.0f / (variance * (16 * kSigmas * kSigmas) + 1e-20f));
  // Means of more samples count for more; after the first level all are mixed.
  const bool by_samples = step == 1;
  real weight = If(known, real(0.25f) * (by_samples ? At(f.samples, i) : real(1.0f)));
  real squares = weight * weight;
  real3 sum = make3(real(0.0f), real(0.0f), real(0.0f));
  ForNeighbours(
      f, rows, x, step_x, [&](int64_t j, bool corner) __attribute__((always_inline)) {
        const mask_t same = SameId(Ids(f.data_id[in], j), c.id);
        if (stdx::none_of(same)) return;
        const real3 light = At3(f.light[in], j);
        const real d = luminance(light) - l;
        real w = If(same, Power8(Likeness(f, c, j) - d * d * sharpness) * (corner ? 0.0625f : 0.125f));
        if (by_samples) w = w * At(f.samples, j);
        sum = sum + (light - base) * w;
        weight = weight + w;
        squares = squares + w * w;
      });
  const real inverse = 1.0f / rmax(weight, real(1e-10f));
  const real3 mean = base + sum * inverse;
  Put(f.light[1 - in][0], i, mean.x);
  Put(f.light[1 - in][1], i, mean.y);
  Put(f.light[1 - in][2], i, mean.z);
  Put(f.variance, i, variance * rmin(squares * (inverse * inverse), real(1.0f)));
  DataIds(weight > 1e-3f, c.id, own_id).copy_to(f.data_id[1 - in] + i, stdx::element_aligned);
}

}  // namespace

void GatherRow(const FilterPlanes& f, int y, int columns) {
  const int64_t row = int64_t{y} * f.stride;
  for (int x = 0; x < f.width; x += kLanes) GatherVector(f, row, x, columns);
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

void AtrousRow(const FilterPlanes& f, int y, int step, int step_x, int in) {
  RowPlace rows[3];
  FindRows(f, y, step, rows);
  for (int x = 0; x < f.width; x += kLanes) AtrousVector(f, rows, rows[1].first + x, x, step, step_x, in);
}

void ReprojectRow(const FilterPlanes& f, int y, const ReprojectedRow& then) {
  const int64_t row = int64_t{y} * f.stride;
  const float* R = then.R;
  for (int x = 0; x < f.width; x += kLanes) {
    real3 v = At3(f.p, row + x);
    v = make3(v.x + then.offset[0], v.y + then.offset[1], v.z + then.offset[2]);
    const real3 c = make3(v.x * R[0] + v.y * R[1] + v.z * R[2], v.x * R[3] + v.y * R[4] + v.z * R[5],
                          v.x * R[6] + v.y * R[7] + v.z * R[8]);
    const real theta = atan2_approx(c.x, c.z);
    const real phi = atan2_approx(real(0.0f) - c.y, rroot(c.x * c.x + c.z * c.z));
    const float per_radian = 0.5f * SHADE_INV_PI * static_cast<float>(f.width);
    Put(then.x, x, theta * per_radian + 0.5f * static_cast<float>(f.width));
    Put(then.y, x, 0.5f * static_cast<float>(f.height) - phi * per_radian);
  }
}

}  // namespace airsim360::internal::AIRSIM360_ISA
