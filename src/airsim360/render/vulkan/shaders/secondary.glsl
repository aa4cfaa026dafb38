// Rays that surfaces send on.

float RayOffset(vec3 p, float distance_) {
  return 1e-3 + 4e-6 * (abs(p.x) + abs(p.y) + abs(p.z) + distance_);
}

/// Share of light that comes along a ray; clear panes tint it (pane.rahit).
float Seen(vec3 origin, vec3 direction, float reach) {
  hit.instance = 0;
  hit.t = 1.0, hit.bary = vec2(1.0);
  traceRayEXT(accelerationStructureEXT(push.frame.v.tlas), gl_RayFlagsTerminateOnFirstHitEXT | gl_RayFlagsSkipClosestHitShaderEXT,
              0xff, 3, 1, 1, origin, 0.0, direction, reach, 0);
  return hit.instance == kMiss ? (hit.t + hit.bary.x + hit.bary.y) / 3.0 : 0.0;
}
