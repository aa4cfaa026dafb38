// Rooms behind panes (interior mapping, van Dongen 2008) in the subset of shading_shared.h, after which it is
// included in the same way: no include guard, no types of its own.
//
// Pane frame, metres: a to the right seen from outside, b up, both from the pane's centre; depth into the
// room. A room is a box around the pane with a little wall on every side, furnished on two planes parallel
// to the pane and hung with curtains or a blind just behind it. Everything follows from one hash per pane, so
// that both triangles of a pane and both sides of its diagonal show the same room.

// Fraction of a number's decimal places: an independent uniform number from a hash in [0, 1).
SHARED real hash_again(real h, real k) {
  real x = h * k + k * 0.137f;
  return x - rfloor(x);
}

// Uniform in [0, 1) from two whole numbers of either sign below about 1e5.
SHARED real hash_cell(real x, real y) {
  real px = x * 0.1031f;
  real py = y * 0.1030f;
  px = px - rfloor(px);
  py = py - rfloor(py);
  real d = (px + py) * 33.33f + px * py * 19.19f;
  px = px + d;
  py = py + d * 1.17f;
  real h = (px + py) * (px * 7.31f + py * 3.77f + 0.71f);
  return h - rfloor(h);
}

SHARED real inside01(real x, real low, real high) {
  return sel(x > low, real(1.0f), real(0.0f)) * sel(x < high, real(1.0f), real(0.0f));
}

// Colour of furnishings: wood, cloth, paper, paint by two hashes.
SHARED real3 furnishing(real h1, real h2) {
  real3 wood = make3(real(0.26f), real(0.16f), real(0.09f));
  real3 cloth = make3(0.12f + 0.30f * h2, 0.13f + 0.14f * h1, 0.34f - 0.22f * h2);
  real3 pale = make3(real(0.55f), real(0.52f), real(0.46f));
  real3 c = lerp3(wood, cloth, sel(h1 > 0.45f, real(1.0f), real(0.0f)));
  return lerp3(c, pale, sel(h1 > 0.80f, real(1.0f), real(0.0f))) * (0.7f + 0.5f * h2);
}

// White of luminance 1 at 1e6 / `mired` kelvin, 110 to 500 (9000 to 2000 K), in linear sRGB: lines through Planck's
// locus, within 6 per cent of the temperature.
SHARED real3 lamp_white(real mired) {
  real r = 1.0f + 0.0045f * (mired - 154.0f);
  real b = rmax(0.985f - 0.0040f * (mired - 154.0f), real(0.01f));
  return make3(r, (1.0f - 0.2126f * r - 0.0722f * b) * (1.0f / 0.7152f), b);
}

// Light in a room whose lamps are on, by day: warm to neutral white.
SHARED real3 day_light(real hash) {
  real h4 = hash_again(hash, real(521.3f));
  real warm = 0.45f + 0.55f * h4;
  return lerp3(make3(real(1.0f), real(0.66f), real(0.36f)), make3(real(1.0f), real(0.92f), real(0.82f)), h4 * warm);
}

// Light in a lit room in the evening, luminance 1 for 500 lx: homes of 20 to 200 lx at 2600 to 4000 K, offices (the
// likelier the larger the pane, `area` in m^2) of 225 to 500 lx at 3700 to 5000 K (EN 12464-1 asks for 300 to 500), and
// rooms in the bluish light of a screen alone, 10 to 25 lx.
SHARED real3 evening_light(real hash, real area) {
  real kind = hash_again(hash, real(947.9f));
  real u = hash_again(hash, real(389.3f));
  real v = hash_again(hash, real(173.1f));
  real offices = rmin(rmax(0.10f + 0.22f * (area - 1.2f), real(0.10f)), real(0.75f));
  mask_t office = kind < offices;
  mask_t screen = kind > 0.94f;
  real v2 = v * v;
  real mired = sel(office, 200.0f + 70.0f * v, sel(screen, 118.0f + 25.0f * v, 385.0f - 45.0f * v - 90.0f * (v2 * v2)));
  real light = sel(office, 0.45f + 0.55f * u, sel(screen, 0.02f + 0.03f * u, exp2_approx(-1.3f - 3.3f * u)));
  return lamp_white(mired) * light;
}

// What a lit window whose room is not seen (a curtain hangs before it) sends, over the mean of all such windows:
// behind some nobody is at home.
SHARED real3 window_light(real hash, real area) {
  real lit = sel(hash_again(hash, real(811.3f)) < 0.55f, real(1.0f), real(0.0f));
  return evening_light(hash, area) * (lit * (1.0f / (0.55f * 0.25f)));
}

// What the ray through (a, b) of a pane of half size (half_a, half_b) meets; (da, db, dn) its direction,
// dn > 0 inwards. `light`: day_light or evening_light, black if the room's lamps are off. Out: `daylight`, the radiance towards the viewer over
// that of a white surface in the pane's place (day factor times albedo), `lamplight`, the radiance of a lit
// room in cd-like units where a surface of albedo 1 under its lamps has 1, and the point of the back wall
// that the ray aims at, for pictures (`back_a`, `back_b`); `front` is 1 where the nearer furniture, a curtain
// or a blind hides it.
SHARED void interior_room(real a, real b, real half_a, real half_b, real da, real db, real dn, real hash,
                          real3 light, INOUT(real3) daylight, INOUT(real3) lamplight, INOUT(real) front,
                          INOUT(real) back_a, INOUT(real) back_b) {
  real h1 = hash_again(hash, real(61.7f));
  real h2 = hash_again(hash, real(137.3f));
  real h3 = hash_again(hash, real(293.9f));
  real h4 = hash_again(hash, real(521.3f));
  real into = rmax(dn, real(0.02f));

  // The box: rooms are 2.6 m high or a little more than the pane, 3 to 6 m deep.
  real deep = 3.0f + 3.0f * h1;
  real left = 0.0f - half_a - 0.25f - 1.1f * h2;
  real right = half_a + 0.25f + 1.1f * h3;
  real sill = rmax(1.7f - 1.3f * half_b, real(0.06f));
  real low = 0.0f - half_b - sill;
  real high = half_b + 0.22f;
  real ta = (sel(da > 0.0f, right, left) - a) / sel(rabs(da) > 1e-5f, da, real(1e-5f));
  real tb = (sel(db > 0.0f, high, low) - b) / sel(rabs(db) > 1e-5f, db, real(1e-5f));
  real tn = deep / into;
  real t = rmax(rmin(rmin(ta, tb), tn), real(0.0f));  // points a hair outside of the pane look at its edge
  mask_t on_side = (ta < tb) && (ta < tn);
  mask_t on_level = (tb <= ta) && (tb < tn);
  real x = a + da * t;
  real y = b + db * t;
  real z = into * t;

  // Painted walls, floor of wood or carpet, white ceiling with a row of lamps.
  real3 paint =
      lerp3(make3(real(0.62f), real(0.57f), real(0.47f)), make3(real(0.52f), real(0.56f), real(0.58f)), h4);
  paint = paint * (0.72f + 0.35f * h2);
  real3 wall = paint * sel(y < low + 0.10f, real(0.55f), real(1.0f));
  // A door or a picture hangs on the back wall.
  real middle = left + (right - left) * (0.25f + 0.5f * h3);
  real door = inside01(x, middle - 0.42f, middle + 0.42f) * inside01(y, low, low + 2.05f) *
              sel(h1 > 0.5f, real(1.0f), real(0.0f));
  real picture = inside01(x, middle - 0.55f, middle + 0.45f) * inside01(y, low + 1.15f, low + 1.85f) *
                 sel(h1 > 0.5f, real(0.0f), real(1.0f));
  real3 back = lerp3(wall, make3(real(0.22f), real(0.13f), real(0.07f)), door);
  back = lerp3(back, furnishing(h3, h4), picture);
  real3 boards = make3(0.25f + 0.1f * h2, 0.17f + 0.08f * h2, real(0.10f)) *
                 (0.85f + 0.3f * hash_cell(rfloor(x * 7.0f), rfloor(h1 * 99.0f)));
  real3 level = sel3(db > 0.0f, make3(real(0.74f), real(0.73f), real(0.70f)), boards);
  real3 albedo = sel3(on_level, level, sel3(on_side, wall, back));
  real lamp_x = rabs(x - 0.5f * (left + right));
  real lamp = sel(on_level, real(1.0f), real(0.0f)) * sel(db > 0.0f, real(1.0f), real(0.0f)) *
              sel(lamp_x < 0.16f, real(1.0f), real(0.0f)) * inside01(z, deep * 0.25f, deep * 0.75f);

  // Two rows of furniture: silhouettes on planes inside the room.
  real near = real(0.0f);
  for (int k = 0; k < 2; k++) {
    real at = deep * (k == 0 ? 0.72f : 0.34f);
    real s = at / into;
    real fx = a + da * s;
    real fy = b + db * s - low;
    real cell = rfloor(fx * 1.25f + h2 * 7.0f);
    real within = fx * 1.25f + h2 * 7.0f - cell;
    real pick = hash_cell(cell + rfloor(h1 * 512.0f), real(3.0f) + float(k) * 7.0f);
    real shade = hash_cell(cell + rfloor(h3 * 512.0f), real(11.0f) + float(k) * 5.0f);
    real tall = (k == 0 ? 0.55f : 0.38f) + pick * (k == 0 ? 1.4f : 0.55f);
    real there = inside01(within, 0.10f + 0.1f * shade, 0.92f) * inside01(fy, real(-1.0f), tall) *
                 inside01(fx, left, right) * sel(pick > 0.35f, real(1.0f), real(0.0f)) *
                 sel(s < t, real(1.0f), real(0.0f));
    mask_t met = there > 0.5f;
    albedo = sel3(met, furnishing(pick * 2.0f - rfloor(pick * 2.0f), shade), albedo);
    z = sel(met, at, z);
    t = sel(met, s, t);
    lamp = sel(met, real(0.0f), lamp);
    near = k == 1 ? sel(met, real(1.0f), near) : near;
  }

  // Daylight falls off with the depth; more of it reaches the floor than the ceiling.
  real fall = 0.03f + 0.26f * exp2_approx(0.0f - 0.75f * z);
  real share = fall * clamp01(0.35f + 0.5f * rmin(half_a * half_b, real(1.3f)));
  real3 day = albedo * share;
  real3 glow = (albedo * (0.75f + 0.25f * clamp01(1.2f - y * 0.3f)) + make3(lamp, lamp, lamp) * 9.0f) * light;

  // Curtains at the sides, or a blind from above, 8 cm behind the glass.
  real c = 0.08f / into;
  real cx = (a + da * c) / half_a;
  real cy = (b + db * c) / half_b;
  real drawn = 0.08f + 0.45f * h3;
  real folds = 0.82f + 0.18f * sin_approx((a + da * c) * 46.0f + h1 * 6.0f);
  real curtain =
      sel(rabs(cx) > 1.0f - drawn, real(1.0f), real(0.0f)) * sel(h2 < 0.45f, real(1.0f), real(0.0f));
  real slat = (b + db * c) * 24.0f;
  real slats = 0.78f + 0.22f * (slat - rfloor(slat));
  real blind = sel(cy > 1.0f - 1.5f * h4, real(1.0f), real(0.0f)) * sel(h2 > 0.70f, real(1.0f), real(0.0f));
  real3 cloth =
      lerp3(make3(real(0.55f), real(0.52f), real(0.46f)), furnishing(0.46f + 0.3f * h1, h3), h4) * folds;
  real3 screen = lerp3(make3(real(0.58f), real(0.56f), real(0.52f)) * slats, cloth, curtain);
  real hung = rmax(curtain, blind);
  daylight = lerp3(day, screen * real(0.42f), hung);
  lamplight = lerp3(glow, screen * light * 0.35f, hung);
  front = rmax(near, hung);
  back_a = rmin(rmax(a + da * tn * 0.4f, left), right);
  back_b = rmin(rmax(b + db * tn * 0.4f, low), high);
}
