// Views in closed form and noisy light on them, for tests of the denoiser.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "airsim360/base/random.h"
#include "airsim360/render/filter/denoiser.h"
#include "airsim360/render/frame/test_room.h"

namespace airsim360::internal {

/// Guides of a scene in closed form.
struct View {
  Camera camera;
  RigidTransform X_WC;
  Image<float> range;
  Image<uint32_t> entity;
  Image<Vec3f> normal;

  int width() const { return range.width(); }
  int height() const { return range.height(); }
  FilterGuides guides() const { return {&camera, X_WC, &range, &entity, &normal, &normal}; }
};

inline View MakeView(int width, Vec3d p, const std::function<test::Truth(Vec3d, Vec3d)>& look, Mat3d R = {}) {
  const RigidTransform X_WC{R * CameraInBody().R, p};
  const Equirectangular erp{width, width / 2};
  View view{erp, X_WC, Image<float>(width, width / 2), Image<uint32_t>(width, width / 2), Image<Vec3f>(width, width / 2)};
  for (int y = 0; y < width / 2; ++y) {
    for (int x = 0; x < width; ++x) {
      const test::Truth truth = look(p, X_WC.R * *PixelToRay(erp, {x + 0.5, y + 0.5}));
      view.range(x, y) = truth.range < 1e29 ? static_cast<float>(truth.range) : 0;
      view.entity(x, y) = truth.entity;
      view.normal(x, y) = VecCast<float>(truth.normal);
    }
  }
  return view;
}

/// A sphere of 10 m about the camera, one entity: every pixel is like every other.
inline View MakeBall(int width) {
  return MakeView(width, {}, [](Vec3d, Vec3d d) { return test::Truth{10, 1, -d}; });
}

inline View MakeRoomView(int width, Vec3d p = {0.3, -0.4, 2}) { return MakeView(width, p, test::Look); }

/// Uniform noise of standard deviation `sigma` about `mean`, by pixel.
inline Image<Rgb32f> Noise(const View& view, float mean, float sigma, uint64_t seed = 1) {
  Image<Rgb32f> light(view.width(), view.height());
  RngStream rng(seed, "noise");
  for (Rgb32f& c : light.pixels()) {
    const float v = mean + sigma * static_cast<float>(rng.Uniform(-std::sqrt(3.0), std::sqrt(3.0)));
    c = {v, v, v};
  }
  return light;
}

inline Image<Rgb32f> Filter(const View& view, Image<Rgb32f> light, const Image<uint8_t>* samples = nullptr, float radius_px = 16) {
  Denoiser().Run(view.guides(), {&light, samples, radius_px}, false);
  return light;
}

/// Mean squared difference from `mean` over pixels chosen, weighted by solid angle.
inline double Variance(const View& view, const Image<Rgb32f>& light, float mean, const std::function<bool(int, int)>& use) {
  double sum = 0, weight = 0;
  for (int y = 0; y < view.height(); ++y) {
    const double w = std::cos(std::numbers::pi * (0.5 - (y + 0.5) / view.height()));
    for (int x = 0; x < view.width(); ++x) {
      if (!use(x, y)) continue;
      const double d = light(x, y).g - mean;
      sum += w * d * d;
      weight += w;
    }
  }
  return sum / weight;
}

inline bool Anywhere(int, int) { return true; }

}  // namespace airsim360::internal
