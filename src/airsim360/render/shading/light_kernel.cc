// Kernel: from surfaces and their visibility of the sun to radiance; the sky itself; display colours.
#include "airsim360/render/indoor/indoor_kernels.h"
#include "airsim360/render/shared/precipitation_simd.h"
#include "airsim360/render/shared/shading_ambient.h"
#include "airsim360/render/shared/shading_kernels.h"

namespace airsim360::internal::AIRSIM360_ISA {
namespace {

constexpr int kAgx = 1, kLinear = 2;  // ToneCurve

KERNEL real3 Grey(float v) { return make3(real(v), real(v), real(v)); }

/// What is seen in the surface: the traced reflection, else sky and ground dimmed as the probes say.
KERNEL real3 Reflection(const ShadeView& view, const SurfaceSet& s, int i, real3 r, real3 around) {
  const real roughness = load(s.roughness + i);
  const real3 rough = around * real(SHADE_INV_PI);
  const mask_t traced = load(s.traced + i) > 0.5f;
  const mask_t shiny = ((roughness < 0.5f) || (load(s.metallic + i) > kShinyMetal)) && !traced;
  real3 light = rough;
  if (view.has_sky > 0.5f && stdx::any_of(shiny)) {
    // Share of the open sky and ground that reaches this place about that direction.
    const real open = luminance(UniformAmbient(view, r, r).front);
    const real share = open_share(luminance(around), open);
    light = sel3(shiny, BlurredSky(view, r, roughness) * share, light);
  }
  return sel3(traced, load3(s.reflected_r + i, s.reflected_g + i, s.reflected_b + i), light);
}

/// What a surface does with light, before it is known how much ambient light there is.
struct Response {
  real3 skin;      ///< reflectance of skin and coat
  real3 coat;      ///< of the coat alone
  real3 body;      ///< share of ambient light that the body gives back …
  real3 leaf;      ///< … and of light on the back of a leaf
  real3 straight;  ///< share of what lies behind a clear pane
  real3 sun;       ///< radiance by the sun if it is seen
};

/// The BSDF of the last vector and what its layers were made of: neighbours are often of one plain material.
struct LastBsdf {
  real made_of[5];
  Bsdf bsdf;
  bool any = false;
};

KERNEL void MakeBsdf(const SurfaceSet& s, int i, LastBsdf& last) {
  const real kind = load(s.kind + i);
  // A pane behind which nothing was traced shows its body alone.
  const real transmission = sel((kind == kFoliage) || (load(s.clear + i) > 0.5f), load(s.transmission + i), real(0.0f));
  const real made_of[5] = {kind, load(s.metallic + i), load(s.roughness + i), load(s.coat + i), load(s.coat_roughness + i)};
  const real3 base = load3(s.ar + i, s.ag + i, s.ab + i);
  if (last.any) {
    // Without metal the layers know nothing of the base colour.
    mask_t same = made_of[0] == last.made_of[0] && made_of[1] == 0.0f;
    for (int k = 1; k < 5; ++k) same = same && made_of[k] == last.made_of[k];
    if (stdx::all_of(same)) {
      last.bsdf = bsdf_bodies(last.bsdf, base, made_of[1], transmission);
      return;
    }
  }
  for (int k = 0; k < 5; ++k) last.made_of[k] = made_of[k];
  last.bsdf = bsdf_make(kind, base, made_of[1], made_of[2], transmission, made_of[3], made_of[4]);
  last.any = true;
}

/// `sun` false: nobody asks what the sun does.
KERNEL Response RespondTo(const ShadeView& view, const SurfaceSet& s, int i, real3 d, bool sun, LastBsdf& last) {
  const real3 n = load3(s.nx + i, s.ny + i, s.nz + i), l = load3(s.lx + i, s.ly + i, s.lz + i);
  MakeBsdf(s, i, last);
  const Bsdf& bsdf = last.bsdf;
  const BsdfSide seen = bsdf_side(bsdf, rmax(real(0.0f) - dot3(n, d), real(kViewCosine)));
  const real3 through = bsdf_entering(seen);

  Response out;
  out.skin = bsdf_reflected(seen);
  out.coat = make3(seen.coat, seen.coat, seen.coat);
  out.body = bsdf.body * through;
  out.leaf = bsdf.through * through;
  out.straight = bsdf_straight(bsdf, seen);

  out.sun = Grey(0);
  if (!sun) return out;
  // The sun as a point, so lobes narrower than its disc take the disc's width.
  real pdf = real(0.0f);
  const real3 shine = bsdf_evaluate(bsdf_widen(bsdf, real(SHADE_SUN_ALPHA)), seen, bsdf_lobes(bsdf, seen), n, -d, l, pdf) *
                      Uniform(view.sun_irradiance) * CloudShadow(view.cloud_shadow, load3(s.px + i, s.py + i, s.pz + i));
  out.sun = make3(rmin(shine.x, real(kBrightestGlint)), rmin(shine.y, real(kBrightestGlint)), rmin(shine.z, real(kBrightestGlint)));
  return out;
}

/// What is seen behind a clear pane.
KERNEL real3 Behind(const SurfaceSet& s, int i, real3 straight) {
  const mask_t clear = load(s.clear + i) > 0.5f;
  if (!stdx::any_of(clear)) return Grey(0);
  return sel3(clear, load3(s.behind_r + i, s.behind_g + i, s.behind_b + i) * straight, Grey(0));
}

/// Emission, and the light of lamps.
KERNEL real3 OwnAndLamps(const ShadeView& view, const SurfaceSet& s, int i, const Response& surface) {
  real3 light = load3(s.er + i, s.eg + i, s.eb + i);
  if (view.lamps.lamps == nullptr && view.moving_lamps.lamps == nullptr) return light;
  const real3 front = load3(s.lamp_r + i, s.lamp_g + i, s.lamp_b + i);
  const real3 back = load3(s.lamp_back_r + i, s.lamp_back_g + i, s.lamp_back_b + i);
  // Skins without highlights spread the light of lamps as bodies do.
  const mask_t shiny = lamp_shines(load(s.kind + i), load(s.roughness + i), load(s.metallic + i)) || (load(s.traced + i) > 0.5f);
  const real3 body = surface.body + sel3(shiny, Grey(0), surface.skin);
  light = light + (body * front + surface.leaf * back) * real(SHADE_INV_PI);
  return light + load3(s.lamp_shine_r + i, s.lamp_shine_g + i, s.lamp_shine_b + i);
}

/// Metres of the way that are free of fog.
KERNEL real FreeOfFog(const ShadeView& view, const RaySet& rays, int i, real3 d, real distance) {
  if (!(view.air.weather > 0.0f) || view.roofs.heights == nullptr) return real(0.0f);
  return roofed_way(view.roofs, load3(rays.ox + i, rays.oy + i, rays.oz + i), d, distance);
}

/// Share of light left after the way, and what the air adds.
KERNEL void Air(const ShadeView& view, const RaySet& rays, int i, real3 d, real3& kept, real3& added) {
  const real distance = load(rays.distance + i);
  const AirEffect air = air_to_surface(view.air, load(rays.oz + i), d, distance, FreeOfFog(view, rays, i, d, distance));
  kept = air.kept;
  added = air.added;
}

KERNEL void LightVector(const ShadeView& view, const RaySet& rays, const SurfaceSet& s, int i, LastBsdf& last, LightSet& out,
                        const IndoorLight* indoor = nullptr) {
  const real3 d = load3(rays.dx + i, rays.dy + i, rays.dz + i);
  const real3 p = load3(s.px + i, s.py + i, s.pz + i);
  const real3 n = load3(s.nx + i, s.ny + i, s.nz + i), g = load3(s.gx + i, s.gy + i, s.gz + i);
  const real3 r = load3(s.rx + i, s.ry + i, s.rz + i);
  const real sunlit = load(s.sunlit + i);
  const Response surface = RespondTo(view, s, i, d, stdx::any_of(sunlit > 0.0f), last);

  Ambient ambient = SampleProbes(view, p, g, n, r);
  real contact = load(s.contact + i), share = real(0.0f);
  if (indoor != nullptr) {
    // Rooms mirror the light that their surfaces get.
    const real3 kept = load3(indoor->r + i, indoor->g + i, indoor->b + i);
    share = load(indoor->share + i);
    ambient.front = lerp3(ambient.front, kept, share);
    ambient.reflected = lerp3(ambient.reflected, kept, share);
    contact = contact + (1.0f - contact) * share;
  }
  const real crown = sel(load(s.kind + i) == kFoliage, real(SHADE_CROWN), real(1.0f));
  const real3 body = (surface.body * ambient.front * contact + surface.leaf * ambient.back) * (crown * SHADE_INV_PI);
  real3 seen = Reflection(view, s, i, r, ambient.reflected);
  if (indoor != nullptr) {
    const mask_t inside = (share > 0.5f) && !(load(s.traced + i) > 0.5f);
    seen = sel3(inside, ambient.reflected * real(SHADE_INV_PI), seen);
  }
  const real3 mirrored = seen * surface.skin;
  real3 light = body + Behind(s, i, surface.straight) + surface.sun * sunlit + mirrored + OwnAndLamps(view, s, i, surface);
  if (view.has_sky > 0.5f) {
    real3 kept, added;
    Air(view, rays, i, d, kept, added);
    light = light * kept + added;
  }
  store3(out.r + i, out.g + i, out.b + i, light);
}

KERNEL void TermsVector(const ShadeView& view, const RaySet& rays, const SurfaceSet& s, int i, LastBsdf& last, LightTerms& out) {
  const real3 d = load3(rays.dx + i, rays.dy + i, rays.dz + i);
  const Response surface = RespondTo(view, s, i, d, view.has_sky > 0.5f, last);
  // The traced ray is what the coat mirrors where there is one, else what the skin does. What no ray was sent
  // for mirrors the same light that the body gets.
  const mask_t traced = load(s.traced + i) > 0.5f, coated = load(s.coat + i) > kThinCoat;
  const real3 sharp = sel3(traced, sel3(coated, surface.coat, surface.skin), Grey(0));
  const real3 reflected = sel3(traced, load3(s.reflected_r + i, s.reflected_g + i, s.reflected_b + i) * sharp, Grey(0));
  real3 ambient = (surface.body + surface.skin - sharp) * real(SHADE_INV_PI);
  real3 sun = surface.sun;
  real3 rest = reflected + Behind(s, i, surface.straight) + OwnAndLamps(view, s, i, surface);
  if (view.has_sky > 0.5f) {
    real3 kept, added;
    Air(view, rays, i, d, kept, added);
    ambient = ambient * kept;
    sun = sun * kept;
    rest = rest * kept + added;
  }
  store3(out.ambient_r + i, out.ambient_g + i, out.ambient_b + i, ambient);
  store3(out.sun_r + i, out.sun_g + i, out.sun_b + i, sun);
  store3(out.rest_r + i, out.rest_g + i, out.rest_b + i, rest);
}

/// The sun's disc; by night the moon's, as wide, with its face and phase.
KERNEL real3 SunDisc(const ShadeView& view, real3 d) {
  const real3 off = d - make3(real(view.to_sun[0]), real(view.to_sun[1]), real(view.to_sun[2]));
  const real x2 = dot3(off, off) * (1.0f / (SUN_RADIUS * SUN_RADIUS));
  if (view.moon_gain > 0) {
    if (!stdx::any_of(x2 < 1.0f)) return Grey(0);
    const real3 light = make3(real(view.moon_light[0]), real(view.moon_light[1]), real(view.moon_light[2]));
    const real3 centre = make3(real(view.to_sun[0]), real(view.to_sun[1]), real(view.to_sun[2]));
    return Uniform(view.sun_radiance) * (moon_face(off * real(1.0f / SUN_RADIUS), centre, light) * (view.moon_gain * view.sun_seen));
  }
  return Uniform(view.sun_radiance) * sel(x2 < 1.0f, sun_limb(x2) * (SUN_LIMB_GAIN * view.sun_seen), real(0.0f));
}

/// The low three bytes of every lane, one after another.
KERNEL void StorePacked(ureal lanes, uint8_t* to) {
  alignas(64) uint32_t words[kLanes];
  lanes.copy_to(words, stdx::vector_aligned);
  const __m128i order = _mm_setr_epi8(0, 1, 2, 4, 5, 6, 8, 9, 10, 12, 13, 14, -1, -1, -1, -1);
  for (int q = 0; q < kLanes / 4; ++q) {
    const __m128i four = _mm_shuffle_epi8(_mm_load_si128(reinterpret_cast<const __m128i*>(words + 4 * q)), order);
    // Four bytes too many, where the next four pixels come.
    if (q + 1 < kLanes / 4) {
      _mm_storeu_si128(reinterpret_cast<__m128i*>(to + 12 * q), four);
    } else {
      _mm_storel_epi64(reinterpret_cast<__m128i*>(to + 12 * q), four);
      const int rest = _mm_extract_epi32(four, 2);
      __builtin_memcpy(to + 12 * q + 8, &rest, 4);
    }
  }
}

}  // namespace

void LightSurfaces(const ShadeView& view, const RaySet& rays, const SurfaceSet& surfaces, LightSet& light) {
  LastBsdf last;
  for (int i = 0; i < rays.count; i += kLanes) LightVector(view, rays, surfaces, i, last, light);
}

void LightSurfacesIndoors(const ShadeView& view, const RaySet& rays, const SurfaceSet& surfaces, const IndoorLight& indoor,
                          LightSet& light) {
  LastBsdf last;
  for (int i = 0; i < rays.count; i += kLanes) LightVector(view, rays, surfaces, i, last, light, &indoor);
}

void SplitLight(const ShadeView& view, const RaySet& rays, const SurfaceSet& surfaces, LightTerms& terms) {
  LastBsdf last;
  for (int i = 0; i < rays.count; i += kLanes) TermsVector(view, rays, surfaces, i, last, terms);
}

void LookUpSky(const ShadeView& view, const RaySet& rays, bool sun_disc, LightSet& light) {
  // First where to look, so that the texels are on their way.
  SkyPlace places[kBatch / kLanes];
  for (int i = 0; i < rays.count && view.has_sky > 0.5f; i += kLanes) {
    SkyPlace& place = places[i / kLanes];
    place = FindSky(view.sky, load3(rays.dx + i, rays.dy + i, rays.dz + i), false);
    KeepInMemory(place.index);
    for (int k = 0; k < kLanes; k += 2) {
      __builtin_prefetch(view.sky.texels + place.index[k]);
      __builtin_prefetch(view.sky.texels + place.index[k] + view.sky.stride * 4);
    }
  }
  for (int i = 0; i < rays.count; i += kLanes) {
    const real3 d = load3(rays.dx + i, rays.dy + i, rays.dz + i);
    real3 c = Grey(0);
    if (view.has_sky > 0.5f) {
      const real z = load(rays.oz + i);
      const mask_t down = d.z < 0.0f;
      const real3 up = make3(d.x, d.y, rabs(d.z));
      c = TakeSky(view.sky, places[i / kLanes]);
      if (stdx::any_of(down)) {
        // Far ground in haze, or the lower half of a picture.
        const real distance = ground_distance(z - view.ground_z, d.z);
        real3 below = Grey(0);
        if (view.sky_below.texels) {
          below = SampleSky(view.sky_below, up, false);
        } else {
          const AirEffect air = air_to_surface(view.air, z, d, distance, FreeOfFog(view, rays, i, d, distance));
          below = Uniform(view.ground) * air.kept + air.added;
        }
        c = sel3(down, below, c);
      }
      if (view.air.weather > 0.0f) {
        const AirEffect air = air_to_sky(view.air, z, up, real(kFarAir), FreeOfFog(view, rays, i, d, real(kFarAir)));
        c = sel3(down, c, c * air.kept + air.added);
      }
      // The sun's radiance is what the weather leaves of it.
      if (sun_disc) c = c + SunDisc(view, d);
    }
    store3(light.r + i, light.g + i, light.b + i, c);
  }
}

void ToneMapRow(const float* r, const float* g, const float* b, int count, float exposure, int curve, Rgb8* out) {
  const auto map = [&](real3 light) __attribute__((always_inline)) {
    const real3 exposed = light * real(exposure);
    const real3 c = curve == kAgx ? agx_curve(exposed) : curve == kLinear ? linear_curve(exposed) : tone_curve(exposed);
    const auto code = [](real x) __attribute__((always_inline)) {
      return stdx::static_simd_cast<ureal>(to_int(srgb_encode(x) * 255.0f + 0.5f));
    };
    return code(c.x) | code(c.y) << 8 | code(c.z) << 16;
  };
  int i = 0;
  for (; i + kLanes <= count; i += kLanes) {
    StorePacked(map({real(r + i, stdx::element_aligned), real(g + i, stdx::element_aligned), real(b + i, stdx::element_aligned)}),
                reinterpret_cast<uint8_t*>(out + i));
  }
  if (i == count) return;
  // The rest, in a vector filled up with zeros.
  alignas(64) float rest[3][kLanes] = {};
  for (int k = 0; i + k < count; ++k) rest[0][k] = r[i + k], rest[1][k] = g[i + k], rest[2][k] = b[i + k];
  uint8_t bytes[3 * kLanes];
  StorePacked(map(load3(rest[0], rest[1], rest[2])), bytes);
  __builtin_memcpy(static_cast<void*>(out + i), bytes, 3 * static_cast<size_t>(count - i));
}

}  // namespace airsim360::internal::AIRSIM360_ISA
