// What tells one square metre of ground or wall from the next: stains, cracks, repairs, wheel tracks, mowing, dry
// and damp places, in the subset of shading_shared.h, after which it is included in the same way. `wide`, `mid`
// and `fine` are three independent noises each (mean 0.5, sd about 0.13) with features of about 5 to 40,
// 0.8 to 6 and 0.2 to 1.4 m; `detail` is 1 close by and 0 where a pixel is wider than the fine noise.

// Line of half width `half_width` around the zero of `distance`, softened by a pixel of size `width`; thinner
// than a pixel it fades instead of aliasing.
SHARED real soft_line(real distance, real half_width, real width) {
  real w = half_width + 0.5f * width;
  return clamp01((w - rabs(distance)) / rmax(width, real(1e-4f))) * clamp01(half_width * 2.0f / rmax(width, real(1e-4f)) + 0.15f);
}

// Repairs of roads: at most one rectangle per cell of 9 m. Out: `fresh` 1 on the patch, `seal` 1 on its
// tarred edge, `tone` hash of the patch.
SHARED void road_patch(real px, real py, real wobble, real width, INOUT(real) fresh, INOUT(real) seal, INOUT(real) tone) {
  real cx = rfloor(px * (1.0f / 9.0f));
  real cy = rfloor(py * (1.0f / 9.0f));
  real h = hash_cell(cx, cy);
  real h1 = hash_again(h, real(41.3f));
  real h2 = hash_again(h, real(87.1f));
  real h3 = hash_again(h, real(171.7f));
  real half_x = 0.35f + 1.5f * h1 * h1;
  real half_y = 0.5f + 2.6f * h2 * h2;
  real ox = px - (cx + 0.3f + 0.4f * h3) * 9.0f;
  real oy = py - (cy + 0.3f + 0.4f * h1) * 9.0f;
  real d = rmax(rabs(ox) - half_x, rabs(oy) - half_y) + 0.03f * wobble;
  real some = sel(h < 0.30f, real(1.0f), real(0.0f));
  fresh = clamp01(0.5f - d / rmax(width, real(0.01f))) * some;
  seal = soft_line(d, real(0.028f), width) * some;
  tone = h2;
}

// Asphalt. `across` is the distance from the middle of the street where the texture runs along it
// (`street` = 1), else it counts for nothing. Colours are multiplied by `gain`, then mixed with tar by `tar`;
// `polish` is taken from the roughness.
SHARED void asphalt_wear(real px, real py, real across, real street, real3 wide, real3 mid, real3 fine, real detail, real width,
                         INOUT(real) gain, INOUT(real) tar, INOUT(real) polish) {
  real f = (fine.x - 0.5f) * detail;
  real m = mid.x - 0.5f;
  real g = 1.0f + 0.35f * f + 0.28f * m;
  // Oil and tyre dust in thresholded blots.
  real blot = smooth01(clamp01((mid.y + 0.4f * (fine.y - 0.5f) * detail - 0.66f) * 9.0f));
  g = g * (1.0f - 0.24f * blot);
  // Cracks: level lines of a warped noise, in worn parts only; some are sealed with tar.
  real worn = smooth01(clamp01((wide.z - 0.50f) * 6.0f));
  real crack = soft_line((mid.z - 0.5f + 0.16f * (fine.z - 0.5f)) * 2.4f, real(0.006f), width) * worn;
  real sealed = sel(wide.y > 0.56f, real(1.0f), real(0.0f));
  g = g * (1.0f - 0.62f * crack * (1.0f - sealed));
  real snake = soft_line((mid.y - 0.46f + 0.10f * (fine.x - 0.5f)) * 2.4f, real(0.024f), width) * sealed * worn;
  // Repairs, sealed round their edge.
  real fresh = real(0.0f);
  real seal = real(0.0f);
  real tone = real(0.0f);
  road_patch(px, py, fine.z - 0.5f, width, fresh, seal, tone);
  g = g * (1.0f - fresh * sel(tone > 0.3f, 0.16f + 0.22f * tone, real(-0.14f)));
  // Lanes of 3.3 m: two bands polished by wheels, oil between them.
  real lane = rabs(rabs(across) - 1.72f);
  real band = (lane - 0.78f) * (1.0f / 0.27f);
  real track = exp_approx(0.0f - band * band) * street * clamp01(0.75f + 1.2f * m);
  real drip = exp_approx(0.0f - lane * lane * 16.0f) * street * clamp01(0.6f + 1.6f * (mid.z - 0.5f) + 0.6f * f);
  real joint = soft_line(rabs(across), real(0.012f), width) * street * 0.5f;
  g = g * (1.0f - 0.17f * track - 0.15f * drip) * (1.0f - 0.5f * joint);
  gain = g;
  tar = rmax(rmax(snake, seal * 0.9f), crack * sealed);
  polish = 0.10f * track + 0.05f * drip + 0.12f * blot;
}

// Flags and setts: walked lines, damp and dirty places, a few wet stains.
SHARED real paving_wear(real3 wide, real3 mid, real3 fine, real detail) {
  real f = (fine.x - 0.5f) * detail;
  real stain = smooth01(clamp01((mid.y + 0.5f * (fine.y - 0.5f) * detail - 0.64f) * 8.0f));
  real spill = smooth01(clamp01((mid.z + 0.25f * (fine.z - 0.5f) * detail - 0.72f) * 14.0f));
  real worn = clamp01((wide.z - 0.5f) * 4.0f + 0.5f);
  return (1.0f + 0.14f * f + 0.18f * (mid.x - 0.5f)) * (1.0f - 0.13f * stain - 0.16f * spill) * (0.95f + 0.09f * worn);
}

// Lawn: mowing lanes of 1.6 m, clover, dry patches, bare earth. `color` is what the texture shows.
SHARED real3 lawn_life(real3 color, real px, real py, real3 wide, real3 mid, real3 fine, real detail, real width) {
  real f = (fine.x - 0.5f) * detail;
  real lane = (px * 0.82f + py * 0.57f + 0.5f * (mid.x - 0.5f)) * 0.625f;
  real phase = lane - 2.0f * rfloor(lane * 0.5f);
  real mown = clamp01((rabs(phase - 1.0f) - 0.5f) * 6.0f + 0.5f) * 2.0f - 1.0f;
  real stripes = 0.045f * mown * clamp01(1.6f / rmax(width, real(0.01f)) - 1.0f);
  real3 c = color * (1.0f + stripes + 0.55f * f + 0.30f * (mid.x - 0.5f));
  real dry = smooth01(clamp01((wide.y + 0.55f * (mid.y - 0.5f) + 0.5f * f - 0.58f) * 6.0f));
  real clover = smooth01(clamp01((mid.z + 0.7f * (fine.z - 0.5f) * detail - 0.58f) * 9.0f));
  real bare = smooth01(clamp01((mid.y + 0.5f * (fine.y - 0.5f) * detail - 0.76f) * 14.0f));
  c = c * make3(1.0f + 0.50f * dry, 1.0f + 0.16f * dry, 1.0f + 0.30f * dry);
  c = c * make3(1.0f - 0.24f * clover, 1.0f - 0.10f * clover, 1.0f - 0.05f * clover);
  return lerp3(c, make3(real(0.155f), real(0.115f), real(0.075f)) * (1.0f + 0.5f * f), 0.7f * bare);
}

// Gravel paths and soil: fines washed together, weeds, damp hollows with an edge.
SHARED real3 loose_ground(real3 color, real3 wide, real3 mid, real3 fine, real detail, real damp_share) {
  real f = (fine.x - 0.5f) * detail;
  real3 c = color * (1.0f + 0.40f * f + 0.25f * (mid.x - 0.5f));
  real wet = mid.y + 0.35f * (fine.y - 0.5f) * detail + 0.5f * (wide.y - 0.5f);
  real damp = smooth01(clamp01((wet - 0.60f) * 10.0f)) * damp_share;
  c = c * (1.0f - 0.32f * damp);
  real weed = smooth01(clamp01((mid.z + 0.9f * (fine.z - 0.5f) * detail - 0.70f) * 9.0f));
  return lerp3(c, make3(real(0.095f), real(0.118f), real(0.045f)) * (1.0f + 0.8f * f), 0.6f * weed);
}

// Flat roofs: rings of dried puddles, ponding dirt, the seams of 1 m rolls where `seams` is 1.
SHARED real roof_wear(real px, real3 wide, real3 mid, real3 fine, real detail, real width, real seams) {
  real f = (fine.x - 0.5f) * detail;
  real level = mid.y + 0.6f * (wide.y - 0.5f) + 0.12f * (fine.y - 0.5f) * detail;
  real pond = smooth01(clamp01((level - 0.58f) * 9.0f));
  real ring = clamp01(1.0f - rabs(level - 0.585f) * 40.0f);
  real roll = px + 0.05f * (mid.z - 0.5f);
  real line = soft_line(roll - rfloor(roll) - 0.5f, real(0.03f), width) * seams;
  return (1.0f + 0.3f * f + 0.2f * (mid.x - 0.5f)) * (1.0f - 0.26f * pond + 0.14f * ring) * (1.0f - 0.22f * line);
}

// Share of a surface's macro variation that is a wall's: upright, and no ground.
SHARED real wall_share(real macro, real ground, real up) {
  return sel(ground > 0.5f, real(0.0f), clamp01(macro * 17.0f) * clamp01(3.0f - 6.0f * rabs(up)));
}

// Walls: soot in patches, dark streaks that rain drew down where the wall is dirty, lime where it is not. `fine` was
// looked up along the wall and slowly down it, so that it is drawn out in height.
SHARED real3 wall_wear(real3 wide, real3 mid, real3 fine, real width, real share) {
  real near = clamp01(0.30f / rmax(width, real(1e-3f)));
  real soot = smooth01(clamp01((mid.y + 0.8f * (wide.z - 0.5f) - 0.42f) * 4.0f));
  real streak = smooth01(clamp01((fine.x - 0.47f) * 4.5f)) * near * (0.35f + 0.65f * soot);
  real lime = smooth01(clamp01((fine.y - 0.60f) * 6.0f)) * near * (1.0f - soot);
  real light = (1.0f + 0.30f * (mid.z - 0.5f)) * (1.0f + 0.10f * lime) * (1.0f - 0.16f * soot) * (1.0f - 0.30f * streak);
  real brown = 0.05f * soot + 0.06f * streak;
  real one = real(1.0f);
  return lerp3(make3(one, one, one), make3(light * (1.0f + 0.3f * brown), light, light * (1.0f - brown)), share);
}
