// Fences, railings and bollards. Panels run along X; their length is exactly 2 m, so that they join.
#include <cmath>

#include "airsim360/base/random.h"
#include "airsim360/worlds/props/families.h"
#include "airsim360/worlds/props/finishes.h"
#include "airsim360/worlds/props/prop_builder.h"

namespace airsim360::internal {
namespace {

constexpr Vec3f kIron{0.022f, 0.028f, 0.027f};

// Post at the left end, two rails, pickets of slightly different heights with pointed tops.
Model MakeWoodFence(uint32_t variant, uint64_t seed) {
  PropBuilder b("wood_fence");
  RngStream random(seed, "wood_fence");
  const Vec3f tones[3] = {{1, 1, 1}, {0.75f, 0.78f, 0.80f}, {2.1f, 2.9f, 4.4f}};
  UseWood(b, tones[variant]);
  b.BevelBox({-1.0f, -0.05f, -0.3f}, {-0.90f, 0.05f, 1.22f}, 0.008f);
  for (float z : {0.28f, 0.88f}) b.BevelBox({-1.0f, 0.012f, z}, {1.0f, 0.05f, z + 0.085f}, 0.006f);
  for (int i = 0; i < 15; ++i) {
    const float x = -0.885f + 0.125f * static_cast<float>(i), top = 1.10f + 0.02f * static_cast<float>(random.Uniform(-1, 1));
    const float low = 0.05f + 0.01f * static_cast<float>(random.Uniform());
    const Vec2f outline[] = {{x, low}, {x + 0.095f, low}, {x + 0.095f, top - 0.06f}, {x + 0.0475f, top}, {x, top - 0.06f}};
    // The outline stands up: builder y becomes z, builder z becomes -y.
    b.Place(Turn(90, 0, 0));
    b.Prism(outline, -0.012f, 0.010f);
    b.Place({});
  }
  return b.Finish();
}

// Iron railing: two flat rails, balusters, a ring under the top rail every fourth gap.
Model MakeRail(uint32_t, uint64_t) {
  PropBuilder b("rail");
  b.Use(Paint(kIron, 0.35f));
  b.BevelBox({-1.0f, -0.025f, 1.00f}, {1.0f, 0.025f, 1.04f}, 0.008f);
  b.BevelBox({-1.0f, -0.015f, 0.84f}, {1.0f, 0.015f, 0.86f}, 0.004f);
  b.BevelBox({-1.0f, -0.015f, 0.10f}, {1.0f, 0.015f, 0.13f}, 0.004f);
  for (int i = 0; i < 16; ++i) {
    const float x = -0.9375f + 0.125f * static_cast<float>(i);
    b.mesh().Tube({x, 0, 0.13f}, {x, 0, 0.84f}, 0.0085f, 0.0085f, 8, false, false);
    std::vector<Vec3f> ring;
    for (int k = 0; k <= 14; ++k) {
      const float a = 6.2831853f * static_cast<float>(k) / 14;
      ring.push_back({x + 0.062f * std::cos(a), 0, 0.93f + 0.062f * std::sin(a)});
    }
    b.Bar(ring, 0.006f, 5);
  }
  for (float x : {-0.97f, 0.97f}) b.BevelBox({x - 0.02f, -0.02f, 0}, {x + 0.02f, 0.02f, 1.0f}, 0.004f);
  return b.Finish();
}

// Stone pillar between railings: plinth, shaft with a recessed field, cap and low pyramid.
Model MakeRailPillar(uint32_t variant, uint64_t) {
  PropBuilder b("rail_pillar");
  const Vec3f tones[2] = {{0.42f, 0.39f, 0.34f}, {0.30f, 0.135f, 0.085f}};
  b.Use(Stone(tones[variant]), ConcreteTexture());
  b.BevelBox({-0.25f, -0.25f, -0.1f}, {0.25f, 0.25f, 0.16f}, 0.015f);
  b.BevelBox({-0.20f, -0.20f, 0.15f}, {0.20f, 0.20f, 1.10f}, 0.012f);
  b.Use(Stone({0.46f, 0.43f, 0.38f}), ConcreteTexture());
  b.BevelBox({-0.23f, -0.23f, 1.08f}, {0.23f, 0.23f, 1.13f}, 0.015f);
  b.BevelBox({-0.27f, -0.27f, 1.125f}, {0.27f, 0.27f, 1.20f}, 0.02f);
  for (int i = 0; i < 4; ++i) {
    b.Place(Turn(0, 0, 90.0f * static_cast<float>(i)));
    b.mesh().Triangle({-0.24f, -0.24f, 1.199f}, {0.24f, -0.24f, 1.199f}, {0, 0, 1.30f}, {0, 0.3f}, {0.48f, 0.3f}, {0.24f, 0});
  }
  return b.Finish();
}

// Bollard that keeps cars off: steel with reflective bands and a domed cap, or cast iron with rings.
Model MakeCarPillar(uint32_t variant, uint64_t) {
  PropBuilder b("car_pillar");
  if (variant == 0) {
    b.Use(Metal({0.58f, 0.58f, 0.57f}, 0.32f));
    const Vec2f body[] = {{0.085f, -0.2f}, {0.085f, 0.0f},   {0.10f, 0.0f},    {0.10f, 0.012f},  {0.057f, 0.013f},
                          {0.057f, 0.86f}, {0.055f, 0.885f}, {0.046f, 0.905f}, {0.028f, 0.918f}, {0, 0.922f}};
    b.Lathe(body, 24);
    b.Use(Paint({0.75f, 0.55f, 0.04f}));
    for (float z : {0.62f, 0.74f}) {
      const Vec2f band[] = {{0.0575f, z}, {0.0588f, z + 0.001f}, {0.0588f, z + 0.06f}, {0.0575f, z + 0.061f}};
      b.Lathe(band, 24);
    }
    return b.Finish();
  }
  b.Use(variant == 1 ? CastIron() : Paint({0.03f, 0.075f, 0.055f}));
  const Vec2f body[] = {{0.12f, -0.2f},   {0.12f, 0.06f},   {0.115f, 0.075f}, {0.095f, 0.09f}, {0.08f, 0.16f},
                        {0.092f, 0.175f}, {0.092f, 0.195f}, {0.078f, 0.21f},  {0.062f, 0.70f}, {0.08f, 0.715f},
                        {0.08f, 0.735f},  {0.062f, 0.75f},  {0.06f, 0.80f},   {0.085f, 0.83f}, {0.098f, 0.88f},
                        {0.085f, 0.93f},  {0.05f, 0.965f},  {0.02f, 0.975f},  {0.012f, 1.0f},  {0, 1.003f}};
  b.Lathe(body, 24);
  return b.Finish();
}

}  // namespace

std::vector<PropKind> BarrierKinds() {
  return {
      {"wood_fence", "barrier/fence/wood_fence", 3, MakeWoodFence, 1.0f, 1.15f, 1.3f, 1500},
      {"rail", "barrier/railing/rail", 1, MakeRail, 1.0f, 1.0f, 1.1f, 4500},
      {"rail_pillar", "barrier/railing/pillar", 2, MakeRailPillar, 0.3f, 1.2f, 1.35f, 600},
      {"car_pillar", "traffic/bollard/car_pillar", 3, MakeCarPillar, 0.2f, 0.9f, 1.05f, 1500},
  };
}

}  // namespace airsim360::internal
