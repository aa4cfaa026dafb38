// Rays of cameras, and labels of what they meet.

const uint kWantRange = 1, kWantEntity = 2, kWantSemantic = 4, kWantNormal = 8, kWantPosition = 16,
           kWantMaterial = 32, kWantFlow = 64, kWantAlbedo = 128, kWantRadiance = 256, kWantRgb = 512, kWantCoverage = 1024,
           kWantLight = 2048;  // radiance has antialiased edges

layout(location = 0) rayPayloadEXT Hit hit;

/// Direction in W through the centre of a canonical pixel; false = the camera has no ray there.
bool PixelRay(GpuCamera camera, uvec2 pixel, out vec3 direction) {
  if (camera.separable != 0) {
    const uint s = camera.stride, r = camera.stride_rows;
    const float scale = camera.rows.v[pixel.y];
    const vec3 row = vec3(camera.rows.v[r + pixel.y], camera.rows.v[2 * r + pixel.y], camera.rows.v[3 * r + pixel.y]);
    const vec3 column = vec3(camera.columns.v[pixel.x], camera.columns.v[s + pixel.x], camera.columns.v[2 * s + pixel.x]);
    direction = scale * column + row;
    return true;
  }
  const vec3 ray = Load3(camera.rays, pixel.y * camera.width + pixel.x);
  direction = Turn(camera.R, ray);
  return ray != vec3(0.0);
}

/// Distance from the centre of a fisheye picture, in focal lengths, of what is `theta` from its axis.
float FisheyeRadius(GpuCamera camera, float theta) {
  const float t = theta * theta;
  return theta * (1.0 + t * (camera.distortion[0] + t * (camera.distortion[1] +
                             t * (camera.distortion[2] + t * camera.distortion[3]))));
}

/// Radius in the plane of a lens (CalibratedLens) of a direction: LensLaw's formulas.
float LawRadius(GpuCamera camera, vec3 d, float theta) {
  Floats h = camera.lens;
  const float across = length(d.xy);
  if (camera.law == 0) return across / d.z;
  if (camera.law == 1) {
    const float t = theta * theta;
    return theta * (1.0 + t * (h.v[0] + t * (h.v[1] + t * (h.v[2] + t * (h.v[3] + t * (h.v[4] + t * h.v[5]))))));
  }
  if (camera.law == 2) return atan2_approx(h.v[19] * across, d.z) / h.v[0];
  if (camera.law == 3) return across / (h.v[0] * length(d) + d.z);
  if (camera.law == 4) {
    const float z = h.v[0] * length(d) + d.z;
    return across / (h.v[1] * length(vec2(across, z)) + (1.0 - h.v[1]) * z);
  }
  if (camera.law == 5) return across / (h.v[0] * sqrt(h.v[1] * across * across + d.z * d.z) + (1.0 - h.v[0]) * d.z);
  return theta * (h.v[0] + theta * (h.v[1] + theta * (h.v[2] + theta * (h.v[3] + theta * (h.v[4] + theta * h.v[5])))));
}

/// Distortion of a point of that plane.
vec2 Distort(GpuCamera camera, vec2 m) {
  Floats c = camera.lens;
  const float q = dot(m, m), p1 = c.v[13], p2 = c.v[14];
  const float radial = (1.0 + q * (c.v[6] + q * (c.v[7] + q * (c.v[8] + q * c.v[9])))) /
                       (1.0 + q * (c.v[10] + q * (c.v[11] + q * c.v[12])));
  return m * radial + vec2(2.0 * p1 * m.x * m.y + p2 * (q + 2.0 * m.x * m.x) + q * (c.v[15] + q * c.v[16]),
                           p1 * (q + 2.0 * m.y * m.y) + 2.0 * p2 * m.x * m.y + q * (c.v[17] + q * c.v[18]));
}

/// Where the plane of a lens's picture, continued beyond its borders, shows a direction.
vec2 LensPixel(GpuCamera camera, vec3 d) {
  const float across = length(d.xy);
  const vec2 along = across > 0.0 ? d.xy / across : vec2(1.0, 0.0);
  return vec2(camera.focal[0], camera.focal[1]) * Distort(camera, LawRadius(camera, d, atan2_approx(across, d.z)) * along) +
         vec2(camera.center[0], camera.center[1]);
}

/// Pixel position that sees a direction of the frame of the projection; false = none.
bool Project(GpuCamera camera, vec3 d, out vec2 pixel) {
  pixel = vec2(0.0);
  if (camera.projection == 0) {
    const float x = float(camera.width) * (atan2_approx(d.x, d.z) / (2.0 * SHADE_PI) + 0.5);
    pixel = vec2(x, float(camera.height) * (0.5 - atan2_approx(-d.y, length(d.xz)) / SHADE_PI));
    return true;
  }
  const vec2 focal = vec2(camera.focal[0], camera.focal[1]), center = vec2(camera.center[0], camera.center[1]);
  if (camera.projection == 1) {
    if (!(d.z > 0.0)) return false;
    pixel = focal * d.xy / d.z + center;
  } else {
    const float across = length(d.xy), theta = atan2_approx(across, d.z);
    if (!(theta <= camera.max_theta)) return false;
    if (camera.projection == 3) pixel = LensPixel(camera, d);
    else pixel = focal * FisheyeRadius(camera, theta) * (across > 0.0 ? d.xy / across : vec2(1.0, 0.0)) + center;
  }
  return pixel.x >= 0.0 && pixel.y >= 0.0 && pixel.x <= float(camera.width) && pixel.y <= float(camera.height);
}

/// Index in the image of a canonical pixel.
uint ImageIndex(GpuCamera camera, uvec2 pixel) {
  int x = int(pixel.x) - camera.column_shift;
  if (x < 0) x += int(camera.width);
  return pixel.y * camera.width + uint(x);
}

void Trace(uvec2 tlas, vec3 origin, vec3 direction, float t_min, float t_max) {
  hit.instance = kMiss;
  traceRayEXT(accelerationStructureEXT(tlas), gl_RayFlagsNoneEXT, 0xff, 0, 1, 0, origin, t_min, direction, t_max, 0);
}

struct Surface {
  uint mesh, primitive, triangle, entity;
  vec3 normal;  // unit, in W, towards the origin of the ray
  bool back;    // the corners stand clockwise as seen from there
};

Surface Resolve(Hit h, vec3 direction) {
  Surface s;
  GpuInstance instance = push.frame.v.instances.v[h.instance];
  GpuMesh mesh = push.frame.v.meshes.v[instance.mesh];
  s.mesh = instance.mesh;
  s.primitive = h.primitive;
  s.triangle = (mesh.flags & kSorted) != 0 ? mesh.triangle_of.v[h.primitive] : h.primitive;
  const uint own = (mesh.flags & kHasEntities) != 0 ? mesh.entity_of.v[s.triangle] : 0;
  s.entity = own != 0 ? own : instance.entity;

  // The cofactor matrix of A takes normals to W; up to a sign that does not matter here.
  const uvec3 c = Corners(mesh, h.primitive);
  const vec3 p0 = Load3(instance.positions, c.x);
  const vec3 e1 = Load3(instance.positions, c.y) - p0, e2 = Load3(instance.positions, c.z) - p0;
  const vec3 n = cross(Turn(instance.A, e1), Turn(instance.A, e2));
  const float length2 = dot(n, n);
  s.normal = length2 > 0.0 ? n * inversesqrt(length2) : vec3(0.0);
  s.back = dot(s.normal, direction) > 0.0;
  if (s.back) s.normal = -s.normal;
  return s;
}
