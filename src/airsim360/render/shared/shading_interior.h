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

SHARED real inside01(real x, real low, real high) { return sel(x > low, real(1.0f), real(0.0f)) * sel(x < high, real(1.0f), real(0.0f)); }

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

// A room behind a pane whose middle is (0, 0): its box, and numbers that make it what it is.
struct Room {
  real deep, left, right, low, high;
  real h1, h2, h3, h4;
};

// Rooms are 2.6 m high or a little more than the pane, 3 to 6 m deep.
SHARED Room make_room(real half_a, real half_b, real hash) {
  Room r;
  r.h1 = hash_again(hash, real(61.7f));
  r.h2 = hash_again(hash, real(137.3f));
  r.h3 = hash_again(hash, real(293.9f));
  r.h4 = hash_again(hash, real(521.3f));
  real sill = rmax(1.7f - 1.3f * half_b, real(0.06f));
  r.deep = 3.0f + 3.0f * r.h1;
  r.left = 0.0f - half_a - 0.25f - 1.1f * r.h2;
  r.right = half_a + 0.25f + 1.1f * r.h3;
  r.low = 0.0f - half_b - sill;
  r.high = half_b + 0.22f;
  return r;
}

// What a ray meets in a room.
struct RoomHit {
  real t, y, z;  // along the ray; height; depth behind the pane
  real3 albedo;
  real lamp, near;  // 1 on a lamp; 1 on the nearer furniture
};

// Painted walls, floor of wood or carpet, white ceiling with a row of lamps; `into`: depth per length of the ray.
SHARED RoomHit meet_room(Room r, real a, real b, real da, real db, real into) {
  real ta = (sel(da > 0.0f, r.right, r.left) - a) / sel(rabs(da) > 1e-5f, da, real(1e-5f));
  real tb = (sel(db > 0.0f, r.high, r.low) - b) / sel(rabs(db) > 1e-5f, db, real(1e-5f));
  real tn = r.deep / into;
  RoomHit at;
  at.t = rmax(rmin(rmin(ta, tb), tn), real(0.0f));  // points a hair outside of the pane look at its edge
  mask_t on_side = (ta < tb) && (ta < tn);
  mask_t on_level = (tb <= ta) && (tb < tn);
  real x = a + da * at.t;
  at.y = b + db * at.t;
  at.z = into * at.t;
  real3 paint = lerp3(make3(real(0.62f), real(0.57f), real(0.47f)), make3(real(0.52f), real(0.56f), real(0.58f)), r.h4);
  paint = paint * (0.72f + 0.35f * r.h2);
  real3 wall = paint * sel(at.y < r.low + 0.10f, real(0.55f), real(1.0f));
  // A door or a picture hangs on the back wall.
  real middle = r.left + (r.right - r.left) * (0.25f + 0.5f * r.h3);
  real door = inside01(x, middle - 0.42f, middle + 0.42f) * inside01(at.y, r.low, r.low + 2.05f) * sel(r.h1 > 0.5f, real(1.0f), real(0.0f));
  real picture =
      inside01(x, middle - 0.55f, middle + 0.45f) * inside01(at.y, r.low + 1.15f, r.low + 1.85f) * sel(r.h1 > 0.5f, real(0.0f), real(1.0f));
  real3 back = lerp3(wall, make3(real(0.22f), real(0.13f), real(0.07f)), door);
  back = lerp3(back, furnishing(r.h3, r.h4), picture);
  real3 boards =
      make3(0.25f + 0.1f * r.h2, 0.17f + 0.08f * r.h2, real(0.10f)) * (0.85f + 0.3f * hash_cell(rfloor(x * 7.0f), rfloor(r.h1 * 99.0f)));
  real3 level = sel3(db > 0.0f, make3(real(0.74f), real(0.73f), real(0.70f)), boards);
  at.albedo = sel3(on_level, level, sel3(on_side, wall, back));
  real lamp_x = rabs(x - 0.5f * (r.left + r.right));
  at.lamp = sel(on_level, real(1.0f), real(0.0f)) * sel(db > 0.0f, real(1.0f), real(0.0f)) * sel(lamp_x < 0.16f, real(1.0f), real(0.0f)) *
            inside01(at.z, r.deep * 0.25f, r.deep * 0.75f);
  at.near = real(0.0f);
  return at;
}

// Two rows of furniture: silhouettes on planes inside the room.
SHARED void furnish_room(Room r, real a, real b, real da, real db, real into, INOUT(RoomHit) at) {
  for (int k = 0; k < 2; k++) {
    real z = r.deep * (k == 0 ? 0.72f : 0.34f);
    real s = z / into;
    real fx = a + da * s;
    real fy = b + db * s - r.low;
    real cell = rfloor(fx * 1.25f + r.h2 * 7.0f);
    real within = fx * 1.25f + r.h2 * 7.0f - cell;
    real pick = hash_cell(cell + rfloor(r.h1 * 512.0f), real(3.0f) + float(k) * 7.0f);
    real shade = hash_cell(cell + rfloor(r.h3 * 512.0f), real(11.0f) + float(k) * 5.0f);
    real tall = (k == 0 ? 0.55f : 0.38f) + pick * (k == 0 ? 1.4f : 0.55f);
    real there = inside01(within, 0.10f + 0.1f * shade, 0.92f) * inside01(fy, real(-1.0f), tall) * inside01(fx, r.left, r.right) *
                 sel(pick > 0.35f, real(1.0f), real(0.0f)) * sel(s < at.t, real(1.0f), real(0.0f));
    mask_t met = there > 0.5f;
    at.albedo = sel3(met, furnishing(pick * 2.0f - rfloor(pick * 2.0f), shade), at.albedo);
    at.z = sel(met, z, at.z);
    at.t = sel(met, s, at.t);
    at.lamp = sel(met, real(0.0f), at.lamp);
    at.near = k == 1 ? sel(met, real(1.0f), at.near) : at.near;
  }
}

// Curtains at the sides, or a blind from above, 8 cm behind the glass: their colour, and 1 where they hang.
SHARED real3 hang_cloth(Room r, real a, real b, real half_a, real half_b, real da, real db, real into, INOUT(real) hung) {
  real c = 0.08f / into;
  real cx = (a + da * c) / half_a;
  real cy = (b + db * c) / half_b;
  real drawn = 0.08f + 0.45f * r.h3;
  real folds = 0.82f + 0.18f * sin_approx((a + da * c) * 46.0f + r.h1 * 6.0f);
  real curtain = sel(rabs(cx) > 1.0f - drawn, real(1.0f), real(0.0f)) * sel(r.h2 < 0.45f, real(1.0f), real(0.0f));
  real slat = (b + db * c) * 24.0f;
  real slats = 0.78f + 0.22f * (slat - rfloor(slat));
  real blind = sel(cy > 1.0f - 1.5f * r.h4, real(1.0f), real(0.0f)) * sel(r.h2 > 0.70f, real(1.0f), real(0.0f));
  real3 cloth = lerp3(make3(real(0.55f), real(0.52f), real(0.46f)), furnishing(0.46f + 0.3f * r.h1, r.h3), r.h4) * folds;
  hung = rmax(curtain, blind);
  return lerp3(make3(real(0.58f), real(0.56f), real(0.52f)) * slats, cloth, curtain);
}

// What the ray through (a, b) of a pane of half size (half_a, half_b) meets; (da, db, dn) its direction,
// dn > 0 inwards. `light`: day_light or evening_light, black if the room's lamps are off. Out: `daylight`, the radiance towards the viewer over
// that of a white surface in the pane's place (day factor times albedo), `lamplight`, the radiance of a lit
// room in cd-like units where a surface of albedo 1 under its lamps has 1, and the point of the back wall
// that the ray aims at, for pictures (`back_a`, `back_b`); `front` is 1 where the nearer furniture, a curtain
// or a blind hides it.
SHARED void interior_room(real a, real b, real half_a, real half_b, real da, real db, real dn, real hash, real3 light,
                          INOUT(real3) daylight, INOUT(real3) lamplight, INOUT(real) front, INOUT(real) back_a, INOUT(real) back_b) {
  real into = rmax(dn, real(0.02f));
  Room room = make_room(half_a, half_b, hash);
  RoomHit at = meet_room(room, a, b, da, db, into);
  furnish_room(room, a, b, da, db, into, at);

  // Daylight falls off with the depth; more of it reaches the floor than the ceiling.
  real fall = 0.03f + 0.26f * exp2_approx(0.0f - 0.75f * at.z);
  real share = fall * clamp01(0.35f + 0.5f * rmin(half_a * half_b, real(1.3f)));
  real3 day = at.albedo * share;
  real3 glow = (at.albedo * (0.75f + 0.25f * clamp01(1.2f - at.y * 0.3f)) + make3(at.lamp, at.lamp, at.lamp) * 9.0f) * light;

  real hung = real(0.0f);
  real3 screen = hang_cloth(room, a, b, half_a, half_b, da, db, into, hung);
  daylight = lerp3(day, screen * real(0.42f), hung);
  lamplight = lerp3(glow, screen * light * 0.35f, hung);
  front = rmax(at.near, hung);
  real back = room.deep / into;
  back_a = rmin(rmax(a + da * back * 0.4f, room.left), room.right);
  back_b = rmin(rmax(b + db * back * 0.4f, room.low), room.high);
}
