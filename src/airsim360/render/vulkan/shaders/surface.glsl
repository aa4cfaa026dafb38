// From a hit to a surface: render/shading/surface_kernel.cc for one lane.

struct Ray {
  vec3 origin, direction;
  float distance_, width;
  vec2 bary;
  uint instance, primitive, key;
  float most_taps;  // 1, or SURFACE_MOST_TAPS
};

struct Shaded {
  vec3 p, n, g;
  vec3 color, emission;
  float metallic, roughness, transmission, coat, coat_roughness, kind;
  vec3 r;       // reflected direction
  bool mirror;  // reflects sharply enough for a traced ray
  vec3 l;       // towards the sun
  float sunlit; // 1 if the sun can matter; then the share of it that is seen
  float contact;
  bool traced, clear;
  vec3 reflected, behind;
  vec3 lamp_front, lamp_back, lamp_shine;  // of lamps: irradiance, and what the skin reflects
};

#include "surface_detail.glsl"

/// The tables of what a ray met.
struct Fetched {
  GpuInstance placed;
  GpuMesh mesh;
  GpuShaded own;
  GpuTriangle t;
  GpuMaterial m;
  uint triangle;
  float matrix[9];  // turns normals from the mesh's frame to W
  float pane;       // hash of the pane or leaf
};

/// Cofactors of where the instance is now.
float[9] NormalMatrix(GpuInstance placed) {
  const vec3 r0 = vec3(placed.A[0], placed.A[1], placed.A[2]), r1 = vec3(placed.A[3], placed.A[4], placed.A[5]),
             r2 = vec3(placed.A[6], placed.A[7], placed.A[8]);
  vec3 c0 = cross(r1, r2), c1 = cross(r2, r0), c2 = cross(r0, r1);
  const float det = dot(r0, c0);
  const float side = (det < 0.0 ? -1.0 : 1.0) / pow(max(abs(det), 1e-30), 2.0 / 3.0);
  c0 *= side, c1 *= side, c2 *= side;
  return float[9](c0.x, c0.y, c0.z, c1.x, c1.y, c1.z, c2.x, c2.y, c2.z);
}

Fetched Fetch(Ray ray) {
  Fetched f;
  f.placed = push.frame.v.instances.v[ray.instance];
  f.mesh = push.frame.v.meshes.v[f.placed.mesh];
  f.triangle = (f.mesh.flags & kSorted) != 0 ? f.mesh.triangle_of.v[ray.primitive] : ray.primitive;
  f.own = view.instances.v[ray.instance];
  f.t = view.triangles.v[f.own.first_triangle + f.triangle];
  f.m = view.materials.v[f.t.material & ~kMirroredUv];
  f.matrix = NormalMatrix(f.placed);
  f.pane = HashOf(f.t.pane ^ f.own.hash);
  return f;
}

/// Where a ray meets a surface (Meeting of surface_kernel.cc).
struct Meeting {
  vec3 d, p;
  float u, v, w;
  vec3 facing, n;
  float front, tu, tv, width, slant, footprint;
};

/// Geometric and interpolated normal in W; of bent meshes those of this instant.
void NormalsAt(Fetched f, uint primitive, vec3 corner, out vec3 g, out vec3 smooth_) {
  const float u = corner.x, v = corner.y, w = corner.z;
  if (uvec2(f.placed.positions) == uvec2(f.mesh.positions)) {
    g = Row3(f.matrix, UnpackDirection(f.t.geometric_normal));
    smooth_ = Row3(f.matrix, UnpackDirection(f.t.normals[0]) * w + UnpackDirection(f.t.normals[1]) * u +
                                 UnpackDirection(f.t.normals[2]) * v);
    return;
  }
  const uvec3 c = Corners(f.mesh, primitive);
  const vec3 a = Load3(f.placed.positions, c.x);
  g = Row3(f.matrix, cross(Load3(f.placed.positions, c.y) - a, Load3(f.placed.positions, c.z) - a));
  smooth_ = g;
  if (f.placed.normals != 0) {
    // Means of the faces around, behind the positions.
    smooth_ = Row3(f.matrix, normalize3(Load3(f.placed.positions, f.placed.normals + c.x)) * w +
                                 normalize3(Load3(f.placed.positions, f.placed.normals + c.y)) * u +
                                 normalize3(Load3(f.placed.positions, f.placed.normals + c.z)) * v);
  }
}

Meeting Meet(Ray ray, Fetched f) {
  Meeting at;
  at.d = ray.direction;
  at.p = ray.origin + at.d * ray.distance_;
  at.u = ray.bary.x, at.v = ray.bary.y, at.w = 1.0 - at.u - at.v;
  vec3 g, smooth_;
  NormalsAt(f, ray.primitive, vec3(at.u, at.v, at.w), g, smooth_);
  at.front = dot(g, at.d) > 0.0 ? -1.0 : 1.0;
  at.facing = g * at.front;
  at.n = (dot(smooth_, g) > 0.0 ? smooth_ : -smooth_) * at.front;
  at.tu = f.t.uv[0] * at.w + f.t.uv[2] * at.u + f.t.uv[4] * at.v;
  at.tv = f.t.uv[1] * at.w + f.t.uv[3] * at.u + f.t.uv[5] * at.v;
  at.width = ray.width;
  at.slant = slant_of(at.facing, at.d);
  at.footprint = texture_footprint(ray.width, at.slant, f.t.texels_log2 + f.own.texels_log2);
  return at;
}

/// Where the picture of a slanted pixel is looked up.
Stretch StretchOf(Fetched f, Meeting at, float most_taps) {
  const vec3 g = at.facing * at.front, t = Row3(f.matrix, UnpackDirection(f.t.tangent));
  const vec3 b = cross(g, t) * ((f.t.material & kMirroredUv) != 0 ? -1.0 : 1.0);
  return stretched_pixel(dot(at.d, t), -dot(at.d, b), at.width, at.slant, f.t.texels_log2 + f.own.texels_log2, at.footprint,
                         f.m.blend > 0.5, most_taps);
}

/// Base colour of the material as the instance tints it.
vec3 Tint(Fetched f) { return vec3(f.m.base[0] * f.own.tint[0], f.m.base[1] * f.own.tint[1], f.m.base[2] * f.own.tint[2]); }

/// A look through a pane.
RoomView LookInside(Fetched f, Meeting at) {
  const GpuPane q = view.panes.v[f.t.window - 1];
  const float a = q.a[0] * at.w + q.a[1] * at.u + q.a[2] * at.v, b = q.b[0] * at.w + q.b[1] * at.u + q.b[2] * at.v;
  const float room = HashOf((q.hash ^ f.own.hash) * 0x85ebca6bu + 77u);
  const vec3 light = room_light(room, f.t.area, f.m.emission[0], view.lit_rooms, view.evening);
  return look_inside(a, b, q.half_a, q.half_b, dot(at.d, Row3(f.matrix, UnpackDirection(q.right))),
                     dot(at.d, Row3(f.matrix, UnpackDirection(q.up))), -dot(at.d, at.facing), room, light, q.u_per_a, q.v_per_b);
}

bool LiesWeather() { return view.wetness > 0.0 || view.lying_snow > 0.0; }

/// Colour, roughness and light of the material: its textures and what makes places differ. Normals are still those of the mesh.
Skin PaintSkin(Fetched f, uint instance, Meeting at, Sampled sampled, out Noises noises) {
  const GpuMaterial m = f.m;
  vec3 color = Tint(f) * VertexColors(f.own, f.triangle, vec2(at.u, at.v));
  float metallic = m.metallic, roughness = m.roughness;
  color *= sampled.texel[0];
  roughness *= sampled.texel[1].y, metallic *= sampled.texel[1].z;
  vec3 emission = Vec(m.emission) * sampled.texel[3];
  if (emission != vec3(0.0)) emission = Thrown(m, f.t, f.matrix, instance, f.pane, at.d, emission);
  const bool wear = m.ground > 0.5 && m.kind != kFoliage, weather = LiesWeather();
  if (m.macro_variation != 0.0 || wear || weather)
    noises = LookUpNoises(wear || weather, wall_share(m.macro_variation, m.ground, at.n.z), at.p, at.n, at.width);
  if (m.macro_variation != 0.0)
    color *= macro_tint(m.macro_variation, noises, at.width) *
             wall_wear(noises.wide, noises.mid, noises.fine, at.width, noises.wall);
  if (wear) wear_ground(m.ground, noises, at.p, at.tu * m.tile, at.width, color, roughness);
  if (m.kind == kFoliage) color = leaf_tint(true, m.transmission, f.pane, color);
  return Skin(lawful_color(color), metallic, lawful_roughness(roughness), m.clear_coat, m.clear_coat_roughness, m.transmission, m.kind,
              at.n, emission);
}

/// A part of the normal map's slope; what mipmapping shortened becomes roughness (Toksvig 2005).
void MapNormal(Fetched f, vec3 texel, inout Skin s) {
  const float mirrored = (f.t.material & kMirroredUv) != 0 ? -1.0 : 1.0;
  s.n = bend_normal(texel, s.n, Row3(f.matrix, UnpackDirection(f.t.tangent)), mirrored, f.m.normal_scale, s.roughness);
}

void RaiseWaves(Meeting at, inout Skin s) {
  const PlanePoint gust = gust_at(at.p);
  float lost = 0.0;
  s.n = windy_water(at.p, SampleNoise(gust.x, gust.y), at.width / sqrt(at.slant), lost);
  s.roughness = water_roughness(lost);
}

/// The sun's centre, or for samples beside the pixel's centre a point of its disc.
vec3 TowardsSun(uint key) {
  const vec3 s = Vec(view.to_sun);
  if (key == 0) return normalize3(s);
  const uint h = hash_bits(key);
  const float a = float((h >> 8) & 0xfffu) * kTwelveBits, b = float((h >> 20) & 0xfffu) * kTwelveBits;
  const PlanePoint at = disc_place(sqrt(a) * kSunRayRadius, b);
  const float flat2 = s.x * s.x + s.y * s.y;
  const vec3 e1 = flat2 > kSteepest2 ? vec3(-s.y, s.x, 0.0) / sqrt(flat2) : vec3(1.0, 0.0, 0.0);
  return normalize3(e1 * at.x + cross(s, e1) * at.y + s);
}

/// What light does to it is still to be found out.
Shaded Unlit(Meeting at, Skin skin, uint key) {
  Shaded s;
  s.p = at.p, s.n = skin.n, s.g = at.facing, s.color = skin.color;
  s.emission = at.front > 0.0 ? skin.emission : vec3(0.0);
  s.metallic = skin.metallic, s.roughness = skin.roughness, s.transmission = skin.transmission;
  s.coat = skin.coat, s.coat_roughness = skin.coat_roughness, s.kind = skin.kind;
  s.r = reflect_above(at.d, s.n, at.facing);
  s.mirror = mirrors(skin);
  s.l = TowardsSun(key);
  s.sunlit = takes_sun(s.n, at.facing, s.kind, s.l) && sun_is_up(view.to_sun[2]) && view.has_sky != 0 ? 1.0 : 0.0;
  s.contact = 1.0;
  s.traced = s.clear = false;
  s.reflected = s.behind = vec3(0.0);
  s.lamp_front = s.lamp_back = s.lamp_shine = vec3(0.0);
  return s;
}

/// PrepareVector of surface_kernel.cc.
Shaded Prepare(Ray ray) {
  Fetched f = Fetch(ray);
  Meeting at = Meet(ray, f);
  // Rooms behind panes: what is seen through them, and where their pictures hang.
  RoomView room;
  if (f.t.window != 0) {
    room = LookInside(f, at);
    at.tu += room.du, at.tv += room.dv;
  }
  const Sampled sampled = SampleAll(f.m, ChooseCorners(f.m, at.tu, at.tv, at.footprint), at.tu, at.tv, at.footprint,
                                    StretchOf(f, at, ray.most_taps));
  Noises noises;
  Skin skin = PaintSkin(f, ray.instance, at, sampled, noises);
  if (f.m.normal_texture != 0) MapNormal(f, sampled.texel[2], skin);
  if (f.m.kind == kGlass) glaze(f.t.window != 0, f.pane, f.t.area, at.p, at.facing, skin);
  if (f.t.window != 0)
    furnish_pane(true, f.m.base_texture != 0, Tint(f), room, view.evening, view.lamplight, skin.color, skin.emission);
  if (f.m.kind == kWater && at.facing.z > 0.5) RaiseWaves(at, skin);
  if (LiesWeather()) LieWeather(f.m, noises, at.p, at.facing, at.width, at.tu, skin);
  skin.n = turn_to_viewer(skin.n, at.d);
  return Unlit(at, skin, ray.key);
}
