// Kernel: rays that look for ambient light, what they bring, and scattered reflections (tier `high`).
#include "airsim360/render/shading/shading_ambient.h"
#include "airsim360/render/shading/shading_kernels.h"

namespace airsim360::internal::AIRSIM360_ISA {
namespace {

constexpr float kVisibleSkin = 0.08f;  // reflectance from which a blurred reflection deserves a ray

/// Surfaces of sixteen lanes, gathered.
struct alignas(64) Gathered {
  alignas(64) float px[16], py[16], pz[16], nx[16], ny[16], nz[16], gx[16], gy[16], gz[16], distance[16];
};

/// What sixteen rays met.
struct alignas(64) Met {
  alignas(64) int32_t normal[16];
  alignas(64) float m[9][16], albedo[3][16], emission[3][16], leaf[16], hit[16];
};

KERNEL void FetchMet(const ShadeView& view, const AmbientHits& hits, Met& met) {
  for (int i = 0; i < 16; ++i) {
    const bool hit = hits.instance[i] != kMiss;
    met.hit[i] = hit ? 1.0f : 0.0f;
    const InstanceRecord& placed = view.instances[hit ? hits.instance[i] : 0];
    const TriangleRecord& record = view.triangles[placed.first_triangle + (hit ? hits.triangle[i] : 0)];
    const uint32_t id = record.material & ~kMirroredUv;
    const MaterialRecord& material = view.materials[id];
    met.normal[i] = static_cast<int32_t>(record.geometric_normal);
    for (int k = 0; k < 9; ++k) met.m[k][i] = placed.normal_matrix[k];
    for (int k = 0; k < 3; ++k) {
      const float albedo = view.mean_colors[3 * id + static_cast<uint32_t>(k)] * placed.tint[k];
      met.albedo[k][i] = albedo < 0.9f ? albedo : 0.9f;
      met.emission[k][i] = hit ? material.emission[k] * hits.shines[i] : 0.0f;
    }
    met.leaf[i] = material.kind == BSDF_FOLIAGE ? material.transmission : 0.0f;
  }
}

KERNEL real3 MetNormal(const Met& met, int i) {
  const ireal p(met.normal + i, stdx::vector_aligned);
  constexpr float scale = 2.0f / 65534.0f;
  const real3 a =
      octahedral_decode(to_real(p & 0xffff) * scale - 1.0f, to_real((p >> 16) & 0xffff) * scale - 1.0f);
  const auto row = [&](int k) __attribute__((always_inline)) {
    return load(met.m[k] + i) * a.x + load(met.m[k + 1] + i) * a.y + load(met.m[k + 2] + i) * a.z;
  };
  return normalize3(make3(row(0), row(3), row(6)));
}

/// 1 where the sun map says that the sun is seen, or knows nothing.
KERNEL real SunSeen(const SunMapView& map, real3 p) {
  const auto affine = [&](const float* m) __attribute__((always_inline)) {
    return p.x * m[0] + p.y * m[1] + p.z * m[2] + m[3];
  };
  const real last = real(static_cast<float>(map.size - 1)), zero = real(0.0f);
  const real column = affine(map.column), row = affine(map.row);
  const mask_t inside = (column > 0.0f) && (column < last) && (row > 0.0f) && (row < last);
  alignas(64) int32_t index[kLanes];
  alignas(64) float height[kLanes];
  (to_int(rmin(last, rmax(zero, row))) * map.size + to_int(rmin(last, rmax(zero, column))))
      .copy_to(index, stdx::vector_aligned);
  for (int i = 0; i < kLanes; ++i) height[i] = map.heights[index[i]];
  return sel(inside && (affine(map.height) + map.bias < load(height)), zero, real(1.0f));
}

/// Irradiance of the eight probes around, weighted, for one lane.
KERNEL Quad AllProbes(const ProbeView& grid, const float* base, const float* f, const float* n) {
  Quad terms[4] = {};
  for (int k = 0; k < 8; ++k) {
    const float* probe = base + ((k & 1) + (k & 2 ? grid.stride_y : 0) + (k & 4 ? grid.stride_z : 0)) * 16;
    const float weight = (k & 1 ? f[0] : 1 - f[0]) * (k & 2 ? f[1] : 1 - f[1]) * (k & 4 ? f[2] : 1 - f[2]);
    for (int j = 0; j < 4; ++j) terms[j] += LoadQuad(probe + 4 * j) * weight;
  }
  const float scale = 1.0f / terms[0][3];
  const Quad square = {terms[1][3], terms[2][3], terms[3][3], 0};
  return (terms[0] + terms[1] * n[0] + terms[2] * n[1] + terms[3] * n[2] + square * (n[2] * n[2])) * scale;
}

/// Irradiance by probes: one of the eight around, chosen with the probability of its weight (which is right
/// on average and reads one cache line); all eight where the chosen one is inside a solid. The choice hangs
/// on the bits of the point alone.
KERNEL real3 NearProbe(const ShadeView& view, real3 p, real3 n) {
  const ProbeView& grid = view.probes;
  if (grid.probes == nullptr) return UniformAmbient(view, n, n).front;
  const real3 q = p + n * real(0.45f / grid.cells_per_metre);
  const real zero = real(0.0f);
  const real x = rmin(real(grid.max_x + 0.9999f), rmax(zero, (q.x - grid.origin_x) * grid.cells_per_metre));
  const real y = rmin(real(grid.max_y + 0.9999f), rmax(zero, (q.y - grid.origin_y) * grid.cells_per_metre));
  const real h = rmin(real(grid.height_last), rmax(zero, (q.z - grid.height_origin) * grid.height_scale));
  alignas(64) float layer[kLanes];
  store(layer, rfloor(h + 0.5f));
  for (int i = 0; i < kLanes; ++i) layer[i] = grid.layer_of_height[static_cast<int>(layer[i])];
  const real z = load(layer);
  const real x0 = rmin(rfloor(x), real(grid.max_x)), y0 = rmin(rfloor(y), real(grid.max_y)),
             z0 = rmin(rfloor(z), real(grid.max_z));
  alignas(64) float fx[kLanes], fy[kLanes], fz[kLanes], nx[kLanes], ny[kLanes], nz[kLanes];
  alignas(64) int32_t index[kLanes], bits_x[kLanes], bits_y[kLanes], bits_z[kLanes];
  store3(fx, fy, fz, make3(x - x0, y - y0, z - z0));
  store3(nx, ny, nz, n);
  bits_of(p.x).copy_to(bits_x, stdx::vector_aligned);
  bits_of(p.y).copy_to(bits_y, stdx::vector_aligned);
  bits_of(p.z).copy_to(bits_z, stdx::vector_aligned);
  ((to_int(z0) * grid.stride_z + to_int(y0) * grid.stride_y + to_int(x0)) * 16)
      .copy_to(index, stdx::vector_aligned);
  ColorLanes out;
  for (int i = 0; i < kLanes; ++i) {
    uint32_t hash = static_cast<uint32_t>(bits_x[i]) * 0x9e3779b1u ^
                    static_cast<uint32_t>(bits_y[i]) * 0x85ebca77u ^
                    static_cast<uint32_t>(bits_z[i]) * 0xc2b2ae3du;
    hash = (hash ^ (hash >> 16)) * 0x7feb352du;
    hash = (hash ^ (hash >> 15)) * 0x846ca68bu;
    hash ^= hash >> 16;
    const auto above = [&](float f, int shift) __attribute__((always_inline)) {
      return static_cast<float>((hash >> shift) & 0x3ff) * (1.0f / 1024) < f;
    };
    const float* base = grid.probes + index[i];
    const float* probe = base + ((above(fx[i], 0) ? 1 : 0) + (above(fy[i], 10) ? grid.stride_y : 0) +
                                 (above(fz[i], 20) ? grid.stride_z : 0)) *
                                    16;
    const float direction[3] = {nx[i], ny[i], nz[i]};
    if (probe[3] < 0.5f) {
      const float f[3] = {fx[i], fy[i], fz[i]};
      out.Set(i, AllProbes(grid, base, f, direction));
      continue;
    }
    const Quad t0 = LoadQuad(probe), t1 = LoadQuad(probe + 4), t2 = LoadQuad(probe + 8),
               t3 = LoadQuad(probe + 12);
    const Quad square = {t1[3], t2[3], t3[3], 0};
    out.Set(i, (t0 + t1 * nx[i] + t2 * ny[i] + t3 * nz[i] + square * (nz[i] * nz[i])) * (1.0f / t0[3]));
  }
  const real3 e = out.Get();
  return make3(rmax(e.x, zero), rmax(e.y, zero), rmax(e.z, zero));
}

/// Light of the surface met, towards the ray's origin.
KERNEL real3 Bounced(const ShadeView& view, const SunMapView& map, const AmbientHits& hits, const Met& met,
                     int i, real3 p, real3 d, real distance) {
  const real3 emission = load3(met.emission[0] + i, met.emission[1] + i, met.emission[2] + i);
  const real3 glow{real(view.mean_ambient[0]), real(view.mean_ambient[1]), real(view.mean_ambient[2])};
  if (view.mean_ambient[0] + view.mean_ambient[1] + view.mean_ambient[2] > 0.0f) {
    // Closed rooms that glow do so less where something is near: the model that their probes use.
    const real t2 = distance * distance;
    return glow * (0.35f + 0.65f * t2 / (t2 + 0.5f)) + emission;
  }
  const real3 outward = MetNormal(met, i);
  const real3 n = outward * sel(dot3(outward, d) > 0.0f, real(-1.0f), real(1.0f));
  real3 light = NearProbe(view, p, n) + load3(hits.lamp_r + i, hits.lamp_g + i, hits.lamp_b + i);
  if (map.heights != nullptr) {
    const real cosine = dot3(n, ufloat3{view.to_sun[0], view.to_sun[1], view.to_sun[2]});
    const real zero = real(0.0f);
    const real share = rmax(cosine, zero) + rmax(zero - cosine, zero) * load(met.leaf + i);
    light =
        light + Uniform(view.sun_irradiance) * (share * SunSeen(map, p) * CloudShadow(view.cloud_shadow, p));
  }
  const real3 albedo = load3(met.albedo[0] + i, met.albedo[1] + i, met.albedo[2] + i);
  return diffuse(albedo, light) + emission;
}

}  // namespace

void AmbientRays(const RaySet& rays, const SurfaceSet& s, const int* index, const float* side,
                 const float* sphere, RayHit16& out) {
  Gathered at;
  for (int i = 0; i < 16; ++i) {
    const int k = index[i];
    at.px[i] = s.px[k], at.py[i] = s.py[k], at.pz[i] = s.pz[k];
    at.nx[i] = s.nx[k], at.ny[i] = s.ny[k], at.nz[i] = s.nz[k];
    at.gx[i] = s.gx[k], at.gy[i] = s.gy[k], at.gz[i] = s.gz[k];
    at.distance[i] = rays.distance[k];
  }
  const ufloat3 w{sphere[0], sphere[1], sphere[2]};
  for (int i = 0; i < 16; i += kLanes) {
    const real flip = load(side + i);
    const real3 p = load3(at.px + i, at.py + i, at.pz + i);
    const real3 n = load3(at.nx + i, at.ny + i, at.nz + i) * flip;
    const real3 g = load3(at.gx + i, at.gy + i, at.gz + i) * flip;
    real3 d = n + w;
    const real length2 = dot3(d, d);
    d = sel3(length2 > 1e-6f, d * (1.0f / rroot(rmax(length2, real(1e-6f)))), n);
    // A direction under the surface itself, where the normal is bent, is mirrored up.
    const real below = dot3(d, g);
    d = sel3(below < 0.01f, normalize3(d + g * (0.02f - 2.0f * below)), d);
    const real lift = 1e-3f + 4e-6f * (rabs(p.x) + rabs(p.y) + rabs(p.z) + load(at.distance + i));
    store3(out.origin_x + i, out.origin_y + i, out.origin_z + i, p + g * lift);
    store3(out.direction_x + i, out.direction_y + i, out.direction_z + i, d);
  }
}

void ShadeAmbient(const ShadeView& view, const SunMapView& sun_map, const RayHit16& rays,
                  const AmbientHits& hits, float* r, float* g, float* b) {
  uint32_t any_hit = 0, any_miss = 0;
  for (int i = 0; i < 16; ++i) any_hit |= hits.instance[i] != kMiss, any_miss |= hits.instance[i] == kMiss;
  Met met;
  if (any_hit != 0) FetchMet(view, hits, met);
  for (int i = 0; i < 16; i += kLanes) {
    const real3 d = load3(rays.direction_x + i, rays.direction_y + i, rays.direction_z + i);
    real3 light = make3(real(view.mean_ambient[0]), real(view.mean_ambient[1]), real(view.mean_ambient[2]));
    if (view.has_sky > 0.5f && any_miss != 0) light = SampleSky(view.blurred[0], d, true);
    if (any_hit != 0) {
      const mask_t hit = load(met.hit + i) > 0.5f;
      const real t = sel(hit, load(rays.t_far + i), real(0.0f));
      const real3 p = load3(rays.origin_x + i, rays.origin_y + i, rays.origin_z + i) + d * t;
      light = sel3(hit, Bounced(view, sun_map, hits, met, i, p, d, t), light);
    }
    store3(r + i, g + i, b + i, light);
  }
}

void ScatterReflections(const RaySet& rays, const float* u, const float* v, SurfaceSet& s) {
  for (int i = 0; i < rays.count; i += kLanes) {
    const real roughness = load(s.roughness + i), metallic = load(s.metallic + i), kind = load(s.kind + i);
    const real coat = load(s.coat + i);
    const mask_t untraced = !(load(s.mirror + i) > 0.5f) && (kind < 0.5f);
    const mask_t coated = untraced && (coat > 0.05f);
    const mask_t rough = untraced && !coated && ((roughness < 0.5f) || (metallic > 0.2f));
    if (!stdx::any_of(coated || rough)) continue;
    const real3 d = load3(rays.dx + i, rays.dy + i, rays.dz + i);
    const real3 n = load3(s.nx + i, s.ny + i, s.nz + i), g = load3(s.gx + i, s.gy + i, s.gz + i);
    const Bsdf bsdf = bsdf_make(kind, load3(s.ar + i, s.ag + i, s.ab + i), metallic, roughness, real(0.0f),
                                coat, load(s.coat_roughness + i));
    const real n_dot_v = rmax(real(0.0f) - dot3(n, d), real(0.02f));
    const mask_t visible = luminance(bsdf_reflected(bsdf_side(bsdf, n_dot_v))) > kVisibleSkin;
    // A facet of the skin as the viewer sees it; a coat is taken as smooth.
    const BsdfLobes skin_alone{real(0.0f), real(1.0f), real(0.0f), real(0.0f), real(0.0f)};
    real event = real(0.0f);
    real3 r = bsdf_sample(bsdf, skin_alone, n, -d, real(0.5f), load(u + i), load(v + i), event);
    const real below = dot3(r, g);
    r = sel3(below < 0.01f, normalize3(r + g * (0.02f - 2.0f * below)), r);
    const mask_t turned = rough && visible;
    store3(s.rx + i, s.ry + i, s.rz + i, sel3(turned, r, load3(s.rx + i, s.ry + i, s.rz + i)));
    store(s.mirror + i, sel(turned || (coated && visible), real(1.0f), load(s.mirror + i)));
  }
}

}  // namespace airsim360::internal::AIRSIM360_ISA
