// From a hit to a surface: render/shading/surface_kernel.cc and surface_detail.h for one lane.

struct Ray {
  vec3 origin, direction;
  float distance_, width;
  vec2 bary;
  uint instance, primitive, key;
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
  at.slant = max(abs(dot(at.facing, at.d)), 0.03);
  at.footprint =
      log2_approx(max(ray.width, 1e-9)) - 0.75 * log2_approx(at.slant) + (f.t.texels_log2 + f.own.texels_log2);
  return at;
}

/// Base colour of the material as the instance tints it.
vec3 Tint(Fetched f) { return vec3(f.m.base[0] * f.own.tint[0], f.m.base[1] * f.own.tint[1], f.m.base[2] * f.own.tint[2]); }

float FoldPicture(float x, float half_) {
  return abs(x) > half_ ? (x > 0.0 ? 2.0 * half_ - x : -2.0 * half_ - x) : x;
}

/// A look through a pane.
struct RoomView {
  vec3 daylight, lamplight;
  float front;   // 1 where something near hides the back wall
  float du, dv;  // how far a picture on the back wall seems shifted
};
RoomView LookInside(Fetched f, Meeting at) {
  const GpuPane q = view.panes.v[f.t.window - 1];
  const float a = q.a[0] * at.w + q.a[1] * at.u + q.a[2] * at.v, b = q.b[0] * at.w + q.b[1] * at.u + q.b[2] * at.v;
  const float room = HashOf((q.hash ^ f.own.hash) * 0x85ebca6bu + 77u);
  const bool lit = hash_again(room, 811.3) < view.lit_rooms || f.m.emission[0] > 0.0;
  const vec3 light = view.evening > 0.0 ? evening_light(room, f.t.area) : day_light(room);
  RoomView seen;
  seen.daylight = seen.lamplight = vec3(0.0), seen.front = 0.0;
  float back_a = a, back_b = b;
  interior_room(a, b, q.half_a, q.half_b, dot(at.d, Row3(f.matrix, UnpackDirection(q.right))),
                dot(at.d, Row3(f.matrix, UnpackDirection(q.up))), -dot(at.d, at.facing), room, lit ? light : vec3(0.0),
                seen.daylight, seen.lamplight, seen.front, back_a, back_b);
  seen.du = (FoldPicture(back_a, q.half_a) - a) * q.u_per_a;
  seen.dv = (min(max(back_b, -q.half_b), q.half_b) - b) * q.v_per_b;
  return seen;
}

vec3 LeafTint(GpuMaterial m, float pane, vec3 color) {
  const float amount = clamp01((m.transmission - 0.4) * 5.0), h2 = hash_again(pane, 61.7);
  const float light = 1.0 + (pane - 0.5) * 0.44 * amount, yellow = (h2 - 0.42) * 0.34 * amount;
  return vec3(color.x * light * (1.0 + yellow), color.y * light, color.z * light * (1.0 - yellow * 0.6));
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
    color *= MacroTint(m, noises, at.width) * wall_wear(noises.wide, noises.mid, noises.fine, at.width, noises.wall);
  color *= UnitTint(m, at.tu, at.tv, at.footprint);
  if (wear) WearGround(m, noises, at.p, at.tu, at.width, color, roughness);
  if (m.kind == kFoliage) color = LeafTint(m, f.pane, color);
  color = min(color, vec3(1.0));
  roughness = min(max(roughness, 0.03), 1.0);
  return Skin(color, metallic, roughness, m.clear_coat, m.clear_coat_roughness, m.transmission, m.kind, at.n, emission);
}

/// A part of the normal map's slope; what mipmapping shortened becomes roughness (Toksvig 2005).
void MapNormal(Fetched f, vec3 texel, inout Skin s) {
  const vec3 bend = texel * 2.0 - 1.0;
  const float length_ = min(sqrt(dot(bend, bend)), 1.0), scale = f.m.normal_scale;
  const vec3 t0 = Row3(f.matrix, UnpackDirection(f.t.tangent));
  const vec3 along = normalize3(t0 - s.n * dot(s.n, t0));
  const vec3 beside = cross(s.n, along) * ((f.t.material & kMirroredUv) != 0 ? -1.0 : 1.0);
  s.n = normalize3(along * (bend.x * scale) + beside * (bend.y * scale) + s.n * max(bend.z, 0.05));
  const float variance = (1.0 - length_) / max(length_, 0.2) * scale * scale;
  const float alpha = s.roughness * s.roughness;
  s.roughness = max(sqrt(sqrt(min(alpha * alpha + 2.0 * variance * variance + variance * 0.5, 1.0))), s.roughness);
}

/// Panes are smooth; behind some without a room hangs something.
void Glaze(Fetched f, Meeting at, inout Skin s) {
  const float pane = f.pane;
  s.n = GlassNormal(pane, s.n, at.p);
  s.roughness = min(s.roughness, 0.08);
  if (f.t.window != 0) return;
  const float blind =
      clamp01((0.30 - pane) * 40.0) * clamp01((f.t.area - 0.7) * 4.0) * clamp01((0.3 - abs(at.facing.z)) * 8.0);
  const float shade = blind * 0.16 * (0.6 + 1.3 * pane);
  s.color = s.color * (1.0 - shade) + vec3(shade, shade * 0.97, shade * 0.88);
  // No two blinds or curtains have the same colour.
  if (f.m.transmission < 0.01 && luminance(s.color) > 0.10) {
    const float warm = 0.16 * (hash_again(pane, 61.7) - 0.5), light = 0.58 + 0.74 * pane;
    s.color = vec3(s.color.x * light * (1.0 + warm), s.color.y * light, s.color.z * light * (1.0 - warm));
  }
}

/// The room instead of a flat colour; panes with a picture keep that as back wall.
void FurnishPane(Fetched f, RoomView room, inout Skin s) {
  const vec3 tint = Tint(f);
  const float most = max(tint.x, max(tint.y, max(tint.z, 1e-3)));
  const vec3 glass = lerp3(vec3(0.86, 0.87, 0.86), tint * (0.8 / most), 0.5);
  if (f.m.base_texture == 0) {
    s.color = room.daylight * glass + tint * 0.15;
    s.emission = room.lamplight * glass * view.lamplight;
  } else if (room.front > 0.5) {
    s.color = room.daylight * 1.6;
    // By night what is displayed stands in the light of the shop alone.
    s.emission = s.emission * 0.25 + room.daylight * (view.evening > 0.0 ? 1.5 * view.lamplight : 0.5);
  }
}

void RaiseWaves(Meeting at, inout Skin s) {
  float lost = 0.0;
  s.n = Waves(at.p, at.width / sqrt(at.slant), lost);
  s.roughness = min(sqrt(sqrt(2.0 * lost + 1e-5)), 0.5);
}

/// The sun's centre, or for samples beside the pixel's centre a point of its disc.
vec3 TowardsSun(uint key) {
  const vec3 s = Vec(view.to_sun);
  if (key == 0) return normalize3(s);
  uint h = (key ^ (key >> 16)) * 0x7feb352du;
  h = (h ^ (h >> 15)) * 0x846ca68bu;
  h = h ^ (h >> 16);
  const float a = float((h >> 8) & 0xfffu) * (1.0 / 4096.0), b = float((h >> 20) & 0xfffu) * (1.0 / 4096.0);
  const float radius = sqrt(a) * 0.00462, angle = b * (2.0 * SHADE_PI);
  const float flat2 = s.x * s.x + s.y * s.y;
  const vec3 e1 = flat2 > 1e-6 ? vec3(-s.y, s.x, 0.0) / sqrt(flat2) : vec3(1.0, 0.0, 0.0);
  return normalize3(e1 * (radius * sin_approx(angle + 0.5 * SHADE_PI)) + cross(s, e1) * (radius * sin_approx(angle)) + s);
}

/// What light does to it is still to be found out.
Shaded Unlit(Meeting at, Skin skin, uint key) {
  Shaded s;
  s.p = at.p, s.n = skin.n, s.g = at.facing, s.color = skin.color;
  s.emission = at.front > 0.0 ? skin.emission : vec3(0.0);
  s.metallic = skin.metallic, s.roughness = skin.roughness, s.transmission = skin.transmission;
  s.coat = skin.coat, s.coat_roughness = skin.coat_roughness, s.kind = skin.kind;
  const vec3 r = reflect3(at.d, s.n);
  const float below = dot(r, at.facing);
  s.r = below < 0.01 ? normalize3(r + at.facing * (0.02 - below)) : r;
  s.mirror = s.kind == kGlass || s.kind == kWater || (s.roughness < 0.12 && s.metallic > 0.3) ||
             (s.coat > 0.25 && s.coat_roughness < 0.12);
  s.l = TowardsSun(key);
  // Leaves from behind, too, but nothing where the two normals disagree about the side.
  const float above = dot(s.n, s.l);
  const bool lit = above * dot(at.facing, s.l) > 0.0 && (above > 0.0 || s.kind == kFoliage);
  s.sunlit = lit && view.to_sun[2] > -0.02 && view.has_sky != 0 ? 1.0 : 0.0;
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
  const Sampled sampled = SampleAll(f.m, ChooseCorners(f.m, at.tu, at.tv, at.footprint), at.tu, at.tv, at.footprint);
  Noises noises;
  Skin skin = PaintSkin(f, ray.instance, at, sampled, noises);
  if (f.m.normal_texture != 0) MapNormal(f, sampled.texel[2], skin);
  if (f.m.kind == kGlass) Glaze(f, at, skin);
  if (f.t.window != 0) FurnishPane(f, room, skin);
  if (f.m.kind == kWater && at.facing.z > 0.5) RaiseWaves(at, skin);
  if (LiesWeather()) LieWeather(f.m, noises, at.p, at.facing, at.width, at.tu, skin);
  // A bent normal must not look away from the viewer.
  const float towards = dot(skin.n, at.d);
  if (towards > -0.02) skin.n = normalize3(skin.n - at.d * (towards + 0.02));
  return Unlit(at, skin, ray.key);
}
