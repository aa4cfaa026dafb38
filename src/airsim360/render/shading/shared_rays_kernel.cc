#include "airsim360/render/shading/shared_rays_kernel.h"

#include "airsim360/render/shared/shading_simd.h"

namespace airsim360::internal::AIRSIM360_ISA {
namespace {

#define KERNEL static inline __attribute__((always_inline, unused))

#define SHARED KERNEL
#define word uint32_t
#include "airsim360/render/shared/shading_points.h"
#undef SHARED
#undef word

/// SobolPoint of sixteen indices in a row, in loops that compilers make vectors of.
KERNEL void SobolPoints(uint32_t first, uint32_t seed, float* u, float* v) {
  const uint32_t hash = hash_bits(seed), hash2 = hash_bits(hash);
  // Reversed bits scrambled are the bits scrambled and reversed.
  for (uint32_t i = 0; i < 16; ++i) u[i] = unit_of(reverse_bits(owen_hash(first + i, hash)));
  uint32_t second[16] = {};
  for (uint32_t bit = 0, step = 0x80000000u; (first + 15) >> bit != 0; ++bit, step ^= step >> 1) {
    for (uint32_t i = 0; i < 16; ++i) second[i] ^= (0u - ((first + i) >> bit & 1u)) & step;
  }
  for (uint32_t i = 0; i < 16; ++i) v[i] = unit_of(owen_scramble(second[i], hash2));
}

KERNEL real3 Across(real3 a, real3 b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
KERNEL real3 Divided(real3 a, real s) { return {a.x / s, a.y / s, a.z / s}; }
KERNEL real3 Spread(const float* p) { return {real(p[0]), real(p[1]), real(p[2])}; }

}  // namespace

void SharedSphere(uint32_t first, uint32_t seed, float* x, float* y, float* z) {
  alignas(64) float u[16], v[16];
  SobolPoints(first, seed, u, v);
  for (int i = 0; i < 16; i += kLanes) {
    const real height = 1.0f - 2.0f * load(u + i);
    const PlanePoint at = disc_place(rroot(rmax(real(0.0f), 1.0f - height * height)), load(v + i));
    store3(x + i, y + i, z + i, {at.x, at.y, height});
  }
}

void SharedSun(const SunFrame& sun, uint32_t seed, int count, bool of_pixel, SunPoints& out) {
  const real3 middle = Spread(sun.to_sun), right = Spread(sun.right), up = Spread(sun.up);
  for (int first = 0; first < count; first += 16) {
    alignas(64) float u[16], v[16];
    SobolPoints(static_cast<uint32_t>(first), seed ^ 0x68bc21ebu, u, v);
    for (int i = 0; i < 16; i += kLanes) {
      const PlanePoint at = disc_place(rroot(load(u + i)), load(v + i));
      const real3 d = middle + right * at.x + up * at.y;
      store3(out.x + first + i, out.y + first + i, out.z + first + i, Divided(d, rroot(dot3(d, d))));
    }
    if (!of_pixel) continue;
    SobolPoints(static_cast<uint32_t>(first), seed ^ 0x02e5be93u, u, v);
    for (int i = 0; i < 16; ++i) out.across[first + i] = u[i] - 0.5f, out.up[first + i] = v[i] - 0.5f;
  }
}

void LiftSunRays(const RaySet& rays, const SurfaceSet& s, const SunFrame& sun, const SunPoints& points, const PixelShape& pixel,
                 const SunPair& pair, RayHit16& out) {
  alignas(64) float lanes[15][16];
  const float* planes[10] = {rays.dx, rays.dy, rays.dz, rays.distance, s.px, s.py, s.pz, s.gx, s.gy, s.gz};
  const float* of_point[5] = {points.x, points.y, points.z, points.across, points.up};
  for (int k = 0; k < 10; ++k) {
    const float a = planes[k][pair.surface[0]], b = planes[k][pair.surface[1]];
    for (int i = 0; i < 8; ++i) lanes[k][i] = a;
    for (int i = 8; i < 16; ++i) lanes[k][i] = b;
  }
  for (int k = 0; k < 5; ++k) {
    for (int i = 0; i < 8; ++i) lanes[10 + k][i] = of_point[k][pair.first[0] + i];
    for (int i = 0; i < 8; ++i) lanes[10 + k][8 + i] = of_point[k][pair.first[1] + i];
  }
  const real3 to_sun = Spread(sun.to_sun), pole = Spread(pixel.pole);
  const real zero = real(0.0f), one = real(1.0f);
  for (int i = 0; i < 16; i += kLanes) {
    const auto lane = [&](int k) __attribute__((always_inline)) { return load(lanes[k] + i); };
    const real3 d{lane(0), lane(1), lane(2)}, p{lane(4), lane(5), lane(6)}, g{lane(7), lane(8), lane(9)};
    const real distance = lane(3);
    // The pixel's width and height at the distance 1; columns are narrower towards a panorama's poles.
    const real3 turned = Across(pole, d);
    const mask_t level = rabs(d.z) < kUpright;
    const real3 axis = pixel.panorama ? pole : make3(sel(level, zero, one), zero, sel(level, one, zero));
    const real3 sideways = Across(axis, d);
    const real length = rroot(dot3(sideways, sideways));
    const real3 across = sel3(length > 0.0f, Divided(sideways, length), make3(zero, zero, zero));
    const real3 up = Across(across, d);
    const real aspect = pixel.panorama ? rmax(rroot(dot3(turned, turned)), real(kLeastAspect)) : one;
    // A point of the pixel on the surface's plane.
    const real3 beside = d + across * (lane(13) * pixel.cone_angle * aspect) + up * (lane(14) * pixel.cone_angle);
    const real slant = dot3(g, d), there = dot3(g, beside);
    const real stretch = plane_stretch(slant, there);
    const real lift = ray_offset(p, distance) * sel(dot3(g, to_sun) < 0.0f, real(-1.0f), one);
    store3(out.origin_x + i, out.origin_y + i, out.origin_z + i, p + g * lift + (beside * stretch - d) * distance);
    store3(out.direction_x + i, out.direction_y + i, out.direction_z + i, {lane(10), lane(11), lane(12)});
  }
}

}  // namespace airsim360::internal::AIRSIM360_ISA
