// The shading functions of all tiers, once, in a subset that is C++ (scalar and SIMD) and GLSL at the same
// time. Not a normal header: it is included inside a namespace by shading_scalar.h and shading_simd.h, or
// pasted into a shader after shading_glsl.h; no include guard. The one who includes it
// provides
//   real real3 (per lane), ufloat ufloat3 (same for all lanes), mask_t, SHARED, INOUT, sel sel3 make3 rmin
//   rmax rroot rsqrt_exact rfloor rabs pow2_int exponent_of mantissa_of dot3 any_lane.
// Only + - * / sqrt floor and bit moves are used, so every compiler and lane width gives the same bits
// (without contraction). Directions are unit vectors pointing away from the surface; cosines are clamped by
// the caller.

#define SHADE_PI 3.14159265f
#define SHADE_INV_PI 0.318309886f
// Of the ambient light of probes on leaves, which hide each other from the sky: probes metres apart do not know.
// Without it crowns came out 1.3 times as bright as in the path tracer.
#define SHADE_CROWN 0.6f
// Bias of the sun map on leaves, metres: in a crown the map's texels are lines through it as good as any, and
// the share of them that pass a place is the light that gets there; more bias would light the crown's top alone.
#define SHADE_LEAF_BIAS 0.05f
// About the sine of the sun's diameter of 0.53 degrees, less its limb: no highlight is narrower.
#define SHADE_SUN_ALPHA 0.006f

// ---- numbers
// ----------------------------------------------------------------------------------------------------

// 0 where x is not a number (C++).
SHARED real clamp01(real x) { return rmin(real(1.0f), rmax(real(0.0f), x)); }
SHARED real lerp1(real a, real b, real t) { return a + (b - a) * t; }
SHARED real3 lerp3(real3 a, real3 b, real t) { return a + (b - a) * t; }
// Mix of a triangle's corners at the weights u and v of the second and third; exact where all are alike.
SHARED real corner_mix(real a, real b, real c, real u, real v) { return a + ((b - a) * u + (c - a) * v); }
SHARED real3 corner_color(real3 a, real3 b, real3 c, real u, real v) {
  return make3(clamp01(corner_mix(a.x, b.x, c.x, u, v)), clamp01(corner_mix(a.y, b.y, c.y, u, v)),
               clamp01(corner_mix(a.z, b.z, c.z, u, v)));
}
SHARED real smooth01(real t) { return t * t * (3.0f - 2.0f * t); }
SHARED real3 normalize3(real3 a) { return a * rsqrt_exact(rmax(dot3(a, a), real(1e-30f))); }
// How far secondary rays start from a surface: above the rounding errors of hit points.
SHARED real ray_offset(real3 p, real distance_) { return 1e-3f + 4e-6f * (rabs(p.x) + rabs(p.y) + rabs(p.z) + distance_); }
SHARED real luminance(real3 c) { return 0.2126f * c.x + 0.7152f * c.y + 0.0722f * c.z; }

// Polynomials are summed in pairs (Estrin), not from one end: their chains of dependent operations are what
// vectors wait for.

// 2^x for |x| < 126; relative error below 2e-7 (Taylor series of exp on [-0.5, 0.5] ln 2).
SHARED real exp2_approx(real x) {
  real whole = rfloor(x + 0.5f);
  real f = (x - whole) * 0.69314718f;
  real f2 = f * f;
  real p = (1.0f + f) + f2 * (0.5f + f * 0.166666667f) + (f2 * f2) * ((0.0416666667f + f * 0.00833333333f) + f2 * 0.00138888889f);
  return p * pow2_int(whole);
}

SHARED real exp_approx(real x) { return exp2_approx(rmax(x * 1.44269504f, real(-125.0f))); }

// log2 of a normal positive number; absolute error below 4e-7 (atanh series about the mantissa's middle).
SHARED real log2_approx(real x) {
  real e = exponent_of(x);
  real m = mantissa_of(x);
  mask_t high = m > 1.41421356f;
  m = sel(high, m * 0.5f, m);
  e = sel(high, e + 1.0f, e);
  real t = (m - 1.0f) / (m + 1.0f);
  real t2 = t * t;
  real s = t * ((2.0f + t2 * 0.666666667f) + (t2 * t2) * ((0.4f + t2 * 0.285714286f) + (t2 * t2) * 0.222222222f));
  return e + s * 1.44269504f;
}

// x^y for x >= 0.
SHARED real pow_approx(real x, real y) { return exp2_approx(rmax(y * log2_approx(rmax(x, real(1e-30f))), real(-125.0f))); }

// x^y for x >= 0 and |y| below 2, for what is shown with 8 bits: relative error below 1.5e-5 |y| + 3e-6
// (least-error polynomials of log2 over [1, 2] and exp2 over [-0.5, 0.5]; no division).
SHARED real pow_display(real x, real y) {
  real positive = rmax(x, real(1e-30f));
  real f = mantissa_of(positive) - 1.0f;
  real f2 = f * f;
  real stops =
      exponent_of(positive) + (f * 1.44196561f + f2 * (-0.709662799f + f * 0.417595704f) + (f2 * f2) * (-0.196269528f + f * 0.04638531f));
  real e = rmax(y * stops, real(-125.0f));
  real whole = rfloor(e + 0.5f);
  real g = e - whole;
  real g2 = g * g;
  real p = (0.99999926f + g * 0.69312181f) + g2 * (0.24024745f + g * 0.05591786f) + (g2 * g2) * 0.0095701f;
  return p * pow2_int(whole);
}

// sin(x) for |x| up to a few thousand; absolute error below 3e-6 near 0, growing with |x| as float does.
SHARED real sin_approx(real x) {
  real turns = rfloor(x * SHADE_INV_PI + 0.5f);
  real y = (x - turns * 3.140625f) - turns * 9.67653589e-4f;
  real odd = turns - 2.0f * rfloor(turns * 0.5f);
  real y2 = y * y;
  real s = y * (1.0f + y2 * (-0.166666667f + y2 * (0.00833333333f + y2 * (-0.000198412698f + y2 * 2.75573192e-6f))));
  return s * (1.0f - 2.0f * odd);
}
SHARED real cos_approx(real x) { return sin_approx(x + 0.5f * SHADE_PI); }

// Two coordinates on some plane.
struct PlanePoint {
  real x, y;
};
// A place on a disc: `radius` from its middle (the root of an even number, times the disc's), `b` of a turn.
SHARED PlanePoint disc_place(real radius, real b) {
  real angle = b * (2.0f * SHADE_PI);
  PlanePoint at;
  at.x = radius * cos_approx(angle);
  at.y = radius * sin_approx(angle);
  return at;
}

// Angle of (x, y) in (-pi, pi]; absolute error below 2e-6 (Abramowitz & Stegun 4.4.49).
SHARED real atan2_approx(real y, real x) {
  real ax = rabs(x);
  real ay = rabs(y);
  real q = rmin(ax, ay) / rmax(rmax(ax, ay), real(1e-30f));
  real s = q * q;
  real s2 = s * s;
  real low = (s * 0.1999355085f - 0.3333314528f) + s2 * (s * 0.1065626393f - 0.1420889944f);
  real high = (s * 0.0429096138f - 0.0752896400f) + s2 * (s * 0.0028662257f - 0.0161657367f);
  real p = low + (s2 * s2) * high;
  real a = q + q * s * p;
  a = sel(ay > ax, 1.57079633f - a, a);
  a = sel(x < 0.0f, SHADE_PI - a, a);
  return sel(y < 0.0f, 0.0f - a, a);
}

SHARED real asin_approx(real x) { return atan2_approx(x, rroot(rmax(1.0f - x * x, real(0.0f)))); }

// ---- colour
// -----------------------------------------------------------------------------------------------------

// The inverse of the sRGB transfer function (IEC 61966-2-1) with a quartic fit above the toe, within 1.2
// per cent of the curve: for texels, before filtering.
SHARED real srgb_decode_approx(real s) {
  real p = 0.00109740f + s * (0.02750550f + s * (0.56390260f + s * (0.52268787f - s * 0.11601764f)));
  return sel(s < 0.04045f, s * 0.0773993808f, p);
}

// ---- reflectance
// ------------------------------------------------------------------------------------------------

SHARED real pow5(real x) {
  real x2 = x * x;
  return x2 * x2 * x;
}

// Schlick (1994).
SHARED real fresnel_schlick(real f0, real cos_theta) { return f0 + (1.0f - f0) * pow5(1.0f - cos_theta); }
SHARED real3 fresnel_schlick3(real3 f0, real cos_theta) {
  return f0 + (make3(1.0f - f0.x, 1.0f - f0.y, 1.0f - f0.z)) * pow5(1.0f - cos_theta);
}

// Unpolarised reflectance of a smooth dielectric, eta = n_inside / n_outside > 1, light from outside.
SHARED real fresnel_dielectric(real eta, real cos_i) {
  real cos_t = rroot(1.0f - (1.0f - cos_i * cos_i) / (eta * eta));
  real s = (cos_i - eta * cos_t) / (cos_i + eta * cos_t);
  real p = (eta * cos_i - cos_t) / (eta * cos_i + cos_t);
  return 0.5f * (s * s + p * p);
}

// GGX normal distribution (Walter et al. 2007); alpha = roughness^2.
SHARED real ggx_distribution(real alpha, real n_dot_h) {
  real a2 = alpha * alpha;
  real d = n_dot_h * n_dot_h * (a2 - 1.0f) + 1.0f;
  return a2 / rmax(SHADE_PI * d * d, real(1e-20f));
}

// Height-correlated Smith masking-shadowing over 4 n.l n.v (Heitz 2014).
SHARED real smith_visibility(real alpha, real n_dot_l, real n_dot_v) {
  real a2 = alpha * alpha;
  real l = n_dot_v * rroot(a2 + (1.0f - a2) * n_dot_l * n_dot_l);
  real v = n_dot_l * rroot(a2 + (1.0f - a2) * n_dot_v * n_dot_v);
  return 0.5f / rmax(l + v, real(1e-9f));
}

// Microfacet reflectance per channel, without the cosine.
SHARED real3 specular_brdf(real3 f0, real alpha, real n_dot_l, real n_dot_v, real n_dot_h, real v_dot_h) {
  real w = ggx_distribution(alpha, n_dot_h) * smith_visibility(alpha, n_dot_l, n_dot_v);
  return fresnel_schlick3(f0, v_dot_h) * w;
}

// Directional albedo of specular_brdf as f0 * x + y: Karis' analytic fit of the split sum (2014),
// up to 0.08 low for bright metals.
SHARED real3 environment_brdf(real3 f0, real roughness, real n_dot_v) {
  real r_x = 1.0f - roughness;
  real r_y = 0.0425f - 0.0275f * roughness;
  real r_z = 1.04f - 0.572f * roughness;
  real r_w = 0.022f * roughness - 0.04f;
  real a = rmin(r_x * r_x, exp2_approx(-9.28f * n_dot_v)) * r_x + r_y;
  real scale = r_z - 1.04f * a;
  real bias = 1.04f * a + r_w;
  return f0 * scale + make3(bias, bias, bias);
}

// Lambert: reflected radiance of irradiance e.
SHARED real3 diffuse(real3 albedo, real3 e) { return albedo * e * real(SHADE_INV_PI); }

// What passes through a leaf is yellower than what it reflects (chlorophyll absorbs less of the green-yellow on the longer path).
SHARED real3 leaf_color() { return make3(real(1.10f), real(1.15f), real(0.55f)); }

// A leaf lit from either side: n_dot_l signed towards the viewer's side; `transmission` times albedo passes
// through.
SHARED real3 leaf_diffuse(real3 albedo, real transmission, real n_dot_l) {
  real front = rmax(n_dot_l, real(0.0f));
  real back = rmax(0.0f - n_dot_l, real(0.0f)) * transmission;
  real3 leaf = leaf_color();
  return make3(albedo.x * (front + leaf.x * back), albedo.y * (front + leaf.y * back), albedo.z * (front + leaf.z * back)) *
         real(SHADE_INV_PI);
}

// ---- light
// ------------------------------------------------------------------------------------------------------

// Irradiance of the sky from nine coefficients, normal n (Ramamoorthi & Hanrahan 2001; basis constants folded
// in).
SHARED real3 sh9_irradiance(ufloat3 c0, ufloat3 c1, ufloat3 c2, ufloat3 c3, ufloat3 c4, ufloat3 c5, ufloat3 c6, ufloat3 c7, ufloat3 c8,
                            real3 n) {
  real3 e = c1 * n.y + c2 * n.z + c3 * n.x;
  e = e + c4 * (n.x * n.y) + c5 * (n.y * n.z) + c6 * (3.0f * n.z * n.z - 1.0f) + c7 * (n.x * n.z) + c8 * (n.x * n.x - n.y * n.y);
  return e + c0;
}

// Part of the light that is left after `distance` through extinction beta (1 / m).
SHARED real3 transmittance(ufloat3 beta, real distance) {
  return make3(exp_approx(0.0f - beta.x * distance), exp_approx(0.0f - beta.y * distance), exp_approx(0.0f - beta.z * distance));
}

// ---- lamps
// ------------------------------------------------------------------------------------------------------

// Part of a lamp's light that still counts at `distance`: all of it up to 3/4 of its reach.
SHARED real lamp_fade(real distance, real reach) { return smooth01(clamp01(4.0f - 4.0f * distance / reach)); }

// Irradiance on a surface that faces a lamp, per unit of its radiance: projected area over squared distance.
// `towards` is facing . w for the direction w from the lamp.
SHARED real lamp_irradiance(real body, real towards, real soft, real radius, real distance, real reach) {
  real near_side = 0.5f * radius;
  real d2 = rmax(distance * distance, near_side * near_side) + soft;
  return rmax(body + towards, real(0.0f)) * lamp_fade(distance, reach) / rmax(d2, real(1e-8f));
}

SHARED real lamp_distance(real3 to_lamp) { return rroot(rmax(dot3(to_lamp, to_lamp), real(1e-8f))); }

// Whether a skin shows highlights of lamps.
SHARED mask_t lamp_shines(real kind, real roughness, real metallic) {
  return !(kind == kFoliage) && ((roughness < kLampMatt) || (metallic > kShinyMetal));
}

// What the skin of a surface reflects of a lamp, whose size widens the highlight, for it is no point (Karis 2013).
SHARED real3 lamp_skin(real3 color, real metallic) { return lerp3(make3(real(0.04f), real(0.04f), real(0.04f)), color, metallic); }
SHARED real3 lamp_highlight(real3 f0, real own_alpha, real radius, real distance, real n_dot_l, real n_dot_v, real n_dot_h, real w_dot_h) {
  real alpha = rmin(rmax(own_alpha, real(SHADE_SUN_ALPHA)) + 0.5f * radius / distance, real(1.0f));
  return specular_brdf(f0, alpha, rmax(n_dot_l, real(1e-3f)), n_dot_v, n_dot_h, w_dot_h);
}

// Share of a lamp's light that a beam throws into a direction w: `sharp` is |Material::beam|, `along` sharp times
// the cosine between w and the beam's axis, `rise` the z of w. Half the light at the angle of 1 - cos =
// 0.41 / sharp. Low beams are cut off above the horizon over 5 degrees, a sixteenth is scattered beyond (the cut-off of
// UN Regulation 149 without its asymmetry). 1 for sharp = 0.
SHARED real beam_shape(real sharp, real along, real rise) {
  real spread = 1.0f + (sharp - along);
  real cut = sel(sharp > 10.0f, 0.06f + 0.94f * clamp01(0.45f - 10.0f * rise), real(1.0f));
  return cut / (spread * spread);
}

// ---- geometry
// ---------------------------------------------------------------------------------------------------

SHARED real3 reflect3(real3 d, real3 n) { return d - n * (2.0f * dot3(d, n)); }

// A direction that leaves a surface of geometric normal g; one under it, where the shading normal is bent, is mirrored up.
SHARED real3 leave_above(real3 d, real3 g) {
  real below = dot3(d, g);
  return sel3(below < 0.01f, normalize3(d + g * (0.02f - 2.0f * below)), d);
}

// Cosine-distributed direction about the normal n where `sum` is n and an even unit vector.
SHARED real3 cosine_direction(real3 sum, real3 n) {
  real length2 = dot3(sum, sum);
  return sel3(length2 > 1e-6f, sum * (1.0f / rroot(rmax(length2, real(1e-6f)))), n);
}

// How far a point of a pixel lies on the surface's plane, by the pixel's distance: cosines of its middle's ray and of its own.
SHARED real plane_stretch(real slant, real there) {
  return sel(there < 0.3f * slant, rmin(rmax(slant / there, real(0.5f)), real(2.0f)), real(1.0f));
}

// Unit vector of octahedral coordinates in [-1, 1]^2 (Meyer et al. 2010).
SHARED real3 octahedral_decode(real x, real y) {
  real z = 1.0f - rabs(x) - rabs(y);
  real fold = rmax(0.0f - z, real(0.0f));
  real px = x + sel(x < 0.0f, fold, 0.0f - fold);
  real py = y + sel(y < 0.0f, fold, 0.0f - fold);
  return normalize3(make3(px, py, z));
}

// Slope of water at a point (metres): seven directional ripples, fading where they get smaller than a pixel
// of size `footprint`; the slope lost to the fade goes into `lost`, a variance. Waves of Gerstner-like phase,
// no time.
SHARED real3 water_normal(real px, real py, real footprint, INOUT(real) lost) {
  real sx = real(0.0f);
  real sy = real(0.0f);
  real k = real(0.55f);
  real dx = real(1.0f);
  real dy = real(0.25f);
  real variance = real(0.0f);
  for (int i = 0; i < 7; i++) {
    real keep = clamp01(1.6f - footprint * k * 0.9f);
    real s = sin_approx((dx * px + dy * py) * k + 1.7f * float(i)) * 0.017f;
    sx = sx + dx * s * keep;
    sy = sy + dy * s * keep;
    variance = variance + 0.000145f * (1.0f - keep * keep);
    real rx = dx * -0.36f - dy * 0.93f;
    dy = dx * 0.93f + dy * -0.36f;
    dx = rx;
    k = k * 1.83f;
  }
  lost = variance;
  return normalize3(make3(0.0f - sx, 0.0f - sy, real(1.0f)));
}
