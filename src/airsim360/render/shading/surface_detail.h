// What the surface kernel adds to plain texture look-ups (only for *_kernel.cc files): tiles without repeat,
// use and wear of grounds, rooms behind panes, waves, and the weather that lies on everything.
#pragma once

#include "airsim360/render/shading/surface_fetch.h"
#include "airsim360/render/shared/precipitation_simd.h"
#include "airsim360/render/shared/shading_ambient.h"

namespace airsim360::internal::AIRSIM360_ISA {

#define SHARED KERNEL
#define INOUT(type) type&
#define IN(type) const type&
// The second uses what the first defines.
// clang-format off
#include "airsim360/render/shared/shading_marks.h"
#include "airsim360/render/shared/shading_surface.h"
// clang-format on
#undef SHARED
#undef INOUT
#undef IN

/// A function of its own: inlined into the kernel, these make it so large that compilers take minutes.
#define SEPARATE static __attribute__((noinline))

// ---- Tiles mixed from patches (after Heitz & Neyret 2018 and Mikkelsen 2022)
// --------------------------------------

SEPARATE TileCorners ChooseCorners(const Fetched& f, real u, real v, real footprint) {
  if (!f.any_blend) return plain_tile(u, v);
  return mixed_tile(load(f.blend) > 0.5f, u, v, footprint);
}

/// Mix of the copies of one texture; `gain` (TileCorners::gain or 1) spreads it about `mean` in every
/// channel.
KERNEL real3 SampleTiles(const ShadeView& view, const Fetched& f, const int32_t* id, const TileCorners& c, real footprint, bool trilinear,
                         real3 mean, real gain) {
  const real3 first = SampleTexture(view.textures, id, c.u[0], c.v[0], footprint, trilinear);
  if (!f.any_blend) return first;
  real3 sum = (first - mean) * c.weight[0];
  for (int k = 1; k < 3; ++k) {
    // A lane without weight adds nothing, so leaving out a vector without any changes no bit.
    if (stdx::any_of(c.weight[k] > 0.0f))
      sum = sum + (SampleTexture(view.textures, id, c.u[k], c.v[k], footprint, trilinear) - mean) * c.weight[k];
  }
  const real3 mixed = mean + sum * gain;
  return sel3(load(f.blend) > 0.5f, make3(clamp01(mixed.x), clamp01(mixed.y), clamp01(mixed.z)), first);
}

// ---- World-space noise and what grounds make of it
// ----------------------------------------------------------------

KERNEL real3 SampleNoise(const ShadeView& view, PlanePoint at) { return SampleNoise(view, at.x, at.y); }

SEPARATE Noises LookUpNoises(const ShadeView& view, const Fetched& f, real3 p, real3 n, real width) {
  const PlanePoint plane = noise_plane(p, n);
  Noises out;
  out.wide = SampleNoise(view, wide_noise_at(plane));
  out.mid = SampleNoise(view, mid_noise_at(plane, out.wide));
  out.detail = noise_detail(width);
  out.fine = make3(real(0.5f), real(0.5f), real(0.5f));
  const mask_t near = shows_fine_noise(width);
  out.wall = wall_share(load(f.macro), load(f.ground), n.z);
  const mask_t upright = out.wall > 0.0f;
  if ((f.any_ground || view.wetness > 0 || view.snow > 0 || stdx::any_of(upright)) && stdx::any_of(near)) {
    const real3 fine = SampleNoise(view, fine_noise_at(plane, upright, p, n, out.wide, out.mid));
    out.fine = sel3(near, fine, out.fine);
  }
  return out;
}

/// Lanes of every kind of ground that the vector holds.
SEPARATE void WearGround(const Fetched& f, const Noises& s, real3 p, real u, real width, real3& color, real& roughness) {
  const real ground = sel(load(f.kind) == kFoliage, real(0.0f), load(f.ground));
  wear_ground(ground, s, p, u * load(f.tile), width, color, roughness);
}

// ---- Windows
// ------------------------------------------------------------------------------------------------------

SEPARATE RoomView LookInside(const ShadeView& view, const Fetched& f, real3 right, real3 up, real3 facing, real3 d, real w, real u,
                             real v) {
  const real a = load(f.corner_a[0]) * w + load(f.corner_a[1]) * u + load(f.corner_a[2]) * v;
  const real b = load(f.corner_b[0]) * w + load(f.corner_b[1]) * u + load(f.corner_b[2]) * v;
  const real room = load(f.room);
  const real3 light = room_light(room, load(f.area), load(f.emission[0]), view.lit_rooms, view.evening);
  return look_inside(a, b, load(f.half_a), load(f.half_b), dot3(d, right), dot3(d, up), real(0.0f) - dot3(d, facing), room, light,
                     load(f.u_per_a), load(f.v_per_b));
}

KERNEL void FurnishPane(const ShadeView& view, const Fetched& f, const RoomView& room, mask_t window, Skin& s) {
  const mask_t picture = to_real(ireal(f.base_id, stdx::vector_aligned)) > 0.5f;
  furnish_pane(window, picture, load3(f.color[0], f.color[1], f.color[2]), room, view.evening, view.lamplight, s.color, s.emission);
}

// ---- Lamps
// --------------------------------------------------------------------------------------------------------

/// Emission as the instance colours it, the beam throws it along the ray's way back, and the window shares it out.
SEPARATE real3 Thrown(const ShadeView& view, const RaySet& rays, int begin, const Fetched& f, real3 d, real3 emission) {
  if (view.glows != nullptr) {
    alignas(64) float glow[3][kLanes];
    for (int i = 0; i < kLanes; ++i) {
      for (uint32_t k = 0; k < 3; ++k) glow[k][i] = view.glows[3 * rays.instance[begin + i] + k];
    }
    emission = emission * load3(glow[0], glow[1], glow[2]);
  }
  if (!f.any_beam) return emission;
  const real beam = load(f.beam), zero = real(0.0f);
  const mask_t window = beam == kWindowBeam;
  const real sharp = sel(window, zero, rabs(beam));
  const real3 axis = ToWorld(f, beam_axis(beam));
  emission = emission * beam_shape(sharp, zero - sharp * dot3(axis, d), zero - d.z);
  if (!stdx::any_of(window)) return emission;
  return sel3(window, window_light(load(f.pane), load(f.area)) * luminance(emission), emission);
}

// ---- Weather
// ------------------------------------------------------------------------------------------------------

/// Share of the sky that is open above, from the probes: 1 in the open, 0.5 in a street, 0.2 under a canopy. By night they know
/// lamps above all: the roofs of rooms count as well.
KERNEL real OpenAbove(const ShadeView& view, real3 p, real3 facing) {
  if (!(view.open_sky > 0)) return real(0.0f);
  const real3 up = make3(real(0.0f), real(0.0f), real(1.0f));
  const real e = luminance(SampleProbes(view, p, facing, up, up).front);
  return clamp01(e * (1.0f / view.open_sky)) * (1.0f - roof_share(view.roofs, p));
}

/// Film of water with puddles, then snow over it.
SEPARATE void LieWeather(const ShadeView& view, const Fetched& f, const Noises& s, real3 p, real3 facing, real width, real u, Skin& k) {
  const real open = OpenAbove(view, p, facing);
  const Bed bed = bed_of(k, load(f.ground), facing, u * load(f.tile));
  if (view.wetness > 0) wet_skin(bed, s, p, facing, width, open, view.wetness, view.rain, k);
  if (view.snow > 0) snowy_skin(bed, s, facing, open, view.snow, k);
}

}  // namespace airsim360::internal::AIRSIM360_ISA
