// Tone curves: from scene radiance times exposure to display-linear colour in [0, 1]. In the subset of
// shading_shared.h and included right after it, in the same way.

// ---- by octaves
// Both curves are cubics in the mantissa, one for every octave of the argument, whose exponent's low bits
// choose the coefficients: least-error fits. They take half of the time of powers and divisions.

// clang-format off
SHADE_TABLE16(SRGB_OCTAVE_0, -0.00078857422f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0058329244f, -0.0069551458f,
  0.0091321862f, 0.030606198f, 0.059270565f, 0.097532904f, 0.148607f, 0.21678274f, 0.30778643f, 0.42926179f)
SHADE_TABLE16(SRGB_OCTAVE_1, 0.00078857422f, 0.00078857422f, 0.0015771484f, 0.0031542969f, 0.0063085937f,
  0.012617187f, 0.011429215f, 0.072532588f, 0.09681939f, 0.12923838f, 0.17251254f, 0.23027661f, 0.3073824f,
  0.41030628f, 0.54769318f, 0.73108268f)
SHADE_TABLE16(SRGB_OCTAVE_2, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.010737572f, -0.018452556f, -0.024631207f,
  -0.032878716f, -0.043887821f, -0.058583213f, -0.078199207f, -0.10438342f, -0.13933515f, -0.18599011f)
SHADE_TABLE16(SRGB_OCTAVE_3, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f, -0.0027461746f, 0.0025532168f,
  0.0034081355f, 0.0045493151f, 0.0060726071f, 0.008105958f, 0.010820156f, 0.014443175f, 0.019279326f,
  0.025734812f)
SHADE_TABLE32(FILM_OCTAVE_0, 0.39278062f, 0.6585415f, 0.83696246f, 0.93349635f, 0.98046196f, 1.0022053f,
  1.0120469f, 1.0164566f, 1.0184235f, 1.019299f, 1.0196884f, 1.0198615f, 1.0199384f, 1.0199726f,
  -9.6798174e-08f, -2.1780793e-07f, -4.9009695e-07f, -1.1027938e-06f, -2.4815082e-06f, -5.5841552e-06f,
  -1.2567394e-05f, -2.8290253e-05f, -6.3718352e-05f, -0.00014369272f, -0.00032499596f, -0.00074028097f,
  -0.0017154827f, -0.0041208195f, -0.010174169f, -0.02070408f, -0.0051340323f, 0.12798521f)
SHADE_TABLE32(FILM_OCTAVE_1, 0.60076553f, 0.38063433f, 0.2011789f, 0.096914529f, 0.044675815f, 0.020183462f,
  0.0090359111f, 0.0040288713f, 0.0017931159f, 0.00079741315f, 0.00035448904f, 0.00015756257f,
  7.0028134e-05f, 3.1122781e-05f, 1.4091675e-06f, 3.1707944e-06f, 7.1346718e-06f, 1.6053914e-05f,
  3.6123529e-05f, 8.1283908e-05f, 0.00018290714f, 0.00041160733f, 0.00092639321f, 0.0020856659f,
  0.0046990966f, 0.010606079f, 0.024043146f, 0.055046584f, 0.12765053f, 0.28727995f, 0.5379359f,
  0.69719006f)
SHADE_TABLE32(FILM_OCTAVE_2, -0.25816729f, -0.1723052f, -0.093200532f, -0.045361893f, -0.021006814f,
  -0.0095096788f, -0.0042612238f, -0.0019007286f, -0.00084610167f, -0.00037629808f, -0.00016728875f,
  -7.4357327e-05f, -3.3048084e-05f, -1.4687689e-05f, 1.9944924e-07f, 4.487769e-07f, 1.0097639e-06f,
  2.2719017e-06f, 5.1111064e-06f, 1.1495836e-05f, 2.5842909e-05f, 5.8027576e-05f, 0.00012994957f,
  0.00028924839f, 0.00063468204f, 0.001344294f, 0.0025830879f, 0.0034850883f, -0.0033678209f, -0.046396566f,
  -0.15799254f, -0.26650223f)
SHADE_TABLE32(FILM_OCTAVE_3, 0.041755466f, 0.028775023f, 0.01578825f, 0.0077333698f, 0.0035914276f,
  0.0016278692f, 0.00072984572f, 0.00032563034f, 0.00014496906f, 6.4477192e-05f, 2.8664893e-05f,
  1.2741237e-05f, 5.662862e-06f, 2.5167727e-06f, -2.0436722e-08f, -4.5985857e-08f, -1.0347782e-07f,
  -2.3285877e-07f, -5.2406862e-07f, -1.1797676e-06f, -2.6574009e-06f, -5.9934715e-06f, -1.355585e-05f,
  -3.0843588e-05f, -7.0993716e-05f, -0.00016633824f, -0.00039294682f, -0.00085269256f, -0.0010207405f,
  0.0033105432f, 0.019987111f, 0.04009119f)
// clang-format on

// sRGB transfer function (IEC 61966-2-1), [0, 1] to [0, 1]; within 7e-5, a fiftieth of a code (below
// 2^-14, where a line goes to 0 at 2^-15, within a tenth of one).
SHARED real srgb_encode(real linear_value) {
  real x = rmin(rmax(real(3.0517578e-5f), linear_value), real(0.99999994f));
  real m = mantissa_of(x);
  return octave16(SRGB_OCTAVE_0, x) + m * (octave16(SRGB_OCTAVE_1, x) + m * (octave16(SRGB_OCTAVE_2, x) + m * octave16(SRGB_OCTAVE_3, x)));
}

// ---- filmic
// ----------------------------------------------------------------------------------------------------

// Film-like response of one channel: a logistic curve in log exposure, 0 at 0, about 0.3 at 0.18 * 3, 1 at
// infinity: 1.02 p / (p + 1) with p = (1.35 x)^1.17, within 2e-4, in the shadows within 5e-5 of the value.
SHARED real film_curve(real light) {
  real x = rmin(rmax(real(7.6293945e-6f), light), real(32767.998f));
  real m = mantissa_of(x);
  return octave32(FILM_OCTAVE_0, x) + m * (octave32(FILM_OCTAVE_1, x) + m * (octave32(FILM_OCTAVE_2, x) + m * octave32(FILM_OCTAVE_3, x)));
}

// Brake lamps, signals and neon by night are hundreds of times as bright as white, and film would make white of them. Pure
// colours, whose second channel is less than a fifth of the first, get no brighter than `white`: from a twelfth on they keep all
// of their hue. What is less pure, and all that is no brighter, stays as it is.
SHARED real3 keep_hue(real3 c) {
  real white = real(3.0f);
  real most = rmax(rmax(c.x, c.y), c.z), second = rmax(rmin(c.x, c.y), rmin(rmax(c.x, c.y), c.z));
  real over = clamp01(1.6667f - 8.3333f * second / rmax(most, white)) * (most * (1.0f / 3.0f) - 1.0f);
  return sel3(over > 0.0f, c * (1.0f / (1.0f + rmax(over, real(0.0f)))), c);
}

// A little of each channel reaches the others, as in film, so that very bright colours turn white instead of
// clipping; saturation is given back after the curve, but not in the shadows, where the eye sees little of it.
SHARED real3 tone_curve(real3 light) {
  real3 c = keep_hue(light);
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
SHARED real agx_log(real x) { return clamp01((log2_approx(rmax(x, real(1.8e-4f))) + 12.47393f) * (1.0f / 16.5f)); }

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
  real3 shown = make3(1.19704227f * r - 0.098017255f * g - 0.0990250133f * b, -0.0529040673f * r + 1.15186052f * g - 0.0989564493f * b,
                      -0.0529788612f * r - 0.0980398231f * g + 1.15101868f * b);
  return make3(pow_approx(clamp01(shown.x), real(2.2f)), pow_approx(clamp01(shown.y), real(2.2f)),
               pow_approx(clamp01(shown.z), real(2.2f)));
}

// ---- linear
// ----------------------------------------------------------------------------------------------------

SHARED real3 linear_curve(real3 c) { return make3(clamp01(c.x), clamp01(c.y), clamp01(c.z)); }
