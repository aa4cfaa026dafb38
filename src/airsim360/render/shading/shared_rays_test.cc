// Directions shared by a tile's pixels: the points of the sequence one by one, to the bit, by every instruction set.
#include "airsim360/render/shading/shared_rays_kernel.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "airsim360/render/shading/sampling.h"

namespace airsim360::internal {
namespace {

std::vector<decltype(&isa_sse42::SharedSphere)> SphereKernels() {
  std::vector<decltype(&isa_sse42::SharedSphere)> kernels{&isa_sse42::SharedSphere};
  if (__builtin_cpu_supports("avx2")) kernels.push_back(&isa_avx2::SharedSphere);
  if (CurrentKernelIsa() == KernelIsa::kAvx512) kernels.push_back(&isa_avx512::SharedSphere);
  return kernels;
}

std::vector<decltype(&isa_sse42::SharedSun)> SunKernels() {
  std::vector<decltype(&isa_sse42::SharedSun)> kernels{&isa_sse42::SharedSun};
  if (__builtin_cpu_supports("avx2")) kernels.push_back(&isa_avx2::SharedSun);
  if (CurrentKernelIsa() == KernelIsa::kAvx512) kernels.push_back(&isa_avx512::SharedSun);
  return kernels;
}

TEST(SharedRays, PointsOfTheSphereAreThoseOfTheSequence) {
  for (const auto kernel : SphereKernels()) {
    for (const uint32_t first : {0u, 7u, 61u, 4090u, 65535u}) {
      alignas(64) float x[16], y[16], z[16];
      kernel(first, 1234567u, x, y, z);
      for (uint32_t i = 0; i < 16; ++i) {
        const Vec3f point = SpherePoint(SobolPoint(first + i, 1234567u));
        ASSERT_EQ((Vec3f{x[i], y[i], z[i]}), point) << first + i;
      }
    }
  }
}

TEST(SharedRays, PointsOfTheSunAreThoseOfTheSequence) {
  const Vec3f to_sun = Normalized(Vec3f{0.3f, -0.5f, 0.7f});
  const SunDisc disc(to_sun);
  const Vec3f right = disc.right(), up = disc.up();
  const SunFrame frame{{to_sun.x, to_sun.y, to_sun.z}, {right.x, right.y, right.z}, {up.x, up.y, up.z}};
  for (const auto kernel : SunKernels()) {
    SunPoints points;
    kernel(frame, 99u, SunPoints::kMost, true, points);
    for (uint32_t i = 0; i < SunPoints::kMost; ++i) {
      const Vec3f direction = disc.At(SobolPoint(i, 99u ^ 0x68bc21ebu));
      ASSERT_EQ((Vec3f{points.x[i], points.y[i], points.z[i]}), direction) << i;
      EXPECT_NEAR(Norm(direction), 1, 1e-6);
      EXPECT_LT(Norm(direction - to_sun), 0.00463f);
      const Vec2f of_pixel = SobolPoint(i, 99u ^ 0x02e5be93u);
      ASSERT_EQ(points.across[i], of_pixel.x - 0.5f);
      ASSERT_EQ(points.up[i], of_pixel.y - 0.5f);
    }
  }
}

}  // namespace
}  // namespace airsim360::internal
