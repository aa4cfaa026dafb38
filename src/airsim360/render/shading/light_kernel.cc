// Kernel: from surfaces and their visibility of the sun to radiance; the sky itself; display colours.
#include "airsim360/render/shading/shading_ambient.h"
#include "airsim360/render/shading/shading_kernels.h"

namespace airsim360::internal::AIRSIM360_ISA {
namespace {

constexpr float kFoliage = 1, kGlass = 2, kWater = 3;  // SurfaceKind
constexpr float kBrightest = 400;  // radiance of a sun glint that still averages well over few samples

KERNEL real3 Grey(float v) { return make3(real(v), real(v), real(v)); }

/// What is seen in a skin of this roughness: the traced reflection, else sky and ground dimmed as the probes
/// say.
KERNEL real3 Reflection(const ShadeView& view, const SurfaceSet& s, int i, real3 r, real3 around,
                        real roughness, mask_t traced) {
  const real3 rough = around * real(SHADE_INV_PI);
  const mask_t shiny = ((roughness < 0.5f) || (load(s.metallic + i) > 0.2f)) && !traced;
  real3 light = rough;
  if (view.has_sky > 0.5f && stdx::any_of(shiny)) {
    // Share of the open sky and ground that reaches this place about that direction.
    const real open = luminance(UniformAmbient(view, r, r).front);
    const real share = rmin(luminance(around) / rmax(open, real(1e-4f)), real(1.0f));
    light = sel3(shiny, BlurredSky(view, r, roughness) * share, light);
  }
  return sel3(traced, load3(s.reflected_r + i, s.reflected_g + i, s.reflected_b + i), light);
}

/// Reflectance of the surface's skin towards the viewer.
KERNEL real3 Skin(real3 f0, real roughness, real kind, real n_dot_v) {
  const real3 rough = environment_brdf(f0, roughness, n_dot_v);
  const mask_t glass = kind == kGlass, water = kind == kWater;
  if (!stdx::any_of(glass || water)) return rough;
  // A pane has two faces, and a coating.
  const real one = fresnel_dielectric(real(1.5f), n_dot_v), both = 2.0f * one / (1.0f + one);
  const real pane = both + (1.0f - both) * 0.07f;
  const real wet = fresnel_dielectric(real(1.33f), n_dot_v);
  real3 skin = sel3(glass, make3(pane, pane, pane), rough);
  return sel3(water, make3(wet, wet, wet), skin);
}

KERNEL void LightVector(const ShadeView& view, const RaySet& rays, const SurfaceSet& s, int i,
                        LightSet& out) {
  const real3 d = load3(rays.dx + i, rays.dy + i, rays.dz + i);
  const real3 p = load3(s.px + i, s.py + i, s.pz + i);
  const real3 n = load3(s.nx + i, s.ny + i, s.nz + i), g = load3(s.gx + i, s.gy + i, s.gz + i);
  const real3 r = load3(s.rx + i, s.ry + i, s.rz + i), l = load3(s.lx + i, s.ly + i, s.lz + i);
  const real3 base = load3(s.ar + i, s.ag + i, s.ab + i);
  const real metallic = load(s.metallic + i), roughness = load(s.roughness + i), kind = load(s.kind + i);
  const real transmission = load(s.transmission + i);
  const mask_t leaf = kind == kFoliage;
  const real n_dot_v = rmax(real(0.0f) - dot3(n, d), real(0.02f));

  const real dielectric = sel(leaf, real(0.028f), real(0.04f));
  const real3 f0 = lerp3(make3(dielectric, dielectric, dielectric), base, metallic);
  const real3 skin = Skin(f0, roughness, kind, n_dot_v);
  const real3 inside = base * (1.0f - metallic);
  const real3 through = make3(1.0f - skin.x, 1.0f - skin.y, 1.0f - skin.z);

  // Sky and bounced light.
  const Ambient ambient = SampleProbes(view, p, g, n, r);
  const real3 yellow = make3(real(1.10f), real(1.15f), real(0.55f)) * transmission;
  real3 body =
      diffuse(inside, ambient.front * load(s.contact + i) + sel3(leaf, ambient.back * yellow, Grey(0)));

  // Sun.
  const real3 sun = Uniform(view.sun_irradiance) * load(s.sunlit + i);
  const real n_dot_l = dot3(n, l);
  const real lambert = rmax(n_dot_l, real(0.0f));
  const real3 lit =
      sel3(leaf, leaf_diffuse(inside, transmission, n_dot_l), inside * (lambert * SHADE_INV_PI));
  body = body + sun * lit;
  const real3 h = normalize3(l - d);
  const real alpha = rmax(roughness * roughness, real(0.006f));
  const real3 glint = specular_brdf(f0, alpha, rmax(n_dot_l, real(1e-3f)), n_dot_v,
                                    rmax(dot3(n, h), real(0.0f)), clamp01(dot3(l, h)));
  const real3 shine = sun * glint * lambert;
  const real3 bounded = make3(rmin(shine.x, real(kBrightest)), rmin(shine.y, real(kBrightest)),
                              rmin(shine.z, real(kBrightest)));

  // Under a coat the traced reflection is the coat's.
  const real coat = load(s.clear_coat + i);
  const mask_t traced = load(s.traced + i) > 0.5f, coated = coat > 0.0f;
  const real3 mirrored = Reflection(view, s, i, r, ambient.reflected, roughness, traced && !coated) * skin;
  real3 light = body * through + mirrored + bounded + load3(s.er + i, s.eg + i, s.eb + i);
  if (stdx::any_of(coated)) {
    // Clear lacquer or water: reflects by its own Fresnel term, what is below gets the rest.
    const real coat_roughness = load(s.clear_coat_roughness + i);
    const real3 film = environment_brdf(Grey(0.04f), coat_roughness, n_dot_v) * coat;
    const real coat_alpha = rmax(coat_roughness * coat_roughness, real(0.006f));
    const real3 flash = specular_brdf(Grey(0.04f), coat_alpha, rmax(n_dot_l, real(1e-3f)), n_dot_v,
                                      rmax(dot3(n, h), real(0.0f)), clamp01(dot3(l, h))) *
                        (sun * (lambert * coat));
    const real3 seen = Reflection(view, s, i, r, ambient.reflected, coat_roughness, traced) * film;
    const real3 over = light * (1.0f - film.x) + seen +
                       make3(rmin(flash.x, real(kBrightest)), rmin(flash.y, real(kBrightest)),
                             rmin(flash.z, real(kBrightest)));
    light = sel3(coated, over, light);
  }

  // Air between.
  if (view.has_sky > 0.5f) {
    const real3 kept = transmittance(Uniform(view.extinction), load(rays.distance + i));
    const real3 haze =
        Uniform(view.horizon_x) * d.x + Uniform(view.horizon_y) * d.y + Uniform(view.horizon_mean);
    light = light * kept + haze * make3(1.0f - kept.x, 1.0f - kept.y, 1.0f - kept.z);
  }
  store3(out.r + i, out.g + i, out.b + i, light);
}

/// The sun's disc of 0.53 degrees, darker towards its limb: 1 - 0.6 (1 - mu) (Hestroffer & Magnan 1998,
/// mid-visible).
KERNEL real3 SunDisc(const ShadeView& view, real3 d) {
  const real3 off = d - make3(real(view.to_sun[0]), real(view.to_sun[1]), real(view.to_sun[2]));
  const real x2 = dot3(off, off) * (1.0f / (0.004625f * 0.004625f));
  const real limb = 0.4f + 0.6f * rroot(rmax(1.0f - x2, real(0.0f)));
  return Uniform(view.sun_radiance) * sel(x2 < 1.0f, limb * 1.25f, real(0.0f));
}

}  // namespace

void LightSurfaces(const ShadeView& view, const RaySet& rays, const SurfaceSet& surfaces, LightSet& light) {
  for (int i = 0; i < rays.count; i += kLanes) LightVector(view, rays, surfaces, i, light);
}

void LookUpSky(const ShadeView& view, const RaySet& rays, bool sun_disc, LightSet& light) {
  for (int i = 0; i < rays.count; i += kLanes) {
    const real3 d = load3(rays.dx + i, rays.dy + i, rays.dz + i);
    real3 c = Grey(0);
    if (view.has_sky > 0.5f) {
      c = SampleSky(view.sky, d, false);
      const mask_t down = d.z < 0.0f;
      if (stdx::any_of(down)) {
        // Far ground in haze.
        const real height = rmax(load(rays.oz + i) - view.ground_z, real(2.0f));
        const real3 kept = transmittance(Uniform(view.extinction), height / rmax(0.0f - d.z, real(1e-4f)));
        const real3 ground = Uniform(view.ground) * real(1.0f);
        c = sel3(down, ground * kept + c * make3(1.0f - kept.x, 1.0f - kept.y, 1.0f - kept.z), c);
      }
      if (sun_disc) c = c + SunDisc(view, d);
    }
    store3(light.r + i, light.g + i, light.b + i, c);
  }
}

void ToneMapRow(const float* r, const float* g, const float* b, int count, float exposure, Rgb8* out) {
  alignas(64) int32_t shown[3][kLanes];
  const auto map = [&](real3 light, Rgb8 * to, int n) __attribute__((always_inline)) {
    const real3 c = tone_curve(light * real(exposure));
    to_int(srgb_encode(c.x) * 255.0f + 0.5f).copy_to(shown[0], stdx::vector_aligned);
    to_int(srgb_encode(c.y) * 255.0f + 0.5f).copy_to(shown[1], stdx::vector_aligned);
    to_int(srgb_encode(c.z) * 255.0f + 0.5f).copy_to(shown[2], stdx::vector_aligned);
    for (int k = 0; k < n; ++k) {
      to[k].r = static_cast<uint8_t>(shown[0][k]);
      to[k].g = static_cast<uint8_t>(shown[1][k]);
      to[k].b = static_cast<uint8_t>(shown[2][k]);
    }
  };
  int i = 0;
  for (; i + kLanes <= count; i += kLanes) {
    map({real(r + i, stdx::element_aligned), real(g + i, stdx::element_aligned),
         real(b + i, stdx::element_aligned)},
        out + i, kLanes);
  }
  if (i == count) return;
  // The rest, in a vector filled up with zeros.
  alignas(64) float rest[3][kLanes] = {};
  for (int k = 0; i + k < count; ++k) rest[0][k] = r[i + k], rest[1][k] = g[i + k], rest[2][k] = b[i + k];
  map(load3(rest[0], rest[1], rest[2]), out + i, count - i);
}

}  // namespace airsim360::internal::AIRSIM360_ISA
