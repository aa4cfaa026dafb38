// What the surface kernel adds to plain texture look-ups (only for *_kernel.cc files): tiles without repeat,
// use and wear of grounds, rooms behind panes, waves, and the weather that lies on everything.
#pragma once

#include "airsim360/render/shading/surface_fetch.h"
#include "airsim360/render/shared/roofs_simd.h"
#include "airsim360/render/shared/shading_ambient.h"

namespace airsim360::internal::AIRSIM360_ISA {

constexpr float kLowBeam = 10;  // of scene/material.h

#define SHARED KERNEL
#define INOUT(type) type&
#include "airsim360/render/shared/shading_marks.h"
#undef SHARED
#undef INOUT

/// A function of its own: inlined into the kernel, these make it so large that compilers take minutes.
#define SEPARATE static __attribute__((noinline))

// ---- Tiles mixed from patches (after Heitz & Neyret 2018 and Mikkelsen 2022)
// --------------------------------------

/// Where a texture is read: up to three shifted copies with weights that add up to 1.
struct TileCorners {
  real u[3], v[3], weight[3];
  real gain;  ///< restores the contrast that mixing takes: 1 / sqrt(sum of squared weights)
};

constexpr float kCellSize = 0.75f;  // edge of the triangular grid, in tiles

/// Triangular grid over the texture plane; every corner shifts its copy of the texture by its own hash.
SEPARATE TileCorners ChooseCorners(const Fetched& f, real u, real v, real footprint) {
  TileCorners c;
  c.u[0] = c.u[1] = c.u[2] = u;
  c.v[0] = c.v[1] = c.v[2] = v;
  c.weight[0] = c.gain = real(1.0f);
  c.weight[1] = c.weight[2] = real(0.0f);
  if (!f.any_blend) return c;
  const mask_t blended = load(f.blend) > 0.5f;
  const real q = (u - 0.57735027f * v) * (1.0f / kCellSize), r = 1.15470054f * v * (1.0f / kCellSize);
  const real q0 = rfloor(q), r0 = rfloor(r), a = q - q0, b = r - r0;
  const mask_t lower = a + b < 1.0f;
  const real one = real(1.0f), zero = real(0.0f);
  real w[3] = {sel(lower, 1.0f - a - b, a + b - 1.0f), sel(lower, a, 1.0f - b), sel(lower, b, 1.0f - a)};
  const real far = sel(lower, zero, one);
  const real cq[3] = {q0 + far, q0 + 1.0f, q0}, cr[3] = {r0 + far, r0, r0 + 1.0f};
  // Sharpened; where a pixel covers a good part of a tile one copy shows the same.
  const mask_t coarse = footprint > -2.0f;
  const real best = rmax(w[0], rmax(w[1], w[2]));
  real sum = zero, squares = zero;
  for (int k = 0; k < 3; ++k) {
    const real s = w[k] / best, s2 = s * s, s4 = s2 * s2;
    w[k] = sel(coarse && (s < 1.0f), zero, sel(s4 < 0.02f, zero, s4));
    sum = sum + w[k];
  }
  for (int k = 0; k < 3; ++k) {
    w[k] = w[k] / sum;
    squares = squares + w[k] * w[k];
    const real h = hash_cell(cq[k], cr[k]);
    c.u[k] = sel(blended, u + h, u);
    c.v[k] = sel(blended, v + hash_again(h, real(97.3f)), v);
    c.weight[k] = sel(blended, w[k], k == 0 ? one : zero);
  }
  c.gain = sel(blended, 1.0f / rroot(squares), one);
  return c;
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

/// Three noises each at three scales; see shading_ground.h.
struct Noises {
  real3 wide, mid, fine;
  real detail;
  real wall;  ///< see wall_share
};

SEPARATE Noises LookUpNoises(const ShadeView& view, const Fetched& f, real3 p, real3 n, real width) {
  // Walls see the noise from the side: height counts as a way along.
  const real px = p.x + 0.41f * p.z * n.x, py = p.y + 0.37f * p.z;
  Noises out;
  out.wide = SampleNoise(view, px * (1.0f / 311.0f), py * (1.0f / 311.0f));
  // The wider noise bends the finer ones, so that their periods of 47 and 11 m do not line up.
  const real bend_x = (out.wide.y - 0.5f) * 0.9f, bend_y = (out.wide.z - 0.5f) * 0.9f;
  out.mid = SampleNoise(view, px * (1.0f / 47.0f) + 0.37f + bend_x, py * (1.0f / 47.0f) + bend_y);
  out.detail = rmin(real(1.0f), 0.5f / rmax(width, real(1e-3f)));
  out.fine = make3(real(0.5f), real(0.5f), real(0.5f));
  const mask_t near = width < 5.0f;
  out.wall = wall_share(load(f.macro), load(f.ground), n.z);
  const mask_t upright = out.wall > 0.0f;
  if ((f.any_ground || view.wetness > 0 || view.snow > 0 || stdx::any_of(upright)) && stdx::any_of(near)) {
    const real qx = (px * 0.83f + py * 0.56f) * (1.0f / 11.3f), qy = (py * 0.83f - px * 0.56f) * (1.0f / 11.3f);
    // On walls it runs along and, much slower, down.
    const real along = (p.y * n.x - p.x * n.y) * (1.0f / 4.7f), down = p.z * (1.0f / 67.0f);
    const real3 fine =
        SampleNoise(view, sel(upright, along, qx + (out.mid.y - 0.5f) * 0.6f + bend_x), sel(upright, down, qy + (out.mid.z - 0.5f) * 0.6f));
    out.fine = sel3(near, fine, out.fine);
  }
  return out;
}

/// Brightness over 5 to 40 m of world, so that large grounds do not look tiled.
KERNEL real3 MacroTint(const Fetched& f, const Noises& noises, real width) {
  const real fade = rmin(real(1.0f), 6.0f / rmax(width, real(1e-3f)));
  const real amount = load(f.macro) * 2.0f;
  const real light = (noises.wide.x - 0.5f) * 1.1f + (noises.mid.x - 0.5f) * 0.9f * fade;
  const real warm = (noises.wide.y - 0.5f) * 0.35f + (noises.mid.y - 0.5f) * 0.2f * fade;
  const real low = real(0.35f);
  return make3(rmax(1.0f + amount * (light + warm), low), rmax(1.0f + amount * light, low), rmax(1.0f + amount * (light - warm), low));
}

/// Bricks and slabs differ from each other all over the world, not only within their tile.
KERNEL real3 UnitTint(const Fetched& f, real u, real v, real footprint) {
  const real columns = load(f.columns), rows = load(f.rows);
  const real row = rfloor(v * rows);
  const real column = rfloor(u * columns + 0.5f * (row - 2.0f * rfloor(row * 0.5f)));
  const real h = hash_cell(column, row), h2 = hash_again(h, real(61.7f));
  // Fades where a pixel covers several.
  const real keep = clamp01(1.3f - exp2_approx(footprint) * rmax(columns, rows) * 0.7f);
  const real light = 1.0f + (h - 0.5f) * 0.24f * keep, warm = (h2 - 0.5f) * 0.07f * keep;
  const mask_t has = columns > 0.5f;
  const real one = real(1.0f);
  return make3(sel(has, light + warm, one), sel(has, light, one), sel(has, light - warm, one));
}

// GroundWear
constexpr float kAsphalt = 1, kCarriageway = 2, kPaving = 3, kLawn = 4, kGravel = 5, kSoil = 6, kRoof = 7, kRoofRolls = 8;

/// Lanes of every kind of ground that the vector holds; see shading_ground.h and shading_marks.h.
SEPARATE void WearGround(const Fetched& f, const Noises& s, real3 p, real u, real width, real3& color, real& roughness) {
  const real ground = sel(load(f.kind) == kFoliage, real(0.0f), load(f.ground));
  const real zero = real(0.0f), one = real(1.0f);
  const mask_t street = (ground == kCarriageway), asphalt = street || (ground == kAsphalt);
  if (stdx::any_of(asphalt)) {
    real gain = one, tar = zero, polish = zero;
    asphalt_wear(p.x, p.y, u * load(f.tile), sel(street, one, zero), s.wide, s.mid, s.fine, s.detail, width, gain, tar, polish);
    const real3 marked = asphalt_marks(color * gain, p.x, p.y, s.wide, s.mid, s.fine, s.detail, width);
    color = sel3(asphalt, lerp3(marked, make3(real(0.034f), real(0.034f), real(0.035f)), tar), color);
    roughness = sel(asphalt, lerp1(roughness - polish, real(0.45f), tar), roughness);
  }
  const mask_t paving = (ground == kPaving);
  if (stdx::any_of(paving)) {
    const real3 worn = color * paving_wear(s.wide, s.mid, s.fine, s.detail);
    color = sel3(paving, paving_marks(worn, p.x, p.y, s.wide, s.mid, s.fine, s.detail, width), color);
  }
  const mask_t lawn = (ground == kLawn);
  if (stdx::any_of(lawn)) color = sel3(lawn, lawn_life(color, p.x, p.y, s.wide, s.mid, s.fine, s.detail, width), color);
  const mask_t gravel = (ground == kGravel), loose = gravel || (ground == kSoil);
  if (stdx::any_of(loose)) color = sel3(loose, loose_ground(color, s.wide, s.mid, s.fine, s.detail, sel(gravel, real(0.35f), one)), color);
  const mask_t rolls = (ground == kRoofRolls), roof = rolls || (ground == kRoof);
  if (stdx::any_of(roof)) {
    const real tint = roof_wear(p.x, s.wide, s.mid, s.fine, s.detail, width, sel(rolls, one, zero));
    color = sel3(roof, color * tint, color);
  }
}

/// Every leaf its own green: lighter and yellower or darker and bluer than its neighbours. Cloth (which lets
/// little light through) stays as it is.
KERNEL real3 LeafTint(const Fetched& f, real3 color) {
  const real amount = sel(load(f.kind) == kFoliage, clamp01((load(f.transmission) - 0.4f) * 5.0f), real(0.0f));
  const real h = load(f.pane), h2 = hash_again(h, real(61.7f));
  const real light = 1.0f + (h - 0.5f) * 0.44f * amount, yellow = (h2 - 0.42f) * 0.34f * amount;
  return make3(color.x * light * (1.0f + yellow), color.y * light, color.z * light * (1.0f - yellow * 0.6f));
}

// ---- Windows
// ------------------------------------------------------------------------------------------------------

/// A look through a pane: furnishings in daylight, lamplight, and how far a picture on the back wall seems
/// shifted.
struct RoomView {
  real3 daylight, lamplight;
  real front;  ///< 1 where something near hides the back wall
  real du, dv;
};

SEPARATE RoomView LookInside(const ShadeView& view, const Fetched& f, real3 right, real3 up, real3 facing, real3 d, real w, real u,
                             real v) {
  const real a = load(f.corner_a[0]) * w + load(f.corner_a[1]) * u + load(f.corner_a[2]) * v;
  const real b = load(f.corner_b[0]) * w + load(f.corner_b[1]) * u + load(f.corner_b[2]) * v;
  const real room = load(f.room);
  const mask_t lit = (hash_again(room, real(811.3f)) < view.lit_rooms) || (load(f.emission[0]) > 0.0f);
  const real3 light = view.evening > 0 ? evening_light(room, load(f.area)) : day_light(room);
  const real3 dark = make3(real(0.0f), real(0.0f), real(0.0f));
  RoomView out;
  real back_a = a, back_b = b;
  // Seen from the back of the pane (from inside) right and left change places; the hash keeps the room.
  interior_room(a, b, load(f.half_a), load(f.half_b), dot3(d, right), dot3(d, up), real(0.0f) - dot3(d, facing), room,
                sel3(lit, light, dark), out.daylight, out.lamplight, out.front, back_a, back_b);
  // A picture is as wide as its pane; beyond its edges it continues mirrored.
  const auto fold = [](real x, real half) __attribute__((always_inline)) {
    return sel(rabs(x) > half, sel(x > 0.0f, 2.0f * half - x, 0.0f - 2.0f * half - x), x);
  };
  out.du = (fold(back_a, load(f.half_a)) - a) * load(f.u_per_a);
  out.dv = (rmin(rmax(back_b, 0.0f - load(f.half_b)), load(f.half_b)) - b) * load(f.v_per_b);
  return out;
}

/// The room instead of a flat colour. Tinted panes colour it; panes with a picture (shops) keep that as back
/// wall, with the nearer furnishings in front.
KERNEL void FurnishPane(const ShadeView& view, const Fetched& f, const RoomView& room, mask_t window, real3& color, real3& emission) {
  const real3 tint = load3(f.color[0], f.color[1], f.color[2]);
  const real most = rmax(tint.x, rmax(tint.y, rmax(tint.z, real(1e-3f))));
  const real3 glass = lerp3(make3(real(0.86f), real(0.87f), real(0.86f)), tint * (0.8f / most), real(0.5f));
  const mask_t picture = to_real(ireal(f.base_id, stdx::vector_aligned)) > 0.5f;
  const mask_t plain = window && !picture;
  color = sel3(plain, room.daylight * glass + tint * real(0.15f), color);
  emission = sel3(plain, room.lamplight * glass * real(view.lamplight), emission);
  const mask_t display = window && picture && (room.front > 0.5f);
  color = sel3(display, room.daylight * real(1.6f), color);
  // By night what is displayed stands in the light of the shop alone.
  const real shown = real(view.evening > 0 ? 1.5f * view.lamplight : 0.5f);
  emission = sel3(display, emission * real(0.25f) + room.daylight * shown, emission);
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
  const real3 axis = ToWorld(f, make3(zero, sel(beam > 0.0f, real(-1.0f), real(1.0f)), sel(beam > kLowBeam, real(kBeamDrop), zero)));
  emission = emission * beam_shape(sharp, zero - sharp * dot3(axis, d), zero - d.z);
  if (!stdx::any_of(window)) return emission;
  return sel3(window, window_light(load(f.pane), load(f.area)) * luminance(emission), emission);
}

// ---- Water
// --------------------------------------------------------------------------------------------------------

/// Waves whose strength wanders over 5 to 60 m: gusts and calm streaks, which also hides that the waves are
/// few.
KERNEL real3 Waves(const ShadeView& view, real3 p, real footprint, real& lost) {
  const real3 gust = SampleNoise(view, p.x * (1.0f / 173.0f), p.y * (1.0f / 131.0f));
  const real wind = rmax(0.75f + 2.6f * (gust.x - 0.5f), real(0.22f));
  const real3 n = water_normal(p.x + 5.0f * (gust.y - 0.5f), p.y + 5.0f * (gust.z - 0.5f), footprint, lost);
  lost = lost * wind * wind;
  return normalize3(make3(n.x * wind, n.y * wind, n.z));
}

// ---- Weather
// ------------------------------------------------------------------------------------------------------

/// What weather changes about a surface.
struct Skin {
  real3 color;
  real metallic, roughness, coat, coat_roughness, transmission, kind;
  real3 n, emission;
};

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
  const real open = OpenAbove(view, p, facing), zero = real(0.0f), one = real(1.0f);
  const mask_t leaf = k.kind == kFoliage, solid = (k.kind != kGlass) && (k.kind != kWater);
  const real ground = load(f.ground);
  const mask_t grass = (ground == kLawn) || (ground == kSoil);
  // Blades stand, but they hold what falls on their lawn.
  const real up = sel(leaf, rmax(rabs(facing.z), sel(grass, real(0.8f), zero)), facing.z);
  const mask_t street = (ground == kCarriageway);
  const real lane = (rabs(rabs(u * load(f.tile)) - 1.72f) - 0.78f) * (1.0f / 0.32f);
  const real track = sel(street, exp_approx(zero - lane * lane), zero);
  if (view.wetness > 0) {
    const real exposed = smooth01(clamp01((open - 0.12f) * 5.0f)) * (0.12f + 0.88f * clamp01(up * 2.0f + 0.2f));
    const real film = sel(solid, clamp01(view.wetness * exposed * (1.15f + 1.2f * (s.mid.y - 0.5f))), zero);
    const real soak = film * porosity(k.roughness, k.metallic);
    k.color = lerp3(k.color, make3(wet_albedo(k.color.x), wet_albedo(k.color.y), wet_albedo(k.color.z)), soak);
    // Puddles on level ground, the first of them in the wheel tracks.
    const real level = sel(grass || (facing.z < 0.97f) || leaf, zero, one);
    const real relief = 0.55f * s.mid.x + 0.30f * s.fine.y + 0.15f * s.wide.y - 0.035f * track;
    const real puddle = puddle_cover(relief, view.wetness * exposed) * level;
    real ring_x = zero, ring_y = zero;
    if (view.rain > 0 && stdx::any_of(puddle > 0.0f)) {
      drop_rings(p.x, p.y, real(view.rain), ring_x, ring_y);
      const real near = clamp01(0.06f / rmax(width, real(1e-3f)));
      ring_x = ring_x * near;
      ring_y = ring_y * near;
    }
    // The film follows the relief less than the stone does; standing water not at all.
    k.n = normalize3(lerp3(k.n, facing, rmax(puddle, sel(leaf, zero, film * 0.55f))));
    k.n = normalize3(k.n + make3(ring_x * puddle, ring_y * puddle, zero));
    const real sheen = film * sel(leaf || grass, real(0.35f), real(0.75f)) * (1.0f - 0.5f * k.metallic);
    const real water = rmax(sheen, puddle);
    const real film_roughness = lerp1(0.34f - 0.14f * film, real(0.03f), puddle);
    k.coat_roughness = sel(water > k.coat, film_roughness, k.coat_roughness);
    k.coat = rmax(k.coat, water);
  }
  if (view.snow > 0) {
    const real exposed = smooth01(clamp01((open - 0.15f) * 3.4f)) * (1.0f - 0.62f * track) * sel(ground > 0.5f && !grass, real(0.85f), one);
    const real relief = 0.45f * s.mid.z + 0.55f * s.fine.x;
    const real cover = sel(solid || ((k.kind == kGlass) && (up > 0.25f)), snow_cover(real(view.snow), up, relief, exposed), zero);
    const real3 white = make3(real(0.83f), real(0.85f), real(0.88f)) * (0.97f + 0.25f * (s.fine.z - 0.5f));
    // Some slush stays dark at the edge.
    k.color = lerp3(k.color, white, cover);
    k.metallic = k.metallic * (1.0f - cover);
    k.roughness = lerp1(k.roughness, real(0.75f), cover);
    k.coat = k.coat * (1.0f - cover);
    k.transmission = k.transmission * (1.0f - 0.8f * cover);
    k.emission = k.emission * (1.0f - cover);
    const real3 soft = normalize3(facing + make3(s.fine.x - 0.5f, s.fine.y - 0.5f, zero) * real(0.30f));
    k.n = sel3(leaf, k.n, normalize3(lerp3(k.n, soft, cover)));
    k.kind = sel((cover > 0.5f) && !leaf, zero, k.kind);
  }
}

}  // namespace airsim360::internal::AIRSIM360_ISA
