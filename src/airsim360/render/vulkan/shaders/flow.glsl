// Where the point of a pixel is at the next instant (render/cpu/flow.cc in single precision, about the eye).

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
  } else if ((hit.instance != instance || hit.primitive != primitive) && hit.t < flow.range * (1.0 - kFlowRelative) - kFlowMetres) {
    flow.occluded = 1;
  }
  return flow;
}
