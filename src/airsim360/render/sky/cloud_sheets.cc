#include "airsim360/render/sky/cloud_sheets.h"

#include <algorithm>
#include <cmath>

#include "airsim360/base/random.h"
#include "airsim360/math/angles.h"
#include "airsim360/render/shared/shading_scalar.h"
#include "airsim360/render/sky/cloud_geometry.h"
#include "airsim360/render/sky/noise.h"
#include "airsim360/render/sky/sky_table.h"

namespace airsim360::internal {
namespace {

constexpr Vec3f kDeckColor{0.955f, 1.0f, 1.06f};  // daylight through water, a little bluer than sun and sky together

float Fractal(float x, float y, int octaves, int seed) { return FractalNoise(x, y, 0, octaves, seed); }
int ShortSeed(uint32_t seed) { return static_cast<int>(seed & 0xffffff); }
float Gradation(float z) { return (1 + 2 * std::max(z, 0.0f)) / 3; }

}  // namespace

Cirrus::Cirrus(float cover, Vec2f wind, uint32_t seed) : cover_(cover), wind_(wind), seed_(ShortSeed(seed)) {
  height_ = 7600 + 2400 * HashUnit(seed_, 1, 0);
}

float Cirrus::Depth(float x, float y) const {
  if (cover_ <= 0) return 0;
  x *= 1e-3f, y *= 1e-3f;
  const float bend_x = Fractal(x / 22, y / 22, 3, seed_ + 301), bend_y = Fractal(x / 22, y / 22, 3, seed_ + 311);
  const float patches = Fractal((x + 8 * bend_x) / 26, (y + 8 * bend_y) / 26, 4, seed_ + 321);
  const float mask = SmoothStep(-0.15f, 0.40f, patches + (cover_ - 0.5f) * 0.7f);
  if (mask <= 0) return 0;
  const float turn = 3.6f * Fractal(x / 45, y / 45, 2, seed_ + 331);
  float u = wind_.x * x + wind_.y * y, v = wind_.x * y - wind_.y * x;
  v += 3.5f * bend_x + 1.3f * Fractal(x / 7, y / 7, 3, seed_ + 341) + turn;
  u += 4 * bend_y;
  const float fibres = Fractal(u / 12, v / 2.1f, 5, seed_ + 351), veil = Fractal(u / 9, v / 6, 5, seed_ + 361);
  const float broken = SmoothStep(-0.35f, 0.4f, veil);
  const float body = 0.2f * broken + 2.2f * std::max(0.0f, fibres + 0.06f) * broken + 0.3f * mask * broken;
  return 1.2f * cover_ * mask * body;
}

StratusDeck::StratusDeck(float base, float illuminance, Vec3f to_sun, Vec2f wind, uint32_t seed)
    : base_(base), to_sun_(to_sun), wind_(wind), seed_(ShortSeed(seed)) {
  RngStream random(seed, "stratus");
  depth_ = static_cast<float>(random.Uniform(9, 24)), contrast_ = static_cast<float>(random.Uniform(1.5, 2.8));
  glow_ = 0.6f * static_cast<float>(random.Uniform() * random.Uniform()) * SmoothStep(0.0f, 0.2f, to_sun.z);
  // What a zenith of 1 would give level ground.
  constexpr int kUp = 24, kAround = 64;
  float level = 0;
  for (int k = 0; k < kUp * kAround; ++k) {
    const float z = std::sqrt((static_cast<float>(k / kAround) + 0.5f) / kUp);
    const Vec3f d = DirectionOf((static_cast<float>(k % kAround) + 0.5f) * 2 * kPiF / kAround, std::asin(z));
    level += Light(d) * (kPiF / (kUp * kAround));
    reflectance_ += Reflectance(d) / (kUp * kAround);
  }
  zenith_ = illuminance / level;
  mean_ = level / (7 * kPiF / 9);  // level ground under the bare gradation
}

// Optical depth of the water there.
float StratusDeck::Depth(Vec3f d) const {
  const float t = DistanceToAltitude(std::max(d.z, 0.002f), base_), scale = 1 / 2600.0f;
  const float x = d.x * t * scale, y = d.y * t * scale;
  const float bend_x = Fractal(0.5f * x, 0.5f * y, 3, seed_ + 401), bend_y = Fractal(0.5f * x, 0.5f * y, 3, seed_ + 411);
  const float u = (wind_.x * x + wind_.y * y) * 0.7f + 0.45f * bend_x, v = wind_.x * y - wind_.y * x + 0.45f * bend_y;
  const float rolls = 0.35f - std::fabs(Fractal(u * 1.9f + bend_x, v * 1.9f, 4, seed_ + 441));
  const float lumps = 0.8f * Fractal(u, v, 6, seed_ + 421) + 0.45f * rolls;
  const float banks = Fractal(u * 0.22f, v * 0.22f, 3, seed_ + 431);
  const float far = scalar::exp_approx(-t / 14000);
  return depth_ * scalar::exp_approx((-1.15f * lumps * (0.25f + 0.75f * far) - 1.1f * banks * (0.3f + 0.7f * far)) * contrast_);
}

// What passes of the light above, and the sun's glow through it.
float StratusDeck::Light(Vec3f d) const {
  const float depth = Depth(d), through = Through(depth), off = 1 - Dot(d, to_sun_);
  const float glow = 1 + glow_ * (1.2f * scalar::exp_approx(-off / 0.10f) * through / 0.35f +
                                  4.0f * scalar::exp_approx(-off / 0.006f) * scalar::exp_approx(-depth / 9));
  return Gradation(d.z) * through * glow;
}

Vec3f StratusDeck::Radiance(Vec3f direction) const { return kDeckColor * (zenith_ * Light(direction)); }

Vec3f StratusDeck::AirLight(Vec3f below) const { return kDeckColor * (zenith_ * Gradation(0) * mean_) + below * reflectance_; }

}  // namespace airsim360::internal
