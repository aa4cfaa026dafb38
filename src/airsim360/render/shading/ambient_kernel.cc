// Kernel: rays that look for ambient light, what they bring, and scattered reflections (tier `high`).
#include "airsim360/render/shared/shading_ambient.h"
#include "airsim360/render/shared/shading_kernels.h"

namespace airsim360::internal::AIRSIM360_ISA {
namespace {

/// What sixteen rays met.
struct alignas(64) Met {
  alignas(64) int32_t normal[16];
  alignas(64) float m[9][16], albedo[3][16], emission[3][16], foliage[16], leaf[16], hit[16];
};

/// Vertex colours in the mean of each triangle, of vectors some lane of which lies in a mesh that has them.
static __attribute__((noinline)) void TintMet(const ShadeView& view, const AmbientHits& hits, const InstanceRecord* const* instance,
                                              int first, float (&mean)[3][kLanes]) {
  for (int i = 0; i < kLanes; ++i) {
    if (instance[i]->first_color == 0 || hits.instance[first + i] == kMiss) continue;
    const TriangleColors& colors = view.colors[instance[i]->first_color + hits.triangle[first + i]];
    for (int k = 0; k < 3; ++k) {
      const int sum = colors.corner[0][k] + colors.corner[1][k] + colors.corner[2][k];
      mean[k][i] *= static_cast<float>(sum) * (1.0f / (3 * 65535.0f));
    }
  }
}

KERNEL void FetchMet(const ShadeView& view, const AmbientHits& hits, Met& met) {
  for (int first = 0; first < 16; first += kLanes) {
    const InstanceRecord* instance[kLanes];
    const TriangleRecord* triangle[kLanes];
    const MaterialRecord* material[kLanes];
    alignas(64) float mean[3][kLanes];
    uint32_t colored = 0;
    for (int i = 0; i < kLanes; ++i) {
      const bool hit = hits.instance[first + i] != kMiss;
      met.hit[first + i] = hit ? 1.0f : 0.0f;
      instance[i] = &view.instances[hit ? hits.instance[first + i] : 0];
      triangle[i] = &view.triangles[instance[i]->first_triangle + (hit ? hits.triangle[first + i] : 0)];
      const uint32_t id = triangle[i]->material & ~kMirroredUv;
      colored |= instance[i]->first_color;
      material[i] = &view.materials[id];
      met.normal[first + i] = static_cast<int32_t>(triangle[i]->geometric_normal);
      const float shines = hit ? hits.shines[first + i] : 0.0f;
      for (uint32_t k = 0; k < 3; ++k) {
        mean[k][i] = view.mean_colors[3 * id + k];
        met.emission[k][first + i] = shines * view.mean_emissions[3 * id + k];
      }
      if (view.glows != nullptr && hit) {
        for (uint32_t k = 0; k < 3; ++k) met.emission[k][first + i] *= view.glows[3 * hits.instance[first + i] + k];
      }
    }
    if (colored != 0) TintMet(view, hits, instance, first, mean);
    const auto quad = [](const auto* const* records, int q) __attribute__((always_inline)) {
      return GatherQuads([&](int i) __attribute__((always_inline)) { return reinterpret_cast<const float*>(records[i]) + 4 * q; });
    };
    const real4 m0 = quad(instance, 0), m1 = quad(instance, 1), m2 = quad(instance, 2);
    const real rows[9] = {m0.x, m0.y, m0.z, m0.w, m1.x, m1.y, m1.z, m1.w, m2.x};
    for (int k = 0; k < 9; ++k) store(met.m[k] + first, rows[k]);
    const real tint[3] = {m2.y, m2.z, m2.w};
    for (int k = 0; k < 3; ++k) store(met.albedo[k] + first, rmin(load(mean[k]) * tint[k], real(kMostBounced)));
    const real4 b = quad(material, 2);  // transmission, …, kind
    store(met.foliage + first, sel(b.w == kFoliage, real(1.0f), real(0.0f)));
    store(met.leaf + first, sel(b.w == kFoliage, b.x, real(0.0f)));
  }
}

KERNEL real3 MetNormal(const Met& met, int i) {
  const ireal p(met.normal + i, stdx::vector_aligned);
  const real3 a = octahedral_decode(to_real(p & 0xffff) * kDirectionStep - 1.0f, to_real((p >> 16) & 0xffff) * kDirectionStep - 1.0f);
  const auto row = [&](int k) __attribute__((always_inline)) {
    return load(met.m[k] + i) * a.x + load(met.m[k + 1] + i) * a.y + load(met.m[k + 2] + i) * a.z;
  };
  return normalize3(make3(row(0), row(3), row(6)));
}

/// 1 where the sun map says that the sun is seen, or knows nothing.
KERNEL real SunSeen(const SunMapView& map, real3 p, real bias) {
  const auto affine = [&](const float* m) __attribute__((always_inline)) { return p.x * m[0] + p.y * m[1] + p.z * m[2] + m[3]; };
  const real last = real(static_cast<float>(map.size - 1)), zero = real(0.0f);
  const real column = affine(map.column), row = affine(map.row);
  const mask_t inside = (column > 0.0f) && (column < last) && (row > 0.0f) && (row < last);
  const real height = GatherFloats(map.heights, to_int(rmin(last, rmax(zero, row))) * map.size + to_int(rmin(last, rmax(zero, column))));
  return sel(inside && (affine(map.height) + bias < height), zero, real(1.0f));
}

/// Irradiance by probes: one of the eight around, chosen with the probability of its weight (which is right
/// on average and reads one cache line); all eight in `wanted` lanes where the chosen one is inside a solid. The
/// choice hangs on the point alone, to a millimetre, so that other back ends choose the same.
KERNEL real3 NearProbe(const ShadeView& view, mask_t wanted, real3 p, real3 n) {
  const ProbeView& grid = view.probes;
  if (grid.probes == nullptr) return UniformAmbient(view, n, n).front;
  const ProbePlace place = FindProbes(grid, p, n);
  const auto bits = [](real x) __attribute__((always_inline)) { return stdx::static_simd_cast<ureal>(to_int(rfloor(x * kProbeGrains))); };
  const ureal hash = hash_bits(bits(p.x) * 0x9e3779b1u ^ bits(p.y) * 0x85ebca77u ^ bits(p.z) * 0xc2b2ae3du);
  const auto step = [&](real f, int shift, int32_t stride) __attribute__((always_inline)) {
    const real u = to_real(stdx::static_simd_cast<ireal>((hash >> shift) & 0x3ffu)) * kTenBits;
    return to_int(sel(u < f, real(static_cast<float>(stride * 16)), real(0.0f)));
  };
  alignas(64) int32_t chosen[kLanes];
  (ireal(place.index, stdx::vector_aligned) + step(place.fx, 0, 1) + step(place.fy, 10, grid.stride_y) + step(place.fz, 20, grid.stride_z))
      .copy_to(chosen, stdx::vector_aligned);
  ProbeTerms terms = GatherTerms([&](int i) __attribute__((always_inline)) { return grid.probes + chosen[i]; });
  const mask_t solid = wanted && (terms.t[0].w < 0.5f);
  if (stdx::any_of(solid)) {
    const ProbeTerms all = MixProbes(grid, place);
    for (int j = 0; j < 4; ++j) {
      real4& t = terms.t[j];
      t = {sel(solid, all.t[j].x, t.x), sel(solid, all.t[j].y, t.y), sel(solid, all.t[j].z, t.z), sel(solid, all.t[j].w, t.w)};
    }
  }
  const real3 e = (Rgb(terms.t[0]) + Rgb(terms.t[1]) * n.x + Rgb(terms.t[2]) * n.y + Rgb(terms.t[3]) * n.z + terms.Square() * (n.z * n.z)) *
                  (1.0f / terms.t[0].w);
  const real zero = real(0.0f);
  return make3(rmax(e.x, zero), rmax(e.y, zero), rmax(e.z, zero));
}

/// Light of the surface met, towards the ray's origin.
KERNEL real3 Bounced(const ShadeView& view, const SunMapView& map, const AmbientHits& hits, const Met& met, int i, real3 p, real3 d,
                     real distance) {
  const real3 outward = MetNormal(met, i);
  const mask_t back = dot3(outward, d) > 0.0f;  // lamps shine to their front
  const real3 emission = load3(met.emission[0] + i, met.emission[1] + i, met.emission[2] + i) * sel(back, real(0.0f), real(1.0f));
  const real3 glow{real(view.mean_ambient[0]), real(view.mean_ambient[1]), real(view.mean_ambient[2])};
  if (view.mean_ambient[0] + view.mean_ambient[1] + view.mean_ambient[2] > 0.0f) {
    // Closed rooms that glow do so less where something is near: the model that their probes use.
    const real t2 = distance * distance;
    return glow * (kRoomNear + kRoomFar * t2 / (t2 + 0.5f)) + emission;
  }
  const real3 n = outward * sel(back, real(-1.0f), real(1.0f));
  const mask_t foliage = load(met.foliage + i) > 0.5f;
  real3 light = NearProbe(view, load(met.hit + i) > 0.5f, p, n) * sel(foliage, real(SHADE_CROWN), real(1.0f)) +
                load3(hits.lamp_r + i, hits.lamp_g + i, hits.lamp_b + i);
  if (map.heights != nullptr) {
    const real cosine = dot3(n, ufloat3{view.to_sun[0], view.to_sun[1], view.to_sun[2]});
    const real zero = real(0.0f);
    const real share = rmax(cosine, zero) + rmax(zero - cosine, zero) * load(met.leaf + i);
    const real seen = SunSeen(map, p, sel(foliage, real(SHADE_LEAF_BIAS), real(map.bias)));
    light = light + Uniform(view.sun_irradiance) * (share * seen * CloudShadow(view.cloud_shadow, p));
  }
  const real3 albedo = load3(met.albedo[0] + i, met.albedo[1] + i, met.albedo[2] + i);
  return diffuse(albedo, light) + emission;
}

}  // namespace

void GatherOrigins(const RaySet& rays, const SurfaceSet& s, const int* index, AmbientOrigins& at) {
  for (int i = 0; i < 16; ++i) {
    const int k = index[i];
    at.px[i] = s.px[k], at.py[i] = s.py[k], at.pz[i] = s.pz[k];
    at.nx[i] = s.nx[k], at.ny[i] = s.ny[k], at.nz[i] = s.nz[k];
    at.gx[i] = s.gx[k], at.gy[i] = s.gy[k], at.gz[i] = s.gz[k];
    at.distance[i] = rays.distance[k];
  }
}

void AmbientRays(const AmbientOrigins& at, const float* side, const float* sphere, RayHit16& out) {
  const ufloat3 w{sphere[0], sphere[1], sphere[2]};
  for (int i = 0; i < 16; i += kLanes) {
    const real flip = load(side + i);
    const real3 p = load3(at.px + i, at.py + i, at.pz + i);
    const real3 n = load3(at.nx + i, at.ny + i, at.nz + i) * flip;
    const real3 g = load3(at.gx + i, at.gy + i, at.gz + i) * flip;
    const real3 d = leave_above(cosine_direction(n + w, n), g);
    const real lift = ray_offset(p, load(at.distance + i));
    store3(out.origin_x + i, out.origin_y + i, out.origin_z + i, p + g * lift);
    store3(out.direction_x + i, out.direction_y + i, out.direction_z + i, d);
  }
}

void ShadeAmbient(const ShadeView& view, const SunMapView& sun_map, const RayHit16& rays, const AmbientHits& hits, float* r, float* g,
                  float* b) {
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
    const mask_t coated = untraced && (coat > kThinCoat);
    const mask_t rough = untraced && !coated && (roughness < kScattered);
    if (!stdx::any_of(coated || rough)) continue;
    const real3 d = load3(rays.dx + i, rays.dy + i, rays.dz + i);
    const real3 n = load3(s.nx + i, s.ny + i, s.nz + i), g = load3(s.gx + i, s.gy + i, s.gz + i);
    const Bsdf bsdf =
        bsdf_make(kind, load3(s.ar + i, s.ag + i, s.ab + i), metallic, roughness, real(0.0f), coat, load(s.coat_roughness + i));
    const real n_dot_v = rmax(real(0.0f) - dot3(n, d), real(kViewCosine));
    const mask_t visible = luminance(bsdf_reflected(bsdf_side(bsdf, n_dot_v))) > kVisibleSkin;
    // A facet of the skin as the viewer sees it; a coat is taken as smooth.
    const BsdfLobes skin_alone{real(0.0f), real(1.0f), real(0.0f), real(0.0f), real(0.0f)};
    real event = real(0.0f);
    const real3 r = leave_above(bsdf_sample(bsdf, skin_alone, n, -d, real(0.5f), load(u + i), load(v + i), event), g);
    const mask_t turned = rough && visible;
    store3(s.rx + i, s.ry + i, s.rz + i, sel3(turned, r, load3(s.rx + i, s.ry + i, s.rz + i)));
    store(s.mirror + i, sel(turned || (coated && visible), real(1.0f), load(s.mirror + i)));
  }
}

}  // namespace airsim360::internal::AIRSIM360_ISA
