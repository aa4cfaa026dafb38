// Edges of shadows in a picture of two walls: against a plain sum pixel by pixel, and between instruction sets.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "airsim360/base/random.h"
#include "airsim360/render/frame/tile_kernel.h"
#include "airsim360/render/high/smooth_sun_kernel.h"

namespace airsim360::internal {
namespace {

// A room seen from its middle whose two halves are two entities, with spots of sun and penumbrae at random.
struct Picture {
  int width, height;
  CameraRays rays;
  std::vector<float> range, sun;
  std::vector<uint32_t> entity;
  std::vector<Vec3f> normal;
  std::vector<uint8_t> penumbra;

  Picture(const Camera& camera, int w, int h) : width(w), height(h) {
    rays.Update(camera, Mat3d());
    RngStream rng(5, "sun");
    for (int y = 0; y < h; ++y) {
      for (int x = 0; x < w; ++x) {
        const Vec3f d = Direction(x, y);
        const float ax = std::fabs(d.x), ay = std::fabs(d.y), az = std::fabs(d.z), most = std::max({ax, ay, az});
        range.push_back(2 / most);
        normal.push_back(most == ax   ? Vec3f{d.x < 0 ? 1.0f : -1.0f, 0, 0}
                         : most == ay ? Vec3f{0, d.y < 0 ? 1.0f : -1.0f, 0}
                                      : Vec3f{0, 0, d.z < 0 ? 1.0f : -1.0f});
        entity.push_back(d.x + 0.3f * d.y < 0 ? 1 : 2);
        sun.push_back(static_cast<float>(static_cast<int>(rng.Uniform(0, 9))) / 8);
        penumbra.push_back(static_cast<uint8_t>(rng.Uniform(0, 1) < 0.3 ? 0 : rng.Uniform(0, 60)));
      }
    }
  }

  Vec3f Direction(int x, int y) const {
    const RayField& f = rays.field();
    if (f.separable) {
      const double s = f.row_scale[y];
      return VecCast<float>(Vec3d{s * f.column_x[x] + f.row_x[y], s * f.column_y[x] + f.row_y[y], s * f.column_z[x] + f.row_z[y]});
    }
    const int i = y * f.stride + x;
    const Vec3d d{f.ray_x[i], f.ray_y[i], f.ray_z[i]};
    return VecCast<float>(Vec3d{f.R[0] * d.x + f.R[1] * d.y + f.R[2] * d.z, f.R[3] * d.x + f.R[4] * d.y + f.R[5] * d.z,
                                f.R[6] * d.x + f.R[7] * d.y + f.R[8] * d.z});
  }

  // Calls visit(index, squared distance) for pixels of about the same plane.
  template <class Visit>
  void ForPixels(int x, int y, int rows, int columns, int step, const Visit& visit) const {
    const int i = y * width + x;
    for (int v = std::max(0, y - rows); v <= std::min(height - 1, y + rows); ++v) {
      for (int u = x - columns; u <= x + columns; u += step) {
        if (!rays.field().separable && (u < 0 || u >= width)) continue;
        const int c = (u + width) % width, k = v * width + c;
        if (entity[k] != entity[i] || Dot(normal[i], normal[k]) < 0.9f) continue;
        const Vec3f away = Direction(c, v) * range[k] - Direction(x, y) * range[i];
        if (std::fabs(Dot(normal[i], away)) < 0.02f + 0.01f * range[i]) visit(k, Dot(away, away));
      }
    }
  }

  double Expected(int x, int y) const {
    const RayField& f = rays.field();
    const int i = y * width + x;
    if (penumbra[i] == 0) return sun[i];
    const double across = f.separable ? std::min(1 / f.row_scale[y], width / 8.0) : 1;
    const int square = std::clamp(static_cast<int>(across + 0.5), 1, 20);
    double sum = 0, count = 0, light = 0, weight = 0;
    ForPixels(x, y, 2, 2 * square, square, [&](int k, float) {
      if (penumbra[k] > 1) sum += penumbra[k] - 2, ++count;
    });
    if (count == 0) return sun[i];
    const double spread = std::min(0.45 + 0.13 * sum / (8 * count), 2.5);
    const double metres = spread * rays.cone_angle() * range[i];
    ForPixels(x, y, static_cast<int>(std::ceil(2 * spread)), std::min(40, static_cast<int>(std::ceil(2 * spread * across))), 1,
              [&](int k, float distance2) {
                const double w = std::pow(std::max(0.0, 1 - distance2 / (8 * metres * metres)), 4);
                light += sun[k] * w, weight += w;
              });
    return weight > 0 ? light / weight : sun[i];
  }

  template <class Kernel>
  std::vector<float> Smooth(Kernel kernel) const {
    std::vector<float> out(sun.size(), -1);
    const SunPlanes planes{range.data(), entity.data(), normal.data(), sun.data(), penumbra.data(), out.data()};
    for (int row = 0; row < height; row += kTileSize) {
      for (int column = 0; column < width; column += kTileSize)
        kernel(planes, rays.field(), static_cast<float>(rays.cone_angle()), column, row);
    }
    return out;
  }
};

void ExpectSmooth(const Picture& picture) {
  const std::vector<float> smooth = picture.Smooth(&isa_sse42::SmoothSunTile);
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) ASSERT_NEAR(smooth[y * picture.width + x], picture.Expected(x, y), 2e-5) << x << " " << y;
  }
  if (__builtin_cpu_supports("avx2")) {
    EXPECT_TRUE(smooth == picture.Smooth(&isa_avx2::SmoothSunTile));
  }
  if (CurrentKernelIsa() == KernelIsa::kAvx512) {
    EXPECT_TRUE(smooth == picture.Smooth(&isa_avx512::SmoothSunTile));
  }
}

TEST(SmoothSun, IsTheMeanOfTheSameSurfaceAroundInAPanorama) { ExpectSmooth(Picture(Equirectangular{150, 75}, 150, 75)); }

TEST(SmoothSun, IsTheMeanOfTheSameSurfaceAroundInAPinhole) { ExpectSmooth(Picture(Pinhole{70, 45, 50, 50, 35, 22.5}, 70, 45)); }

}  // namespace
}  // namespace airsim360::internal
