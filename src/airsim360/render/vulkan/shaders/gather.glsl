// What rays that look for ambient light bring: render/shading/ambient_kernel.cc for one lane.
#include "high_records.h"
layout(buffer_reference, scalar, buffer_reference_align = 8) buffer High { GpuHigh v; };
#define bounce push.frame.v.high.v

/// 1 where the sun map says that the sun is seen, or knows nothing.
float MapSun(vec3 p, float bias) {
  if (bounce.sun_size == 0) return 0.0;
  float at[3];
  for (int k = 0; k < 3; ++k)
    at[k] = p.x * bounce.sun_axes[4 * k] + p.y * bounce.sun_axes[4 * k + 1] + p.z * bounce.sun_axes[4 * k + 2] +
            bounce.sun_axes[4 * k + 3];
  const float last = float(bounce.sun_size - 1u);
  if (!(at[0] > 0.0 && at[0] < last && at[1] > 0.0 && at[1] < last)) return 1.0;
  return at[2] + bias < bounce.sun_heights.v[uint(at[1]) * bounce.sun_size + uint(at[0])] ? 0.0 : 1.0;
}

/// Irradiance by one of the eight probes around, chosen by its weight; by all where that one is inside a solid.
vec3 NearProbe(vec3 p, vec3 n) {
  if (view.has_probes == 0) return UniformFrom(n);
  const ProbeCell cell = ProbeCellAt(p, n);
  const uvec3 millimetres = uvec3(ivec3(floor(p * kProbeGrains)));
  uint hash = millimetres.x * 0x9e3779b1u ^ millimetres.y * 0x85ebca77u ^ millimetres.z * 0xc2b2ae3du;
  hash = hash_bits(hash);
  uint at = cell.lowest;
  if (float(hash & 0x3ffu) * kTenBits < cell.inside.x) at += 16u;
  if (float((hash >> 10) & 0x3ffu) * kTenBits < cell.inside.y) at += uint(view.probe_stride_y) * 16u;
  if (float((hash >> 20) & 0x3ffu) * kTenBits < cell.inside.z) at += uint(view.probe_stride_z) * 16u;
  Floats t = view.probes;
  if (t.v[at + 3] < 0.5) return SampleProbes(p, n, n, n).front;
  const vec3 e = vec3(t.v[at], t.v[at + 1], t.v[at + 2]) + vec3(t.v[at + 4], t.v[at + 5], t.v[at + 6]) * n.x +
                 vec3(t.v[at + 8], t.v[at + 9], t.v[at + 10]) * n.y +
                 vec3(t.v[at + 12], t.v[at + 13], t.v[at + 14]) * n.z +
                 vec3(t.v[at + 7], t.v[at + 11], t.v[at + 15]) * (n.z * n.z);
  return max(e * (1.0 / t.v[at + 3]), vec3(0.0));
}

uint LampCellAt(vec3 q) {
  const ivec3 n = ivec3(view.lamp_n[0], view.lamp_n[1], view.lamp_n[2]);
  if (!(all(greaterThanEqual(q, vec3(0.0))) && all(lessThan(q, vec3(n))))) return 0;
  const ivec3 i = ivec3(q);
  return view.lamp_cell_of.v[(i.z * n.y + i.y) * n.x + i.x];
}

/// Irradiance by the lamps near a point, as the nearest cell has it on average (LampGrid::NearIrradiance).
vec3 NearLamps(vec3 p, vec3 n) {
  if (view.has_lamps == 0) return vec3(0.0);
  const vec3 q = (p - Vec(view.lamp_origin)) * view.lamp_cells_per_metre;
  uint cell = LampCellAt(q + 0.5 * n);
  if (cell == 0) cell = LampCellAt(q);
  const uint at = 6 * cell;
  return Load3(bounce.lamp_sides, at + (n.x < 0.0 ? 1u : 0u)) * (n.x * n.x) +
         Load3(bounce.lamp_sides, at + (n.y < 0.0 ? 3u : 2u)) * (n.y * n.y) +
         Load3(bounce.lamp_sides, at + (n.z < 0.0 ? 5u : 4u)) * (n.z * n.z);
}

/// Whether a triangle is a lamp of the grid, whose light is accounted for already.
bool IsGridLamp(uint instance, uint triangle) {
  if (view.has_lamps == 0) return false;
  const uint first = bounce.lamp_bits_of.v[instance];
  if (first == 0) return false;
  const uint bit = first + triangle;
  return (bounce.lamp_bits.v[bit >> 5] >> (bit & 31u) & 1u) != 0;
}

/// Whether a ray met a surface from behind, where no lamp shines. In an instance that mirrors, the front has its corners clockwise.
bool ShowsBack(uint instance, Surface met) {
  GpuInstance placed = push.frame.v.instances.v[instance];
  const bool mirrored = dot(Turn(placed.A, vec3(1, 0, 0)), cross(Turn(placed.A, vec3(0, 1, 0)), Turn(placed.A, vec3(0, 0, 1)))) < 0.0;
  return met.back != mirrored;
}

/// Light along a ray that looks for ambient light and met `h` (t, instance, primitive).
vec3 Gathered(Hit h, vec3 origin, vec3 d) {
  if (h.instance == kMiss) return view.has_sky != 0 ? SampleSky(view.blurred[0], d, true) : Vec(view.mean_ambient);
  const Surface met = Resolve(h, d);
  const GpuShaded own = view.instances.v[h.instance];
  const GpuTriangle t = view.triangles.v[own.first_triangle + met.triangle];
  const uint id = t.material & ~kMirroredUv;
  const GpuMaterial m = view.materials.v[id];
  vec3 emission = Load3(view.mean_emissions, id);
  if (view.has_glows != 0) emission *= Load3(view.glows, h.instance);
  if (emission != vec3(0.0) && (ShowsBack(h.instance, met) || IsGridLamp(h.instance, met.triangle))) emission = vec3(0.0);
  const vec3 glow = Vec(view.mean_ambient);
  if (glow.x + glow.y + glow.z > 0.0) {
    // Closed rooms that glow do so less where something is near.
    const float t2 = h.t * h.t;
    return glow * (kRoomNear + kRoomFar * t2 / (t2 + 0.5)) + emission;
  }
  const vec3 p = origin + d * h.t, n = met.normal;
  const bool foliage = m.kind == kFoliage;
  vec3 light = NearProbe(p, n) * (foliage ? SHADE_CROWN : 1.0) + NearLamps(p, -d);
  if (bounce.sun_size != 0) {
    const float cosine = dot(n, Vec(view.to_sun)), leaf = foliage ? m.transmission : 0.0;
    const float share = max(cosine, 0.0) + max(-cosine, 0.0) * leaf;
    light += Vec(view.sun_irradiance) * (share * MapSun(p, foliage ? SHADE_LEAF_BIAS : bounce.sun_bias) * CloudShadow(p));
  }
  const vec3 color = Load3(view.mean_colors, id) * VertexColors(own, met.triangle, vec2(1.0 / 3.0));
  const vec3 albedo = min(color * vec3(own.tint[0], own.tint[1], own.tint[2]), vec3(kMostBounced));
  return diffuse(albedo, light) + emission;
}
