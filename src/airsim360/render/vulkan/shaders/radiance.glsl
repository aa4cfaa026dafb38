// Tier `fast`: the radiance along one ray. Sun, probes, lamps and sky; mirrors and clear panes send their ray on, once.

Ray RayOf(vec3 origin, vec3 direction, Hit h, float width) {
  Ray ray;
  ray.origin = origin, ray.direction = direction;
  ray.distance_ = h.t, ray.width = width, ray.bary = h.bary;
  ray.instance = h.instance, ray.primitive = h.primitive;
  ray.key = 0;
  return ray;
}

/// Radiance along a ray of the camera that met `h`; `cone_angle` is its width per metre, `key` 0 for pixel centres.
vec3 Radiance(vec3 eye, Hit h, vec3 direction, float cone_angle, uint key, out vec3 albedo) {
  albedo = vec3(0.0);
  if (h.instance == kMiss) return LookUpSky(eye.z, direction, true);
  Ray first = RayOf(eye, direction, h, h.t * cone_angle);
  first.key = key;
  Ray ray = first;
  Shaded s0;
  // 0: what the camera sees; 1: what it mirrors; 2: what is behind it.
  for (int k = 0; k < 3; ++k) {
    if (k > 0) {
      const bool wanted = k == 1 ? s0.mirror : s0.kind == kGlass && s0.transmission > 0.0;
      if (!wanted) continue;
      const float lift = RayOffset(s0.p, first.distance_);
      const vec3 origin = s0.p + s0.g * (k == 1 ? lift : -lift), to = k == 1 ? s0.r : direction;
      Trace(push.frame.v.tlas, origin, to, 0.0, 1e30);
      if (hit.instance == kMiss) {
        const vec3 sky = LookUpSky(origin.z, to, false);
        if (k == 1) s0.reflected = sky, s0.traced = true;
        else s0.behind = sky, s0.clear = true;
        continue;
      }
      ray = RayOf(origin, to, hit, first.width * (1.0 + hit.t / max(first.distance_, 0.01)));
    }
    Shaded s = Prepare(ray);
    if (s.sunlit > 0.0) {
      const float lift = RayOffset(s.p, ray.distance_);
      s.sunlit = Seen(s.p + s.g * (dot(s.g, s.l) < 0.0 ? -lift : lift), s.l, 1e30);
    }
    // What is seen in a mirror does without rays to lamps.
    LightByLamps(ray, s, k == 0 ? 2 : 0);
    if (k == 0) {
      // Things close above level ground keep ambient light off.
      if (s.g.z >= 0.7 && ray.distance_ <= 40.0 && s.kind == 0.0) {
        Trace(push.frame.v.tlas, s.p + s.g * RayOffset(s.p, ray.distance_), vec3(0.0123, 0.0071, 1.0), 0.0, 1.2);
        if (hit.instance != kMiss) {
          const float t = min(1.0, hit.t / 1.2);
          s.contact = 0.25 + 0.75 * t * t * (3.0 - 2.0 * t);
        }
      }
      s0 = s;
      albedo = s.color;
      continue;
    }
    const vec3 light = LightOf(ray, s);
    if (k == 1) s0.reflected = light, s0.traced = true;
    else s0.behind = light, s0.clear = true;
  }
  return LightOf(first, s0);
}


/// Display colour of a radiance, 8 bits a channel.
uvec3 Develop(vec3 light, float exposure) {
  const vec3 exposed = light * exposure;
  const vec3 shown = view.tone == 1 ? agx_curve(exposed) : view.tone == 2 ? linear_curve(exposed) : tone_curve(exposed);
  return uvec3(uint(srgb_encode(shown.x) * 255.0 + 0.5), uint(srgb_encode(shown.y) * 255.0 + 0.5),
               uint(srgb_encode(shown.z) * 255.0 + 0.5));
}
