// From radiance to pictures.

/// Display colour of a radiance, 8 bits a channel.
uvec3 Develop(vec3 light, float exposure) {
  const vec3 exposed = light * exposure;
  const vec3 shown = view.tone == 1 ? agx_curve(exposed) : view.tone == 2 ? linear_curve(exposed) : tone_curve(exposed);
  uvec3 code;
  for (int k = 0; k < 3; ++k) code[k] = uint(srgb_encode(shown[k]) * 255.0 + 0.5);
  return code;
}

/// Writes what is wanted of a pixel's colour and gives its code; black where the camera has no ray.
uvec3 WriteColor(GpuCamera camera, uint at, vec3 light, bool has_ray) {
  for (int k = 0; k < 3; ++k) {
    if ((camera.wanted & kWantRadiance) != 0) camera.radiance.v[3 * at + k] = light[k];
  }
  if ((camera.wanted & kWantRgb) == 0) return uvec3(0);
  const uvec3 c = has_ray ? Develop(light, camera.exposure) : uvec3(0);
  for (int k = 0; k < 3; ++k) camera.rgb.v[3 * at + k] = uint8_t(c[k]);
  return c;
}
