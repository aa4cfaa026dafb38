// Everything of a pixel but its colour.
void WriteLabels(GpuCamera camera, uvec2 pixel, Hit h, vec3 direction, bool has_ray) {
  const uint i = ImageIndex(camera, pixel);
  uint entity = has_ray ? push.frame.v.sky_entity : 0, material = 0;
  float range = 0.0;
  vec3 normal = vec3(0.0), position = vec3(0.0);
  if (h.instance != kMiss) {
    const Surface s = Resolve(h, direction);
    entity = s.entity, normal = s.normal, range = h.t;
    position = Vec(camera.origin) + direction * h.t;
    if ((camera.wanted & kWantMaterial) != 0)
      material = push.frame.v.meshes.v[s.mesh].material_of.v[s.triangle] + 1;
  }
  if ((camera.wanted & kWantRange) != 0) camera.range.v[i] = range;
  if ((camera.wanted & kWantEntity) != 0) camera.entity.v[i] = entity;
  if ((camera.wanted & kWantSemantic) != 0)
    camera.semantic.v[i] = uint16_t(push.frame.v.category_of.v[entity]);
  if ((camera.wanted & kWantMaterial) != 0) camera.material.v[i] = uint16_t(material);
  if ((camera.wanted & kWantNormal) != 0) {
    camera.normal.v[3 * i] = normal.x, camera.normal.v[3 * i + 1] = normal.y, camera.normal.v[3 * i + 2] = normal.z;
  }
  if ((camera.wanted & kWantPosition) != 0) {
    camera.position.v[3 * i] = position.x, camera.position.v[3 * i + 1] = position.y;
    camera.position.v[3 * i + 2] = position.z;
  }
}
