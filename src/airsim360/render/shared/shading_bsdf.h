// What surfaces do to light, for all tiers: one BSDF for every SurfaceKind. In the subset of
// shading_shared.h and included after it in the same way; any_lane(mask) says whether a mask holds anywhere.
//
// Layers from outside to inside:
//   coat  a clear film of n = 1.5 (Schlick), GGX, share `coat`;
//   skin  GGX with height-correlated Smith masking and the Fresnel of the kind (Schlick of f0; water exact
//         for n = 1.33; a pane two faces of n = 1.5 and a coating of 7 %), and the light that a rough metal
//         would lose without scattering from facet to facet (Kulla & Conty 2017);
//   body  Lambert under both. What of it a leaf lets through leaves on the other side; what a pane lets
//         through goes straight on.
// A body gets what the skin leaves on the way in and gives what it leaves on the way out:
//   body (1 - E(v)) (1 - E(l)) / ((1 - mean E) pi)      (Kelemen & Szirmay-Kalos 2001)
// with E the directional albedo of the skin. So everything is reciprocal, and under even light a surface
// shows E + body (1 - E), which is what tiers with ambient light compute. Under a coat the skin loses light
// both ways.
//
// Directions are unit vectors away from the surface; n is the shading normal on the viewer's side.

#define BSDF_LEAST_ROUGHNESS 0.03f
#define BSDF_COAT_F0 0.04f

// Everything that does not depend on directions. alpha, coat_alpha: of the lobes; fit_*: directional albedo
// of GGX.
struct Bsdf {
  real kind;
  real3 f0;
  real3 body, through, straight;
  real alpha, coat, coat_alpha;
  real3 body_scale;  // 1 / (1 - mean E)
  real3 multiple;    // of the light scattered between facets
  real lost;         // mean of 1 - E of a white skin
  real fit_alpha, coat_blur;
  real e0, e1, e2, e3, e4;            // of mu / (mu + alpha)
  real k00, k01, k02, k10, k11, k20;  // of sqrt(mu^2 + alpha^2) and mu
};

// The surface seen from, or lit from, one cosine.
struct BsdfSide {
  real white;    // directional albedo of the skin if its Fresnel were 1
  real3 single;  // directional albedo of the skin, scattering once
  real3 skin;    // and between facets
  real coat;     // of the coat
};

// Probabilities of the lobes, sum 1.
struct BsdfLobes {
  real coat, skin, body, through, straight;
};

SHARED real bsdf_pane(real cos_i) {
  real one = fresnel_dielectric(real(1.5f), cos_i);
  real both = 2.0f * one / (1.0f + one);
  return both + (1.0f - both) * 0.07f;
}

SHARED real3 bsdf_fresnel(Bsdf b, real cos_i) {
  real3 f = fresnel_schlick3(b.f0, cos_i);
  mask_t dielectric = (b.kind == kGlass) || (b.kind == kWater);
  if (any_lane(dielectric)) {
    real s = sel(b.kind == kGlass, bsdf_pane(cos_i), fresnel_dielectric(real(1.33f), cos_i));
    f = sel3(dielectric, make3(s, s, s), f);
  }
  return f;
}

// Fits to numerical integration over roughness 0.03 ... 1 and mu 0.02 ... 1: the directional albedo of GGX
// without Fresnel (within 0.007, rms 0.0016), and the cosine whose Fresnel is the lobe's mean (Schlick's
// fifth power times the albedo within 0.012, rms 0.0023).
SHARED Bsdf bsdf_fit(Bsdf b, real r) {
  b.fit_alpha = r * r;
  b.e0 = 0.60863316f + r * (1.6753603f + r * (-2.5555156f + r * (1.5865004f + r * -0.34242176f)));
  b.e1 = 2.9266576f + r * (-9.3568579f + r * (6.6014322f + r * (1.6755584f + r * -4.6960715f)));
  b.e2 = -7.9474615f + r * (2.3569421f + r * (60.737196f + r * (-101.22153f + r * 52.622006f)));
  b.e3 = 8.6148752f + r * (20.117658f + r * (-137.42343f + r * (180.66032f + r * -81.964198f)));
  b.e4 = -3.2085931f + r * (-14.547473f + r * (69.701002f + r * (-73.701447f + r * 27.635937f)));
  b.k00 = -0.0030851831f + r * (0.014339855f + r * (1.103342f + r * -2.1714225f));
  b.k01 = -2.1204149f + r * (9.4264499f + r * -9.2537457f);
  b.k02 = -4.0520481f + r * 1.0919378f;
  b.k10 = 3.1074718f + r * (-9.9023118f + r * 7.3785923f);
  b.k11 = -5.4009081f + r * 11.650237f;
  b.k20 = 9.6183908f + r * -12.218894f;
  return b;
}

SHARED BsdfSide bsdf_side(Bsdf b, real mu) {
  BsdfSide s;
  real q = mu / (mu + b.fit_alpha);
  s.white = clamp01(b.e0 + q * (b.e1 + q * (b.e2 + q * (b.e3 + q * b.e4))));
  real g = rroot(mu * mu + b.fit_alpha * b.fit_alpha);
  real c = b.k00 + mu * (b.k01 + mu * (b.k02 + mu * 0.30577131f)) +
           g * (b.k10 + mu * (b.k11 + mu * -0.098317633f) + g * (b.k20 + mu * -3.9144001f + g * 3.5359498f));
  s.single = bsdf_fresnel(b, clamp01(c)) * s.white;
  s.skin = s.single + b.multiple * ((1.0f - s.white) * b.lost);
  s.coat = real(0.0f);
  if (any_lane(b.coat > 0.0f)) s.coat = b.coat * fresnel_schlick(real(BSDF_COAT_F0), rmin(rroot(mu * mu + b.coat_blur), real(1.0f)));
  return s;
}

// What lies under the layers: the part of a BSDF that the base colour decides where nothing is metallic.
SHARED Bsdf bsdf_bodies(Bsdf b, real3 base, real metallic, real transmission) {
  real zero = real(0.0f);
  mask_t leaf = b.kind == kFoliage;
  mask_t glass = b.kind == kGlass;
  real3 inside = base * (1.0f - metallic);
  real t = sel(leaf, transmission, zero);
  real3 color = leaf_color();
  b.through = make3(rmin(inside.x * color.x * t, 1.0f - inside.x), rmin(inside.y * color.y * t, 1.0f - inside.y),
                    rmin(inside.z * color.z * t, 1.0f - inside.z));
  real clear = sel(glass, transmission, zero);
  b.straight = inside * clear;
  b.body = inside * (1.0f - clear);
  return b;
}

// The BSDF of a surface; all colours linear in [0, 1]. Where foliage would give back more than it gets, less
// goes through. `transmission`: foliage, share of the base colour that passes; glass, share of the body that
// is clear.
SHARED Bsdf bsdf_make(real kind, real3 base, real metallic, real roughness, real transmission, real coat, real coat_roughness) {
  Bsdf b;
  real zero = real(0.0f);
  mask_t leaf = kind == kFoliage;
  mask_t glass = kind == kGlass;
  b.kind = kind;
  real r = rmin(rmax(roughness, real(BSDF_LEAST_ROUGHNESS)), real(1.0f));
  b.alpha = r * r;
  b = bsdf_fit(b, r);
  // A film of n = 1.5 leaves a dielectric of the same index no skin of its own.
  real plain = sel(leaf, real(0.028f), real(0.04f)) * (1.0f - coat);
  b.f0 = lerp3(make3(plain, plain, plain), base, metallic);
  b.coat = coat;
  real cr = rmin(rmax(coat_roughness, real(BSDF_LEAST_ROUGHNESS)), real(0.3f));
  b.coat_alpha = cr * cr;
  b.coat_blur = 2.56f * b.coat_alpha * b.coat_alpha;

  // Means over the hemisphere, cosine-weighted: of the white skin, of its fifth power, of the whole skin.
  real white = 0.99967243f + r * (-0.013493368f + r * (0.33342894f + r * (-2.2056302f + r * 1.2973213f)));
  real fifth = 0.046146435f + r * (0.051770683f + r * (-0.45110063f + r * (0.59867614f + r * -0.24314086f)));
  b.lost = rmax(1.0f - white, zero);
  real mirror = white - fifth;
  real3 skin = b.f0 * mirror + make3(fifth, fifth, fifth);
  // Between facets: the mean Fresnel at every further meeting. Smooth surfaces lose so little that the fits'
  // errors would be all of it.
  real3 mean = b.f0 * 0.952381f + make3(real(0.047619f), real(0.047619f), real(0.047619f));
  real spread = (1.0f / rmax(b.lost, real(0.02f)));
  mask_t plain_kind = (kind != kGlass) && (kind != kWater);
  b.multiple = sel3(plain_kind,
                    make3(mean.x * mean.x * white / (1.0f - mean.x * b.lost), mean.y * mean.y * white / (1.0f - mean.y * b.lost),
                          mean.z * mean.z * white / (1.0f - mean.z * b.lost)) *
                        spread,
                    make3(zero, zero, zero));
  skin = skin + b.multiple * (b.lost * b.lost);
  // Mean reflectances of the pane and of water (n = 1.33) by integration.
  real wet = 0.0201f * mirror + fifth;
  skin = sel3(plain_kind, skin, sel3(glass, make3(real(0.214563f), real(0.214563f), real(0.214563f)), make3(wet, wet, wet)));
  // Under a coat 1 - E is smaller where the skin's is: 0.0119 is the covariance of two smooth films.
  real film = 1.0f - coat * 0.0857f;
  real both = coat * 0.0119f;
  b.body_scale = make3(1.0f / ((1.0f - skin.x) * film + both * (1.0f - b.f0.x) + 1e-6f),
                       1.0f / ((1.0f - skin.y) * film + both * (1.0f - b.f0.y) + 1e-6f),
                       1.0f / ((1.0f - skin.z) * film + both * (1.0f - b.f0.z) + 1e-6f));

  return bsdf_bodies(b, base, metallic, transmission);
}

// Lobes no narrower than this alpha, for a source of light taken as a point that is none.
SHARED Bsdf bsdf_widen(Bsdf b, real least_alpha) {
  b.alpha = rmax(b.alpha, least_alpha);
  b.coat_alpha = rmax(b.coat_alpha, least_alpha);
  return b;
}

// Share of uniform light that the layers over the body turn back towards the viewer, and what is left for the
// body.
SHARED real3 bsdf_reflected(BsdfSide seen) {
  real film = 1.0f - seen.coat;
  return seen.skin * (film * film) + make3(seen.coat, seen.coat, seen.coat);
}
SHARED real3 bsdf_entering(BsdfSide seen) { return make3(1.0f - seen.skin.x, 1.0f - seen.skin.y, 1.0f - seen.skin.z) * (1.0f - seen.coat); }

SHARED BsdfLobes bsdf_lobes(Bsdf b, BsdfSide seen) {
  BsdfLobes p;
  real film = 1.0f - seen.coat;
  real3 in = bsdf_entering(seen);
  p.coat = seen.coat;
  p.skin = luminance(seen.single) * film * film;
  p.body = luminance(b.body * in) + luminance(b.multiple) * (1.0f - seen.white) * b.lost * film;
  p.through = luminance(b.through * in);
  p.straight = luminance(b.straight * in);
  real scale = 1.0f / rmax(p.coat + p.skin + p.body + p.through + p.straight, real(1e-6f));
  p.coat = p.coat * scale;
  p.skin = p.skin * scale;
  p.body = p.body * scale;
  p.through = p.through * scale;
  p.straight = p.straight * scale;
  return p;
}

// Colour of what goes straight on.
SHARED real3 bsdf_straight(Bsdf b, BsdfSide seen) { return b.straight * bsdf_entering(seen); }

// GGX over pi d^2 with the sine of the half vector's angle given squared: exact for the narrowest lobes.
SHARED real bsdf_ggx(real alpha, real n_dot_h, real sin2) {
  real a2 = alpha * alpha;
  real d = n_dot_h * n_dot_h * a2 + sin2;
  return a2 * SHADE_INV_PI / rmax(d * d, real(1e-26f));
}
// Density of a direction mirrored at a visible facet (Heitz 2018), over D.
SHARED real bsdf_facet_density(real alpha, real n_dot_v) {
  real a2 = alpha * alpha;
  return 0.5f / (n_dot_v + rroot(a2 + (1.0f - a2) * n_dot_v * n_dot_v));
}

// BSDF times |n . l|, and the density, per solid angle, with which bsdf_sample finds l (light straight on
// left out).
SHARED real3 bsdf_evaluate(Bsdf b, BsdfSide seen, BsdfLobes p, real3 n, real3 v, real3 l, INOUT(real) pdf) {
  real signed_l = dot3(n, l);
  mask_t above = signed_l > 0.0f;
  real zero = real(0.0f);
  real nl = rabs(signed_l);
  real nv = rmax(dot3(n, v), real(1e-3f));
  BsdfSide lit = bsdf_side(b, nl);

  // Body and what is scattered between facets; or through a leaf.
  real film = (1.0f - seen.coat) * (1.0f - lit.coat);
  real3 in = make3((1.0f - seen.skin.x) * (1.0f - lit.skin.x), (1.0f - seen.skin.y) * (1.0f - lit.skin.y),
                   (1.0f - seen.skin.z) * (1.0f - lit.skin.z)) *
             b.body_scale;
  real3 even = b.body * in + b.multiple * ((1.0f - seen.white) * (1.0f - lit.white));
  real3 f = sel3(above, even, b.through * in) * (film * SHADE_INV_PI);
  pdf = sel(above, p.body, p.through) * nl * SHADE_INV_PI;

  // Facets of skin and coat that mirror v into l.
  real3 h = normalize3(v + l);
  real nh = dot3(n, h);
  real3 across = make3(n.y * h.z - n.z * h.y, n.z * h.x - n.x * h.z, n.x * h.y - n.y * h.x);
  real sin2 = dot3(across, across);
  real vh = clamp01(dot3(v, h));
  real d = sel(above, bsdf_ggx(b.alpha, nh, sin2), zero);
  f = f + bsdf_fresnel(b, vh) * (film * d * smith_visibility(b.alpha, nl, nv));
  pdf = pdf + p.skin * d * bsdf_facet_density(b.alpha, nv);
  if (any_lane(b.coat > 0.0f)) {
    real dc = sel(above, bsdf_ggx(b.coat_alpha, nh, sin2), zero);
    real c = b.coat * fresnel_schlick(real(BSDF_COAT_F0), vh) * dc * smith_visibility(b.coat_alpha, nl, nv);
    f = f + make3(c, c, c);
    pdf = pdf + p.coat * dc * bsdf_facet_density(b.coat_alpha, nv);
  }
  return f * nl;
}

// Facet normal seen from v, in the frame of n (spherical caps: Dupuy & Benyoub 2023).
SHARED real3 bsdf_facet(real alpha, real3 v, real u, real w) {
  real3 s = normalize3(make3(v.x * alpha, v.y * alpha, v.z));
  real z = (1.0f - w) * (1.0f + s.z) - s.z;
  PlanePoint rim = disc_place(rroot(clamp01(1.0f - z * z)), u);
  real3 h = make3(rim.x + s.x, rim.y + s.y, z + s.z);
  return normalize3(make3(h.x * alpha, h.y * alpha, h.z));
}

// A direction by density bsdf_evaluate, from three numbers in [0, 1). `event`: 0 = absorbed, 1 = scattered, 2
// = straight on through a pane (l = -v), to be weighted by bsdf_straight / p.straight.
SHARED real3 bsdf_sample(Bsdf b, BsdfLobes p, real3 n, real3 v, real choice, real u, real w, INOUT(real) event) {
  // Frame of n (Duff et al. 2017).
  real side = sel(n.z < 0.0f, real(-1.0f), real(1.0f));
  real a = -1.0f / (side + n.z);
  real xy = n.x * n.y * a;
  real3 t = make3(1.0f + side * n.x * n.x * a, side * xy, 0.0f - side * n.x);
  real3 s = make3(xy, side + n.y * n.y * a, 0.0f - n.y);

  mask_t coat = choice < p.coat;
  mask_t facet = choice < p.coat + p.skin;
  mask_t up = choice < p.coat + p.skin + p.body;
  mask_t diffused = choice < p.coat + p.skin + p.body + p.through;

  // Mirrored at a facet.
  real3 local = make3(dot3(t, v), dot3(s, v), rmax(dot3(n, v), real(1e-3f)));
  real3 h = bsdf_facet(sel(coat, b.coat_alpha, b.alpha), local, u, w);
  real3 mirrored = h * (2.0f * dot3(local, h)) - local;
  // Cosine over the hemisphere, or below.
  PlanePoint foot = disc_place(rroot(u), w);
  real height = rroot(rmax(1.0f - u, real(1e-9f)));
  real3 even = make3(foot.x, foot.y, sel(up, height, 0.0f - height));

  real3 l = sel3(facet, mirrored, even);
  real3 out_l = normalize3(t * l.x + s * l.y + n * l.z);
  mask_t below = facet && (l.z <= 1e-6f);
  event = sel(below, real(0.0f), real(1.0f));
  event = sel(diffused, event, sel(p.straight > 0.0f, real(2.0f), real(0.0f)));
  return sel3(event > 1.5f, make3(0.0f - v.x, 0.0f - v.y, 0.0f - v.z), out_l);
}
