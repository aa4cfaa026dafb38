// From a surface to radiance: render/shading/light_kernel.cc for one lane.

/// What a surface does with light, before it is known how much ambient light there is.
struct Response {
  vec3 skin, body, leaf, straight, sun;
  float coat;
};

/// `sun`: whether its light is wanted.
Response RespondTo(Ray ray, Shaded s, bool sun) {
  const vec3 d = ray.direction;
  const float transmission = s.kind == kFoliage || s.clear ? s.transmission : 0.0;
  const Bsdf bsdf = bsdf_make(s.kind, s.color, s.metallic, s.roughness, transmission, s.coat, s.coat_roughness);
  const BsdfSide seen = bsdf_side(bsdf, max(-dot(s.n, d), kViewCosine));
  const vec3 through = bsdf_entering(seen);
  Response o;
  o.skin = bsdf_reflected(seen);
  o.coat = seen.coat;
  o.body = bsdf.body * through;
  o.leaf = bsdf.through * through;
  o.straight = bsdf_straight(bsdf, seen);
  float pdf = 0.0;
  o.sun = vec3(0.0);
  if (sun) {
    o.sun = bsdf_evaluate(bsdf_widen(bsdf, SHADE_SUN_ALPHA), seen, bsdf_lobes(bsdf, seen), s.n, -d, s.l, pdf) *
            Vec(view.sun_irradiance) * CloudShadow(s.p);
    o.sun = min(o.sun, vec3(kBrightestGlint));
  }
  return o;
}

/// Emission, and the light of lamps.
vec3 OwnAndLamps(Shaded s, Response o) {
  // Skins without highlights spread the light of lamps as bodies do.
  const bool shiny = s.traced || lamp_shines(s.kind, s.roughness, s.metallic);
  const vec3 body = o.body + (shiny ? vec3(0.0) : o.skin);
  return s.emission + (body * s.lamp_front + o.leaf * s.lamp_back) * SHADE_INV_PI + s.lamp_shine;
}

vec3 LightOf(Ray ray, Shaded s) {
  const Response o = RespondTo(ray, s, s.sunlit > 0.0);
  const Ambient ambient = SampleProbes(s.p, s.g, s.n, s.r);
  const float crown = s.kind == kFoliage ? SHADE_CROWN : 1.0;
  const vec3 body = (o.body * ambient.front * s.contact + o.leaf * ambient.back) * (crown * SHADE_INV_PI);
  vec3 mirrored = ambient.reflected * SHADE_INV_PI;
  if (s.traced) {
    mirrored = s.reflected;
  } else if ((s.roughness < 0.5 || s.metallic > kShinyMetal) && view.has_sky != 0) {
    const float open = luminance(UniformFrom(s.r));
    mirrored = BlurredSky(s.r, s.roughness) * open_share(luminance(ambient.reflected), open);
  }
  vec3 light = body + o.sun * s.sunlit + mirrored * o.skin + OwnAndLamps(s, o);
  if (s.clear) light += s.behind * o.straight;
  if (view.has_sky != 0) {
    const AirEffect air = AirToSurface(ray.origin, ray.direction, ray.distance_);
    light = light * air.kept + air.added;
  }
  return light;
}

/// Radiance is ambient * (irradiance around) + sun * (share of the disc seen) + rest.
struct Terms {
  vec3 ambient, sun, rest;
};

/// `sun`: whether it can matter.
Terms TermsOf(Ray ray, Shaded s, bool sun) {
  const Response o = RespondTo(ray, s, sun);
  // The traced ray is what the coat mirrors where there is one, else what the skin does.
  const vec3 sharp = s.traced ? (s.coat > kThinCoat ? vec3(o.coat) : o.skin) : vec3(0.0);
  Terms t;
  t.ambient = (o.body + o.skin - sharp) * SHADE_INV_PI;
  t.sun = o.sun;
  t.rest = OwnAndLamps(s, o);
  if (s.traced) t.rest += s.reflected * sharp;
  if (s.clear) t.rest += s.behind * o.straight;
  if (view.has_sky != 0) {
    const AirEffect air = AirToSurface(ray.origin, ray.direction, ray.distance_);
    t.ambient *= air.kept, t.sun *= air.kept;
    t.rest = t.rest * air.kept + air.added;
  }
  return t;
}
