// Kernel: from hits to surfaces (geometry, material, textures), all lanes at once.
#include "airsim360/render/shading/stretched_surfaces.h"
#include "airsim360/render/shading/surface_detail.h"
#include "airsim360/render/shared/shading_kernels.h"

namespace airsim360::internal::AIRSIM360_ISA {
namespace {

KERNEL real3 Facing(real3 n, real3 direction) {
  const real side = sel(dot3(n, direction) > 0.0f, real(-1.0f), real(1.0f));
  return n * side;
}

/// A part of the normal map's slope; what mipmapping shortened becomes roughness (Toksvig 2005).
KERNEL real3 MapNormal(const ShadeView& view, const Fetched& f, const TileCorners& corners, real3 n, real footprint, real& roughness) {
  const real3 c = SampleTiles(view, f, f.normal_id, corners, footprint, false, mean_normal(), corners.gain);
  real rougher = roughness;
  const real3 bent = bend_normal(c, n, ToWorld(f, UnpackDirection(f.tangent)), load(f.mirrored), load(f.normal_scale), rougher);
  const mask_t mapped = to_real(ireal(f.normal_id, stdx::vector_aligned)) > 0.5f;
  roughness = sel(mapped, rougher, roughness);
  return sel3(mapped, bent, n);
}

/// The sun's centre, or a point of its disc for samples beside the centre one.
KERNEL real3 TowardsSun(const ShadeView& view, const RaySet& rays, int i, real3 center) {
  const ufloat3 s{view.to_sun[0], view.to_sun[1], view.to_sun[2]};
  const ureal key = Bits(rays.key + i);
  if (stdx::all_of(key == 0u)) return center;
  const ureal h = hash_bits(key);
  const auto part = [](ureal bits) __attribute__((always_inline)) {
    return to_real(stdx::static_simd_cast<ireal>(bits & 0xfffu)) * kTwelveBits;
  };
  const real a = part(h >> 8), b = part(h >> 20);
  const mask_t beside = stdx::__proposed::static_simd_cast<mask_t>(key != 0u);
  const real radius = rroot(a) * kSunRayRadius * sel(beside, real(1.0f), real(0.0f));
  const float side = s.x * s.x + s.y * s.y > kSteepest2 ? 1.0f / __builtin_sqrtf(s.x * s.x + s.y * s.y) : 0.0f;
  const ufloat3 e1 = side > 0 ? ufloat3{-s.y * side, s.x * side, 0} : ufloat3{1, 0, 0};
  const ufloat3 e2{s.y * e1.z - s.z * e1.y, s.z * e1.x - s.x * e1.z, s.x * e1.y - s.y * e1.x};
  const PlanePoint at = disc_place(radius, b);
  return normalize3(e1 * at.x + e2 * at.y + s);
}

/// Where a vector of rays meets surfaces.
struct Meeting {
  real3 d, p;         // direction of the rays; the points
  real u, v, w;       // of the triangles
  real3 facing, n;    // geometric and shading normal towards the viewer
  real front;         // 1 where the triangle is seen from its front, else -1
  real tu, tv;        // texture coordinates
  real width, slant;  // of the rays' cones; cosine between ray and surface
  real footprint;     // log2 of texture tiles, for pictures alone: between the cone's width and its stretch on the slanted surface
};

KERNEL Meeting Meet(const RaySet& rays, int i, const Fetched& f) {
  Meeting at;
  at.d = load3(rays.dx + i, rays.dy + i, rays.dz + i);
  at.p = load3(rays.ox + i, rays.oy + i, rays.oz + i) + at.d * load(rays.distance + i);
  const real u = load(rays.u + i), v = load(rays.v + i), w = 1.0f - u - v;
  at.u = u, at.v = v, at.w = w;
  const real3 g = load3(f.facet[0], f.facet[1], f.facet[2]);
  real3 smooth = g;
  if (f.any_smooth) {
    const real3 bent = UnpackDirection(f.normal[0]) * w + UnpackDirection(f.normal[1]) * u + UnpackDirection(f.normal[2]) * v;
    smooth = sel3(IsSmooth(f), ToWorld(f, bent), g);
  }
  at.front = sel(dot3(g, at.d) > 0.0f, real(-1.0f), real(1.0f));
  at.facing = g * at.front;
  at.n = sel3(dot3(smooth, g) > 0.0f, smooth, smooth * real(-1.0f)) * at.front;
  at.tu = load(f.uv[0]) * w + load(f.uv[2]) * u + load(f.uv[4]) * v;
  at.tv = load(f.uv[1]) * w + load(f.uv[3]) * u + load(f.uv[5]) * v;
  at.width = load(rays.width + i);
  at.slant = slant_of(at.facing, at.d);
  at.footprint = real(0.0f);
  if (f.any_picture) at.footprint = texture_footprint(at.width, at.slant, load(f.texels_log2));
  return at;
}

/// What the base colour's picture shows of a slanted pixel, with the tone of every slab or brick.
SEPARATE real3 SampleStretched(const ShadeView& view, const Fetched& f, const TileCorners& corners, const Meeting& at) {
  const real3 g = load3(f.facet[0], f.facet[1], f.facet[2]), t = ToWorld(f, UnpackDirection(f.tangent));
  const real3 b = make3(g.y * t.z - g.z * t.y, g.z * t.x - g.x * t.z, g.x * t.y - g.y * t.x) * load(f.mirrored);
  const Stretch s = stretched_pixel(dot3(at.d, t), real(0.0f) - dot3(at.d, b), at.width, at.slant, load(f.texels_log2), at.footprint,
                                    load(f.blend) > 0.5f, SURFACE_MOST_TAPS);
  const real3 mean = load3(f.mean[0], f.mean[1], f.mean[2]);
  real3 sum = make3(real(0.0f), real(0.0f), real(0.0f));
  for (int k = 0;; ++k) {
    const mask_t has = s.taps > static_cast<float>(k);
    if (!stdx::any_of(has)) break;
    const real at_tap = tap_at(real(static_cast<float>(k)), s.taps), u = s.u * at_tap, v = s.v * at_tap;
    TileCorners moved = corners;
    moved.u[0] = corners.u[0] + u;
    moved.v[0] = corners.v[0] + v;
    real3 c = SampleTiles(view, f, f.base_id, moved, s.footprint, true, mean, corners.gain);
    if (f.any_unit) c = c * unit_tint(load(f.columns), load(f.rows), at.tu + u, at.tv + v, s.footprint);
    sum = sum + sel3(has, c, c * real(0.0f));
  }
  return sum * (1.0f / s.taps);
}

/// Colour, roughness and light of the material: its textures and what makes places differ. Normals are still those of the mesh.
KERNEL Skin PaintSkin(const ShadeView& view, const RaySet& rays, int i, bool stretches, const Fetched& f, const Meeting& at,
                      const TileCorners& corners, Noises& noises) {
  real3 color = load3(f.color[0], f.color[1], f.color[2]);
  if (f.any_colored) color = color * VertexColors(f, at.u, at.v);
  real metallic = load(f.metallic), roughness = load(f.roughness);
  real3 emission = load3(f.emission[0], f.emission[1], f.emission[2]);
  const bool stretched = f.any_base && stretches;
  if (stretched) {
    color = color * SampleStretched(view, f, corners, at);
  } else if (f.any_base) {
    color = color * SampleTiles(view, f, f.base_id, corners, at.footprint, true, load3(f.mean[0], f.mean[1], f.mean[2]), corners.gain);
  }
  if (f.any_roughness) {
    const real3 c = SampleTiles(view, f, f.roughness_id, corners, at.footprint, false, mean_roughness(), real(1.0f));
    roughness = roughness * c.y;
    metallic = metallic * c.z;
  }
  if (f.any_emission) emission = emission * SampleTexture(view.textures, f.emission_id, at.tu, at.tv, at.footprint, true);
  if (f.any_beam || (view.glows != nullptr && stdx::any_of(emission.x + emission.y + emission.z > 0.0f)))
    emission = Thrown(view, rays, i, f, at.d, emission);
  if (f.any_macro || f.any_ground || view.wetness > 0 || view.snow > 0) noises = LookUpNoises(view, f, at.p, at.n, at.width);
  if (f.any_macro) {
    color = color * macro_tint(load(f.macro), noises, at.width) * wall_wear(noises.wide, noises.mid, noises.fine, at.width, noises.wall);
  }
  if (f.any_unit && !stretched) color = color * unit_tint(load(f.columns), load(f.rows), at.tu, at.tv, at.footprint);
  if (f.any_ground) WearGround(f, noises, at.p, at.tu, at.width, color, roughness);
  if (f.any_leaf) color = leaf_tint(load(f.kind) == kFoliage, load(f.transmission), load(f.pane), color);
  return {lawful_color(color),
          metallic,
          lawful_roughness(roughness),
          load(f.clear_coat),
          load(f.clear_coat_roughness),
          load(f.transmission),
          load(f.kind),
          at.n,
          emission};
}

KERNEL void RaiseWaves(const ShadeView& view, const Meeting& at, Skin& s) {
  const mask_t water = (s.kind == kWater) && (at.facing.z > 0.5f);
  real lost = real(0.0f);
  const real3 waves = windy_water(at.p, SampleNoise(view, gust_at(at.p)), at.width / rroot(at.slant), lost);
  s.n = sel3(water, waves, s.n);
  s.roughness = sel(water, water_roughness(lost), s.roughness);
}

KERNEL void StoreSurface(const Meeting& at, const Skin& s, int i, SurfaceSet& out) {
  store3(out.px + i, out.py + i, out.pz + i, at.p);
  store3(out.nx + i, out.ny + i, out.nz + i, s.n);
  store3(out.gx + i, out.gy + i, out.gz + i, at.facing);
  store3(out.ar + i, out.ag + i, out.ab + i, s.color);
  store3(out.er + i, out.eg + i, out.eb + i, sel3(at.front > 0.0f, s.emission, s.emission * real(0.0f)));
  store(out.metallic + i, s.metallic);
  store(out.roughness + i, s.roughness);
  store(out.transmission + i, s.transmission);
  store(out.coat + i, s.coat);
  store(out.coat_roughness + i, s.coat_roughness);
  store(out.kind + i, s.kind);
}

KERNEL void StoreReflection(const Meeting& at, const Skin& s, int i, SurfaceSet& out) {
  store3(out.rx + i, out.ry + i, out.rz + i, reflect_above(at.d, s.n, at.facing));
  store(out.mirror + i, sel(mirrors(s), real(1.0f), real(0.0f)));
}

/// Whether the sun, whose ray has the direction `l`, can matter.
KERNEL void StoreSun(const ShadeView& view, const Meeting& at, const Skin& s, real3 l, int i, SurfaceSet& out) {
  store3(out.lx + i, out.ly + i, out.lz + i, l);
  store(out.sunlit + i, sel(takes_sun(s.n, at.facing, s.kind, l) && sun_is_up(view.to_sun[2]), real(1.0f), real(0.0f)));
  store(out.traced + i, real(0.0f));
  store(out.contact + i, real(1.0f));
  store(out.clear + i, real(0.0f));
}

/// `f` is that of the vector before, or new; `sun` the direction of the sun's centre.
KERNEL void PrepareVector(const ShadeView& view, const RaySet& rays, int i, bool stretches, real3 sun, Fetched& f, SurfaceSet& out) {
  Fetch(view, rays, i, f);
  Prefetch(view, rays, i + kLanes);
  Meeting at = Meet(rays, i, f);

  // Rooms behind panes: what is seen through them, and where their pictures hang.
  const mask_t window = f.any_window ? load(f.interior) > 0.5f : mask_t(false);
  RoomView room;
  if (f.any_window) {
    room = LookInside(view, f, ToWorld(f, UnpackDirection(f.right)), ToWorld(f, UnpackDirection(f.up)), at.facing, at.d, at.w, at.u, at.v);
    at.tu = at.tu + room.du;
    at.tv = at.tv + room.dv;
  }

  const TileCorners corners = ChooseCorners(f, at.tu, at.tv, at.footprint);
  Noises noises;
  Skin s = PaintSkin(view, rays, i, stretches, f, at, corners, noises);
  if (f.any_normal) s.n = MapNormal(view, f, corners, s.n, at.footprint, s.roughness);
  if (f.any_glass) glaze(window, load(f.pane), load(f.area), at.p, at.facing, s);
  if (f.any_window) FurnishPane(view, f, room, window, s);
  if (f.any_water) RaiseWaves(view, at, s);
  if (view.wetness > 0 || view.snow > 0) {
    // A copy, since what a function that is not inlined changes lives in memory.
    Skin weathered = s;
    LieWeather(view, f, noises, at.p, at.facing, at.width, at.tu, weathered);
    s = weathered;
  }
  s.n = turn_to_viewer(s.n, at.d);
  StoreSurface(at, s, i, out);
  StoreReflection(at, s, i, out);
  StoreSun(view, at, s, TowardsSun(view, rays, i, sun), i, out);
}

/// One copy of it all: whether it stretches is asked for every vector.
SEPARATE void PrepareAll(const ShadeView& view, const RaySet& rays, bool stretches, SurfaceSet& surfaces) {
  const real3 sun = normalize3(make3(real(view.to_sun[0]), real(view.to_sun[1]), real(view.to_sun[2])));
  Fetched f;
  for (int i = 0; i < rays.count; i += kLanes) PrepareVector(view, rays, i, stretches, sun, f, surfaces);
}

}  // namespace

void PrepareSurfaces(const ShadeView& view, const RaySet& rays, SurfaceSet& surfaces) { PrepareAll(view, rays, false, surfaces); }
void PrepareStretched(const ShadeView& view, const RaySet& rays, SurfaceSet& surfaces) { PrepareAll(view, rays, true, surfaces); }

void LiftRays(const RaySet& rays, const SurfaceSet& s, int first, const float* x, const float* y, const float* z, RayHit16& out) {
  const auto three = [](const float* a, const float* b, const float* c) __attribute__((always_inline)) {
    return real3{real(a, stdx::element_aligned), real(b, stdx::element_aligned), real(c, stdx::element_aligned)};
  };
  for (int k = 0; k < 16; k += kLanes) {
    const int i = first + k;
    const real3 d = three(x + k, y + k, z + k), p = three(s.px + i, s.py + i, s.pz + i), g = three(s.gx + i, s.gy + i, s.gz + i);
    const real distance(rays.distance + i, stdx::element_aligned);
    const real lift = ray_offset(p, distance);
    const real offset = sel(dot3(g, d) < 0.0f, 0.0f - lift, lift);
    store3(out.origin_x + k, out.origin_y + k, out.origin_z + k, p + g * offset);
    store3(out.direction_x + k, out.direction_y + k, out.direction_z + k, d);
  }
}

uint32_t AskSun(const SurfaceSet& s, int first) {
  uint32_t bits = 0;
  for (int k = 0; k < 16; ++k) bits |= s.sunlit[first + k] != 0 ? 1u << k : 0;
  return bits;
}

uint32_t AskContact(const RaySet& rays, const SurfaceSet& s, int first, float farthest) {
  uint32_t bits = 0;
  for (int k = 0; k < 16; ++k) {
    const int i = first + k;
    bits |= ((s.gz[i] >= kContactLevel) & (rays.distance[i] <= farthest) & (s.kind[i] == 0)) ? 1u << k : 0;
  }
  return bits;
}

}  // namespace airsim360::internal::AIRSIM360_ISA
