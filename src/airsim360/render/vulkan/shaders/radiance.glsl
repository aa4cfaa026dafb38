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
  const bool coated = s.coat > kThinCoat, rough = !coated && s.roughness < kScattered;
  if (!coated && !rough) return;
  const Bsdf bsdf = bsdf_make(s.kind, s.color, s.metallic, s.roughness, 0.0, s.coat, s.coat_roughness);
  const float n_dot_v = max(-dot(s.n, ray.direction), kViewCosine);
  if (!(luminance(bsdf_reflected(bsdf_side(bsdf, n_dot_v))) > kVisibleSkin)) return;
  s.mirror = true;
  if (!rough) return;
  const BsdfLobes skin_alone = BsdfLobes(0.0, 1.0, 0.0, 0.0, 0.0);
  float event = 0.0;
  s.r = leave_above(bsdf_sample(bsdf, skin_alone, s.n, -ray.direction, 0.5, u.x, u.y, event), s.g);
}
#endif

/// What a camera ray has found so far.
struct Look {
  vec3 eye, direction;
  float cone_angle;
  Ray ray, first;    // that met `s`; that met `s0`
  Shaded s, s0;      // surface at hand; what the camera sees
  LampChoice lamps;  // of `s`
  bool pending;      // `s` waits for its light
  Sample result;
#ifdef HIGH
  Choice choice;
  float sun_known;
#endif
};

/// The ray of one step.
struct Query {
  vec3 origin, to;
  float reach;
  bool wanted, looks;  // looks: sees panes and tells what it met, else only whether
  LampEffect lamp;
};

void AskSun(int step, inout Look look, inout Query q) {
  q.wanted = (step == kSun || look.pending) && look.s.sunlit > 0.0;
  q.looks = false, q.to = look.s.l;
#ifdef HIGH
  if (step == kSun) {
    look.result.asks_sun = q.wanted;
    if (q.wanted && look.choice.sun != vec3(0.0)) q.to = look.choice.sun;
    if (q.wanted && look.sun_known >= 0.0) look.result.seen = look.sun_known, q.wanted = false;
  }
#endif
}

void AskLamp(int which, Look look, inout Query q) {
  q.wanted = ShareOf(look.lamps, which) > 0.0;
  if (!q.wanted) return;
  q.lamp = EffectOfLamp(view.lamps.v[look.lamps.lamp[which]], look.ray, look.s);
  q.looks = false, q.to = q.lamp.direction, q.reach = q.lamp.distance_;
}

Query Ask(int step, inout Look look) {
  Query q;
  q.origin = look.eye, q.to = look.direction, q.reach = 1e30;
  q.wanted = q.looks = true;
  if (step == kSun || step == kMirrorSun || step == kBehindSun) {
    AskSun(step, look, q);
  } else if (step == kLamp0 || step == kLamp1) {
    AskLamp(step - kLamp0, look, q);
  } else if (step == kContact) {
#ifdef HIGH
    q.wanted = false;
#else
    q.wanted = look.s.g.z >= kContactLevel && look.ray.distance_ <= kContactFarthest && look.s.kind == 0.0;
#endif
    q.to = vec3(kContactX, kContactY, 1.0), q.reach = kContactReach;
  } else if (step == kMirror) {
#ifdef HIGH
    Scatter(look.ray, look.s, look.choice.mirrored);
#endif
    look.s0 = look.s;
    q.wanted = look.s0.mirror;
    q.to = look.s0.r;
  } else if (step == kBehind) {
    q.wanted = look.s0.kind == kGlass && look.s0.transmission > 0.0;
  }
  if (!q.wanted || step == kCamera) return q;
  const bool of_first = step == kMirror || step == kBehind;
  const vec3 p = of_first ? look.s0.p : look.s.p, g = of_first ? look.s0.g : look.s.g;
  const float lift = ray_offset(p, of_first ? look.first.distance_ : look.ray.distance_);
  const bool back = step == kBehind || (!q.looks && dot(g, q.to) < 0.0);
  q.origin = p + g * (back ? -lift : lift);
  // Inside the lamp.
  if (!q.looks && q.reach <= lift) q.reach = 0.0;
  return q;
}

/// A ray to the sun or a lamp has come back.
void TakeLight(int step, Query q, inout Look look) {
  const float seen = hit.instance == kMiss ? (hit.t + hit.bary.x + hit.bary.y) / 3.0 : 0.0;
  if (step == kLamp0 || step == kLamp1) {
    const float more = (seen - look.lamps.guess[step - kLamp0]) * ShareOf(look.lamps, step - kLamp0);
    look.s.lamp_front += q.lamp.front * more, look.s.lamp_back += q.lamp.back * more, look.s.lamp_shine += q.lamp.shine * more;
    return;
  }
  look.s.sunlit = seen;
#ifdef HIGH
  if (step == kSun) look.result.seen = seen;
#endif
}

void TakeSky(int step, Query q, inout Look look) {
  vec3 sky = LookUpSky(q.origin, q.to, step == kCamera);
  if (step == kCamera) sky = BehindDrops(sky, look.eye, look.direction, kFarAir, look.cone_angle);
  if (step == kMirror) look.s0.reflected = sky, look.s0.traced = true;
  if (step == kBehind) look.s0.behind = sky, look.s0.clear = true;
  if (step != kCamera) return;
#ifdef HIGH
  look.result.terms.rest = sky;
#endif
  look.result.light = sky;
}

void TakeSurface(int step, Query q, uint key, inout Look look) {
  Ray ray;
  ray.origin = q.origin, ray.direction = q.to, ray.distance_ = hit.t, ray.bary = hit.bary;
  ray.instance = hit.instance, ray.primitive = hit.primitive;
  ray.width = step == kCamera ? hit.t * look.cone_angle : look.first.width * (1.0 + hit.t / max(look.first.distance_, kLeastRange));
  ray.key = step == kCamera ? key : 0u;
#ifdef HIGH
  ray.most_taps = step == kCamera ? SURFACE_MOST_TAPS : 1.0;
#else
  ray.most_taps = 1.0;
#endif
  look.ray = ray;
  look.s = Prepare(ray);
  // What is seen in a mirror does without rays to lamps.
  look.lamps = LightByLamps(ray, look.s);
  look.pending = step != kCamera;
  if (step != kCamera) return;
  look.first = ray, look.result.albedo = look.s.color;
#ifdef HIGH
  look.result.n = look.s.n, look.result.g = look.s.g;
  look.result.leaf = look.s.kind == kFoliage ? look.s.transmission : 0.0;
  look.result.around = LightAround(hit, look.direction, look.sun_known);
#endif
}

#ifdef HIGH
/// The terms of the first surface, about which all is known.
void FindTerms(inout Look look) {
  look.result.terms = TermsOf(look.ray, look.s, look.result.asks_sun);
  if (view.rain + view.snow > 0.0) {
    // Drops and flakes hide a share of every term and add their own light.
    const float hidden = Hidden(look.eye, look.direction, look.ray.distance_, look.cone_angle);
    look.result.terms.ambient *= 1.0 - hidden, look.result.terms.sun *= 1.0 - hidden;
    look.result.terms.rest = lerp3(look.result.terms.rest, Vec(view.drop_light), hidden);
  }
}
#endif

/// Light of the surface at hand, about which all is known.
void LightSurface(int step, inout Look look, inout vec3 light) {
  light = LightOf(look.ray, look.s);
  look.pending = false;
  if (step == kBehind) look.s0.reflected = light, look.s0.traced = true;
  if (step == kBehindLight) look.s0.behind = light, look.s0.clear = true;
}

#ifdef HIGH
Sample Radiance(vec3 eye, vec3 direction, float cone_angle, uint key, Choice choice) {
#else
/// `cone_angle` is the ray's width per metre, `key` 0 for pixel centres.
Sample Radiance(vec3 eye, vec3 direction, float cone_angle, uint key) {
#endif
  Look look;
  look.eye = eye, look.direction = direction, look.cone_angle = cone_angle;
  look.result.albedo = vec3(0.0);
  look.pending = false;
#ifdef HIGH
  look.result.terms.ambient = look.result.terms.sun = vec3(0.0);
  look.result.n = look.result.g = look.result.around = vec3(0.0);
  look.result.asks_sun = false, look.result.seen = look.result.leaf = 0.0;
  look.choice = choice, look.sun_known = -1.0;
#endif
  vec3 light = vec3(0.0);
  [[dont_unroll]] for (int step = kCamera; step <= kLast; ++step) {
    // A surface seen in or behind another, and at last the first one, are lit when all about them is known.
    if (step == kLast) look.ray = look.first, look.s = look.s0, look.pending = true;
#ifdef HIGH
    if (step == kLast) {
      FindTerms(look);
      break;
    }
#endif
    if (look.pending && (step == kBehind || step == kBehindLight || step == kLast)) LightSurface(step, look, light);
    if (step == kBehindLight) continue;
    if (step == kLast) break;
    const Query q = Ask(step, look);
    if (!q.wanted) continue;

    // Rays of light start with the tint (t, bary), which panes change.
    hit.instance = q.looks ? kMiss : 0u;
    hit.t = 1.0, hit.bary = vec2(1.0);
#ifdef RECORD
    RecordRay(q.origin, q.to, q.reach, q.looks);
#endif
    traceRayEXT(accelerationStructureEXT(push.frame.v.tlas),
                q.looks ? gl_RayFlagsNoneEXT : gl_RayFlagsTerminateOnFirstHitEXT | gl_RayFlagsSkipClosestHitShaderEXT, 0xff,
                q.looks ? 0 : 3, 1, q.looks ? 0 : 1, q.origin, 0.0, q.to, q.reach, 0);

    if (!q.looks) {
      TakeLight(step, q, look);
    } else if (step == kContact) {
      // Things close above level ground keep ambient light off.
      if (hit.instance != kMiss) look.s.contact = contact_share(hit.t, kContactReach);
    } else {
      if (step == kCamera) look.result.first = hit;
      if (hit.instance != kMiss) TakeSurface(step, q, key, look);
      else TakeSky(step, q, look);
      if (step == kCamera && hit.instance == kMiss) return look.result;
    }
  }
  look.result.light = BehindDrops(light, eye, direction, look.first.distance_, cone_angle);
  return look.result;
}
