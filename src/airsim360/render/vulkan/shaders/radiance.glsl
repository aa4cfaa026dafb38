// Tier `fast`: the radiance along one ray. Sun, probes, lamps and sky; mirrors and clear panes send their ray on, once.
// With HIGH: the terms of it for tier `high` (render/high/high_shading.cc).
//
// All rays are traced at one place of the shader, a step of the loop each: compilers copy what follows a trace for every place
// that traces.

const int kCamera = 0, kSun = 1, kLamp0 = 2, kLamp1 = 3, kContact = 4, kMirror = 5, kMirrorSun = 6, kBehind = 7,
          kBehindSun = 8, kBehindLight = 9, kLast = 10;

struct Sample {
  vec3 light, albedo;
  Hit first;  // of the camera ray
#ifdef HIGH
  Terms terms;
  vec3 n, g;      // shading and geometric normal
  bool asks_sun;  // it can matter ...
  float seen;     // ... and is seen so far
  float leaf;     // share of light that passes
  vec3 around;    // light of the pixels around
#endif
};

#ifdef HIGH
/// What is chosen for one ray of tier `high`.
struct Choice {
  vec3 sun;      // towards a point of its disc; 0 = as the surface says
  vec2 mirrored; // random numbers of the reflection
};
/// Light of the pixels around a sample, and what they know of the sun there; below 0: nothing.
vec3 LightAround(Hit h, vec3 direction, out float sun_known);
/// Tier `high` sends a ray where any shiny skin is seen to mirror something.
void Scatter(Ray ray, inout Shaded s, vec2 u) {
  if (s.mirror || s.kind >= 0.5) return;
  const bool coated = s.coat > 0.05, rough = !coated && s.roughness < 0.25;
  if (!coated && !rough) return;
  const Bsdf bsdf = bsdf_make(s.kind, s.color, s.metallic, s.roughness, 0.0, s.coat, s.coat_roughness);
  const float n_dot_v = max(-dot(s.n, ray.direction), 0.02);
  if (!(luminance(bsdf_reflected(bsdf_side(bsdf, n_dot_v))) > 0.08)) return;
  s.mirror = true;
  if (!rough) return;
  const BsdfLobes skin_alone = BsdfLobes(0.0, 1.0, 0.0, 0.0, 0.0);
  float event = 0.0;
  vec3 r = bsdf_sample(bsdf, skin_alone, s.n, -ray.direction, 0.5, u.x, u.y, event);
  const float below = dot(r, s.g);
  s.r = below < 0.01 ? normalize3(r + s.g * (0.02 - 2.0 * below)) : r;
}

Sample Radiance(vec3 eye, vec3 direction, float cone_angle, uint key, Choice choice) {
  Sample result;
  result.terms.ambient = result.terms.sun = vec3(0.0);
  result.n = result.g = result.around = vec3(0.0);
  result.asks_sun = false, result.seen = result.leaf = 0.0;
  float sun_known = -1.0;
#else
/// `cone_angle` is the ray's width per metre, `key` 0 for pixel centres.
Sample Radiance(vec3 eye, vec3 direction, float cone_angle, uint key) {
  Sample result;
#endif
  result.albedo = vec3(0.0);
  Ray ray, first;  // that met `s`; that met `s0`
  Shaded s, s0;    // surface at hand; what the camera sees
  LampChoice lamps;
  bool pending = false;  // `s` waits for its light
  vec3 light = vec3(0.0);
  [[dont_unroll]] for (int step = kCamera; step <= kLast; ++step) {
    // A surface seen in or behind another, and at last the first one, are lit when all about them is known.
    if (step == kLast) ray = first, s = s0, pending = true;
#ifdef HIGH
    if (step == kLast) {
      result.terms = TermsOf(ray, s, result.asks_sun);
      if (view.rain + view.snow > 0.0) {
        // Drops and flakes hide a share of every term and add their own light.
        const float hidden = Hidden(eye, direction, ray.distance_, cone_angle);
        result.terms.ambient *= 1.0 - hidden, result.terms.sun *= 1.0 - hidden;
        result.terms.rest = lerp3(result.terms.rest, Vec(view.drop_light), hidden);
      }
      break;
    }
#endif
    if (pending && (step == kBehind || step == kBehindLight || step == kLast)) {
      light = LightOf(ray, s);
      pending = false;
      if (step == kBehind) s0.reflected = light, s0.traced = true;
      if (step == kBehindLight) s0.behind = light, s0.clear = true;
    }
    if (step == kBehindLight) continue;
    if (step == kLast) break;

    // The ray of this step.
    vec3 origin = eye, to = direction;
    float reach = 1e30;
    bool looks = true, wanted = true;  // looks: sees panes and tells what it met, else only whether
    LampEffect lamp;
    if (step == kSun || step == kMirrorSun || step == kBehindSun) {
      wanted = (step == kSun || pending) && s.sunlit > 0.0;
      looks = false, to = s.l;
#ifdef HIGH
      if (step == kSun) {
        result.asks_sun = wanted;
        if (wanted && choice.sun != vec3(0.0)) to = choice.sun;
        if (wanted && sun_known >= 0.0) result.seen = sun_known, wanted = false;
      }
#endif
    } else if (step == kLamp0 || step == kLamp1) {
      wanted = ShareOf(lamps, step - kLamp0) > 0.0;
      if (wanted) {
        lamp = EffectOfLamp(view.lamps.v[lamps.lamp[step - kLamp0]], ray, s);
        looks = false, to = lamp.direction, reach = lamp.distance_;
      }
    } else if (step == kContact) {
#ifdef HIGH
      wanted = false;
#else
      wanted = s.g.z >= 0.7 && ray.distance_ <= 40.0 && s.kind == 0.0;
#endif
      to = vec3(0.0123, 0.0071, 1.0), reach = 1.2;
    } else if (step == kMirror) {
#ifdef HIGH
      Scatter(ray, s, choice.mirrored);
#endif
      s0 = s;
      wanted = s0.mirror;
      to = s0.r;
    } else if (step == kBehind) {
      wanted = s0.kind == kGlass && s0.transmission > 0.0;
    }
    if (!wanted) continue;
    if (step != kCamera) {
      const bool of_first = step == kMirror || step == kBehind;
      const vec3 p = of_first ? s0.p : s.p, g = of_first ? s0.g : s.g;
      const float lift = ray_offset(p, of_first ? first.distance_ : ray.distance_);
      const bool back = step == kBehind || (!looks && dot(g, to) < 0.0);
      origin = p + g * (back ? -lift : lift);
      // Inside the lamp.
      if (!looks && reach <= lift) reach = 0.0;
    }

    // Rays of light start with the tint (t, bary), which panes change.
    hit.instance = looks ? kMiss : 0u;
    hit.t = 1.0, hit.bary = vec2(1.0);
#ifdef RECORD
    RecordRay(origin, to, reach, looks);
#endif
    traceRayEXT(accelerationStructureEXT(push.frame.v.tlas),
                looks ? gl_RayFlagsNoneEXT : gl_RayFlagsTerminateOnFirstHitEXT | gl_RayFlagsSkipClosestHitShaderEXT, 0xff,
                looks ? 0 : 3, 1, looks ? 0 : 1, origin, 0.0, to, reach, 0);

    if (!looks) {
      const float seen = hit.instance == kMiss ? (hit.t + hit.bary.x + hit.bary.y) / 3.0 : 0.0;
      if (step == kLamp0 || step == kLamp1) {
        const float more = (seen - lamps.guess[step - kLamp0]) * ShareOf(lamps, step - kLamp0);
        s.lamp_front += lamp.front * more, s.lamp_back += lamp.back * more, s.lamp_shine += lamp.shine * more;
      } else {
        s.sunlit = seen;
#ifdef HIGH
        if (step == kSun) result.seen = seen;
#endif
      }
      continue;
    }
    if (step == kContact) {
      // Things close above level ground keep ambient light off.
      if (hit.instance == kMiss) continue;
      const float t = min(1.0, hit.t / 1.2);
      s.contact = 0.25 + 0.75 * t * t * (3.0 - 2.0 * t);
      continue;
    }
    if (step == kCamera) result.first = hit;
    if (hit.instance == kMiss) {
      vec3 sky = LookUpSky(origin.z, to, step == kCamera);
      if (step == kCamera) sky = BehindDrops(sky, eye, direction, 2e5, cone_angle);
      if (step == kMirror) s0.reflected = sky, s0.traced = true;
      if (step == kBehind) s0.behind = sky, s0.clear = true;
      if (step != kCamera) continue;
#ifdef HIGH
      result.terms.rest = sky;
#endif
      result.light = sky;
      return result;
    }
    ray.origin = origin, ray.direction = to, ray.distance_ = hit.t, ray.bary = hit.bary;
    ray.instance = hit.instance, ray.primitive = hit.primitive;
    ray.width = step == kCamera ? hit.t * cone_angle : first.width * (1.0 + hit.t / max(first.distance_, 0.01));
    ray.key = step == kCamera ? key : 0u;
    s = Prepare(ray);
    // What is seen in a mirror does without rays to lamps.
    lamps = LightByLamps(ray, s);
    pending = step != kCamera;
    if (step == kCamera) first = ray, result.albedo = s.color;
#ifdef HIGH
    if (step == kCamera) {
      result.n = s.n, result.g = s.g;
      result.leaf = s.kind == kFoliage ? s.transmission : 0.0;
      result.around = LightAround(hit, direction, sun_known);
    }
#endif
  }
  result.light = BehindDrops(light, eye, direction, first.distance_, cone_angle);
  return result;
}
