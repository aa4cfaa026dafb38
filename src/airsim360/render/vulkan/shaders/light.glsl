// From a surface to radiance: render/shading/light_kernel.cc for one lane.

const float kBrightest = 400.0, kSunAlpha = 0.006, kCrownShade = 0.6;

vec3 LightOf(Ray ray, Shaded s) {
  const vec3 d = ray.direction;
  const float transmission = s.kind == kFoliage || s.clear ? s.transmission : 0.0;
  const Bsdf bsdf = bsdf_make(s.kind, s.color, s.metallic, s.roughness, transmission, s.coat, s.coat_roughness);
  const BsdfSide seen = bsdf_side(bsdf, max(-dot(s.n, d), 0.02));
  const vec3 through = bsdf_entering(seen), skin = bsdf_reflected(seen);
  float pdf = 0.0;
  vec3 sun = vec3(0.0);
  if (s.sunlit > 0.0) {
    sun = bsdf_evaluate(bsdf_widen(bsdf, kSunAlpha), seen, bsdf_lobes(bsdf, seen), s.n, -d, s.l, pdf) *
          Vec(view.sun_irradiance) * CloudShadow(s.p);
    sun = min(sun, vec3(kBrightest));
  }

  const Ambient ambient = SampleProbes(s.p, s.g, s.n, s.r);
  const float crown = s.kind == kFoliage ? kCrownShade : 1.0;
  const vec3 body = (bsdf.body * through * ambient.front * s.contact + bsdf.through * through * ambient.back) *
                    (crown * SHADE_INV_PI);
  vec3 mirrored = ambient.reflected * SHADE_INV_PI;
  if (s.traced) {
    mirrored = s.reflected;
  } else if ((s.roughness < 0.5 || s.metallic > 0.2) && view.has_sky != 0) {
    const float open = luminance(UniformFrom(s.r));
    mirrored = BlurredSky(s.r, s.roughness) * min(luminance(ambient.reflected) / max(open, 1e-4), 1.0);
  }
  vec3 light = body + sun * s.sunlit + mirrored * skin + s.emission;
  light += (bsdf.body * through * s.lamp_front + bsdf.through * through * s.lamp_back) * SHADE_INV_PI + s.lamp_shine;
  if (s.clear) light += s.behind * bsdf_straight(bsdf, seen);
  if (view.has_sky != 0) {
    const AirEffect air = AirToSurface(ray.origin.z, d, ray.distance_);
    light = light * air.kept + air.added;
  }
  return light;
}
