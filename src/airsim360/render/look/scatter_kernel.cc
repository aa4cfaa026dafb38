// Kernel: Fourier transforms of rows, tridiagonal systems of columns.
#include "airsim360/render/look/scatter.h"
#include "airsim360/render/look/scatter_kernels.h"
#include "airsim360/render/shared/shading_simd.h"

namespace airsim360::internal::AIRSIM360_ISA {
namespace {

#define KERNEL static inline __attribute__((always_inline, unused))

constexpr int kLength = LightCells::kMostColumns, kRows = LightCells::kMostRows;

// kLanes rows side by side: element x of row i is at [x * kLanes + i].
struct alignas(64) Turned {
  float re[kLength * kLanes], im[kLength * kLanes];
};

KERNEL void Load(const ScatterRows& rows, int first, Turned& turned) {
  const float* re = rows.re + static_cast<int64_t>(first) * rows.stride;
  const float* im = rows.im + static_cast<int64_t>(first) * rows.stride;
  for (int x = 0; x < rows.length; ++x) {
    for (int i = 0; i < kLanes; ++i) {
      turned.re[x * kLanes + i] = re[i * rows.stride + x];
      turned.im[x * kLanes + i] = im[i * rows.stride + x];
    }
  }
}

KERNEL void Store(const ScatterRows& rows, int first, const Turned& turned) {
  float* re = rows.re + static_cast<int64_t>(first) * rows.stride;
  float* im = rows.im + static_cast<int64_t>(first) * rows.stride;
  for (int x = 0; x < rows.length; ++x) {
    for (int i = 0; i < kLanes; ++i) {
      re[i * rows.stride + x] = turned.re[x * kLanes + i];
      im[i * rows.stride + x] = turned.im[x * kLanes + i];
    }
  }
}

// Decimation in frequency: natural order in, bits reversed out.
KERNEL void Forward(const ScatterRows& rows, Turned& v) {
  for (int half = rows.length / 2, step = 1; half >= 1; half /= 2, step *= 2) {
    for (int start = 0; start < rows.length; start += 2 * half) {
      for (int j = 0; j < half; ++j) {
        const int p = (start + j) * kLanes, q = p + half * kLanes;
        const real ar = load(v.re + p), ai = load(v.im + p), br = load(v.re + q), bi = load(v.im + q);
        const real dr = ar - br, di = ai - bi, c = rows.cosines[j * step], s = rows.sines[j * step];
        store(v.re + p, ar + br);
        store(v.im + p, ai + bi);
        store(v.re + q, dr * c + di * s);
        store(v.im + q, di * c - dr * s);
      }
    }
  }
}

// Decimation in time: bits reversed in, natural order out.
KERNEL void Backward(const ScatterRows& rows, Turned& v) {
  for (int half = 1, step = rows.length / 2; half < rows.length; half *= 2, step /= 2) {
    for (int start = 0; start < rows.length; start += 2 * half) {
      for (int j = 0; j < half; ++j) {
        const int p = (start + j) * kLanes, q = p + half * kLanes;
        const real c = rows.cosines[j * step], s = rows.sines[j * step];
        const real xr = load(v.re + q), xi = load(v.im + q);
        const real br = xr * c - xi * s, bi = xi * c + xr * s;
        const real ar = load(v.re + p), ai = load(v.im + p);
        store(v.re + p, ar + br);
        store(v.im + p, ai + bi);
        store(v.re + q, ar - br);
        store(v.im + q, ai - bi);
      }
    }
  }
}

// kLanes columns; `light` and `sum` as [plane][row].
struct alignas(64) Columns {
  real light[4][kRows], sum[4][kRows], solved[4][kRows], ratio[kRows];
};

KERNEL void SolvePart(const ScatterSystem& s, real eigen, float t, float weight, Columns& c) {
  real ratio = 0, above[4] = {0, 0, 0, 0};
  for (int y = 0; y < s.rows; ++y) {
    const float area = s.area[y], up = t * s.flux[y], down = t * s.flux[y + 1];
    const real diagonal = (t * s.across[y]) * eigen + (area + up + down) - up * ratio;
    const real inverse = 1.0f / diagonal;
    for (int k = 0; k < 4; ++k) {
      above[k] = (c.light[k][y] * area + above[k] * up) * inverse;
      c.solved[k][y] = above[k];
    }
    ratio = down * inverse;
    c.ratio[y] = ratio;
  }
  real below[4] = {0, 0, 0, 0};
  for (int y = s.rows - 1; y >= 0; --y) {
    for (int k = 0; k < 4; ++k) {
      below[k] = c.solved[k][y] + c.ratio[y] * below[k];
      c.sum[k][y] = c.sum[k][y] + below[k] * weight;
    }
  }
}

}  // namespace

void FourierRows(const ScatterRows& rows, int first, bool inverse) {
  Turned turned;
  for (int i = first; i < first + kScatterBlock; i += kLanes) {
    Load(rows, i, turned);
    if (inverse)
      Backward(rows, turned);
    else
      Forward(rows, turned);
    Store(rows, i, turned);
  }
}

void SolveColumns(const ScatterSystem& s, int first) {
  Columns c;
  for (int x = first; x < first + kScatterBlock; x += kLanes) {
    for (int k = 0; k < 4; ++k) {
      for (int y = 0; y < s.rows; ++y) {
        c.light[k][y] = real(s.planes[k] + static_cast<int64_t>(y) * s.stride + x, stdx::element_aligned);
        c.sum[k][y] = 0;
      }
    }
    const real eigen(s.eigen + x, stdx::element_aligned);
    for (int i = 0; i < s.parts; ++i) SolvePart(s, eigen, s.t[i], s.weight[i], c);
    for (int k = 0; k < 4; ++k) {
      for (int y = 0; y < s.rows; ++y) c.sum[k][y].copy_to(s.planes[k] + static_cast<int64_t>(y) * s.stride + x, stdx::element_aligned);
    }
  }
}

}  // namespace airsim360::internal::AIRSIM360_ISA
