// Manholes and bus stops.
#include <cmath>
#include <numbers>

#include "airsim360/worlds/props/drawing.h"
#include "airsim360/worlds/props/families.h"
#include "airsim360/worlds/props/finishes.h"
#include "airsim360/worlds/props/prop_builder.h"

namespace airsim360::internal {
namespace {

// Pattern of a cast cover over its square: rings of studs, or a grid of bars; 1 = raised.
float CoverRelief(uint32_t variant, float u, float v) {
  const float x = 2 * u - 1, y = 2 * v - 1, r = std::hypot(x, y);
  const auto ease = [](float t) { return std::clamp(t, 0.0f, 1.0f); };
  if (r > 0.80f) return ease(10 * std::min(r - 0.84f, 0.97f - r));
  if (variant == 0) {
    const float fx = std::abs(x * 6 - std::round(x * 6)), fy = std::abs(y * 6 - std::round(y * 6));
    return ease(8 * (0.36f - std::max(fx, fy)));
  }
  const float ring = std::abs(r * 7 - std::round(r * 7)),
              spokes = std::abs(std::remainder(std::atan2(y, x), std::numbers::pi_v<float> / 8)) * r;
  return std::max(ease(6 * (0.28f - ring)), ease(30 * (0.04f - spokes)));
}

// Flush cover: a disc 5 mm above the road in a frame ring.
Model MakeManhole(uint32_t variant, uint64_t) {
  PropBuilder b("manhole");
  const float r = 0.34f;
  Material iron = CastIron();
  iron.base_color = {1, 1, 1};
  iron.roughness = 0.55f;
  const std::string name = "manhole " + std::to_string(variant);
  const Texture color =
      Texture::FromImage(name,
                         Shade(256, 256,
                               [&](float u, float v) {
                                 const float wear = TileFractal(u, v, 4, 4, 4, 61);
                                 return Vec3f{0.085f, 0.078f, 0.070f} * (0.35f + 0.65f * CoverRelief(variant, u, v)) * (0.7f + 0.6f * wear);
                               }),
                         true);
  const Texture normals =
      NormalsFromHeight(name + " normals", 256, 256, 1, [&](float u, float v) { return 0.008f * CoverRelief(variant, u, v); });
  b.Use(iron, color, {2 * r, 2 * r}, &normals);
  const int sides = 40;
  const auto at = [&](int i, float radius, float z) {
    const float a = 2 * std::numbers::pi_v<float> * static_cast<float>(i % sides) / sides;
    return Vec3f{radius * std::cos(a), radius * std::sin(a), z};
  };
  for (int i = 0; i < sides; ++i) {
    const auto uv = [&](Vec3f p) { return Vec2f{r + p.x, r - p.y}; };
    const Vec3f p = at(i, r, 0.005f), q = at(i + 1, r, 0.005f);
    b.mesh().Triangle({0, 0, 0.005f}, p, q, {r, r}, uv(p), uv(q));
  }
  b.Use(CastIron());
  const Vec2f ring[] = {{r + 0.035f, -0.02f}, {r + 0.035f, 0.003f}, {r + 0.030f, 0.006f}, {r, 0.0055f}, {r, 0.004f}};
  b.Lathe(ring, sides);
  return b.Finish();
}

// Shelter with a glass back and side, bench, roof, and an advertising end panel; open towards -Y.
Model MakeBusStop(uint32_t variant, uint64_t) {
  PropBuilder b("bus_stop");
  const Material frame = Paint({0.05f, 0.055f, 0.06f}, 0.35f);
  b.Use(frame);
  for (float x : {-1.9f, 0.0f, 1.9f}) {
    b.BevelBox({x - 0.035f, 0.58f, 0}, {x + 0.035f, 0.65f, 2.40f}, 0.008f);
    b.BevelBox({x - 0.03f, -0.70f, 2.36f}, {x + 0.03f, 0.65f, 2.44f}, 0.01f);
  }
  b.BevelBox({-1.935f, -0.65f, 0}, {-1.865f, -0.58f, 2.40f}, 0.008f);
  for (float z : {0.18f, 2.20f}) b.BevelBox({-1.9f, 0.60f, z}, {1.9f, 0.63f, z + 0.04f}, 0.005f);
  b.BevelBox({-2.05f, -0.85f, 2.435f}, {2.05f, 0.78f, 2.52f}, 0.03f);
  // Panes are made visible by their printed bands and edges alone: clear glass is not drawn.
  b.Use(Glass({0.30f, 0.33f, 0.33f}));
  for (float z : {0.22f, 0.95f, 1.45f}) {
    const float h = z < 0.5f ? 0.30f : 0.10f;
    for (float x : {-1.86f, 0.04f}) b.mesh().Box({x, 0.609f, z}, {x + 1.82f, 0.617f, z + h});
    b.mesh().Box({-1.904f, -0.58f, z}, {-1.896f, 0.58f, z + h});
  }
  // End panel with a poster case.
  b.Use(frame);
  b.BevelBox({1.82f, -0.66f, 0}, {1.98f, 0.58f, 2.36f}, 0.02f);
  Canvas ad(192, 320, variant ? Vec3f{0.55f, 0.10f, 0.04f} : Vec3f{0.05f, 0.30f, 0.36f});
  ad.Disc({0.5f, 0.40f}, 0.20f, {0.80f, 0.72f, 0.55f});
  ad.Disc({0.62f, 0.36f}, 0.13f, variant ? Vec3f{0.55f, 0.10f, 0.04f} : Vec3f{0.05f, 0.30f, 0.36f});
  ad.Letters(variant ? "COFFEE" : "GO GREEN", {0.5f, 0.74f}, 0.075f, {0.80f, 0.78f, 0.72f});
  ad.Letters(variant ? "FRESH DAILY" : "RIDE THE BUS", {0.5f, 0.86f}, 0.042f, {0.80f, 0.78f, 0.72f});
  b.Use(Plastic({1, 1, 1}, 0.2f), ad.Finish(variant ? "advert coffee" : "advert bus"));
  b.Picture({1.815f, 0.50f, 0.35f}, {1.815f, -0.58f, 0.35f}, {1.815f, -0.58f, 2.15f}, {1.815f, 0.50f, 2.15f});
  b.Picture({1.985f, -0.58f, 0.35f}, {1.985f, 0.50f, 0.35f}, {1.985f, 0.50f, 2.15f}, {1.985f, -0.58f, 2.15f});
  // Bench and sign.
  UseWood(b, {0.9f, 0.85f, 0.8f}, Grain::kAlongX);
  for (int i = 0; i < 4; ++i)
    b.BevelBox({-1.5f, 0.16f + 0.09f * static_cast<float>(i), 0.45f}, {1.2f, 0.235f + 0.09f * static_cast<float>(i), 0.48f}, 0.006f);
  b.Use(frame);
  for (float x : {-1.3f, 0.0f, 1.0f}) {
    b.BevelBox({x - 0.02f, 0.16f, 0.42f}, {x + 0.02f, 0.60f, 0.45f}, 0.004f);
    b.BevelBox({x - 0.02f, 0.30f, 0}, {x + 0.02f, 0.34f, 0.43f}, 0.004f);
  }
  Canvas sign(256, 64, {0.02f, 0.10f, 0.30f});
  sign.Letters(variant ? "GROVE AVE 24" : "MARKET ST 7", {0.5f, 0.5f}, 0.42f, {0.8f, 0.8f, 0.8f});
  b.Use(Plastic({1, 1, 1}, 0.3f), sign.Finish(variant ? "stop grove" : "stop market"));
  b.Picture({-0.6f, -0.852f, 2.445f}, {0.6f, -0.852f, 2.445f}, {0.6f, -0.852f, 2.512f}, {-0.6f, -0.852f, 2.512f});
  return b.Finish();
}

}  // namespace

std::vector<PropKind> StreetKinds() {
  return {
      {"manhole", "ground/manhole", 2, MakeManhole, 0.4f, 0.004f, 0.01f, 500},
      {"bus_stop", "furniture/transit/bus_stop", 2, MakeBusStop, 2.2f, 2.4f, 2.6f, 1500},
  };
}

}  // namespace airsim360::internal
