// Kernel: from hits to surfaces (geometry, material, textures), all lanes at once.
#include "airsim360/render/shading/shading_kernels.h"
#include "airsim360/render/shading/shading_texture.h"

namespace airsim360::internal::AIRSIM360_ISA {
namespace {

constexpr float kFoliage = 1, kGlass = 2, kWater = 3;  // SurfaceKind
constexpr float kMirrorRoughness = 0.12f;

/// Records of the triangles under one vector of rays, turned into lanes.
struct alignas(64) Fetched {
  alignas(64) int32_t normal[3][kLanes], geometric[kLanes], tangent[kLanes];
  alignas(64) int32_t base_id[kLanes], roughness_id[kLanes], normal_id[kLanes],
      emission_id[kLanes], macro_id[kLanes];
  alignas(64) Lanes uv[6], texels_log2, mirrored, pane, area;
  alignas(64) Lanes matrix[9], color[3], emission[3];
  alignas(64) Lanes metallic, roughness, transmission, macro, normal_scale, kind, coat, coat_roughness;
  bool any_normal, any_roughness, any_emission, any_macro, any_glass, any_water, any_base;
};

/// Brings the records of the next vector into the cache while this one is worked on.
KERNEL void Prefetch(const ShadeView& view, const RaySet& rays, int begin) {
  if (begin >= rays.count) return;
  for (int i = 0; i < kLanes; ++i) {
    __builtin_prefetch(
        &view.triangles[view.instances[rays.instance[begin + i]].first_triangle + rays.triangle[begin + i]]);
  }
}

KERNEL void Fetch(const ShadeView& view, const RaySet& rays, int begin, Fetched& f) {
  f.any_normal = f.any_roughness = f.any_emission = f.any_macro = f.any_glass = f.any_water = f.any_base =
      false;
  for (int i = 0; i < kLanes; ++i) {
    const InstanceRecord& instance = view.instances[rays.instance[begin + i]];
    const TriangleRecord& triangle = view.triangles[instance.first_triangle + rays.triangle[begin + i]];
    const MaterialRecord& material = view.materials[triangle.material & ~kMirroredUv];
    for (int k = 0; k < 3; ++k) f.normal[k][i] = static_cast<int32_t>(triangle.normals[k]);
    f.geometric[i] = static_cast<int32_t>(triangle.geometric_normal);
    f.tangent[i] = static_cast<int32_t>(triangle.tangent);
    for (int k = 0; k < 6; ++k) f.uv[k][i] = triangle.uv[k];
    f.texels_log2[i] = triangle.texels_log2 + instance.texels_log2;
    f.mirrored[i] = (triangle.material & kMirroredUv) != 0 ? -1.0f : 1.0f;
    f.pane[i] = static_cast<float>(((triangle.pane ^ instance.hash) * 0x9e3779b1u) >> 8) * 0x1p-24f;
    f.area[i] = triangle.area;
    for (int k = 0; k < 9; ++k) f.matrix[k][i] = instance.normal_matrix[k];
    for (int k = 0; k < 3; ++k) f.color[k][i] = material.base[k] * instance.tint[k];
    for (int k = 0; k < 3; ++k) f.emission[k][i] = material.emission[k];
    f.metallic[i] = material.metallic;
    f.roughness[i] = material.roughness;
    f.transmission[i] = material.transmission;
    f.macro[i] = material.macro_variation;
    f.normal_scale[i] = material.normal_scale;
    f.kind[i] = material.kind;
    f.coat[i] = material.clear_coat;
    f.coat_roughness[i] = material.clear_coat_roughness;
    f.base_id[i] = material.base_texture;
    f.roughness_id[i] = material.roughness_texture;
    f.normal_id[i] = material.normal_texture;
    f.emission_id[i] = material.emission_texture;
    f.macro_id[i] = view.macro_texture;
    f.any_base |= material.base_texture != 0;
    f.any_normal |= material.normal_texture != 0;
    f.any_roughness |= material.roughness_texture != 0;
    f.any_emission |= material.emission_texture != 0;
    f.any_macro |= material.macro_variation != 0;
    f.any_glass |= material.kind == kGlass;
    f.any_water |= material.kind == kWater;
  }
}

KERNEL real3 UnpackDirection(const int32_t* packed) {
  const ireal p(packed, stdx::vector_aligned);
  constexpr float scale = 2.0f / 65534.0f;
  return octahedral_decode(to_real(p & 0xffff) * scale - 1.0f, to_real((p >> 16) & 0xffff) * scale - 1.0f);
}

KERNEL real3 ToWorld(const Fetched& f, real3 a) {
  const auto row = [&](int k) __attribute__((always_inline)) {
    return load(f.matrix[k]) * a.x + load(f.matrix[k + 1]) * a.y + load(f.matrix[k + 2]) * a.z;
  };
  return normalize3(make3(row(0), row(3), row(6)));
}

KERNEL real3 Facing(real3 n, real3 direction) {
  const real side = sel(dot3(n, direction) > 0.0f, real(-1.0f), real(1.0f));
  return n * side;
}

/// A part of the normal map's slope; what mipmapping shortened becomes roughness (Toksvig 2005).
KERNEL real3 MapNormal(const ShadeView& view, const Fetched& f, real3 n, real u, real v, real footprint,
                       real& roughness) {
  const TexelColor c = SampleTexture(view.textures, f.normal_id, u, v, footprint, false);
  const real3 m = c.rgb * real(2.0f) - make3(real(1.0f), real(1.0f), real(1.0f));
  const real length = rmin(rroot(dot3(m, m)), real(1.0f));
  const real scale = load(f.normal_scale);
  const real3 t0 = ToWorld(f, UnpackDirection(f.tangent));
  const real3 t = normalize3(t0 - n * dot3(n, t0));
  const real3 b =
      make3(n.y * t.z - n.z * t.y, n.z * t.x - n.x * t.z, n.x * t.y - n.y * t.x) * load(f.mirrored);
  const real3 bent = normalize3(t * (m.x * scale) + b * (m.y * scale) + n * rmax(m.z, real(0.05f)));
  const mask_t mapped = to_real(ireal(f.normal_id, stdx::vector_aligned)) > 0.5f;
  const real variance = (1.0f - length) / rmax(length, real(0.2f)) * scale * scale;
  const real alpha = roughness * roughness;
  const real widened =
      rroot(rroot(rmin(alpha * alpha + 2.0f * variance * variance + variance * 0.5f, real(1.0f))));
  roughness = sel(mapped, rmax(widened, roughness), roughness);
  return sel3(mapped, bent, n);
}

/// Panes are never quite flat: each tilts by its own hash and bends a little.
KERNEL real3 GlassNormal(const Fetched& f, real3 n, real3 p) {
  const real h1 = load(f.pane), h2 = h1 * 61.7f - rfloor(h1 * 61.7f);
  const real side = rroot(rmax(n.x * n.x + n.y * n.y, real(1e-8f)));
  const real3 across = make3(0.0f - n.y, n.x, real(0.0f)) * (1.0f / side);
  const real along = (p.x * across.x + p.y * across.y) * 2.1f + h1 * 40.0f;
  const real bend = sin_approx(along) * 0.0035f, rise = sin_approx(p.z * 1.9f + h2 * 40.0f) * 0.0035f;
  const mask_t upright = side > 0.3f;
  const real3 tilted =
      n + across * ((h1 - 0.5f) * 0.011f + bend) + make3(real(0.0f), real(0.0f), (h2 - 0.5f) * 0.011f + rise);
  return sel3(upright, normalize3(tilted), n);
}

/// Brightness over 5 to 40 m of world, so that large grounds do not look tiled.
KERNEL real3 MacroTint(const ShadeView& view, const Fetched& f, real3 p, real3 n, real width) {
  const real px = p.x + 0.41f * p.z * n.x, py = p.y + 0.37f * p.z;
  const real none = real(-40.0f);
  const TexelColor wide =
      SampleTexture(view.textures, f.macro_id, px * (1.0f / 311.0f), py * (1.0f / 311.0f), none, false);
  const TexelColor fine =
      SampleTexture(view.textures, f.macro_id, px * (1.0f / 47.0f) + 0.37f, py * (1.0f / 47.0f), none, false);
  const real fade = rmin(real(1.0f), 6.0f / rmax(width, real(1e-3f)));
  const real amount = load(f.macro) * 2.0f;
  const real light = (wide.rgb.x - 0.5f) * 1.1f + (fine.rgb.x - 0.5f) * 0.9f * fade;
  const real warm = (wide.rgb.y - 0.5f) * 0.35f + (fine.rgb.y - 0.5f) * 0.2f * fade;
  const real low = real(0.35f);
  return make3(rmax(1.0f + amount * (light + warm), low), rmax(1.0f + amount * light, low),
               rmax(1.0f + amount * (light - warm), low));
}

/// A point of the sun's disc for samples beside the centre one.
KERNEL real3 TowardsSun(const ShadeView& view, const RaySet& rays, int i) {
  alignas(64) int32_t mixed[kLanes];
  alignas(64) float beside[kLanes];
  for (int k = 0; k < kLanes; ++k) {
    uint32_t h = rays.key[i + k];
    beside[k] = h != 0 ? 1.0f : 0.0f;
    h = (h ^ (h >> 16)) * 0x7feb352du;
    h = (h ^ (h >> 15)) * 0x846ca68bu;
    mixed[k] = static_cast<int32_t>(h ^ (h >> 16));
  }
  const ireal key(mixed, stdx::vector_aligned);
  const real a = to_real((key >> 8) & 0xfff) * (1.0f / 4096.0f),
             b = to_real((key >> 20) & 0xfff) * (1.0f / 4096.0f);
  const real radius = rroot(a) * 0.00462f * load(beside), angle = b * (2.0f * SHADE_PI);
  const ufloat3 s{view.to_sun[0], view.to_sun[1], view.to_sun[2]};
  const float side = s.x * s.x + s.y * s.y > 1e-6f ? 1.0f / __builtin_sqrtf(s.x * s.x + s.y * s.y) : 0.0f;
  const ufloat3 e1 = side > 0 ? ufloat3{-s.y * side, s.x * side, 0} : ufloat3{1, 0, 0};
  const ufloat3 e2{s.y * e1.z - s.z * e1.y, s.z * e1.x - s.x * e1.z, s.x * e1.y - s.y * e1.x};
  const real x = radius * sin_approx(angle + 0.5f * SHADE_PI), y = radius * sin_approx(angle);
  return normalize3(e1 * x + e2 * y + s);
}

KERNEL void PrepareVector(const ShadeView& view, const RaySet& rays, int i, SurfaceSet& out) {
  Fetched f;
  Fetch(view, rays, i, f);
  Prefetch(view, rays, i + kLanes);

  // Where, and which way the surface faces.
  const real3 d = load3(rays.dx + i, rays.dy + i, rays.dz + i);
  const real3 p = load3(rays.ox + i, rays.oy + i, rays.oz + i) + d * load(rays.distance + i);
  const real u = load(rays.u + i), v = load(rays.v + i), w = 1.0f - u - v;
  const real3 g = ToWorld(f, UnpackDirection(f.geometric));
  const real3 smooth = ToWorld(f, UnpackDirection(f.normal[0]) * w + UnpackDirection(f.normal[1]) * u +
                                      UnpackDirection(f.normal[2]) * v);
  const real front = sel(dot3(g, d) > 0.0f, real(-1.0f), real(1.0f));
  const real3 facing = g * front;
  real3 n = sel3(dot3(smooth, g) > 0.0f, smooth, smooth * real(-1.0f)) * front;

  // Texture coordinates and footprint: between the cone's width and its stretch on the slanted surface.
  const real tu = load(f.uv[0]) * w + load(f.uv[2]) * u + load(f.uv[4]) * v;
  const real tv = load(f.uv[1]) * w + load(f.uv[3]) * u + load(f.uv[5]) * v;
  const real width = load(rays.width + i);
  const real slant = rmax(rabs(dot3(facing, d)), real(0.03f));
  const real footprint =
      log2_approx(rmax(width, real(1e-9f))) - 0.75f * log2_approx(slant) + load(f.texels_log2);

  real3 color = load3(f.color[0], f.color[1], f.color[2]);
  real metallic = load(f.metallic), roughness = load(f.roughness);
  real3 emission = load3(f.emission[0], f.emission[1], f.emission[2]);
  if (f.any_base) color = color * SampleTexture(view.textures, f.base_id, tu, tv, footprint, true).rgb;
  if (f.any_macro) color = color * MacroTint(view, f, p, n, width);
  if (f.any_roughness) {
    const TexelColor c = SampleTexture(view.textures, f.roughness_id, tu, tv, footprint, false);
    roughness = roughness * c.rgb.y;
    metallic = metallic * c.rgb.z;
  }
  if (f.any_emission)
    emission = emission * SampleTexture(view.textures, f.emission_id, tu, tv, footprint, true).rgb;
  roughness = rmin(rmax(roughness, real(0.03f)), real(1.0f));

  // Normal: map, panes, waves.
  const real kind = load(f.kind);
  if (f.any_normal) n = MapNormal(view, f, n, tu, tv, footprint, roughness);
  if (f.any_glass) {
    const mask_t glass = kind == kGlass;
    n = sel3(glass, GlassNormal(f, n, p), n);
    roughness = sel(glass, rmin(roughness, real(0.08f)), roughness);
    // Behind some large panes hang blinds: brighter than the dark room.
    const real blind = clamp01((0.30f - load(f.pane)) * 40.0f) * clamp01((load(f.area) - 0.7f) * 4.0f) *
                       clamp01((0.3f - rabs(facing.z)) * 8.0f);
    const real shade = sel(glass, blind * 0.16f * (0.6f + 1.3f * load(f.pane)), real(0.0f));
    color = color * (1.0f - shade) + make3(shade, shade * 0.97f, shade * 0.88f);
  }
  if (f.any_water) {
    const mask_t water = (kind == kWater) && (facing.z > 0.5f);
    real lost = real(0.0f);
    const real3 waves = water_normal(p.x, p.y, width / rroot(slant), lost);
    n = sel3(water, waves, n);
    roughness = sel(water, rmin(rroot(rroot(2.0f * lost + 1e-5f)), real(0.5f)), roughness);
  }
  // A bent normal must not look away from the viewer.
  const real towards = dot3(n, d);
  n = sel3(towards > -0.02f, normalize3(n - d * (towards + 0.02f)), n);

  store3(out.px + i, out.py + i, out.pz + i, p);
  store3(out.nx + i, out.ny + i, out.nz + i, n);
  store3(out.gx + i, out.gy + i, out.gz + i, facing);
  store3(out.ar + i, out.ag + i, out.ab + i, color);
  store3(out.er + i, out.eg + i, out.eb + i, sel3(front > 0.0f, emission, emission * real(0.0f)));
  store(out.metallic + i, metallic);
  store(out.roughness + i, roughness);
  store(out.transmission + i, load(f.transmission));
  store(out.coat + i, load(f.coat));
  store(out.coat_roughness + i, load(f.coat_roughness));
  store(out.kind + i, kind);

  // Reflection: above the surface itself.
  real3 r = reflect3(d, n);
  const real below = dot3(r, facing);
  r = sel3(below < 0.01f, normalize3(r + facing * (0.02f - below)), r);
  store3(out.rx + i, out.ry + i, out.rz + i, r);
  const mask_t sharp =
      (kind == kGlass) || (kind == kWater) || ((roughness < kMirrorRoughness) && (metallic > 0.3f));
  store(out.mirror + i, sel(sharp, real(1.0f), real(0.0f)));

  // Sun.
  const real3 l = TowardsSun(view, rays, i);
  store3(out.lx + i, out.ly + i, out.lz + i, l);
  const mask_t lit = ((dot3(n, l) > 0.0f) && (dot3(facing, l) > 0.0f)) || (kind == kFoliage);
  const mask_t up = real(view.to_sun[2]) > -0.02f;
  store(out.sunlit + i, sel(lit && up, real(1.0f), real(0.0f)));
  store(out.traced + i, real(0.0f));
  store(out.contact + i, real(1.0f));
  store(out.clear + i, real(0.0f));
}

}  // namespace

void PrepareSurfaces(const ShadeView& view, const RaySet& rays, SurfaceSet& surfaces) {
  for (int i = 0; i < rays.count; i += kLanes) PrepareVector(view, rays, i, surfaces);
}

}  // namespace airsim360::internal::AIRSIM360_ISA
