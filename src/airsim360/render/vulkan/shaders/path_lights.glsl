// Lights of tier `reference`: the sun's disc, the sky, lamps (render/reference/path_lights.cc, render/lights/light_tree.cc,
// render/sky/sky_sampler.cc for one lane).
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer LightNodes;
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer PathLamps;
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer LampParts;
#include "path_records.h"
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer LightNodes { GpuLightNode v[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer PathLamps { GpuPathLamp v[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer LampParts { GpuLampPart v[]; };
layout(buffer_reference, scalar, buffer_reference_align = 8) buffer PathTables { GpuPath v; };
#define tables push.frame.v.path.v

const float kTau = 2.0 * SHADE_PI, kHalfPi = 0.5 * SHADE_PI;
const int kSkyCells = 256;

/// A direction to a light, what it sends from there, its density per solid angle, how far it is.
struct LightRay {
  vec3 direction, radiance;
  float pdf, reach;
};

float ArcCosine(float x) { return kHalfPi - asin_approx(clamp(x, -1.0, 1.0)); }

float SunPdf(vec3 d) {
  const vec3 off = d - Vec(view.to_sun);
  return tables.has_sun != 0 && dot(off, off) < SUN_RADIUS * SUN_RADIUS ? 2.0 / (kTau * SUN_RADIUS * SUN_RADIUS) : 0.0;
}

vec3 SunRadiance(vec3 p, vec3 d) {
  const vec3 off = d - Vec(view.to_sun);
  const float x2 = dot(off, off) / (SUN_RADIUS * SUN_RADIUS);
  if (tables.has_sun == 0 || x2 >= 1.0) return vec3(0.0);
  return Vec(view.sun_radiance) * (SUN_LIMB_GAIN * sun_limb(x2) * CloudShadow(p));
}

LightRay SampleSun(vec3 p, vec2 u) {
  const vec3 s = Vec(view.to_sun), reference = abs(s.z) < kUpright ? vec3(0.0, 0.0, 1.0) : vec3(1.0, 0.0, 0.0);
  const vec3 right = normalize(cross(reference, s)), up = cross(s, right);
  // The chord to the disc's centre squared is even over solid angle.
  const float chord = SUN_RADIUS * sqrt(u.x), turn = kTau * u.y, side = chord * sqrt(1.0 - 0.25 * chord * chord);
  const vec3 d = normalize(s * (1.0 - 0.5 * chord * chord) + right * (side * cos_approx(turn)) + up * (side * sin_approx(turn)));
  return LightRay(d, SunRadiance(p, d), SunPdf(d), 1e30);
}

/// First of 256 running shares above u, and where in its step u lies.
int FindShare(Floats shares, uint first, float u, out float inside) {
  int low = 0, high = kSkyCells - 1;
  while (low < high) {
    const int middle = (low + high) / 2;
    if (shares.v[first + uint(middle)] > u) high = middle;
    else low = middle + 1;
  }
  const float below = low > 0 ? shares.v[first + uint(low) - 1u] : 0.0;
  inside = clamp((u - below) / max(shares.v[first + uint(low)] - below, kLeastStep), 0.0, kBelowOne);
  return low;
}

LightRay SampleSkyLight(vec2 u) {
  float across, up;
  const int row = FindShare(tables.sky_rows, 0, u.y, up);
  const int column = FindShare(tables.sky_cumulative, uint(row * kSkyCells), u.x, across);
  const float z = clamp((float(row) + up) * (2.0 / float(kSkyCells)) - 1.0, -1.0, 1.0);
  const float azimuth = (float(column) + across) * (kTau / float(kSkyCells)), s = sqrt(max(0.0, 1.0 - z * z));
  const vec3 d = vec3(s * cos_approx(azimuth), s * sin_approx(azimuth), z);
  return LightRay(d, vec3(1.0), tables.sky_density.v[row * kSkyCells + column], 1e30);
}

float SkyPdf(vec3 d) {
  float azimuth = atan2_approx(d.y, d.x);
  if (azimuth < 0.0) azimuth += kTau;
  const int x = clamp(int(azimuth * (float(kSkyCells) / kTau)), 0, kSkyCells - 1);
  const int y = clamp(int((d.z + 1.0) * (0.5 * float(kSkyCells))), 0, kSkyCells - 1);
  return tables.sky_density.v[y * kSkyCells + x];
}

float CosineWithin(float angle, float cone) {
  const float left = max(0.0, angle - cone);
  return left > kHalfPi + kLampMargin ? 0.0 : max(cos_approx(left), kLampLeastCosine);
}

float Importance(uint node, vec3 p, vec3 normal) {
  const GpuLightNode b = tables.nodes.v[node];
  const vec3 to = Vec(b.center) - p;
  const float distance2 = dot(to, to), clamped2 = max(max(distance2, b.radius2), kLampDistance2);
  // Inside the sphere about the box light may come from anywhere.
  if (distance2 <= b.radius2) return b.power / clamped2;
  const vec3 w = to / sqrt(distance2);
  const float subtended = asin_approx(sqrt(min(1.0, b.radius2 / distance2)));
  const float emitted = CosineWithin(ArcCosine(-dot(Vec(b.axis), w)), b.spread + subtended);
  const float received = normal == vec3(0.0) ? 1.0 : CosineWithin(ArcCosine(dot(normal, w)), subtended);
  return b.power * emitted * received / clamped2;
}

LightRay SampleLamp(vec3 p, vec3 normal, vec3 u) {
  const LightRay none = LightRay(vec3(0.0, 0.0, 1.0), vec3(0.0), 0.0, 0.0);
  if (!(Importance(0, p, normal) > 0.0)) return none;
  uint at = 0;
  float probability = 1.0, rest = u.x;
  while (tables.nodes.v[at].second != 0) {
    const float first = Importance(at + 1, p, normal), second = Importance(tables.nodes.v[at].second, p, normal);
    const float sum = first + second;
    if (!(sum > 0.0)) return none;
    const float share = first / sum;
    const bool to_first = rest < share;
    rest = clamp(to_first ? rest / share : (rest - share) / (1.0 - share), 0.0, 1.0 - 1.0 / 16777216.0);
    probability *= to_first ? share : second / sum;
    at = to_first ? at + 1 : tables.nodes.v[at].second;
  }
  // A triangle by area, with what is left of the first random number; a point of it.
  const GpuPathLamp lamp = tables.lamps.v[tables.nodes.v[at].lamp];
  uint low = lamp.first, high = lamp.first + lamp.count - 1;
  while (low < high) {
    const uint middle = (low + high) / 2;
    if (tables.parts.v[middle].share > rest) high = middle;
    else low = middle + 1;
  }
  const GpuLampPart part = tables.parts.v[low];
  const float root = sqrt(u.y), b0 = 1.0 - root, b1 = root * (1.0 - u.z), b2 = root * u.z;
  const vec3 point = vec3(part.corner[0], part.corner[1], part.corner[2]) * b0 +
                     vec3(part.corner[3], part.corner[4], part.corner[5]) * b1 +
                     vec3(part.corner[6], part.corner[7], part.corner[8]) * b2;
  const vec3 way = point - p;
  const float distance_ = length(way);
  const vec3 d = way / max(distance_, kLampDistance);
  const float cosine = -dot(Vec(part.normal), d);
  if (cosine < kLampGrazing) return none;
  const GpuTriangle t = view.triangles.v[part.triangle];
  const GpuMaterial m = view.materials.v[t.material & ~kMirroredUv];
  vec3 radiance = Vec(m.emission);
  if (m.emission_texture != 0) {
    const uint id = m.emission_texture;
    radiance *= SampleLevel(id, 0, FoldCoordinate(t.uv[0] * b0 + t.uv[2] * b1 + t.uv[4] * b2, view.textures.v[id].wrap_u),
                            FoldCoordinate(t.uv[1] * b0 + t.uv[3] * b1 + t.uv[5] * b2, view.textures.v[id].wrap_v));
  }
  radiance *= Vec(lamp.glow);
  if (m.beam == kWindowBeam) {
    radiance = window_light(HashOf(t.pane ^ lamp.hash), t.area) * luminance(radiance);
  } else if (m.beam != 0.0) {
    const vec3 beam = Vec(lamp.beam);
    radiance *= beam_shape(sqrt(dot(beam, beam)), -dot(beam, d), -d.z);
  }
  return LightRay(d, radiance, probability / lamp.area * distance_ * distance_ / cosine, distance_);
}

/// Density per solid angle with which SampleLamp finds a point of a triangle that is met.
float LampPdf(vec3 p, vec3 normal, uint instance, uint triangle, float distance_, float cosine) {
  if (tables.lamp_count == 0) return 0.0;
  const uint first = tables.lamp_of_first.v[instance];
  if (first == 0) return 0.0;
  const uint found = tables.lamp_of.v[first + triangle];
  if (found == 0 || !(Importance(0, p, normal) > 0.0)) return 0.0;
  const GpuPathLamp lamp = tables.lamps.v[found - 1];
  float probability = 1.0;
  for (uint at = lamp.leaf; at != 0; at = tables.nodes.v[at].parent) {
    const uint parent = tables.nodes.v[at].parent, other = at == parent + 1 ? tables.nodes.v[parent].second : parent + 1;
    const float own = Importance(at, p, normal), sum = own + Importance(other, p, normal);
    if (!(sum > 0.0)) return 0.0;
    probability *= own / sum;
  }
  return probability / lamp.area * distance_ * distance_ / max(cosine, kLampGrazing);
}
