// Food carts.
#include <cmath>

#include "airsim360/math/angles.h"
#include "airsim360/worlds/props/drawing.h"
#include "airsim360/worlds/props/families.h"
#include "airsim360/worlds/props/finishes.h"
#include "airsim360/worlds/props/prop_builder.h"

namespace airsim360::internal {
namespace {

const Vec3f kTones[3] = {{0.31f, 0.060f, 0.050f}, {0.060f, 0.15f, 0.115f}, {0.47f, 0.31f, 0.10f}};
constexpr const char* kNames[3] = {"HOT DOGS", "FRESH TACOS", "ICE CREAM"};

Texture MenuBoard(uint32_t variant) {
  Canvas canvas(256, 192, {0.012f, 0.013f, 0.012f});
  const Vec3f chalk{0.72f, 0.72f, 0.66f};
  canvas.Letters("MENU", {0.5f, 0.12f}, 0.12f, {0.80f, 0.55f, 0.10f});
  const char* lines[3][4] = {{"CLASSIC    4.50", "CHILI      5.50", "PRETZEL    3.00", "LEMONADE   2.50"},
                             {"AL PASTOR  4.00", "CARNITAS   4.25", "FISH       5.00", "HORCHATA   3.00"},
                             {"VANILLA    3.50", "PISTACHIO  4.00", "SUNDAE     6.00", "WATER      1.50"}};
  for (int i = 0; i < 4; ++i) canvas.Letters(lines[variant][i], {0.5f, 0.33f + 0.17f * static_cast<float>(i)}, 0.075f, chalk);
  return canvas.Finish(std::string("menu ") + kNames[variant]);
}

Texture NameBoard(uint32_t variant) {
  Canvas canvas(512, 96, kTones[variant]);
  canvas.Rectangle({0.01f, 0.06f}, {0.99f, 0.94f}, {0.80f, 0.76f, 0.66f});
  canvas.Rectangle({0.016f, 0.10f}, {0.984f, 0.90f}, kTones[variant] * 0.85f);
  canvas.Letters(kNames[variant], {0.5f, 0.5f}, 0.5f, {0.85f, 0.82f, 0.74f});
  return canvas.Finish(std::string("name ") + kNames[variant]);
}

// Spoked wheel in the plane of Y and Z at x, outer radius r.
void Wheel(PropBuilder& b, Vec3f hub, float r, Vec3f tone) {
  std::vector<Vec3f> rim;
  for (int k = 0; k <= 32; ++k) {
    const float a = kTauF * static_cast<float>(k) / 32;
    rim.push_back(hub + Vec3f{0, r * std::cos(a), r * std::sin(a)});
  }
  b.Use(Rubber());
  b.Bar(rim, 0.022f, 8);
  b.Use(Paint(tone));
  for (int k = 0; k < 10; ++k) {
    const float a = kTauF * static_cast<float>(k) / 10;
    b.mesh().Tube(hub, hub + Vec3f{0, r * std::cos(a), r * std::sin(a)}, 0.012f, 0.009f, 6, false, false);
  }
  b.mesh().Tube(hub - Vec3f{0.05f, 0, 0}, hub + Vec3f{0.05f, 0, 0}, 0.045f, 0.045f, 12);
}

// Striped cloth over a frame, with a scalloped edge all around.
void Awning(PropBuilder& b, uint32_t variant) {
  const Vec3f white{0.74f, 0.72f, 0.68f};
  const Vec3f second{kTones[variant].x / white.x, kTones[variant].y / white.y, kTones[variant].z / white.z};
  const Texture cloth = Texture::FromImage("awning stripes",
                                           Shade(64, 16,
                                                 [&](float u, float) {
                                                   return u < 0.5f ? Vec3f{1, 1, 1} : second;
                                                 }),
                                           true);
  b.Use(Fabric(white), cloth, {0.36f, 0.36f});
  const Vec3f l{-1.15f, -0.85f, 2.12f}, r{1.15f, 0.62f, 2.12f};
  const Vec3f a{l.x, l.y, l.z}, c{r.x, l.y, l.z}, d{r.x, r.y, l.z}, e{l.x, r.y, l.z}, p{-0.75f, -0.1f, 2.46f}, q{0.75f, -0.1f, 2.46f};
  b.mesh().QuadUv(a, c, q, p, {-1.15f, 0.85f}, {1.15f, 0.85f}, {0.75f, 0}, {-0.75f, 0});
  b.mesh().QuadUv(d, e, p, q, {1.15f, 0.85f}, {-1.15f, 0.85f}, {-0.75f, 0}, {0.75f, 0});
  b.mesh().Triangle(e, a, p, {-0.72f, 0.5f}, {0.72f, 0.5f}, {0, 0});
  b.mesh().Triangle(c, d, q, {-0.72f, 0.5f}, {0.72f, 0.5f}, {0, 0});
  const Vec3f corners[5] = {a, c, d, e, a};
  for (int side = 0; side < 4; ++side) {
    const Vec3f from = corners[side], to = corners[side + 1];
    const int scallops = static_cast<int>(std::lround(Norm(to - from) / 0.18f));
    for (int i = 0; i < scallops * 4; ++i) {
      const float t0 = static_cast<float>(i) / static_cast<float>(scallops * 4),
                  t1 = static_cast<float>(i + 1) / static_cast<float>(scallops * 4);
      const auto drop = [&](int k) {
        return Vec3f{0, 0, -0.10f - 0.045f * std::sin(kTauF / 2 * static_cast<float>(k % 4 == 0 ? 0 : k % 4) / 4)};
      };
      const Vec3f x0 = from + (to - from) * t0, x1 = from + (to - from) * t1;
      const float u0 = 0.18f * static_cast<float>(i) / 4, u1 = 0.18f * static_cast<float>(i + 1) / 4;
      b.mesh().QuadUv(x0 + drop(i), x1 + drop(i + 1), x1, x0, {u0, 0.15f}, {u1, 0.15f}, {u1, 0}, {u0, 0});
    }
  }
}

// Cart: panelled body with a steel counter, two large wheels, a leg, shelves with goods, posts with an
// awning, menu.
Model MakeFoodCart(uint32_t variant, uint64_t) {
  PropBuilder b("food_cart");
  const Vec3f tone = kTones[variant];
  b.Use(Paint(tone, 0.35f));
  b.BevelBox({-0.95f, -0.36f, 0.32f}, {0.95f, 0.36f, 0.98f}, 0.015f);
  b.Use(Paint({0.74f, 0.70f, 0.60f}));
  for (int i = 0; i < 4; ++i) {
    const float x = -0.90f + 0.455f * static_cast<float>(i);
    b.BevelBox({x, -0.372f, 0.38f}, {x + 0.43f, -0.352f, 0.76f}, 0.008f);
  }
  b.Use(Metal({0.62f, 0.62f, 0.61f}, 0.25f));
  b.BevelBox({-1.02f, -0.46f, 0.98f}, {1.02f, 0.42f, 1.015f}, 0.01f);
  b.BevelBox({-1.02f, -0.44f, 0.29f}, {1.02f, 0.40f, 0.33f}, 0.01f);
  // On the counter: two covered pots, a glass case with trays, bottles.
  const Vec2f pot[] = {{0.15f, 1.015f}, {0.155f, 1.13f}, {0.165f, 1.14f}, {0.15f, 1.15f},
                       {0.09f, 1.19f},  {0.02f, 1.20f},  {0.02f, 1.225f}, {0, 1.228f}};
  b.Lathe(pot, 20, {-0.68f, 0.05f, 0});
  b.Lathe(pot, 20, {-0.30f, 0.05f, 0});
  b.BevelBox({0.10f, -0.20f, 1.015f}, {0.85f, 0.25f, 1.05f}, 0.004f);
  for (float x : {0.105f, 0.845f}) {
    for (float y : {-0.195f, 0.245f}) b.mesh().Tube({x, y, 1.05f}, {x, y, 1.38f}, 0.008f, 0.008f, 6);
  }
  b.BevelBox({0.09f, -0.21f, 1.375f}, {0.86f, 0.26f, 1.395f}, 0.006f);
  b.Use(Stone({0.55f, 0.30f, 0.11f}, 0.7f));
  for (int i = 0; i < 10; ++i)
    b.mesh().Sphere({0.19f + 0.14f * static_cast<float>(i % 5), i < 5 ? -0.08f : 0.12f, 1.075f}, {0.055f, 0.08f, 0.035f}, 6, 10);
  const Vec3f bottles[3] = {{0.45f, 0.02f, 0.01f}, {0.70f, 0.48f, 0.03f}, {0.62f, 0.60f, 0.55f}};
  for (int i = 0; i < 3; ++i) {
    b.Use(Plastic(bottles[i], 0.25f));
    const Vec2f bottle[] = {{0.032f, 1.015f}, {0.032f, 1.13f}, {0.025f, 1.155f}, {0.010f, 1.17f}, {0.006f, 1.21f}, {0, 1.212f}};
    b.Lathe(bottle, 12, {-0.06f, -0.30f + 0.085f * static_cast<float>(i), 0});
  }
  for (float x : {-0.62f, 0.62f}) {
    Wheel(b, {x < 0 ? -1.03f : 1.03f, 0.02f, 0.362f}, 0.34f, tone);
  }
  b.Use(CastIron());
  b.mesh().Tube({-1.0f, 0.02f, 0.362f}, {1.0f, 0.02f, 0.362f}, 0.018f, 0.018f, 8);
  for (float x : {-0.8f, 0.8f}) b.mesh().Tube({x, -0.33f, 0}, {x, -0.33f, 0.30f}, 0.018f, 0.018f, 8);
  const Vec3f handle[] = {{-0.95f, 0.30f, 0.86f},   {-1.25f, 0.30f, 0.90f},  {-1.30f, 0.27f, 0.905f},
                          {-1.30f, -0.27f, 0.905f}, {-1.25f, -0.30f, 0.90f}, {-0.95f, -0.30f, 0.86f}};
  b.Bar(handle, 0.016f, 8);
  b.Use(Paint({0.72f, 0.70f, 0.66f}));
  for (float x : {-0.92f, 0.92f}) {
    for (float y : {-0.40f, 0.36f}) b.mesh().Tube({x, y, 1.01f}, {x, y, 2.20f}, 0.018f, 0.018f, 10);
  }
  Awning(b, variant);
  b.Use(Paint({1, 1, 1}), MenuBoard(variant));
  b.Picture({-0.88f, -0.375f, 0.40f}, {-0.42f, -0.375f, 0.40f}, {-0.42f, -0.375f, 0.74f}, {-0.88f, -0.375f, 0.74f});
  b.Use(Paint({1, 1, 1}), NameBoard(variant));
  b.Picture({-0.85f, -0.405f, 1.82f}, {0.85f, -0.405f, 1.82f}, {0.85f, -0.405f, 2.02f}, {-0.85f, -0.405f, 2.02f});
  b.Picture({0.85f, -0.385f, 1.82f}, {-0.85f, -0.385f, 1.82f}, {-0.85f, -0.385f, 2.02f}, {0.85f, -0.385f, 2.02f});
  return b.Finish();
}

}  // namespace

std::vector<PropKind> VendingKinds() { return {{"food_cart", "furniture/vending/food_cart", 3, MakeFoodCart, 1.4f, 2.3f, 2.6f, 7000}}; }

}  // namespace airsim360::internal
