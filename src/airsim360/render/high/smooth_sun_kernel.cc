#include "airsim360/render/high/smooth_sun_kernel.h"

#include <cstring>

#include "airsim360/render/high/high_shading.h"
#include "airsim360/render/shared/shading_constants.h"

namespace airsim360::internal::AIRSIM360_ISA {
namespace {

#define AIRSIM360_INLINE static inline __attribute__((always_inline, unused))

typedef float Floats16 __attribute__((vector_size(64), aligned(4), may_alias));
typedef int32_t Ints16 __attribute__((vector_size(64), aligned(4), may_alias));

constexpr int kMostColumns = 40, kMostRows = 5;
constexpr int kWindowRows = kTileSize + 2 * kMostRows, kStride = kTileSize + 2 * kMostColumns + 16;
constexpr int32_t kOutside = -1;  // no entity

AIRSIM360_INLINE int Least(int a, int b) { return a < b ? a : b; }
AIRSIM360_INLINE int Most(int a, int b) { return a > b ? a : b; }
AIRSIM360_INLINE int Up(float x) { return static_cast<int>(__builtin_ceilf(x)); }

// Sixteen numbers from anywhere.
AIRSIM360_INLINE const Floats16& At(const float* from) { return reinterpret_cast<const Floats16&>(*from); }
AIRSIM360_INLINE const Ints16& At(const int32_t* from) { return reinterpret_cast<const Ints16&>(*from); }

// The sum of sixteen numbers, the same for every instruction set.
AIRSIM360_INLINE float Sum(const Floats16& v) {
  const auto eight = __builtin_shufflevector(v, v, 0, 1, 2, 3, 4, 5, 6, 7) + __builtin_shufflevector(v, v, 8, 9, 10, 11, 12, 13, 14, 15);
  const auto four = __builtin_shufflevector(eight, eight, 0, 1, 2, 3) + __builtin_shufflevector(eight, eight, 4, 5, 6, 7);
  return (four[0] + four[2]) + (four[1] + four[3]);
}

// Columns of a row that are as wide as it is high.
AIRSIM360_INLINE float Across(const RayField& field, int y) {
  if (!field.separable) return 1;
  const double most = field.width / 8.0, across = 1 / field.row_scale[y];
  return static_cast<float>(across < most ? across : most);
}

// The pixels of a tile and those around that they may ask, plane by plane.
struct Window {
  int left, top, rows;  // canonical pixel of its corner, which may lie beyond the seam
  float x[kWindowRows][kStride], y[kWindowRows][kStride], z[kWindowRows][kStride];  // from the camera
  float nx[kWindowRows][kStride], ny[kWindowRows][kStride], nz[kWindowRows][kStride];
  float sun[kWindowRows][kStride], code[kWindowRows][kStride];
  int32_t entity[kWindowRows][kStride];
};

// `count` pixels from (u, v) on into row r from column c on.
AIRSIM360_INLINE void FillRun(const SunPlanes& planes, const RayField& f, int u, int v, int count, int r, int c, Window& w) {
  const int64_t first = static_cast<int64_t>(v) * f.width + u;
  const float* range = planes.range + first;
  float *x = w.x[r] + c, *y = w.y[r] + c, *z = w.z[r] + c;
  if (f.separable) {
    const double s = f.row_scale[v];
    const auto place = [&](const double* column, double row, float* to) __attribute__((always_inline)) {
      for (int i = 0; i < count; ++i) to[i] = static_cast<float>(s * column[u + i] + row) * range[i];
    };
    place(f.column_x, f.row_x[v], x), place(f.column_y, f.row_y[v], y), place(f.column_z, f.row_z[v], z);
  } else {
    const int64_t at = static_cast<int64_t>(v) * f.stride + u;
    const auto place = [&](const double* R, float* to) __attribute__((always_inline)) {
      for (int i = 0; i < count; ++i) {
        const double dx = f.ray_x[at + i], dy = f.ray_y[at + i], dz = f.ray_z[at + i];
        to[i] = static_cast<float>(R[0] * dx + R[1] * dy + R[2] * dz) * range[i];
      }
    };
    place(f.R, x), place(f.R + 3, y), place(f.R + 6, z);
  }
  const float* normal = &planes.normal[first].x;
  for (int i = 0; i < count; ++i) w.nx[r][c + i] = normal[3 * i];
  for (int i = 0; i < count; ++i) w.ny[r][c + i] = normal[3 * i + 1];
  for (int i = 0; i < count; ++i) w.nz[r][c + i] = normal[3 * i + 2];
  std::memcpy(w.sun[r] + c, planes.sun_seen + first, sizeof(float) * static_cast<size_t>(count));
  std::memcpy(w.entity[r] + c, planes.entity + first, sizeof(uint32_t) * static_cast<size_t>(count));
  for (int i = 0; i < count; ++i) w.code[r][c + i] = static_cast<float>(planes.penumbra[first + i]);
}

// `reach` columns to either side, and as many more as vectors read.
AIRSIM360_INLINE void FillWindow(const SunPlanes& planes, const RayField& f, int column, int row, int reach, Window& w) {
  w.left = column - reach;
  w.top = Most(0, row - kMostRows);
  w.rows = Least(f.height, row + kTileSize + kMostRows) - w.top;
  const int width = kTileSize + 2 * reach + 16;
  for (int r = 0; r < w.rows; ++r) {
    for (int c = 0; c < width;) {
      int u = w.left + c;
      if (!f.separable && (u < 0 || u >= f.width)) {
        const int count = u < 0 ? Least(-u, width - c) : width - c;
        for (int i = 0; i < count; ++i) {
          w.entity[r][c + i] = kOutside;
          for (auto* plane : {w.x, w.y, w.z, w.nx, w.ny, w.nz, w.sun, w.code}) plane[r][c + i] = 0;
        }
        c += count;
        continue;
      }
      u = (u % f.width + f.width) % f.width;
      const int count = Least(width - c, f.width - u);
      FillRun(planes, f, u, w.top + r, count, r, c, w);
      c += count;
    }
  }
}

// A pixel of the window and what those around it are compared with.
struct Middle {
  int r, c;
  float x, y, z, nx, ny, nz, range;
  int32_t entity;
};

// Calls visit(row, column of the window, which of sixteen pixels from there on are alike, their squared distances)
// for pixels of about the same plane, at most so many rows and columns away; on[i] != 0: column i of these counts.
template <class Visit>
AIRSIM360_INLINE void ForAlike(const Window& w, const Middle& m, int rows, int columns, const int32_t* on, const Visit& visit) {
  const float near = kMixedApart + kMixedApartByRange * m.range;
  for (int r = Most(0, m.r - rows); r <= Least(w.rows - 1, m.r + rows); ++r) {
    for (int k = 0; k <= 2 * columns; k += 16) {
      const int c = m.c - columns + k;
      const Floats16 facing = m.nx * At(w.nx[r] + c) + m.ny * At(w.ny[r] + c) + m.nz * At(w.nz[r] + c);
      const Floats16 dx = At(w.x[r] + c) - m.x, dy = At(w.y[r] + c) - m.y, dz = At(w.z[r] + c) - m.z;
      const Floats16 apart = m.nx * dx + m.ny * dy + m.nz * dz;
      const Ints16 alike = (At(w.entity[r] + c) == m.entity) & (facing >= kSamePlane) & (apart < near) & (apart > -near) & At(on + k);
      visit(r, c, alike, dx * dx + dy * dy + dz * dz);
    }
  }
}

// 0 where -1 is not.
AIRSIM360_INLINE void Keep(const Ints16& which, Floats16& values) {
  values = reinterpret_cast<Floats16>(which & reinterpret_cast<Ints16>(values));
}

// -1 for every step-th of 2 `columns` + 1 columns.
AIRSIM360_INLINE void Every(int step, int columns, int32_t* on) {
  for (int i = 0; i < 2 * kMostColumns + 16; ++i) on[i] = 0;
  for (int i = 0; i <= 2 * columns; i += step) on[i] = -1;
}

}  // namespace

void SmoothSunTile(const SunPlanes& planes, const RayField& field, float cone_angle, int column, int row) {
  const int rows = Least(kTileSize, field.height - row), columns = Least(kTileSize, field.width - column);
  float widest = 1;
  for (int y = row; y < row + rows; ++y) widest = Across(field, y) > widest ? Across(field, y) : widest;
  Window w;
  FillWindow(planes, field, column, row, Least(kMostColumns, Up(2 * kMostSpread * widest)), w);
  alignas(64) int32_t stepped[2 * kMostColumns + 16], all[2 * kMostColumns + 16];
  for (int y = row; y < row + rows; ++y) {
    const int64_t first = static_cast<int64_t>(y) * field.width + column;
    std::memcpy(planes.sun_smooth + first, planes.sun_seen + first, sizeof(float) * static_cast<size_t>(columns));
    const float across = Across(field, y);
    const int square = Most(1, Least(kMostColumns / 2, static_cast<int>(across + 0.5f)));
    Every(square, 2 * square, stepped);
    for (int x = column; x < column + columns; ++x) {
      const int64_t pixel = first + x - column;
      if (planes.penumbra[pixel] == 0) continue;
      const int r = y - w.top, c = x - w.left;
      const Middle m{r, c, w.x[r][c], w.y[r][c], w.z[r][c], w.nx[r][c], w.ny[r][c], w.nz[r][c], planes.range[pixel], w.entity[r][c]};

      // Width of the penumbra here, for rays that all saw the sun do not know it.
      Floats16 codes = {}, found = {};
      ForAlike(w, m, 2, 2 * square, stepped, [&](int v, int u, const Ints16& alike, const Floats16&) {
        const Floats16 code = At(w.code[v] + u);
        const Ints16 known = alike & (code > 1.0f);
        Floats16 beyond = code - 2.0f, one = Floats16{} + 1.0f;
        Keep(known, beyond), Keep(known, one);
        codes += beyond, found += one;
      });
      const float count = Sum(found);
      if (count == 0) continue;
      const float width = Sum(codes) / (kPenumbraSteps * count);

      // A mean by distance along the surface, whatever that is in pixels.
      const float wanted = kLeastSpread + kOfPenumbra * width, spread = wanted < kMostSpread ? wanted : kMostSpread;
      const float metres = spread * cone_angle * m.range, sharpness = 1 / (8 * metres * metres);
      const int reach = Least(kMostColumns, Up(2 * spread * across));
      Every(1, reach, all);
      Floats16 light = {}, weight = {};
      ForAlike(w, m, Up(2 * spread), reach, all, [&](int v, int u, const Ints16& alike, const Floats16& distance2) {
        const Floats16 part = 1 - distance2 * sharpness, square2 = part * part;
        Floats16 share = square2 * square2;
        Keep(alike & (part > 0.0f), share);
        light += At(w.sun[v] + u) * share;
        weight += share;
      });
      const float total = Sum(weight);
      if (total > 0) planes.sun_smooth[pixel] = Sum(light) / total;
    }
  }
}

}  // namespace airsim360::internal::AIRSIM360_ISA
