// Small things of San Francisco's pavements: its lamps, poles, bins, ropes and what keeps people and cars apart.
#include <array>
#include <cmath>

#include "airsim360/math/angles.h"
#include "airsim360/worlds/props/drawing.h"
#include "airsim360/worlds/props/families.h"
#include "airsim360/worlds/props/finishes.h"
#include "airsim360/worlds/props/prop_builder.h"

namespace airsim360::internal {
namespace {

// Two globes of opal glass on the arms of a fluted post, a finial between them; the arms run along X.
Model MakeBoulevardLamp(uint32_t variant, uint64_t) {
  PropBuilder b("boulevard_lamp");
  const Material iron = Paint(variant ? Vec3f{0.020f, 0.045f, 0.040f} : Vec3f{0.16f, 0.13f, 0.075f}, 0.4f);
  b.Use(iron);
  const Vec2f post[] = {{0.30f, -0.2f}, {0.30f, 0.06f}, {0.25f, 0.09f}, {0.23f, 0.50f}, {0.26f, 0.54f}, {0.20f, 0.62f},
                        {0.14f, 1.05f}, {0.15f, 1.10f}, {0.10f, 1.18f}, {0.08f, 4.9f},  {0.12f, 4.95f}, {0.12f, 5.02f},
                        {0.07f, 5.10f}, {0.06f, 5.75f}, {0.09f, 5.82f}, {0.03f, 5.98f}, {0.05f, 6.05f}, {0, 6.16f}};
  b.Lathe(post, 20);
  for (int i = 0; i < 8; ++i) {
    const float a = kTauF * static_cast<float>(i) / 8, c = std::cos(a), s = std::sin(a);
    b.mesh().Tube({0.095f * c, 0.095f * s, 1.25f}, {0.082f * c, 0.082f * s, 4.85f}, 0.012f, 0.012f, 5, false, false);
  }
  for (float side : {-1.0f, 1.0f}) {
    const Vec3f arm[] = {{0, 0, 5.15f}, {side * 0.28f, 0, 5.05f}, {side * 0.55f, 0, 5.08f}, {side * 0.70f, 0, 5.22f}};
    const Vec3f brace[] = {{side * 0.06f, 0, 4.70f}, {side * 0.25f, 0, 4.80f}, {side * 0.42f, 0, 5.04f}};
    b.Bar(arm, 0.032f, 10);
    b.Bar(brace, 0.02f, 8);
    const Vec2f cup[] = {{0.03f, 0}, {0.11f, 0.03f}, {0.14f, 0.10f}, {0, 0.10f}};
    b.Lathe(cup, 16, {side * 0.70f, 0, 5.20f});
  }
  // 130 cd each.
  b.Use(WhiteGlow({1.0f, 0.82f, 0.60f}, 620));
  for (float side : {-1.0f, 1.0f}) b.mesh().Sphere({side * 0.70f, 0, 5.53f}, {0.22f, 0.22f, 0.27f}, 14, 22);
  b.Use(iron);
  for (float side : {-1.0f, 1.0f}) {
    const Vec2f cap[] = {{0.10f, 0.24f}, {0.08f, 0.29f}, {0.02f, 0.31f}, {0.02f, 0.37f}, {0, 0.38f}};
    b.Lathe(cap, 14, {side * 0.70f, 0, 5.53f});
  }
  return b.Finish();
}

// A lantern with a pointed hood on a plain post.
Model MakeHillLamp(uint32_t variant, uint64_t) {
  PropBuilder b("hill_lamp");
  const Material iron = Paint({0.022f, 0.024f, 0.026f}, 0.4f);
  b.Use(iron);
  const float neck = variant ? 3.6f : 4.1f;
  const Vec2f post[] = {{0.20f, -0.2f}, {0.20f, 0.05f}, {0.15f, 0.09f},        {0.14f, 0.7f},         {0.16f, 0.74f},
                        {0.08f, 0.86f}, {0.055f, neck}, {0.10f, neck + 0.05f}, {0.10f, neck + 0.09f}, {0, neck + 0.09f}};
  b.Lathe(post, 16);
  const Vec2f hood[] = {{0.27f, 0.55f}, {0.26f, 0.60f}, {0.14f, 0.74f}, {0.05f, 0.80f}, {0.05f, 0.86f}, {0, 0.90f}};
  b.Lathe(hood, 6, {0, 0, neck});
  for (int i = 0; i < 6; ++i) {
    const float a = kTauF * static_cast<float>(i) / 6, c = std::cos(a), s = std::sin(a);
    b.mesh().Tube({0.12f * c, 0.12f * s, neck + 0.08f}, {0.24f * c, 0.24f * s, neck + 0.56f}, 0.012f, 0.012f, 5);
  }
  // 95 cd to all sides.
  b.Use(WhiteGlow({1.0f, 0.84f, 0.62f}, 620));
  b.mesh().Tube({0, 0, neck + 0.10f}, {0, 0, neck + 0.54f}, 0.105f, 0.215f, 6);
  return b.Finish();
}

// A wheeled bin; the lid's hinge is at the back.
Model MakeWheelieBin(uint32_t variant, uint64_t) {
  PropBuilder b("wheelie_bin");
  constexpr Vec3f kTones[3] = {{0.022f, 0.024f, 0.027f}, {0.012f, 0.055f, 0.17f}, {0.014f, 0.11f, 0.030f}};
  b.Use(Plastic(kTones[variant], 0.5f));
  const auto ring = [](float x, float y0, float y1, float z) {
    return std::array<Vec3f, 4>{Vec3f{-x, y0, z}, {x, y0, z}, {x, y1, z}, {-x, y1, z}};
  };
  const auto low = ring(0.22f, -0.22f, 0.26f, 0.05f), high = ring(0.29f, -0.34f, 0.34f, 0.98f);
  for (size_t i = 0; i < 4; ++i) b.mesh().Quad(low[i], low[(i + 1) % 4], high[(i + 1) % 4], high[i]);
  b.mesh().Quad(low[0], low[3], low[2], low[1]);
  b.BevelBox({-0.31f, -0.36f, 0.94f}, {0.31f, 0.36f, 0.99f}, 0.012f);
  b.Place(Turn(4, 0, 0, {0, 0, 0.02f}));
  b.BevelBox({-0.31f, -0.38f, 0.98f}, {0.31f, 0.36f, 1.03f}, 0.02f);
  b.Place({});
  b.mesh().Tube({-0.26f, 0.40f, 0.97f}, {0.26f, 0.40f, 0.97f}, 0.018f, 0.018f, 8);
  for (float x : {-0.26f, 0.26f}) b.mesh().Tube({x, 0.34f, 0.97f}, {x, 0.40f, 0.97f}, 0.016f, 0.016f, 6);
  b.Use(Rubber());
  for (float x : {-0.29f, 0.23f}) b.mesh().Tube({x, 0.29f, 0.10f}, {x + 0.06f, 0.29f, 0.10f}, 0.10f, 0.10f, 14);
  return b.Finish();
}

// Two metres along X between two posts of brass, over which a velvet or plain rope hangs.
Model MakeRopeBollard(uint32_t variant, uint64_t) {
  PropBuilder b("rope_bollard");
  b.Use(variant ? Paint({0.03f, 0.03f, 0.032f}, 0.4f) : Metal({0.62f, 0.46f, 0.20f}, 0.3f));
  for (float x : {-0.98f, 0.98f}) {
    const Vec2f post[] = {{0.16f, 0},      {0.16f, 0.02f},  {0.05f, 0.06f}, {0.035f, 0.10f}, {0.035f, 0.86f},
                          {0.055f, 0.88f}, {0.055f, 0.92f}, {0.04f, 0.95f}, {0.055f, 1.0f},  {0, 1.04f}};
    b.Lathe(post, 16, {x, 0, 0});
  }
  b.Use(Fabric(variant ? Vec3f{0.34f, 0.27f, 0.16f} : Vec3f{0.28f, 0.015f, 0.02f}));
  std::vector<Vec3f> rope;
  for (int i = 0; i <= 16; ++i) {
    const float t = static_cast<float>(i) / 8 - 1;
    rope.push_back({0.96f * t, 0, 0.58f + 0.28f * t * t});
  }
  b.Bar(rope, 0.021f, 8);
  return b.Finish();
}

// An orange tube of plastic with two reflecting bands, on a foot of rubber.
Model MakeTrafficTube(uint32_t variant, uint64_t) {
  PropBuilder b("traffic_tube");
  b.Use(Rubber());
  const Vec2f foot[] = {{0.20f, 0}, {0.20f, 0.03f}, {0.10f, 0.06f}, {0.05f, 0.07f}, {0, 0.07f}};
  b.Lathe(foot, 8);
  const float h = variant ? 1.07f : 0.92f;
  const auto tube = [&](float from, float to, Vec3f color, float roughness) {
    b.Use(Plastic(color, roughness));
    b.mesh().Tube({0, 0, from}, {0, 0, to}, 0.045f, 0.043f, 16, false, to >= h);
  };
  const Vec3f orange{0.80f, 0.15f, 0.012f}, white{0.75f, 0.75f, 0.73f};
  tube(0.05f, h - 0.42f, orange, 0.5f);
  tube(h - 0.42f, h - 0.32f, white, 0.3f);
  tube(h - 0.32f, h - 0.20f, orange, 0.5f);
  tube(h - 0.20f, h - 0.10f, white, 0.3f);
  tube(h - 0.10f, h, orange, 0.5f);
  return b.Finish();
}

// Two metres along X of a crowd barrier: a bent tube with bars, on two feet.
Model MakeMetalBarricade(uint32_t, uint64_t) {
  PropBuilder b("metal_barricade");
  b.Use(Metal({0.50f, 0.51f, 0.52f}, 0.38f));
  const Vec3f frame[] = {{-0.96f, 0, 0.16f}, {-0.96f, 0, 0.98f}, {-0.88f, 0, 1.08f}, {0.88f, 0, 1.08f},
                         {0.96f, 0, 0.98f},  {0.96f, 0, 0.16f},  {-0.96f, 0, 0.16f}};
  b.Bar(frame, 0.021f, 8);
  for (int i = 1; i < 14; ++i) {
    const float x = -0.96f + 1.92f * static_cast<float>(i) / 14;
    b.mesh().Tube({x, 0, 0.16f}, {x, 0, 1.07f}, 0.009f, 0.009f, 6, false, false);
  }
  for (float x : {-0.78f, 0.78f}) {
    const Vec3f foot[] = {{x, -0.30f, 0.015f}, {x, -0.22f, 0.05f}, {x, 0, 0.17f}, {x, 0.22f, 0.05f}, {x, 0.30f, 0.015f}};
    b.Bar(foot, 0.018f, 8);
  }
  return b.Finish();
}

// Two metres along X of pickets on two rails, painted.
Model MakePicketFence(uint32_t variant, uint64_t) {
  PropBuilder b("picket_fence");
  constexpr Vec3f kTones[3] = {{0.72f, 0.71f, 0.67f}, {0.20f, 0.26f, 0.24f}, {0.36f, 0.20f, 0.12f}};
  b.Use(Paint(kTones[variant], 0.6f), ScratchedTexture());
  for (float z : {0.22f, 0.74f}) b.BevelBox({-1, 0.012f, z}, {1, 0.05f, z + 0.08f}, 0.004f);
  for (int i = 0; i < 14; ++i) {
    const float x = -0.93f + 0.143f * static_cast<float>(i);
    const Vec2f board[] = {{x - 0.04f, 0.04f}, {x + 0.04f, 0.04f}, {x + 0.04f, 0.94f}, {x, 1.0f}, {x - 0.04f, 0.94f}};
    b.Place(Turn(90, 0, 0));
    b.Prism(board, -0.012f, 0.012f);
    b.Place({});
  }
  b.BevelBox({-1.04f, 0.0f, -0.2f}, {-0.95f, 0.09f, 1.05f}, 0.008f);
  return b.Finish();
}

// A barrier of orange or white plastic that is filled with water, 1.6 m along X.
Model MakeWaterBarrier(uint32_t variant, uint64_t) {
  PropBuilder b("water_barrier");
  b.Use(Plastic(variant ? Vec3f{0.70f, 0.70f, 0.68f} : Vec3f{0.74f, 0.15f, 0.012f}, 0.5f));
  const std::vector<Vec2f> side = {{-0.27f, 0.03f}, {0.27f, 0.03f},  {0.27f, 0.12f},  {0.13f, 0.34f},
                                   {0.09f, 0.86f},  {-0.09f, 0.86f}, {-0.13f, 0.34f}, {-0.27f, 0.12f}};
  b.Place(AffineTransform{Mat3f::FromColumns({0, 1, 0}, {0, 0, 1}, {1, 0, 0}), {}});
  b.Prism(side, -0.8f, 0.8f);
  b.Place({});
  for (float x : {-0.45f, 0.45f}) b.BevelBox({x - 0.2f, -0.21f, 0}, {x + 0.2f, 0.21f, 0.04f}, 0.01f);
  b.mesh().Tube({0, 0, 0.85f}, {0, 0, 0.90f}, 0.05f, 0.05f, 12);
  Canvas stripes(192, 32, {0.74f, 0.74f, 0.72f});
  for (int i = -1; i < 8; ++i) {
    const float x = 0.15f * static_cast<float>(i);
    stripes.Line({x, 1.2f}, {x + 0.12f, -0.2f}, 0.28f, {0.55f, 0.03f, 0.02f});
  }
  b.Use(Paint({1, 1, 1}, 0.5f), stripes.Finish("water barrier stripes"));
  b.Picture({-0.7f, -0.117f, 0.56f}, {0.7f, -0.117f, 0.56f}, {0.7f, -0.101f, 0.74f}, {-0.7f, -0.101f, 0.74f});
  b.Picture({0.7f, 0.117f, 0.56f}, {-0.7f, 0.117f, 0.56f}, {-0.7f, 0.101f, 0.74f}, {0.7f, 0.101f, 0.74f});
  return b.Finish();
}

// A pole of wood with two cross-arms along X, insulators and a transformer; wires hang at the heights of kPoleArms.
Model MakeUtilityPole(uint32_t variant, uint64_t) {
  PropBuilder b("utility_pole");
  UseWood(b, {0.55f, 0.47f, 0.40f});
  const Vec2f pole[] = {{0.17f, -0.25f}, {0.165f, 0.3f}, {0.115f, 10.4f}, {0, 10.42f}};
  b.Lathe(pole, 12);
  for (float z : {9.3f, 10.0f}) b.BevelBox({-1.15f, -0.17f, z - 0.06f}, {1.15f, -0.08f, z + 0.06f}, 0.006f);
  b.Use(Metal({0.42f, 0.43f, 0.43f}, 0.5f));
  for (float z : {9.3f, 10.0f}) {
    for (float x : {-0.5f, 0.5f}) b.mesh().Beam({x, -0.125f, z - 0.05f}, {0, -0.12f, z - 0.6f}, 0.03f);
  }
  b.Use(Stone({0.30f, 0.28f, 0.25f}, 0.3f));
  for (float z : {9.3f, 10.0f}) {
    for (float x : {-1.05f, -0.55f, 0.55f, 1.05f}) {
      const Vec2f insulator[] = {{0.02f, 0.05f}, {0.05f, 0.08f}, {0.035f, 0.11f}, {0.05f, 0.14f}, {0.02f, 0.18f}, {0, 0.19f}};
      b.Lathe(insulator, 10, {x, -0.125f, z});
    }
  }
  if (variant == 0) {
    b.Use(Paint({0.30f, 0.32f, 0.33f}, 0.5f));
    const Vec2f drum[] = {{0, 0}, {0.24f, 0.01f}, {0.25f, 0.04f}, {0.25f, 0.80f}, {0.22f, 0.88f}, {0, 0.92f}};
    b.Lathe(drum, 18, {0, 0.42f, 7.3f});
    b.BevelBox({-0.05f, 0.1f, 7.5f}, {0.05f, 0.22f, 8.0f}, 0.005f);
    for (float x : {-0.1f, 0.1f}) b.mesh().Tube({x, 0.42f, 8.2f}, {x, 0.42f, 8.42f}, 0.025f, 0.02f, 8);
  }
  b.Use(Metal({0.5f, 0.5f, 0.5f}, 0.5f));
  for (int i = 0; i < 10; ++i) {
    const float z = 3.2f + 0.55f * static_cast<float>(i), x = i % 2 ? 0.15f : -0.15f;
    b.mesh().Tube({0, 0.02f, z}, {x * 1.6f, 0.02f, z}, 0.01f, 0.01f, 5);
  }
  return b.Finish();
}

// A small car on rails: open ends with benches under the roof, a closed middle; front towards -Y.
Model MakeCableCar(uint32_t variant, uint64_t) {
  PropBuilder b("cable_car");
  const Vec3f body = variant ? Vec3f{0.020f, 0.085f, 0.055f} : Vec3f{0.28f, 0.018f, 0.016f}, cream{0.62f, 0.55f, 0.38f};
  const Material paint = Paint(body, 0.3f), trim = Paint(cream, 0.4f), iron = CastIron();
  b.Use(iron);
  for (float y : {-2.3f, -1.1f, 1.1f, 2.3f}) {
    for (float x : {-0.62f, 0.54f}) b.mesh().Tube({x, y, 0.28f}, {x + 0.08f, y, 0.28f}, 0.28f, 0.28f, 20);
  }
  b.BevelBox({-0.85f, -4.1f, 0.42f}, {0.85f, 4.1f, 0.58f}, 0.02f);
  for (float y : {-4.25f, 4.1f}) b.BevelBox({-0.8f, y, 0.25f}, {0.8f, y + 0.15f, 0.62f}, 0.03f);
  UseWood(b, {0.6f, 0.42f, 0.26f}, Grain::kAlongX);
  b.BevelBox({-1.15f, -4.1f, 0.58f}, {1.15f, 4.1f, 0.66f}, 0.01f);
  b.BevelBox({-1.25f, -4.0f, 0.36f}, {1.25f, 0.2f, 0.40f}, 0.01f);
  // Benches back to back in the open part, along the sides.
  for (float y0 : {-3.7f}) {
    b.BevelBox({-0.95f, y0, 1.02f}, {-0.45f, 0.0f, 1.07f}, 0.01f);
    b.BevelBox({0.45f, y0, 1.02f}, {0.95f, 0.0f, 1.07f}, 0.01f);
    b.BevelBox({-0.45f, y0, 1.05f}, {-0.40f, 0.0f, 1.55f}, 0.01f);
    b.BevelBox({0.40f, y0, 1.05f}, {0.45f, 0.0f, 1.55f}, 0.01f);
  }
  // The closed part: panels below, windows above.
  b.Use(paint);
  for (float x : {-1.12f, 1.06f}) b.BevelBox({x, 0.1f, 0.62f}, {x + 0.06f, 4.05f, 1.55f}, 0.01f);
  for (float y : {0.1f, 3.99f}) b.BevelBox({-1.12f, y, 0.62f}, {1.12f, y + 0.06f, 1.55f}, 0.01f);
  b.BevelBox({-1.0f, -4.1f, 0.62f}, {1.0f, -4.02f, 1.5f}, 0.02f);
  b.Use(trim);
  for (float y : {0.1f, 1.08f, 2.06f, 3.04f, 3.99f}) {
    for (float x : {-1.12f, 1.05f}) b.BevelBox({x, y, 1.5f}, {x + 0.07f, y + 0.07f, 2.55f}, 0.005f);
  }
  for (float y : {-3.9f, -2.6f, -1.3f}) {
    for (float x : {-1.08f, 1.02f}) b.BevelBox({x, y, 0.62f}, {x + 0.06f, y + 0.06f, 2.6f}, 0.005f);
  }
  b.BevelBox({-1.2f, -4.1f, 2.55f}, {1.2f, 4.1f, 2.72f}, 0.03f);
  for (float y : {-3.95f, 0.1f, 3.99f})
    for (float x : {-0.4f, 0.34f}) b.BevelBox({x, y, 1.5f}, {x + 0.06f, y + 0.05f, 2.56f}, 0.005f);
  b.Use(Glass());
  for (float x : {-1.095f, 1.08f}) b.mesh().Box({x, 0.17f, 1.55f}, {x + 0.015f, 3.99f, 2.55f});
  for (float y : {0.12f, 4.0f}) b.mesh().Box({-1.06f, y, 1.55f}, {1.06f, y + 0.015f, 2.55f});
  for (float x : {-0.36f, 0.0f}) b.mesh().Box({x, -3.94f, 1.55f}, {x + 0.36f, -3.93f, 2.5f});
  b.Use(Paint({0.30f, 0.31f, 0.31f}, 0.6f));
  b.Sheet(8, 2,
          [](float u, float v) {
            return Vec3f{1.3f * (2 * u - 1), 8.5f * v - 4.25f, 2.72f + 0.22f * (1 - (2 * u - 1) * (2 * u - 1))};
          },
          {2.6f, 8.5f});
  b.Use(trim);
  b.BevelBox({-0.6f, -3.4f, 2.88f}, {0.6f, 3.4f, 3.12f}, 0.03f);
  Canvas sign(256, 40, body * 0.7f);
  sign.Letters(variant ? "MASON ST" : "HILL & BAY", {0.5f, 0.5f}, 0.7f, {0.75f, 0.60f, 0.22f});
  b.Use(Paint({1, 1, 1}, 0.4f), sign.Finish(variant ? "cable car sign 1" : "cable car sign 0"));
  b.Picture({-0.9f, -4.112f, 1.1f}, {0.9f, -4.112f, 1.1f}, {0.9f, -4.112f, 1.38f}, {-0.9f, -4.112f, 1.38f});
  b.Use(Glass({0.75f, 0.72f, 0.6f}));
  const Vec2f lamp[] = {{0.13f, 0}, {0.13f, 0.05f}, {0, 0.06f}};
  b.Place(Turn(90, 0, 0, {0, -4.10f, 0.82f}));
  b.Lathe(lamp, 16);
  return b.Finish();
}

}  // namespace

std::vector<PropKind> SanFranciscoKinds() {
  return {
      {"boulevard_lamp", "furniture/lighting/lamp_post/type_a", 2, MakeBoulevardLamp, 0.5f, 6.0f, 6.3f, 5000},
      {"cable_car", "vehicle/tram", 2, MakeCableCar, 4.6f, 3.0f, 3.3f, 6000},
      {"hill_lamp", "furniture/lighting/lamp_post/type_b", 2, MakeHillLamp, 0.35f, 4.3f, 5.1f, 2000},
      {"metal_barricade", "traffic/barrier/metal_barricade", 1, MakeMetalBarricade, 0.9f, 1.05f, 1.15f, 2000},
      {"picket_fence", "barrier/fence", 3, MakePicketFence, 1.0f, 1.0f, 1.1f, 1500},
      {"rope_bollard", "barrier/rope_bollard", 2, MakeRopeBollard, 1.0f, 1.0f, 1.1f, 2500},
      {"traffic_tube", "traffic/temporary/tube", 2, MakeTrafficTube, 0.25f, 0.9f, 1.1f, 900},
      {"utility_pole", "construction/mast", 2, MakeUtilityPole, 0.4f, 10.3f, 10.5f, 4000},
      {"water_barrier", "traffic/barrier/barrier", 2, MakeWaterBarrier, 0.8f, 0.85f, 0.95f, 1000},
      {"wheelie_bin", "furniture/waste/trash", 3, MakeWheelieBin, 0.5f, 1.0f, 1.15f, 800},
  };
}

}  // namespace airsim360::internal
