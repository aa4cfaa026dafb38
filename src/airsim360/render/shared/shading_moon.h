// The disc of sun and moon and the face of the moon, in the subset of shading_shared.h, after which it is included in the
// same way.

#define SUN_RADIUS 0.004625f  // radians, of either disc

// Reflectance over that of the highlands at (x, y) of the disc, x to the right and y up as seen from northern latitudes:
// the great maria as soft spots (places after any map of the moon).
SHARED real moon_spot(real x, real y, real x0, real y0, real size) {
  real dx = x - x0;
  real dy = y - y0;
  real inside = clamp01(1.4f - (dx * dx + dy * dy) / (size * size));
  return smooth01(inside);
}
SHARED real moon_ground(real x, real y) {
  real dark = rmax(moon_spot(x, y, real(-0.30f), real(0.50f), real(0.34f)),     // Imbrium
                   moon_spot(x, y, real(-0.62f), real(0.16f), real(0.34f)));    // Procellarum
  dark = rmax(dark, moon_spot(x, y, real(0.28f), real(0.42f), real(0.22f)));    // Serenitatis
  dark = rmax(dark, moon_spot(x, y, real(0.48f), real(0.12f), real(0.25f)));    // Tranquillitatis
  dark = rmax(dark, moon_spot(x, y, real(0.78f), real(0.26f), real(0.14f)));    // Crisium
  dark = rmax(dark, moon_spot(x, y, real(-0.22f), real(-0.36f), real(0.24f)));  // Nubium
  dark = rmax(dark, moon_spot(x, y, real(0.56f), real(-0.16f), real(0.18f)));   // Fecunditatis
  return 1.0f - 0.42f * dark;
}

// Brightness of the disc in the direction `to_moon` + `off` times its angular radius, lit along `light` (unit, from the
// moon to the sun): dust that scatters as Lommel and Seeliger found, so that a full moon is as bright at its limb as in
// its middle. 0 beyond the terminator and the limb.
SHARED real moon_face(real3 off, real3 to_moon, real3 light) {
  real beyond = dot3(off, off);
  real mu = rroot(rmax(1.0f - beyond, real(1e-6f)));
  real3 n = off - to_moon * mu;
  real lit = rmax(dot3(n, light), real(0.0f));
  real3 right = normalize3(make3(to_moon.y, 0.0f - to_moon.x, real(1e-6f)));
  real x = dot3(off, right);
  real y = sel(off.z > 0.0f, real(1.0f), real(-1.0f)) * rroot(rmax(beyond - x * x, real(0.0f)));
  return sel(beyond < 1.0f, moon_ground(x, y) * 2.0f * lit / (lit + mu), real(0.0f));
}
