#include "airsim360/render/sky/clouds.h"

#include <algorithm>
#include <cmath>

#include "airsim360/base/parallel.h"
#include "airsim360/render/shared/shading_scalar.h"

namespace airsim360::internal {
namespace {

constexpr float kBase = 1300, kTop = 2900, kFarthest = 60e3f, kEarth = 6360e3f;
constexpr float kExtinction = 0.042f;  // 1 / m at density 1
constexpr int kMap = 1024;             // coverage map, texels a side
constexpr float kMapCell = 2 * kFarthest / kMap;

float Clamp01(float x) { return x < 0 ? 0.0f : x > 1 ? 1.0f : x; }
float Mix(float a, float b, float t) { return a + (b - a) * t; }
Vec3f Mix(Vec3f a, Vec3f b, float t) { return a + (b - a) * t; }
float Exp(float x) { return scalar::exp_approx(x); }

// Henyey-Greenstein.
float Phase(float g, float mu) {
  const float d = 1 + g * g - 2 * g * mu;
  return (1 - g * g) / (4 * 3.14159265f * d * std::sqrt(d));
}

// Distance along a ray of sine `z` from the ground to the sphere `height` above it.
float DistanceToLayer(float z, float height) {
  const float b = kEarth * std::max(z, 0.003f);
  return -b + std::sqrt(b * b + 2 * kEarth * height);
}

float Altitude(Vec3f p) { return p.z + (p.x * p.x + p.y * p.y) * (0.5f / kEarth); }

}  // namespace

Clouds::Clouds(double cover, double cirrus, const CloudLight& light)
    : light_(light),
      cover_(static_cast<float>(std::clamp(cover, 0.0, 1.0))),
      cirrus_(static_cast<float>(std::clamp(cirrus, 0.0, 1.0))) {
  if (cover_ <= 0) return;
  FreeTheSun();
  BakeCoverage();
}

// How much cloud stands over a place, [0, 1]; p relative to the observer.
float Clouds::Coverage(float x, float y) const {
  const float qx = x + offset_x_, qy = y + offset_y_;
  const float c = 0.58f * ValueNoise(qx / 2600, qy / 2600, 3) + 0.30f * ValueNoise(qx / 950, qy / 950, 4) +
                  0.12f * ValueNoise(qx / 420, qy / 420, 5);
  const float far = SmoothStep(2000, 9500, std::sqrt(x * x + y * y));
  const float threshold = Mix(0.70f, 0.40f, far) - (cover_ - 0.35f) * 0.75f;
  return Clamp01((c - threshold) / 0.28f);
}

// Moves the field until the sun's disc and its surroundings are clear.
void Clouds::FreeTheSun() {
  if (light_.to_sun.z < 0.03f) return;
  for (int k = 0; k < 96; ++k) {
    offset_x_ = 400 + 1733.0f * static_cast<float>(k);
    offset_y_ = -911.0f * static_cast<float>(k);
    const float t = 0.5f * (kBase + kTop) / light_.to_sun.z;
    float blocked = 0;
    for (int j = -3; j <= 3; ++j) {
      for (int i = -3; i <= 3; ++i)
        blocked += Coverage(light_.to_sun.x * t + 330.0f * static_cast<float>(i),
                            light_.to_sun.y * t + 330.0f * static_cast<float>(j));
    }
    if (blocked <= 0.05f) return;
  }
}

void Clouds::BakeCoverage() {
  coverage_.resize(static_cast<size_t>(kMap) * kMap);
  ParallelFor(kMap, [&](int64_t j) {
    for (int i = 0; i < kMap; ++i) {
      coverage_[static_cast<size_t>(j) * kMap + i] =
          Coverage((static_cast<float>(i) + 0.5f) * kMapCell - kFarthest,
                   (static_cast<float>(j) + 0.5f) * kMapCell - kFarthest);
    }
  });
}

// Density in [0, 1]; detail 0 = base shape, 1 = eroded, 2 = with small turrets.
float Clouds::Density(Vec3f p, int detail) const {
  const float h = (Altitude(p) - kBase) / (kTop - kBase);
  if (h <= 0 || h >= 1) return 0;
  const float mx = (p.x + kFarthest) / kMapCell - 0.5f, my = (p.y + kFarthest) / kMapCell - 0.5f;
  const int i = std::clamp(static_cast<int>(mx), 0, kMap - 2),
            j = std::clamp(static_cast<int>(my), 0, kMap - 2);
  const float fx = mx - static_cast<float>(i), fy = my - static_cast<float>(j);
  const float* m = &coverage_[static_cast<size_t>(j) * kMap + i];
  const float c = Clamp01(Mix(Mix(m[0], m[1], fx), Mix(m[kMap], m[kMap + 1], fx), fy));
  if (c <= 0.01f) return 0;

  // Flat base, domed top that stands higher where there is more cloud.
  const float profile = SmoothStep(0, 0.07f, h) * (1 - SmoothStep(0.18f + 0.5f * c, 0.34f + 0.66f * c, h));
  if (profile <= 0.01f) return 0;
  const Vec3f q{p.x + offset_x_, p.y + offset_y_, p.z};
  float d = Clamp01((noise_.At(q * (1 / 1700.0f)) - 0.33f) * 2.2f * profile * (0.5f + c) - (1 - c) * 0.28f -
                    (1 - profile) * 0.3f);
  if (d <= 0 || detail == 0) return d;
  float erosion =
      0.60f * noise_.At(q * (1 / 430.0f) + Vec3f{0.3f, 0.1f, h}) + 0.28f * noise_.At(q * (1 / 130.0f));
  erosion += 0.12f * (detail == 2 ? noise_.At(q * (1 / 47.0f)) : 0.5f);
  return Clamp01((d - (0.60f - erosion) * 0.80f * (1 - d)) * 2.2f);
}

float Clouds::DepthTowardsSun(Vec3f p, float dither) const {
  float sum = 0, step = 40, t = step * (0.3f + 0.4f * dither);
  for (int i = 0; i < 5; ++i) {
    sum += Density(p + light_.to_sun * t, i < 2 ? 1 : 0) * step;
    t += step * 0.5f;
    step *= 1.9f;
    t += step * 0.5f;
  }
  return sum * kExtinction;
}

// Fall streaks of ice, drawn out along the wind (x); coordinates in units of 5 km.
float Clouds::CirrusAlpha(float x, float y) const {
  const float mask = SmoothStep(Mix(0.66f, 0.30f, cirrus_), Mix(0.86f, 0.62f, cirrus_),
                                FractalNoise(x * 0.55f + 3, y * 0.75f, 4, 72));
  if (mask <= 0) return 0;
  const float bend = FractalNoise(x * 0.5f + 9, y * 0.5f, 3, 51) - 0.5f,
              curl = FractalNoise(x * 1.3f, y * 1.3f + 5, 3, 57) - 0.5f;
  const float u = x + 0.5f * bend, v = y + 1.1f * bend + 0.22f * curl;
  const float fibre = FractalNoise(u * 1.0f, v * 7.5f, 6, 61);
  const float hair = FractalNoise(u * 2.6f + 4, v * 24.0f + 2.5f * curl, 4, 65);
  const float veil = FractalNoise(u * 0.9f + 1, v * 1.6f, 4, 68);
  const float body = SmoothStep(0.40f, 0.80f, 0.62f * fibre + 0.24f * hair + 0.2f * veil);
  return mask * (0.12f * veil + body * body);
}

// Ice forward-scatters strongly: bright about the sun, thin elsewhere.
Vec3f Clouds::AddCirrus(Vec3f direction, Vec3f behind) const {
  const float fade = SmoothStep(0.04f, 0.22f, direction.z) * SmoothStep(0.0f, 0.1f, cirrus_);
  if (fade <= 0) return behind;
  const float mu = Dot(direction, light_.to_sun);
  const float scatter = 0.06f + 0.16f * std::pow(std::max(0.0f, mu), 6.0f);
  // The distance is bounded so that nothing streaks into the horizon.
  const float t = 7600 / (direction.z + 0.05f);
  const float x = direction.x * t * 0.92f + direction.y * t * 0.39f,
              y = direction.y * t * 0.92f - direction.x * t * 0.39f;
  const float alpha = (1 - Exp(-1.1f * CirrusAlpha(x / 5200 + 7, y / 5200))) * fade;
  return Mix(behind, light_.sun_high * scatter + light_.ambient * 0.55f + behind * 0.3f, alpha);
}

// Fleecy rows: cells of about 350 m in patches of some kilometres; metres.
float Clouds::PuffAlpha(float x, float y) const {
  const float mask = SmoothStep(Mix(0.80f, 0.52f, cover_), Mix(0.92f, 0.74f, cover_),
                                FractalNoise(x / 6500 + 21, y / 5200, 3, 80));
  if (mask <= 0) return 0;
  const float wave = 0.08f * std::sin(x / 210 + 3 * FractalNoise(x / 1500, y / 1500, 2, 84));
  const float cells = FractalNoise(x / 420, y / 300, 5, 86) + wave;
  return SmoothStep(0.62f - 0.26f * mask, 0.86f - 0.22f * mask, cells) * mask;
}

// Lit on the sun's side: the sheet is thicker behind where it grows away from the sun.
Vec3f Clouds::AddPuffs(Vec3f direction, Vec3f behind) const {
  // None overhead, where a panorama would draw them across its whole width.
  const float fade = SmoothStep(0.10f, 0.30f, direction.z) * (1 - SmoothStep(0.80f, 0.95f, direction.z)) *
                     SmoothStep(0.1f, 0.3f, cover_);
  if (fade <= 0) return behind;
  const float t = 4300 / (direction.z + 0.03f), x = direction.x * t, y = direction.y * t;
  const float here = PuffAlpha(x, y);
  if (here <= 0.003f) return behind;
  const float towards = PuffAlpha(x + light_.to_sun.x * 150, y + light_.to_sun.y * 150);
  const float side = Clamp01(0.72f + 0.9f * (here - towards) - 0.30f * here);
  const float mu = Dot(direction, light_.to_sun);
  const float scatter = side * (0.085f + 0.16f * std::pow(std::max(0.0f, mu), 5.0f));
  const float alpha = (1 - Exp(-2.4f * here)) * fade * 0.9f;
  return Mix(behind, Mix(light_.sun, light_.sun_high, 0.4f) * scatter + light_.ambient * 0.75f, alpha);
}

float Clouds::SunAt(float x, float y) const {
  if (cover_ <= 0 || light_.to_sun.z < 0.03f) return 1;
  constexpr int kSteps = 20;
  const float z = std::max(light_.to_sun.z, 0.17f);
  const float first = kBase / z, step = (kTop - kBase) / z / kSteps;
  const Vec3f to_sun{light_.to_sun.x, light_.to_sun.y, z};
  float depth = 0;
  for (int i = 0; i < kSteps; ++i)
    depth += Density(Vec3f{x, y, 0} + to_sun * (first + (static_cast<float>(i) + 0.5f) * step), 1) * step;
  // What scatters forwards through the cloud still comes from about the sun: a floor, and a softer fall than
  // of the direct beam alone.
  return 0.10f + 0.90f * Exp(-0.4f * kExtinction * depth);
}

Vec3f Clouds::Over(Vec3f direction, Vec3f behind, Vec3f haze, float dither) const {
  const Vec3f background = AddPuffs(direction, AddCirrus(direction, behind));
  if (cover_ <= 0) return background;
  const float first = DistanceToLayer(direction.z, kBase),
              last = std::min(DistanceToLayer(direction.z, kTop), kFarthest);
  if (first >= last) return background;

  // Multiple scattering as three octaves of single scattering, each wider, weaker and less attenuated.
  const float mu = Dot(direction, light_.to_sun);
  float phase[3], g = 1;
  for (float& p : phase) {
    p = 0.62f * Phase(0.72f * g, mu) + 0.38f * Phase(-0.22f * g, mu);
    g *= 0.55f;
  }
  Vec3f light{};
  float through = 1, distance = 0, weight = 0;
  float t = first + dither * std::max(16.0f, 0.008f * first);
  while (t < last && through > 0.015f) {
    const float step = std::max(18.0f, 0.0065f * t);
    const Vec3f p = direction * t;
    const float density = Density(p, t < 14000 ? 2 : 1);
    if (density <= 0) {
      t += step * (Density(p, 0) > 0 ? 1.0f : 2.2f);
      continue;
    }
    const float depth = DepthTowardsSun(p, dither);
    float a = 1, b = 1, direct = 0;
    for (float ph : phase) {
      direct += ph * a * Exp(-depth * b);
      a *= 0.72f;
      b *= 0.20f;
    }
    const float h = Clamp01((Altitude(p) - kBase) / (kTop - kBase));
    const Vec3f source =
        light_.sun * (1.40f * direct + 0.014f + 0.035f * h) + light_.ambient * (0.40f + 0.75f * h);
    const float kept = Exp(-density * kExtinction * step);
    const float share = through * (1 - kept);
    light += source * share;
    distance += t * share;
    weight += share;
    through *= kept;
    t += step;
  }
  if (weight < 1e-4f) return background;
  // The air between fades far clouds into the horizon.
  const float clear = Exp(-distance / weight / 21000.0f);
  return background * through + light * clear + haze * ((1 - clear) * (1 - through));
}

}  // namespace airsim360::internal
