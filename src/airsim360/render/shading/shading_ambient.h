// Look-ups of light for the shading kernels (only for *_kernel.cc files): sky tables and light probes.
#pragma once

#include "airsim360/render/shading/shading_data.h"
#include "airsim360/render/shading/shading_simd.h"

namespace airsim360::internal::AIRSIM360_ISA {

#define KERNEL static inline __attribute__((always_inline, unused))

/// One colour and a spare, for gathering lane by lane.
typedef float Quad __attribute__((vector_size(16)));
KERNEL Quad LoadQuad(const float* p) { return *reinterpret_cast<const Quad*>(p); }

/// Colours collected lane by lane.
struct alignas(64) ColorLanes {
  alignas(64) float r[kLanes], g[kLanes], b[kLanes];
  __attribute__((always_inline)) void Set(int i, Quad c) { r[i] = c[0], g[i] = c[1], b[i] = c[2]; }
  __attribute__((always_inline)) real3 Get() const { return load3(r, g, b); }
};

KERNEL ufloat3 Uniform(const float* p) { return {p[0], p[1], p[2]}; }

/// Bilinear look-up of a sky table; `full_sphere` as in SkyTable.
static __attribute__((noinline, unused)) real3 SampleSky(const SkyTableView& table, real3 d,
                                                         bool full_sphere) {
  real column = atan2_approx(d.y, d.x) * (table.width / (2.0f * SHADE_PI)) - 0.5f;
  column = sel(column < 0.0f, column + table.width, column);
  real e = asin_approx(rmin(rmax(d.z, real(-1.0f)), real(1.0f))) * (2.0f / SHADE_PI);
  real t = 0.5f + 0.5f * e;
  if (!full_sphere) {
    // The inverse of SkyTable::ElevationOfRow with kSkyRowSlope = 0.6.
    e = rmax(e, real(0.0f));
    t = (rroot(0.36f + 1.6f * e) - 0.6f) * 1.25f;
  }
  const real row = clamp01(t) * (table.height - 1.0f);
  // Written so that a direction that is not a number still finds a texel.
  const real x = rmin(real(table.width - 1.0f), rmax(real(0.0f), rfloor(column)));
  const real y = rmin(real(table.height - 2.0f), rmax(real(0.0f), rfloor(row)));
  alignas(64) int32_t index[kLanes];
  alignas(64) float fx[kLanes], fy[kLanes];
  ((to_int(y) * table.stride + to_int(x)) * 4).copy_to(index, stdx::vector_aligned);
  store(fx, column - x);
  store(fy, row - y);
  ColorLanes colors;
  for (int i = 0; i < kLanes; ++i) {
    const float* p = table.texels + index[i];
    const float* q = p + table.stride * 4;
    const Quad lower = LoadQuad(p) + (LoadQuad(p + 4) - LoadQuad(p)) * fx[i];
    const Quad upper = LoadQuad(q) + (LoadQuad(q + 4) - LoadQuad(q)) * fx[i];
    colors.Set(i, lower + (upper - lower) * fy[i]);
  }
  return colors.Get();
}

/// Share of the sun's light that clouds leave at p; CloudShadowMap::At for lanes.
KERNEL real CloudShadow(const CloudShadowView& map, real3 p) {
  if (map.texels == nullptr) return real(1.0f);
  const auto size = static_cast<float>(map.size);
  const real above = p.z - map.plane_z;
  const real x = shadow_column(p.x, above, map.slant_x, map.origin_x, map.cells_per_metre, size);
  const real y = shadow_column(p.y, above, map.slant_y, map.origin_y, map.cells_per_metre, size);
  const real x0 = rfloor(x), y0 = rfloor(y);
  alignas(64) int32_t index[kLanes];
  (to_int(y0) * map.size + to_int(x0)).copy_to(index, stdx::vector_aligned);
  alignas(64) float t[4][kLanes];
  for (int i = 0; i < kLanes; ++i) {
    const float* q = map.texels + index[i];
    t[0][i] = q[0], t[1][i] = q[1], t[2][i] = q[map.size], t[3][i] = q[map.size + 1];
  }
  const real fx = x - x0, fy = y - y0;
  const real low = load(t[0]) + (load(t[1]) - load(t[0])) * fx,
             high = load(t[2]) + (load(t[3]) - load(t[2])) * fx;
  return low + (high - low) * fy;
}

/// Sky, and ground below the horizon, blurred as by a surface of this roughness.
KERNEL real3 BlurredSky(const ShadeView& view, real3 d, real roughness) {
  const real3 up = SampleSky(view.sky, d, false);
  const real3 sharp = sel3(d.z > 0.0f, up,
                           lerp3(up, make3(real(view.ground[0]), real(view.ground[1]), real(view.ground[2])),
                                 clamp01(d.z * -12.0f)));
  if (!stdx::any_of(roughness > 0.05f)) return sharp;
  const real3 a = SampleSky(view.blurred[0], d, true);
  const real3 b = SampleSky(view.blurred[1], d, true);
  const real3 c = SampleSky(view.blurred[2], d, true);
  // Roughness 0.05, 0.30, 0.55, 0.85 of the four pictures.
  const real3 low = lerp3(sharp, a, clamp01((roughness - 0.05f) * 4.0f));
  const real3 high = lerp3(low, b, clamp01((roughness - 0.30f) * 4.0f));
  return lerp3(high, c, clamp01((roughness - 0.55f) * (1.0f / 0.30f)));
}

/// Irradiance from the probes around a point: on the front, on the back, and about the reflected direction.
struct Ambient {
  real3 front, back, reflected;
};

KERNEL Ambient UniformAmbient(const ShadeView& view, real3 n, real3 r) {
  const float* c = view.sky_irradiance;
  const auto sky = [&](real3 a) __attribute__((always_inline)) {
    const real3 e =
        sh9_irradiance(Uniform(c), Uniform(c + 3), Uniform(c + 6), Uniform(c + 9), Uniform(c + 12),
                       Uniform(c + 15), Uniform(c + 18), Uniform(c + 21), Uniform(c + 24), a);
    const ufloat3 extra{view.mean_ambient[0] * SHADE_PI, view.mean_ambient[1] * SHADE_PI,
                        view.mean_ambient[2] * SHADE_PI};
    const real3 sum = e + Uniform(view.ground) * ((0.5f - 0.5f * a.z) * SHADE_PI * view.has_sky) + extra;
    const real zero = real(0.0f);
    return make3(rmax(sum.x, zero), rmax(sum.y, zero), rmax(sum.z, zero));
  };
  return {sky(n), sky(-n), sky(r)};
}

static __attribute__((noinline, unused)) Ambient SampleProbes(const ShadeView& view, real3 p, real3 g,
                                                              real3 n, real3 r) {
  const ProbeView& grid = view.probes;
  if (grid.probes == nullptr) return UniformAmbient(view, n, r);

  // Half a cell in front of the surface, in grid coordinates.
  const float bias = 0.45f / grid.cells_per_metre;
  const real3 q = p + g * real(bias);
  const real zero = real(0.0f);
  const real x = rmin(real(grid.max_x + 0.9999f), rmax(zero, (q.x - grid.origin_x) * grid.cells_per_metre));
  const real y = rmin(real(grid.max_y + 0.9999f), rmax(zero, (q.y - grid.origin_y) * grid.cells_per_metre));
  const real h = rmin(real(grid.height_last), rmax(zero, (q.z - grid.height_origin) * grid.height_scale));
  alignas(64) float layer[kLanes];
  store(layer, rfloor(h + 0.5f));
  for (int i = 0; i < kLanes; ++i) layer[i] = grid.layer_of_height[static_cast<int>(layer[i])];
  const real z = load(layer);

  const real x0 = rmin(rfloor(x), real(grid.max_x)), y0 = rmin(rfloor(y), real(grid.max_y)),
             z0 = rmin(rfloor(z), real(grid.max_z));
  alignas(64) float fx[kLanes], fy[kLanes], fz[kLanes], nx[kLanes], ny[kLanes], nz[kLanes], rx[kLanes],
      ry[kLanes], rz[kLanes];
  alignas(64) int32_t index[kLanes];
  store3(fx, fy, fz, make3(x - x0, y - y0, z - z0));
  store3(nx, ny, nz, n);
  store3(rx, ry, rz, r);
  ((to_int(z0) * grid.stride_z + to_int(y0) * grid.stride_y + to_int(x0)) * 16)
      .copy_to(index, stdx::vector_aligned);

  ColorLanes front, back, reflected;
  const int along_x = 16, along_y = grid.stride_y * 16, along_z = grid.stride_z * 16;
  for (int i = 0; i < kLanes; ++i) {
    // Eight probes; their terms carry their weight already.
    const float* base = grid.probes + index[i];
    Quad terms[4] = {};
    for (int k = 0; k < 8; ++k) {
      const float* probe = base + (k & 1 ? along_x : 0) + (k & 2 ? along_y : 0) + (k & 4 ? along_z : 0);
      const float weight =
          (k & 1 ? fx[i] : 1 - fx[i]) * (k & 2 ? fy[i] : 1 - fy[i]) * (k & 4 ? fz[i] : 1 - fz[i]);
      for (int j = 0; j < 4; ++j) terms[j] += LoadQuad(probe + 4 * j) * weight;
    }
    const float scale = 1.0f / terms[0][3];
    for (Quad& t : terms) t *= scale;
    const Quad square = {terms[1][3], terms[2][3], terms[3][3], 0};
    const Quad bent = terms[1] * nx[i] + terms[2] * ny[i] + terms[3] * nz[i];
    const Quad even = terms[0] + square * (nz[i] * nz[i]);
    front.Set(i, even + bent);
    back.Set(i, even - bent);
    reflected.Set(
        i, terms[0] + terms[1] * rx[i] + terms[2] * ry[i] + terms[3] * rz[i] + square * (rz[i] * rz[i]));
  }
  const auto positive = [&](real3 c) __attribute__((always_inline)) {
    return make3(rmax(c.x, zero), rmax(c.y, zero), rmax(c.z, zero));
  };
  return {positive(front.Get()), positive(back.Get()), positive(reflected.Get())};
}

}  // namespace airsim360::internal::AIRSIM360_ISA
