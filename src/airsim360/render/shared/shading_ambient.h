// Look-ups of light for the shading kernels (only for *_kernel.cc files): sky tables and light probes.
#pragma once

#include "airsim360/render/shared/lane_gather.h"
#include "airsim360/render/shared/shading_data.h"

namespace airsim360::internal::AIRSIM360_ISA {

#define KERNEL static inline __attribute__((always_inline, unused))

KERNEL ufloat3 Uniform(const float* p) { return {p[0], p[1], p[2]}; }

/// asin(z) for |z| <= 1 within 7e-7 (least-error quintic of what is left of it over the square root of 1 - |z|).
KERNEL real Elevation(real z) {
  const real a = rabs(z), a2 = a * a;
  const real p =
      (1.57079569f - a * 0.214542817f) + a2 * (0.0881710532f - a * 0.0459272275f) + (a2 * a2) * (0.0206200601f - a * 0.00491117374f);
  const real e = 1.57079633f - rroot(1.0f - a) * p;
  return sel(z < 0.0f, 0.0f - e, e);
}

/// Where directions lie in a sky table.
struct SkyPlace {
  real fx, fy;                        ///< between the texels
  alignas(64) int32_t index[kLanes];  ///< first float of the lower left one
};

/// `full_sphere` as in SkyTable.
KERNEL SkyPlace FindSky(const SkyTableView& table, real3 d, bool full_sphere) {
  real column = atan2_approx(d.y, d.x) * (table.width / (2.0f * SHADE_PI)) - 0.5f;
  column = sel(column < 0.0f, column + table.width, column);
  real e = Elevation(rmin(rmax(d.z, real(-1.0f)), real(1.0f))) * (2.0f / SHADE_PI);
  real t = 0.5f + 0.5f * e;
  if (!full_sphere) {
    t = sky_row(rmax(e, real(0.0f)));
  }
  const real row = clamp01(t) * (table.height - 1.0f);
  // Written so that a direction that is not a number still finds a texel.
  const real x = rmin(real(table.width - 1.0f), rmax(real(0.0f), rfloor(column)));
  const real y = rmin(real(table.height - 2.0f), rmax(real(0.0f), rfloor(row)));
  SkyPlace place{column - x, row - y, {}};
  ((to_int(y) * table.stride + to_int(x)) * 4).copy_to(place.index, stdx::vector_aligned);
  return place;
}

/// Bilinear.
KERNEL real3 TakeSky(const SkyTableView& table, const SkyPlace& place) {
  const auto texel = [&](int32_t offset) __attribute__((always_inline)) {
    return Rgb(GatherQuads([&](int i) __attribute__((always_inline)) { return table.texels + place.index[i] + offset; }));
  };
  const int32_t below = table.stride * 4;
  const real3 lower = lerp3(texel(0), texel(4), place.fx), upper = lerp3(texel(below), texel(below + 4), place.fx);
  return lerp3(lower, upper, place.fy);
}

/// Both at once.
static __attribute__((noinline, unused)) real3 SampleSky(const SkyTableView& table, real3 d, bool full_sphere) {
  SkyPlace place = FindSky(table, d, full_sphere);
  KeepInMemory(place.index);
  return TakeSky(table, place);
}

/// Share of the sun's light that clouds leave at p; CloudShadowMap::At for lanes.
KERNEL real CloudShadow(const CloudShadowView& map, real3 p) {
  if (map.texels == nullptr) return real(1.0f);
  const auto size = static_cast<float>(map.size);
  const real above = p.z - map.plane_z;
  const real x = shadow_column(p.x, above, map.slant_x, map.origin_x, map.cells_per_metre, size);
  const real y = shadow_column(p.y, above, map.slant_y, map.origin_y, map.cells_per_metre, size);
  const real x0 = rfloor(x), y0 = rfloor(y);
  const ireal index = to_int(y0) * map.size + to_int(x0);
  // Near by, all lanes lie in one cell.
  const int32_t first = index[0];
  const bool one_cell = stdx::all_of(index == first);
  const auto texel = [&](int32_t offset) __attribute__((always_inline)) {
    return one_cell ? real(map.texels[first + offset]) : GatherFloats(map.texels + offset, index);
  };
  const real fx = x - x0, fy = y - y0;
  const real low = lerp1(texel(0), texel(1), fx), high = lerp1(texel(map.size), texel(map.size + 1), fx);
  return low + (high - low) * fy;
}

/// Sky, and ground below the horizon, blurred as by a surface of this roughness.
KERNEL real3 BlurredSky(const ShadeView& view, real3 d, real roughness) {
  const real3 up = SampleSky(view.sky, d, false);
  const real3 sharp =
      sel3(d.z > 0.0f, up, lerp3(up, make3(real(view.ground[0]), real(view.ground[1]), real(view.ground[2])), ground_share(d.z)));
  const real3 shares = blur_shares(roughness);
  if (!stdx::any_of(shares.x > 0.0f)) return sharp;
  const real3 a = SampleSky(view.blurred[0], d, true);
  const real3 b = SampleSky(view.blurred[1], d, true);
  const real3 c = SampleSky(view.blurred[2], d, true);
  return lerp3(lerp3(lerp3(sharp, a, shares.x), b, shares.y), c, shares.z);
}

/// Irradiance from the probes around a point: on the front, on the back, and about the reflected direction.
struct Ambient {
  real3 front, back, reflected;
};

KERNEL Ambient UniformAmbient(const ShadeView& view, real3 n, real3 r) {
  const float* c = view.sky_irradiance;
  const auto sky = [&](real3 a) __attribute__((always_inline)) {
    const real3 e = sh9_irradiance(Uniform(c), Uniform(c + 3), Uniform(c + 6), Uniform(c + 9), Uniform(c + 12), Uniform(c + 15),
                                   Uniform(c + 18), Uniform(c + 21), Uniform(c + 24), a);
    const ufloat3 extra{view.mean_ambient[0] * SHADE_PI, view.mean_ambient[1] * SHADE_PI, view.mean_ambient[2] * SHADE_PI};
    const real3 sum = e + Uniform(view.ground) * ((0.5f - 0.5f * a.z) * SHADE_PI * view.has_sky) + extra;
    const real zero = real(0.0f);
    return make3(rmax(sum.x, zero), rmax(sum.y, zero), rmax(sum.z, zero));
  };
  return {sky(n), sky(-n), sky(r)};
}

/// Where points lie among the probes.
struct ProbePlace {
  real fx, fy, fz;                    ///< in the cell
  alignas(64) int32_t index[kLanes];  ///< first float of its lowest corner
};

/// Of points half a cell in front of surfaces of normal g.
KERNEL ProbePlace FindProbes(const ProbeView& grid, real3 p, real3 g) {
  const float bias = kProbeBias / grid.cells_per_metre;
  const real3 q = p + g * real(bias);
  const real zero = real(0.0f);
  const real x = rmin(real(grid.max_x + kProbeReach), rmax(zero, (q.x - grid.origin_x) * grid.cells_per_metre));
  const real y = rmin(real(grid.max_y + kProbeReach), rmax(zero, (q.y - grid.origin_y) * grid.cells_per_metre));
  const real h = rmin(real(grid.height_last), rmax(zero, (q.z - grid.height_origin) * grid.height_scale));
  const real z = GatherFloats(grid.layer_of_height, to_int(rfloor(h + 0.5f)));
  const real x0 = rmin(rfloor(x), real(grid.max_x)), y0 = rmin(rfloor(y), real(grid.max_y)), z0 = rmin(rfloor(z), real(grid.max_z));
  ProbePlace place{x - x0, y - y0, z - z0, {}};
  ((to_int(z0) * grid.stride_z + to_int(y0) * grid.stride_y + to_int(x0)) * 16).copy_to(place.index, stdx::vector_aligned);
  return place;
}

/// Terms of one probe, or the mean of several.
struct ProbeTerms {
  real4 t[4];
  __attribute__((always_inline)) real3 Square() const { return {t[1].w, t[2].w, t[3].w}; }
  __attribute__((always_inline)) real3 Bent(real3 n) const { return Rgb(t[1]) * n.x + Rgb(t[2]) * n.y + Rgb(t[3]) * n.z; }
};
template <class At>
KERNEL ProbeTerms GatherTerms(At at) {
  ProbeTerms terms;
  for (int j = 0; j < 4; ++j) terms.t[j] = GatherQuads([&](int i) __attribute__((always_inline)) { return at(i) + 4 * j; });
  return terms;
}

/// Sum of the eight probes around, by weight; their terms carry one of their own already, which is to be
/// divided by.
KERNEL ProbeTerms MixProbes(const ProbeView& grid, const ProbePlace& place) {
  typedef float Probe __attribute__((vector_size(64), aligned(4), may_alias));
  alignas(64) float weight[8][kLanes], mixed[kLanes][16];
  for (int k = 0; k < 8; ++k) {
    store(weight[k], (k & 1 ? place.fx : 1.0f - place.fx) * (k & 2 ? place.fy : 1.0f - place.fy) * (k & 4 ? place.fz : 1.0f - place.fz));
  }
  const int along_x = 16, along_y = grid.stride_y * 16, along_z = grid.stride_z * 16;
  const auto corner = [&](int k) __attribute__((always_inline)) {
    return (k & 1 ? along_x : 0) + (k & 2 ? along_y : 0) + (k & 4 ? along_z : 0);
  };
  // All lanes in one cell, the usual case near by: the same sums term by term, with nothing to turn round.
  if (stdx::all_of(ireal(place.index, stdx::vector_aligned) == place.index[0])) {
    const float* base = grid.probes + place.index[0];
    ProbeTerms terms;
    for (int j = 0; j < 4; ++j) {
      const auto term = [&](int part) __attribute__((always_inline)) {
        const float* at = base + 4 * j + part;
        real sum = at[0] * load(weight[0]);
        for (int k = 1; k < 8; ++k) sum = sum + at[corner(k)] * load(weight[k]);
        return sum;
      };
      terms.t[j] = {term(0), term(1), term(2), term(3)};
    }
    return terms;
  }
  for (int i = 0; i < kLanes; ++i) {
    const float* base = grid.probes + place.index[i];
    Probe sum = *reinterpret_cast<const Probe*>(base) * weight[0][i];
    for (int k = 1; k < 8; ++k) sum += *reinterpret_cast<const Probe*>(base + corner(k)) * weight[k][i];
    *reinterpret_cast<Probe*>(mixed[i]) = sum;
  }
  return GatherTerms([&](int i) __attribute__((always_inline)) { return mixed[i]; });
}

static __attribute__((noinline, unused)) Ambient SampleProbes(const ShadeView& view, real3 p, real3 g, real3 n, real3 r) {
  const ProbeView& grid = view.probes;
  if (grid.probes == nullptr) return UniformAmbient(view, n, r);
  ProbeTerms terms = MixProbes(grid, FindProbes(grid, p, g));
  const real scale = 1.0f / terms.t[0].w;
  for (real4& t : terms.t) t = {t.x * scale, t.y * scale, t.z * scale, t.w * scale};
  const real3 square = terms.Square(), bent = terms.Bent(n);
  const real3 even = Rgb(terms.t[0]) + square * (n.z * n.z);
  const real3 reflected = Rgb(terms.t[0]) + Rgb(terms.t[1]) * r.x + Rgb(terms.t[2]) * r.y + Rgb(terms.t[3]) * r.z + square * (r.z * r.z);
  const auto positive = [](real3 c) __attribute__((always_inline)) {
    const real zero = real(0.0f);
    return make3(rmax(c.x, zero), rmax(c.y, zero), rmax(c.z, zero));
  };
  return {positive(even + bent), positive(even - bent), positive(reflected)};
}

}  // namespace airsim360::internal::AIRSIM360_ISA
