// From a material and a place to a surface: tiles without repeat, tints, use and wear, rooms behind panes, waves, the weather
// that lies on everything. In the subset of shading_shared.h, included after shading_marks.h in the same way, with IN(T) for an
// argument that is only read. Fetching records, textures and noise is the back ends' own.

#define SURFACE_MIRROR_ROUGHNESS 0.12f
#define LAWN_LIFE 0.6f          // share of lawn_life that mown lawns show
#define SURFACE_MOST_TAPS 8.0f  // places at which tier `high` looks up a slanted pixel
#define SURFACE_LOW_BEAM 10.0f  // kLowBeam of scene/material.h (shading_shared_test.cc compares)

// GroundWear
#define GROUND_ASPHALT 1.0f
#define GROUND_CARRIAGEWAY 2.0f
#define GROUND_PAVING 3.0f
#define GROUND_LAWN 4.0f
#define GROUND_GRAVEL 5.0f
#define GROUND_SOIL 6.0f
#define GROUND_ROOF 7.0f
#define GROUND_ROOF_ROLLS 8.0f

// ---- Texture coordinates

// Cosine between a ray and a surface, not too small to divide by.
SHARED real slant_of(real3 facing, real3 d) { return rmax(rabs(dot3(facing, d)), real(0.03f)); }

// log2 of texture tiles that a pixel covers: between its cone's width and the stretch of that on the slanted surface.
SHARED real texture_footprint(real width, real slant, real texels_log2) {
  return log2_approx(rmax(width, real(1e-9f))) - 0.75f * log2_approx(slant) + texels_log2;
}

// A pixel on a slanted surface is long and narrow. Its picture is the mean of several places along its axis, each filtered over no
// more than its part of the length, so that joints keep the contrast that they have in a photograph.
struct Stretch {
  real u, v;       // the axis from end to end, in texture coordinates
  real taps;       // how many places
  real footprint;  // of each, log2 of texture tiles
};

// `along_u`, `along_v`: the ray's direction in the surface's plane along growing u and v, of any length. Where `most` is 1, or
// the place is `mixed` from patches (which have no joints), the one place and footprint of before.
SHARED Stretch stretched_pixel(real along_u, real along_v, real width, real slant, real texels_log2, real footprint, mask_t mixed,
                               ufloat most) {
  real one = real(1.0f);
  Stretch s;
  s.taps = rmin(rmax(rfloor(1.0f / slant + 0.5f), one), real(most));
  s.taps = sel(mixed, one, s.taps);
  mask_t single = s.taps < 1.5f;
  real across = rmax(width, real(1e-9f)) * exp2_approx(texels_log2);
  real extent = across / slant;
  real scale = extent / rmax(rroot(along_u * along_u + along_v * along_v), real(1e-6f));
  s.u = sel(single, real(0.0f), along_u * scale);
  s.v = sel(single, real(0.0f), along_v * scale);
  s.footprint = sel(single, footprint, log2_approx(rmax(across, extent / s.taps)));
  return s;
}

// Where along the axis the k-th place lies.
SHARED real tap_at(real k, real taps) { return (k + 0.5f) / taps - 0.5f; }

// ---- Tiles mixed from patches (after Heitz & Neyret 2018 and Mikkelsen 2022)

// Where a texture is read: up to three shifted copies with weights that add up to 1.
struct TileCorners {
  real u[3], v[3], weight[3];
  real gain;  // restores the contrast that mixing takes: 1 / sqrt(sum of squared weights)
};

SHARED TileCorners plain_tile(real u, real v) {
  TileCorners c;
  for (int k = 0; k < 3; k++) {
    c.u[k] = u;
    c.v[k] = v;
    c.weight[k] = real(k == 0 ? 1.0f : 0.0f);
  }
  c.gain = real(1.0f);
  return c;
}

// Triangular grid over the texture plane, its edge 0.75 tiles; every corner shifts its copy of the texture by its own hash.
SHARED TileCorners mixed_tile(mask_t blended, real u, real v, real footprint) {
  TileCorners c = plain_tile(u, v);
  real one = real(1.0f);
  real zero = real(0.0f);
  real q = (u - 0.57735027f * v) * (1.0f / 0.75f);
  real r = 1.15470054f * v * (1.0f / 0.75f);
  real q0 = rfloor(q);
  real r0 = rfloor(r);
  real a = q - q0;
  real b = r - r0;
  mask_t lower = a + b < 1.0f;
  real w[3];
  w[0] = sel(lower, 1.0f - a - b, a + b - 1.0f);
  w[1] = sel(lower, a, 1.0f - b);
  w[2] = sel(lower, b, 1.0f - a);
  real far = sel(lower, zero, one);
  real cq[3];
  real cr[3];
  cq[0] = q0 + far;
  cr[0] = r0 + far;
  cq[1] = q0 + 1.0f;
  cr[1] = r0;
  cq[2] = q0;
  cr[2] = r0 + 1.0f;
  // Sharpened; where a pixel covers a good part of a tile one copy shows the same. Of the weights, not of `s`: hardware need not
  // make 1 of a number over itself.
  mask_t coarse = footprint > -2.0f;
  real best = rmax(w[0], rmax(w[1], w[2]));
  real sum = zero;
  real squares = zero;
  for (int k = 0; k < 3; k++) {
    real s = w[k] / best;
    real s2 = s * s;
    real s4 = s2 * s2;
    w[k] = sel(coarse && (w[k] < best), zero, sel(s4 < 0.02f, zero, s4));
    sum = sum + w[k];
  }
  for (int k = 0; k < 3; k++) {
    w[k] = w[k] / sum;
    squares = squares + w[k] * w[k];
    real h = hash_cell(cq[k], cr[k]);
    c.u[k] = sel(blended, u + h, u);
    c.v[k] = sel(blended, v + hash_again(h, real(97.3f)), v);
    c.weight[k] = sel(blended, w[k], c.weight[k]);
  }
  c.gain = sel(blended, 1.0f / rroot(squares), one);
  return c;
}

// What a roughness map and a normal map show on average.
SHARED real3 mean_roughness() { return make3(real(1.0f), real(0.5f), real(1.0f)); }
SHARED real3 mean_normal() { return make3(real(0.5f), real(0.5f), real(0.9f)); }

// Base colours and roughness stay within what nature has: nothing gives back more light than it gets, however bright the tints.
SHARED real3 lawful_color(real3 c) { return make3(rmin(c.x, real(1.0f)), rmin(c.y, real(1.0f)), rmin(c.z, real(1.0f))); }
SHARED real lawful_roughness(real roughness) { return rmin(rmax(roughness, real(BSDF_LEAST_ROUGHNESS)), real(1.0f)); }

// A part of the normal map's slope: normal `n` bent by the texel, `tangent` the direction of growing u, `mirrored` -1 where green
// points the other way. What mipmapping shortened becomes roughness (Toksvig 2005).
SHARED real3 bend_normal(real3 texel, real3 n, real3 tangent, real mirrored, real scale, INOUT(real) roughness) {
  real3 m = texel * real(2.0f) - make3(real(1.0f), real(1.0f), real(1.0f));
  real size = rmin(rroot(dot3(m, m)), real(1.0f));
  real3 t = normalize3(tangent - n * dot3(n, tangent));
  real3 b = make3(n.y * t.z - n.z * t.y, n.z * t.x - n.x * t.z, n.x * t.y - n.y * t.x) * mirrored;
  real variance = (1.0f - size) / rmax(size, real(0.2f)) * scale * scale;
  real alpha = roughness * roughness;
  real widened = rroot(rroot(rmin(alpha * alpha + 2.0f * variance * variance + variance * 0.5f, real(1.0f))));
  roughness = rmax(widened, roughness);
  return normalize3(t * (m.x * scale) + b * (m.y * scale) + n * rmax(m.z, real(0.05f)));
}

// ---- World-space noise and what grounds make of it

// Three noises each at three scales; see shading_ground.h.
struct Noises {
  real3 wide, mid, fine;
  real detail;
  real wall;  // see wall_share
};

// Where the noise of a point is looked up. Walls see it from the side: height counts as a way along.
SHARED PlanePoint noise_plane(real3 p, real3 n) {
  PlanePoint at;
  at.x = p.x + 0.41f * p.z * n.x;
  at.y = p.y + 0.37f * p.z;
  return at;
}
SHARED PlanePoint wide_noise_at(PlanePoint plane) {
  PlanePoint at;
  at.x = plane.x * (1.0f / 311.0f);
  at.y = plane.y * (1.0f / 311.0f);
  return at;
}
// The wider noise bends the finer ones, so that their periods of 47 and 11 m do not line up.
SHARED real noise_bend(real wide) { return (wide - 0.5f) * 0.9f; }
SHARED PlanePoint mid_noise_at(PlanePoint plane, real3 wide) {
  PlanePoint at;
  at.x = plane.x * (1.0f / 47.0f) + 0.37f + noise_bend(wide.y);
  at.y = plane.y * (1.0f / 47.0f) + noise_bend(wide.z);
  return at;
}
// On walls it runs along and, much slower, down.
SHARED PlanePoint fine_noise_at(PlanePoint plane, mask_t upright, real3 p, real3 n, real3 wide, real3 mid) {
  real x = (plane.x * 0.83f + plane.y * 0.56f) * (1.0f / 11.3f);
  real y = (plane.y * 0.83f - plane.x * 0.56f) * (1.0f / 11.3f);
  real along = (p.y * n.x - p.x * n.y) * (1.0f / 4.7f);
  real down = p.z * (1.0f / 67.0f);
  PlanePoint at;
  at.x = sel(upright, along, x + (mid.y - 0.5f) * 0.6f + noise_bend(wide.y));
  at.y = sel(upright, down, y + (mid.z - 0.5f) * 0.6f);
  return at;
}
SHARED real noise_detail(real width) { return rmin(real(1.0f), 0.5f / rmax(width, real(1e-3f))); }
SHARED mask_t shows_fine_noise(real width) { return width < 5.0f; }

// Brightness over 5 to 40 m of world, so that large grounds do not look tiled.
SHARED real3 macro_tint(real variation, IN(Noises) s, real width) {
  real fade = rmin(real(1.0f), 6.0f / rmax(width, real(1e-3f)));
  real amount = variation * 2.0f;
  real light = (s.wide.x - 0.5f) * 1.1f + (s.mid.x - 0.5f) * 0.9f * fade;
  real warm = (s.wide.y - 0.5f) * 0.35f + (s.mid.y - 0.5f) * 0.2f * fade;
  real low = real(0.35f);
  return make3(rmax(1.0f + amount * (light + warm), low), rmax(1.0f + amount * light, low), rmax(1.0f + amount * (light - warm), low));
}

// Bricks and slabs differ from each other all over the world, not only within their tile.
SHARED real3 unit_tint(real columns, real rows, real u, real v, real footprint) {
  real row = rfloor(v * rows);
  real column = rfloor(u * columns + 0.5f * (row - 2.0f * rfloor(row * 0.5f)));
  real h = hash_cell(column, row);
  real h2 = hash_again(h, real(61.7f));
  // Fades where a pixel covers several.
  real keep = clamp01(1.3f - exp2_approx(footprint) * rmax(columns, rows) * 0.7f);
  real light = 1.0f + (h - 0.5f) * 0.24f * keep;
  real warm = (h2 - 0.5f) * 0.07f * keep;
  mask_t has = columns > 0.5f;
  real one = real(1.0f);
  return make3(sel(has, light + warm, one), sel(has, light, one), sel(has, light - warm, one));
}

// Every leaf its own green: lighter and yellower or darker and bluer than its neighbours. Cloth (which lets little light through)
// stays as it is.
SHARED real3 leaf_tint(mask_t foliage, real transmission, real hash, real3 color) {
  real amount = sel(foliage, clamp01((transmission - 0.4f) * 5.0f), real(0.0f));
  real h2 = hash_again(hash, real(61.7f));
  real light = 1.0f + (hash - 0.5f) * 0.44f * amount;
  real yellow = (h2 - 0.42f) * 0.34f * amount;
  return make3(color.x * light * (1.0f + yellow), color.y * light, color.z * light * (1.0f - yellow * 0.6f));
}

// Every kind of ground that there is; see shading_ground.h and shading_marks.h. `across` is the distance from the middle of a
// street.
SHARED void wear_ground(real ground, IN(Noises) s, real3 p, real across, real width, INOUT(real3) color, INOUT(real) roughness) {
  real zero = real(0.0f);
  real one = real(1.0f);
  mask_t street = (ground == GROUND_CARRIAGEWAY);
  mask_t asphalt = street || (ground == GROUND_ASPHALT);
  if (any_lane(asphalt)) {
    real gain = one;
    real tar = zero;
    real polish = zero;
    asphalt_wear(p.x, p.y, across, sel(street, one, zero), s.wide, s.mid, s.fine, s.detail, width, gain, tar, polish);
    real3 marked = asphalt_marks(color * gain, p.x, p.y, s.wide, s.mid, s.fine, s.detail, width);
    color = sel3(asphalt, lerp3(marked, make3(real(0.034f), real(0.034f), real(0.035f)), tar), color);
    roughness = sel(asphalt, lerp1(roughness - polish, real(0.45f), tar), roughness);
  }
  mask_t paving = (ground == GROUND_PAVING);
  if (any_lane(paving)) {
    real3 worn = color * paving_wear(s.wide, s.mid, s.fine, s.detail);
    color = sel3(paving, paving_marks(worn, p.x, p.y, s.wide, s.mid, s.fine, s.detail, width), color);
  }
  mask_t lawn = (ground == GROUND_LAWN);
  // Lawns are of one seed and one mower: they differ less from place to place than what grows by itself.
  if (any_lane(lawn))
    color = sel3(lawn, lerp3(color, lawn_life(color, p.x, p.y, s.wide, s.mid, s.fine, s.detail, width), real(LAWN_LIFE)), color);
  mask_t gravel = (ground == GROUND_GRAVEL);
  mask_t loose = gravel || (ground == GROUND_SOIL);
  if (any_lane(loose)) color = sel3(loose, loose_ground(color, s.wide, s.mid, s.fine, s.detail, sel(gravel, real(0.35f), one)), color);
  mask_t rolls = (ground == GROUND_ROOF_ROLLS);
  mask_t roof = rolls || (ground == GROUND_ROOF);
  if (any_lane(roof)) {
    real tint = roof_wear(p.x, s.wide, s.mid, s.fine, s.detail, width, sel(rolls, one, zero));
    color = sel3(roof, color * tint, color);
  }
}

// ---- Windows

// A look through a pane: furnishings in daylight, lamplight, and how far a picture on the back wall seems shifted.
struct RoomView {
  real3 daylight, lamplight;
  real front;  // 1 where something near hides the back wall
  real du, dv;
};

// Light of a room whose lamps are on, as a share `lit_rooms` of them and all that glow have.
SHARED real3 room_light(real room, real area, real glow, ufloat lit_rooms, ufloat evening) {
  mask_t lit = (hash_again(room, real(811.3f)) < lit_rooms) || (glow > 0.0f);
  real3 light = evening > 0.0f ? evening_light(room, area) : day_light(room);
  return sel3(lit, light, make3(real(0.0f), real(0.0f), real(0.0f)));
}

// A picture is as wide as its pane; beyond its edges it continues mirrored.
SHARED real fold_picture(real x, real half_size) {
  return sel(rabs(x) > half_size, sel(x > 0.0f, 2.0f * half_size - x, 0.0f - 2.0f * half_size - x), x);
}

// From the place (a, b) of a pane along (da, db, dn): right, up and inwards. Seen from the back of the pane (from inside) right and
// left change places; the hash keeps the room.
SHARED RoomView look_inside(real a, real b, real half_a, real half_b, real da, real db, real dn, real room, real3 light, real u_per_a,
                            real v_per_b) {
  RoomView seen;
  real3 dark = make3(real(0.0f), real(0.0f), real(0.0f));
  seen.daylight = dark;
  seen.lamplight = dark;
  seen.front = real(0.0f);
  real back_a = a;
  real back_b = b;
  interior_room(a, b, half_a, half_b, da, db, dn, room, light, seen.daylight, seen.lamplight, seen.front, back_a, back_b);
  seen.du = (fold_picture(back_a, half_a) - a) * u_per_a;
  seen.dv = (rmin(rmax(back_b, 0.0f - half_b), half_b) - b) * v_per_b;
  return seen;
}

// The room instead of a flat colour. Tinted panes colour it; panes with a picture (shops) keep that as back wall, with the nearer
// furnishings in front.
SHARED void furnish_pane(mask_t window, mask_t picture, real3 tint, IN(RoomView) room, ufloat evening, ufloat lamplight, INOUT(real3) color,
                         INOUT(real3) emission) {
  real most = rmax(tint.x, rmax(tint.y, rmax(tint.z, real(1e-3f))));
  real3 glass = lerp3(make3(real(0.86f), real(0.87f), real(0.86f)), tint * (0.8f / most), real(0.5f));
  mask_t plain = window && !picture;
  color = sel3(plain, room.daylight * glass + tint * real(0.15f), color);
  emission = sel3(plain, room.lamplight * glass * real(lamplight), emission);
  mask_t display = window && picture && (room.front > 0.5f);
  color = sel3(display, room.daylight * real(1.6f), color);
  // By night what is displayed stands in the light of the shop alone.
  real shown = real(evening > 0.0f ? 1.5f * lamplight : 0.5f);
  emission = sel3(display, emission * real(0.25f) + room.daylight * shown, emission);
}

// ---- Lamps

// Axis of a material's beam in the mesh frame.
SHARED real3 beam_axis(real beam) {
  real zero = real(0.0f);
  return make3(zero, sel(beam > 0.0f, real(-1.0f), real(1.0f)), sel(beam > SURFACE_LOW_BEAM, real(kBeamDrop), zero));
}

// ---- Skin

// What weather changes about a surface.
struct Skin {
  real3 color;
  real metallic, roughness, coat, coat_roughness, transmission, kind;
  real3 n, emission;
};

// Panes are never quite flat: each tilts by its own hash and bends a little.
SHARED real3 glass_normal(real hash, real3 n, real3 p) {
  real h2 = hash * 61.7f - rfloor(hash * 61.7f);
  real side = rroot(rmax(n.x * n.x + n.y * n.y, real(1e-8f)));
  real3 across = make3(0.0f - n.y, n.x, real(0.0f)) * (1.0f / side);
  real along = (p.x * across.x + p.y * across.y) * 2.1f + hash * 40.0f;
  real bend = sin_approx(along) * 0.0045f;
  real rise = sin_approx(p.z * 1.9f + h2 * 40.0f) * 0.0045f;
  real3 tilted = n + across * ((hash - 0.5f) * 0.018f + bend) + make3(real(0.0f), real(0.0f), (h2 - 0.5f) * 0.018f + rise);
  return sel3(side > 0.3f, normalize3(tilted), n);
}

// Panes are smooth; behind some hangs something. `window`: those with a room behind them; `hash`, `area`, `p`, `facing`: of the pane.
SHARED void glaze(mask_t window, real hash, real area, real3 p, real3 facing, INOUT(Skin) s) {
  mask_t glass = s.kind == kGlass;
  s.n = sel3(glass, glass_normal(hash, s.n, p), s.n);
  s.roughness = sel(glass, rmin(s.roughness, real(0.08f)), s.roughness);
  // Behind some large panes without a room hang blinds: brighter than the dark.
  real blind = clamp01((0.30f - hash) * 40.0f) * clamp01((area - 0.7f) * 4.0f) * clamp01((0.3f - rabs(facing.z)) * 8.0f);
  real shade = sel(glass && !window, blind * 0.16f * (0.6f + 1.3f * hash), real(0.0f));
  s.color = s.color * (1.0f - shade) + make3(shade, shade * 0.97f, shade * 0.88f);
  // No two blinds or curtains have the same colour.
  mask_t hung = glass && !window && (s.transmission < 0.01f) && (luminance(s.color) > 0.10f);
  real warm = 0.16f * (hash_again(hash, real(61.7f)) - 0.5f);
  real light = 0.58f + 0.74f * hash;
  s.color = sel3(hung, make3(s.color.x * light * (1.0f + warm), s.color.y * light, s.color.z * light * (1.0f - warm)), s.color);
}

// Waves whose strength wanders over 5 to 60 m by a noise: gusts and calm streaks, which also hides that the waves are few.
SHARED PlanePoint gust_at(real3 p) {
  PlanePoint at;
  at.x = p.x * (1.0f / 173.0f);
  at.y = p.y * (1.0f / 131.0f);
  return at;
}
SHARED real3 windy_water(real3 p, real3 gust, real footprint, INOUT(real) lost) {
  real wind = rmax(0.75f + 2.6f * (gust.x - 0.5f), real(0.22f));
  real3 n = water_normal(p.x + 5.0f * (gust.y - 0.5f), p.y + 5.0f * (gust.z - 0.5f), footprint, lost);
  lost = lost * wind * wind;
  return normalize3(make3(n.x * wind, n.y * wind, n.z));
}
// Of waves too small to see, whose slopes vary so much.
SHARED real water_roughness(real lost) { return rmin(rroot(rroot(2.0f * lost + 1e-5f)), real(0.5f)); }

// ---- Weather

// What the weather finds at a point: the kind of ground, what of it lies in wheel tracks, whether blades or crumbs hold the water.
struct Bed {
  mask_t leaf, solid, grass;
  real ground, up, track;
};
SHARED Bed bed_of(IN(Skin) k, real ground, real3 facing, real across) {
  Bed b;
  real zero = real(0.0f);
  b.ground = ground;
  b.leaf = k.kind == kFoliage;
  b.solid = (k.kind != kGlass) && (k.kind != kWater);
  b.grass = (ground == GROUND_LAWN) || (ground == GROUND_SOIL);
  // Blades stand, but they hold what falls on their lawn.
  b.up = sel(b.leaf, rmax(rabs(facing.z), sel(b.grass, real(0.8f), zero)), facing.z);
  real lane = (rabs(rabs(across) - 1.72f) - 0.78f) * (1.0f / 0.32f);
  b.track = sel(ground == GROUND_CARRIAGEWAY, exp_approx(zero - lane * lane), zero);
  return b;
}

// Film of water with puddles. `open`: share of the sky that is open above; `wetness`, `rain`: Environment's.
SHARED void wet_skin(IN(Bed) b, IN(Noises) s, real3 p, real3 facing, real width, real open, ufloat wetness, ufloat rain, INOUT(Skin) k) {
  real zero = real(0.0f);
  real exposed = smooth01(clamp01((open - 0.12f) * 5.0f)) * (0.12f + 0.88f * clamp01(b.up * 2.0f + 0.2f));
  real film = sel(b.solid, clamp01(wetness * exposed * (1.15f + 1.2f * (s.mid.y - 0.5f))), zero);
  real soak = film * porosity(k.roughness, k.metallic);
  k.color = lerp3(k.color, make3(wet_albedo(k.color.x), wet_albedo(k.color.y), wet_albedo(k.color.z)), soak);
  // Puddles on level ground, the first of them in the wheel tracks.
  real level = sel(b.grass || (facing.z < 0.97f) || b.leaf, zero, real(1.0f));
  real relief = 0.55f * s.mid.x + 0.30f * s.fine.y + 0.15f * s.wide.y - 0.035f * b.track;
  real puddle = puddle_cover(relief, wetness * exposed) * level;
  real ring_x = zero;
  real ring_y = zero;
  if (rain > 0.0f && any_lane(puddle > 0.0f)) {
    drop_rings(p.x, p.y, real(rain), ring_x, ring_y);
    real near = clamp01(0.06f / rmax(width, real(1e-3f)));
    ring_x = ring_x * near;
    ring_y = ring_y * near;
  }
  // The film follows the relief less than the stone does; standing water not at all.
  k.n = normalize3(lerp3(k.n, facing, rmax(puddle, sel(b.leaf, zero, film * 0.55f))));
  k.n = normalize3(k.n + make3(ring_x * puddle, ring_y * puddle, zero));
  real sheen = film * sel(b.leaf || b.grass, real(0.35f), real(0.75f)) * (1.0f - 0.5f * k.metallic);
  real water = rmax(sheen, puddle);
  real film_roughness = lerp1(0.34f - 0.14f * film, real(0.03f), puddle);
  k.coat_roughness = sel(water > k.coat, film_roughness, k.coat_roughness);
  k.coat = rmax(k.coat, water);
}

// Snow of `depth` 0 … 1 over it.
SHARED void snowy_skin(IN(Bed) b, IN(Noises) s, real3 facing, real open, ufloat depth, INOUT(Skin) k) {
  real zero = real(0.0f);
  real exposed =
      smooth01(clamp01((open - 0.15f) * 3.4f)) * (1.0f - 0.62f * b.track) * sel(b.ground > 0.5f && !b.grass, real(0.85f), real(1.0f));
  real relief = 0.45f * s.mid.z + 0.55f * s.fine.x;
  real cover = sel(b.solid || ((k.kind == kGlass) && (b.up > 0.25f)), snow_cover(real(depth), b.up, relief, exposed), zero);
  real3 white = make3(real(0.83f), real(0.85f), real(0.88f)) * (0.97f + 0.25f * (s.fine.z - 0.5f));
  // Some slush stays dark at the edge.
  k.color = lerp3(k.color, white, cover);
  k.metallic = k.metallic * (1.0f - cover);
  k.roughness = lerp1(k.roughness, real(0.75f), cover);
  k.coat = k.coat * (1.0f - cover);
  k.transmission = k.transmission * (1.0f - 0.8f * cover);
  k.emission = k.emission * (1.0f - cover);
  real3 soft = normalize3(facing + make3(s.fine.x - 0.5f, s.fine.y - 0.5f, zero) * real(0.30f));
  k.n = sel3(b.leaf, k.n, normalize3(lerp3(k.n, soft, cover)));
  k.kind = sel((cover > 0.5f) && !b.leaf, zero, k.kind);
}

// ---- Towards the light

// A bent normal must not look away from the viewer.
SHARED real3 turn_to_viewer(real3 n, real3 d) {
  real towards = dot3(n, d);
  mask_t away = towards > -0.02f;
  if (!any_lane(away)) return n;
  return sel3(away, normalize3(n - d * (towards + 0.02f)), n);
}

// The reflected direction, above the surface itself.
SHARED real3 reflect_above(real3 d, real3 n, real3 facing) {
  real3 r = reflect3(d, n);
  real below = dot3(r, facing);
  mask_t inside = below < 0.01f;
  if (!any_lane(inside)) return r;
  return sel3(inside, normalize3(r + facing * (0.02f - below)), r);
}

// Whether it reflects sharply enough for a traced ray.
SHARED mask_t mirrors(IN(Skin) s) {
  return (s.kind == kGlass) || (s.kind == kWater) || ((s.roughness < SURFACE_MIRROR_ROUGHNESS) && (s.metallic > 0.3f)) ||
         ((s.coat > 0.25f) && (s.coat_roughness < SURFACE_MIRROR_ROUGHNESS));
}

// Whether the sun, whose ray has the direction `l`, can matter. Leaves from behind, too, but nothing where the two normals
// disagree about the side.
SHARED mask_t takes_sun(real3 n, real3 facing, real kind, real3 l) {
  real above = dot3(n, l);
  return (above * dot3(facing, l) > 0.0f) && ((above > 0.0f) || (kind == kFoliage));
}
SHARED mask_t sun_is_up(ufloat sun_z) { return mask_t(sun_z > -0.02f); }
