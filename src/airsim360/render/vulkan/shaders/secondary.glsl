// Where rays that surfaces send on start.

float RayOffset(vec3 p, float distance_) {
  return 1e-3 + 4e-6 * (abs(p.x) + abs(p.y) + abs(p.z) + distance_);
}
