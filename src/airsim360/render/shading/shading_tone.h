// Tone curves: from scene radiance times exposure to display-linear colour in [0, 1]. In the subset of
// shading_shared.h and included right after it, in the same way.

// ---- filmic
// ----------------------------------------------------------------------------------------------------

// Film-like response of one channel: a logistic curve in log exposure, 0 at 0, about 0.3 at 0.18 * 3, 1 at
// infinity.
SHARED real film_curve(real x) {
  real p = pow_display(x * 1.35f, real(1.17f));
  return p / (p + 1.0f) * 1.02f;
}

// A little of each channel reaches the others, as in film, so that very bright colours turn white instead of
// clipping; saturation is given back after the curve, but not in the shadows, where the eye sees little of it.
SHARED real3 tone_curve(real3 c) {
  real mean = (c.x + c.y + c.z) * 0.333333333f;
  real3 mixed = lerp3(c, make3(mean, mean, mean), real(0.05f));
  real3 shown = make3(film_curve(mixed.x), film_curve(mixed.y), film_curve(mixed.z));
  real grey = luminance(shown);
  real saturation = 0.90f + 0.34f * clamp01(grey * 5.0f);
  real3 vivid = lerp3(make3(grey, grey, grey), shown, saturation);
  return make3(clamp01(vivid.x), clamp01(vivid.y), clamp01(vivid.z));
}

// ---- AgX
// -------------------------------------------------------------------------------------------------------

// Share of the dynamic range below a radiance: -12.47 ... +4.03 EV about 1, that is ten stops below middle
// grey (0.18) and six and a half above (Sobotka).
SHARED real agx_log(real x) {
  return clamp01((log2_approx(rmax(x, real(1.8e-4f))) + 12.47393f) * (1.0f / 16.5f));
}

// Contrast of one channel, [0, 1] to [0, 1], both power-2.2 encoded at the output: from middle grey, which is
// kept (0.606 to 0.18^(1 / 2.2)), along a slope of 2.4 into two arms y = s u / (1 + u^3)^(1/3) that end in
// (0, 0) and (1, 1).
SHARED real agx_contrast(real x) {
  real d = (x - 0.60606f) * 2.4f;
  mask_t up = d > 0.0f;
  real scale = sel(up, real(0.58019f), real(0.46355f));
  real u = rabs(d) / scale;
  real y = scale * u * pow_approx(1.0f + u * u * u, real(-0.333333333f));
  return clamp01(0.45866f + sel(up, y, 0.0f - y));
}

// AgX: primaries drawn together before the curve and apart after it, so that bright colours fade to white
// along paths that the eye expects (base matrix by T. Sobotka, rows scaled to sum to 1 so that grey stays
// grey; the second is its inverse).
SHARED real3 agx_curve(real3 c) {
  real r = agx_contrast(agx_log(0.842364158f * c.x + 0.0784229025f * c.y + 0.0792129399f * c.z));
  real g = agx_contrast(agx_log(0.0423298082f * c.x + 0.878501136f * c.y + 0.0791690562f * c.z));
  real b = agx_contrast(agx_log(0.0423776793f * c.x + 0.0784373471f * c.y + 0.879184974f * c.z));
  real3 shown = make3(1.19704227f * r - 0.098017255f * g - 0.0990250133f * b,
                      -0.0529040673f * r + 1.15186052f * g - 0.0989564493f * b,
                      -0.0529788612f * r - 0.0980398231f * g + 1.15101868f * b);
  return make3(pow_approx(clamp01(shown.x), real(2.2f)), pow_approx(clamp01(shown.y), real(2.2f)),
               pow_approx(clamp01(shown.z), real(2.2f)));
}

// ---- linear
// ----------------------------------------------------------------------------------------------------

SHARED real3 linear_curve(real3 c) { return make3(clamp01(c.x), clamp01(c.y), clamp01(c.z)); }
