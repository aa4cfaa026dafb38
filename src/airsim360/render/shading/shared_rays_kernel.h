// Kernels: the directions that the pixels of a tile share (tier `high`), and the rays that take them to the sun.
#pragma once

#include "airsim360/base/kernel_isa.h"
#include "airsim360/render/shared/shading_data.h"
#include "airsim360/trace/ray_tracer.h"

namespace airsim360::internal {

/// The sun's disc: its middle, and its radius to the right and up.
struct SunFrame {
  float to_sun[3], right[3], up[3];
};

/// Points of the disc, and of a pixel in units of it about its middle.
struct alignas(64) SunPoints {
  static constexpr int kMost = 128;
  float x[kMost], y[kMost], z[kMost];  ///< unit
  float across[kMost], up[kMost];
};

/// Two pixels that send eight rays each: index of the surface, and its first point.
struct SunPair {
  int surface[2], first[2];
};

/// What an image says of its pixels.
struct PixelShape {
  float cone_angle;  ///< of a pixel, radians
  bool panorama;     ///< `pole` is the axis about which columns turn
  float pole[3];
};

}  // namespace airsim360::internal

/// SobolPoint of the indices `first` to `first` + 15, as unit vectors.
AIRSIM360_DECLARE_KERNEL(void SharedSphere(uint32_t first, uint32_t seed, float* x, float* y, float* z))
/// The first `count` points of the disc, a multiple of 16; `of_pixel`: and those of the pixel.
AIRSIM360_DECLARE_KERNEL(void SharedSun(const SunFrame& sun, uint32_t seed, int count, bool of_pixel, SunPoints& points))
/// Rays to points of the disc from all over the parts of their surfaces' planes that two pixels show, lifted off them:
/// fills origin and direction.
AIRSIM360_DECLARE_KERNEL(void LiftSunRays(const RaySet& rays, const SurfaceSet& surfaces, const SunFrame& sun, const SunPoints& points,
                                          const PixelShape& pixel, const SunPair& pair, RayHit16& out))
