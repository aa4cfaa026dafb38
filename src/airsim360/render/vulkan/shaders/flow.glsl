// Where the point of a pixel is at the next instant (render/cpu/flow.cc in single precision, about the eye).

/// Pixel position that sees a direction of C; false = none.
bool Project(GpuCamera camera, vec3 d, out vec2 pixel) {
  const float kPi = 3.14159265358979;
  pixel = vec2(0.0);
  if (camera.projection == 0) {
    const float x = float(camera.width) * (atan(d.x, d.z) / (2.0 * kPi) + 0.5);
    pixel = vec2(x, float(camera.height) * (0.5 - atan(-d.y, length(d.xz)) / kPi));
    return true;
  }
  const vec2 focal = vec2(camera.focal[0], camera.focal[1]), center = vec2(camera.center[0], camera.center[1]);
  if (camera.projection == 1) {
    if (!(d.z > 0.0)) return false;
    pixel = focal * d.xy / d.z + center;
  } else {
    const float across = length(d.xy), theta = atan(across, d.z);
    if (!(theta <= camera.max_theta)) return false;
    const float t2 = theta * theta;
    const float r = theta * (1.0 + t2 * (camera.distortion[0] + t2 * (camera.distortion[1] +
                                         t2 * (camera.distortion[2] + t2 * camera.distortion[3]))));
    pixel = focal * r * (across > 0.0 ? d.xy / across : vec2(1.0, 0.0)) + center;
  }
  return pixel.x >= 0.0 && pixel.y >= 0.0 && pixel.x <= float(camera.width) && pixel.y <= float(camera.height);
}

/// A point of a surface in W at the next instant less where it is now.
vec3 MotionOf(Hit h, uint primitive) {
  GpuInstance now = push.frame.v.instances.v[h.instance], then = push.frame.v.next_instances.v[h.instance];
  const uvec3 c = Corners(push.frame.v.meshes.v[now.mesh], primitive);
  const float u = h.bary.x, v = h.bary.y, w = 1.0 - u - v;
  const vec3 a = Load3(now.positions, c.x) * w + Load3(now.positions, c.y) * u + Load3(now.positions, c.z) * v;
  const vec3 b = Load3(then.positions, c.x) * w + Load3(then.positions, c.y) * u + Load3(then.positions, c.z) * v;
  float change[9];
  for (int i = 0; i < 9; ++i) change[i] = then.A[i] - now.A[i];
  return Turn(then.A, b - a) + Turn(change, a) + (Vec(then.p) - Vec(now.p));
}

GpuFlow FlowOf(GpuCamera camera, uvec2 pixel, Hit h, vec3 direction, bool has_point) {
  GpuFlow flow;
  flow.dx = flow.dy = flow.range = 0.0;
  flow.occluded = 1;
  flow.motion[0] = flow.motion[1] = flow.motion[2] = 0.0;
  if (!has_point) return flow;
  flow.occluded = 0;
  vec3 to_point = direction;
  if (h.instance != kMiss) {
    const bool vanishes = push.frame.v.next_instances.v[h.instance].hidden != 0;
    const vec3 motion = vanishes ? vec3(0.0) : MotionOf(h, h.primitive);
    to_point = direction * h.t + motion + Vec(camera.eye_offset);
    flow.range = length(to_point);
    flow.motion[0] = motion.x, flow.motion[1] = motion.y, flow.motion[2] = motion.z;
    flow.occluded = vanishes ? 1 : 0;
  }
  vec2 there;
  if (!Project(camera, TurnBack(camera.next_R, to_point), there)) {
    flow.occluded = 1;
    return flow;
  }
  float dx = there.x - (float(pixel.x) + 0.5);
  if (camera.projection == 0) {
    dx += float(camera.column_turn);
    dx -= float(camera.width) * floor(dx / float(camera.width) + 0.5);
  }
  flow.dx = dx;
  flow.dy = there.y - (float(pixel.y) + 0.5);
  if (flow.occluded != 0) return flow;

  // Does something else hide it then? Nearer by this much: far above rounding.
  const uint instance = h.instance, primitive = h.primitive;
  Trace(push.frame.v.next_tlas, Vec(camera.next_origin), normalize(to_point), 0.0, 1e30);
  if (hit.instance == kMiss) return flow;
  if (instance == kMiss) {
    flow.occluded = 1;
  } else if ((hit.instance != instance || hit.primitive != primitive) && hit.t < flow.range * (1.0 - 1e-4) - 1e-4) {
    flow.occluded = 1;
  }
  return flow;
}
