// Distance fields after the usual smooth unions, marched along parallel rays; light from the upper left, fill from the right.
#include "airsim360/worlds/props/portrait.h"

#include <algorithm>
#include <cmath>

namespace airsim360::internal {
namespace {

enum class Cloth { kSkin, kHair, kEye, kLips, kJacket, kLapel, kShirt, kTie };

struct Near {
  float distance;
  Cloth cloth;
};

float Length2(float x, float y) { return std::sqrt(x * x + y * y); }
float Ellipsoid(Vec3f p, Vec3f c, Vec3f r) {
  const Vec3f q{(p.x - c.x) / r.x, (p.y - c.y) / r.y, (p.z - c.z) / r.z};
  const float k0 = Norm(q), k1 = Norm(Vec3f{q.x / r.x, q.y / r.y, q.z / r.z});
  return k1 > 1e-6f ? k0 * (k0 - 1) / k1 : -std::min({r.x, r.y, r.z});
}
float Capsule(Vec3f p, Vec3f a, Vec3f b, float ra, float rb) {
  const Vec3f v = b - a;
  const float t = std::clamp(Dot(p - a, v) / Dot(v, v), 0.0f, 1.0f);
  return Norm(p - a - v * t) - (ra + (rb - ra) * t);
}
float Join(float a, float b, float k) {
  const float h = std::max(k - std::abs(a - b), 0.0f) / k;
  return std::min(a, b) - h * h * k / 4;
}
float Carve(float a, float b, float k) { return -Join(-a, b, k); }

// The head about its own middle, z to the viewer, y up, half symmetrical.
float HeadShape(Vec3f p) {
  const Vec3f s{std::abs(p.x), p.y, p.z};
  float d = Ellipsoid(p, {0, 0.12f, -0.02f}, {0.335f, 0.40f, 0.385f});                             // skull
  d = Join(d, Ellipsoid(p, {0, -0.18f, 0.08f}, {0.245f, 0.29f, 0.27f}), 0.14f);                    // jaw
  d = Join(d, Ellipsoid(p, {0, -0.385f, 0.215f}, {0.085f, 0.07f, 0.075f}), 0.10f);                 // chin
  d = Join(d, Ellipsoid(s, {0.175f, -0.04f, 0.245f}, {0.085f, 0.07f, 0.06f}), 0.12f);              // cheekbones
  d = Join(d, Capsule(s, {0.03f, 0.155f, 0.345f}, {0.19f, 0.15f, 0.275f}, 0.035f, 0.03f), 0.07f);  // brow ridge
  d = Carve(d, Ellipsoid(s, {0.125f, 0.07f, 0.375f}, {0.075f, 0.05f, 0.055f}), 0.07f);             // sockets
  d = Join(d, Capsule(p, {0, 0.11f, 0.335f}, {0, -0.085f, 0.43f}, 0.028f, 0.045f), 0.06f);         // nose
  d = Join(d, Ellipsoid(s, {0.05f, -0.095f, 0.38f}, {0.035f, 0.03f, 0.04f}), 0.04f);               // nostrils
  d = Join(d, Ellipsoid(s, {0.345f, 0.02f, -0.02f}, {0.035f, 0.11f, 0.07f}), 0.04f);               // ears
  d = Join(d, Ellipsoid(s, {0.118f, 0.098f, 0.305f}, {0.075f, 0.03f, 0.045f}), 0.03f);             // lids
  return d;
}

float Lips(Vec3f p) {
  const float upper = Ellipsoid(p, {0, -0.222f, 0.318f}, {0.098f, 0.020f, 0.045f});
  const float lower = Ellipsoid(p, {0, -0.258f, 0.312f}, {0.082f, 0.026f, 0.048f});
  return Join(upper, lower, 0.012f);
}

float Hair(Vec3f p) {
  const float cap = Ellipsoid(p, {0, 0.20f, -0.055f}, {0.372f, 0.385f, 0.415f});
  const float sweep = Ellipsoid(p, {0.06f, 0.44f, 0.11f}, {0.27f, 0.12f, 0.24f});
  const float strands = 0.006f * std::sin(46 * p.x + 17 * p.z) + 0.004f * std::sin(83 * (p.x + 0.4f * p.y));
  // Off the face: below the hairline in front, below the ears at the sides.
  const float line = 0.335f + 0.05f * p.x - 0.35f * p.x * p.x;
  const float front = std::min(line - p.y, p.z - 0.045f - 0.9f * std::max(0.0f, p.y - 0.30f));
  const float low = 0.015f - p.y - 0.22f * std::max(0.0f, -p.z);
  return std::max({Join(cap, sweep, 0.08f) + strands, front, low});
}

float Torso(Vec3f p) {
  const Vec3f s{std::abs(p.x), p.y, p.z};
  float d = Ellipsoid(p, {0, -1.45f, -0.06f}, {0.74f, 0.98f, 0.44f});
  d = Join(d, Capsule(s, {0.30f, -0.78f, -0.10f}, {0.92f, -0.98f, -0.12f}, 0.22f, 0.25f), 0.22f);
  return Join(d, Capsule(s, {0.95f, -1.0f, -0.12f}, {1.10f, -2.0f, -0.05f}, 0.25f, 0.22f), 0.12f);
}

struct Bust {
  float turn_cos, turn_sin;

  Vec3f ToHead(Vec3f p) const { return {p.x * turn_cos - p.z * turn_sin, p.y - 0.12f, p.x * turn_sin + p.z * turn_cos}; }

  Near At(Vec3f p) const {
    const Vec3f h = ToHead(p);
    Near best{HeadShape(h), Cloth::kSkin};
    best.distance = Join(best.distance, Capsule(p, {0, -0.20f, -0.10f}, {0, -0.74f, -0.14f}, 0.185f, 0.225f), 0.06f);
    const auto take = [&](float d, Cloth cloth) {
      if (d < best.distance) best = {d, cloth};
    };
    const Vec3f side{std::abs(h.x), h.y, h.z};
    take(Ellipsoid(side, {0.122f, 0.066f, 0.272f}, {0.060f, 0.052f, 0.058f}), Cloth::kEye);
    take(Lips(h), Cloth::kLips);
    take(Hair(h), Cloth::kHair);
    // Brows.
    take(Capsule(side, {0.055f, 0.150f, 0.392f}, {0.215f, 0.158f, 0.315f}, 0.015f, 0.009f), Cloth::kHair);
    const float torso = Torso(p), ax = std::abs(p.x);
    // The opening of the jacket: a V from the neck down; lapels along it; collar points of the shirt.
    const float half = 0.30f * std::clamp((p.y + 1.62f) / 0.95f, 0.0f, 1.0f);
    const bool front = p.z > -0.05f;
    if (front && ax < half) {
      const float knot = std::clamp((p.y + 0.95f) / 0.1f, 0.0f, 1.0f);
      const float tie = 0.058f + 0.05f * std::clamp((-0.85f - p.y) / 0.9f, 0.0f, 1.0f) - 0.02f * knot;
      const float bulge = ax < tie && p.y < -0.80f ? 0.035f * std::sqrt(std::max(0.0f, 1 - ax * ax / (tie * tie))) : 0;
      take(torso + 0.03f - bulge, ax < tie && p.y < -0.80f ? Cloth::kTie : Cloth::kShirt);
    } else {
      const float notch = p.y > -0.98f ? std::clamp((-0.70f - p.y) / 0.28f, 0.0f, 1.0f) : 1.0f;
      const float lapel = 0.24f * std::clamp((p.y + 1.75f) / 0.7f, 0.0f, 1.0f) * notch;
      const bool on = front && ax < half + lapel && p.y > -1.72f;
      take(torso - (on ? 0.022f : 0.0f), on ? Cloth::kLapel : Cloth::kJacket);
    }
    const Vec3f mirrored{ax, p.y, p.z};
    const float band = Capsule(mirrored, {0.25f, -0.56f, -0.22f}, {0.17f, -0.64f, 0.06f}, 0.045f, 0.045f);
    const float wing = Capsule(mirrored, {0.17f, -0.64f, 0.06f}, {0.12f, -0.80f, 0.22f}, 0.05f, 0.018f);
    take(Join(band, wing, 0.05f), Cloth::kShirt);
    take(Ellipsoid(p, {0, -0.79f, 0.20f}, {0.06f, 0.07f, 0.06f}), Cloth::kTie);
    return best;
  }
  Vec3f Normal(Vec3f p) const {
    constexpr float e = 0.0025f;
    const float d = At(p).distance;
    return Normalized(Vec3f{At(p + Vec3f{e, 0, 0}).distance - d, At(p + Vec3f{0, e, 0}).distance - d, At(p + Vec3f{0, 0, e}).distance - d});
  }
  // Share of a large lamp that is seen.
  float Lit(Vec3f p, Vec3f to_light) const {
    float lit = 1;
    for (float t = 0.05f; t < 1.6f && lit > 0.02f;) {
      const float d = At(p + to_light * t).distance;
      lit = std::min(lit, 7 * d / t);
      t += std::clamp(d, 0.03f, 0.2f);
    }
    return std::clamp(lit, 0.0f, 1.0f);
  }
  float Open(Vec3f p, Vec3f n) const {
    float closed = 0;
    for (float t : {0.04f, 0.10f, 0.20f}) closed += (t - At(p + n * t).distance) * 0.9f;
    return std::clamp(1 - closed * 2.2f, 0.15f, 1.0f);
  }
};

struct Finish {
  Vec3f color;
  float gloss = 0.10f, power = 22;
};

// Rosier on cheeks, nose and ears; a shaved chin is cooler.
Vec3f SkinColor(Vec3f skin, Vec3f head, float y) {
  const float cheek = std::exp(-14 * (std::pow(std::abs(head.x) - 0.17f, 2.0f) + std::pow(head.y + 0.09f, 2.0f)));
  const float chin = std::clamp((-0.14f - head.y) * 5, 0.0f, 1.0f) * (y > -0.45f ? 1.0f : 0.0f);
  return {skin.x * (1 + 0.10f * cheek - 0.10f * chin), skin.y * (1 - 0.10f * cheek - 0.08f * chin), skin.z * (1 - 0.12f * cheek)};
}

Vec3f EyeColor(Vec3f iris, Vec3f head) {
  const float r = Length2(std::abs(head.x) - 0.122f, head.y - 0.066f);
  return r < 0.012f ? Vec3f{0.01f, 0.01f, 0.01f} : r < 0.028f ? iris : Vec3f{0.62f, 0.60f, 0.58f};
}

// What covers the point that the ray through (x, y) meets; `head`: the point in the head's frame, `height`: its y.
Finish FinishAt(const Sitter& sitter, Cloth cloth, Vec3f head, float height, float x, float y) {
  switch (cloth) {
    case Cloth::kSkin:
      return {SkinColor(sitter.skin, head, height)};
    case Cloth::kHair:
      return {sitter.hair * (0.9f + 0.5f * std::abs(std::sin(60 * head.x + 9 * head.z))), 0.22f, 30};
    case Cloth::kEye:
      return {EyeColor(sitter.iris, head), 0.9f, 90};
    case Cloth::kLips:
      return {{sitter.skin.x * 0.80f, sitter.skin.y * 0.52f, sitter.skin.z * 0.52f}, 0.25f};
    case Cloth::kJacket:
      return {sitter.jacket * (0.95f + 0.05f * std::sin(160 * x) * std::sin(150 * y)), 0.02f};
    case Cloth::kLapel:
      return {sitter.jacket * 1.15f, 0.03f};
    case Cloth::kShirt:
      return {sitter.shirt, 0.03f};
    case Cloth::kTie:
      return {sitter.tie * (std::sin(48 * (x + y)) > 0.6f ? 2.2f : 1.0f), 0.15f};
  }
  return {sitter.skin};
}

// Under a key light from the upper left, a fill from the right and a rim light from behind.
Vec3f LightBust(const Bust& bust, Vec3f p, Vec3f n, bool skin, const Finish& finish) {
  const Vec3f key = Normalized(Vec3f{-0.62f, 0.55f, 0.60f}), fill{0.80f, 0.10f, 0.59f}, rim = Normalized(Vec3f{0.75f, 0.35f, -0.55f});
  const float wrap = skin ? 0.22f : 0.0f, open = bust.Open(p, n);
  const float k = std::max(0.0f, (Dot(n, key) + wrap) / (1 + wrap)) * bust.Lit(p + n * 0.01f, key);
  const float f = std::max(0.0f, Dot(n, fill)) * open, r = std::pow(std::max(0.0f, Dot(n, rim)), 2.0f);
  // Light that went through skin comes out red at the edge of the shadow.
  const Vec3f warm = skin ? Vec3f{1, 0.93f - 0.1f * (1 - k), 0.88f - 0.15f * (1 - k)} : Vec3f{1, 1, 1};
  const float amount = 1.15f * k + 0.30f * f + 0.22f * open + 0.5f * r;
  const Vec3f half = Normalized(key + Vec3f{0, 0, 1});
  const float shine = finish.gloss * std::pow(std::max(0.0f, Dot(n, half)), finish.power) * k;
  const Vec3f& color = finish.color;
  return {color.x * amount * warm.x + shine, color.y * amount * warm.y + shine, color.z * amount * warm.z + shine};
}

}  // namespace

Vec3f PortraitColor(const Sitter& sitter, float x, float y, Vec3f background) {
  // Nobody outside of this.
  if (std::abs(x) > (y < -0.55f ? 1.4f : 0.45f) || y > 0.78f) return background;
  const Bust bust{std::cos(sitter.turn), std::sin(sitter.turn)};
  Vec3f p{x, y, 0.9f};
  Near near{};
  for (int i = 0; i < 60; ++i) {
    near = bust.At(p);
    if (near.distance < 0.0015f) break;
    p.z -= near.distance * 0.8f;
    if (p.z < -0.7f) return background;
  }
  const bool skin = near.cloth == Cloth::kSkin || near.cloth == Cloth::kLips;
  return LightBust(bust, p, bust.Normal(p), skin, FinishAt(sitter, near.cloth, bust.ToHead(p), p.y, x, y));
}

}  // namespace airsim360::internal
