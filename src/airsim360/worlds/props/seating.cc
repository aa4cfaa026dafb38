// Tables, chairs and benches.
#include <cmath>
#include <numbers>

#include "airsim360/base/random.h"
#include "airsim360/worlds/props/families.h"
#include "airsim360/worlds/props/finishes.h"
#include "airsim360/worlds/props/prop_builder.h"

namespace airsim360::internal {
namespace {

constexpr Vec3f kDark{0.03f, 0.032f, 0.035f};
constexpr Vec3f kTopTones[4] = {{1, 1, 1}, {0.62f, 0.50f, 0.42f}, {1.45f, 1.40f, 1.30f}, {0.8f, 0.72f, 0.62f}};

// A round or square board of slats' height on a turned pedestal with a cross foot.
Model MakeDiningTable(uint32_t variant, uint64_t) {
  PropBuilder b("dining_table");
  const float top = 0.74f, half = variant % 2 ? 0.38f : 0.40f;
  UseWood(b, kTopTones[variant]);
  if (variant % 2) {
    const Vec2f rim[] = {{0, top - 0.03f},     {half - 0.012f, top - 0.03f}, {half, top - 0.02f},
                         {half, top - 0.008f}, {half - 0.01f, top},          {0, top}};
    b.Lathe(rim, 40);
  } else {
    for (int i = 0; i < 6; ++i) {
      const float x = -half + 2 * half / 6 * static_cast<float>(i);
      b.BevelBox({x + 0.002f, -half, top - 0.03f}, {x + 2 * half / 6 - 0.002f, half, top}, 0.004f);
    }
    b.Use(Paint(kDark));
    for (float y : {-0.25f, 0.25f}) b.BevelBox({-half + 0.03f, y - 0.02f, top - 0.055f}, {half - 0.03f, y + 0.02f, top - 0.03f}, 0.003f);
  }
  b.Use(Paint(kDark));
  const Vec2f column[] = {{0.05f, 0.05f}, {0.035f, 0.09f}, {0.032f, 0.66f}, {0.05f, 0.69f}, {0.10f, top - 0.031f}};
  b.Lathe(column, 16);
  for (int i = 0; i < 4; ++i) {
    const float a = std::numbers::pi_v<float> * (0.25f + 0.5f * static_cast<float>(i));
    const Vec3f d{std::cos(a), std::sin(a), 0};
    const Vec3f path[] = {Vec3f{0, 0, 0.10f}, d * 0.12f + Vec3f{0, 0, 0.075f}, d * 0.27f + Vec3f{0, 0, 0.022f},
                          d * 0.31f + Vec3f{0, 0, 0.018f}};
    b.Bar(path, 0.018f, 8);
  }
  return b.Finish();
}

// Two bent tubes, a slatted seat and a curved back; seat edge towards -Y.
Model MakeDiningChair(uint32_t variant, uint64_t) {
  PropBuilder b("dining_chair");
  const Vec3f frame_tones[4] = {kDark, {0.35f, 0.36f, 0.37f}, {0.05f, 0.12f, 0.10f}, {0.42f, 0.07f, 0.05f}};
  b.Use(Paint(frame_tones[variant]));
  for (float side : {-1.0f, 1.0f}) {
    const float x = 0.20f * side;
    const Vec3f rear[] = {{x * 1.1f, 0.25f, 0.0f}, {x, 0.20f, 0.43f}, {x, 0.215f, 0.55f}, {x * 0.97f, 0.27f, 0.86f}};
    const Vec3f front[] = {{x * 1.1f, -0.22f, 0.0f}, {x, -0.19f, 0.43f}, {x, -0.17f, 0.447f}, {x, 0.20f, 0.447f}};
    b.Bar(rear, 0.013f, 10);
    b.Bar(front, 0.013f, 10);
    b.mesh().Tube({x * 1.05f, -0.205f, 0.21f}, {x * 1.05f, 0.225f, 0.21f}, 0.008f, 0.008f, 8);
  }
  const Vec3f top_rail[] = {{-0.194f, 0.27f, 0.86f}, {-0.1f, 0.295f, 0.875f}, {0.1f, 0.295f, 0.875f}, {0.194f, 0.27f, 0.86f}};
  b.Bar(top_rail, 0.013f, 10);
  b.mesh().Tube({-0.2f, -0.19f, 0.43f}, {0.2f, -0.19f, 0.43f}, 0.010f, 0.010f, 8);

  UseWood(b, kTopTones[variant], Grain::kAlongX);
  for (int i = 0; i < 7; ++i) {
    const float y = -0.205f + 0.058f * static_cast<float>(i);
    b.BevelBox({-0.215f, y, 0.455f}, {0.215f, y + 0.050f, 0.473f}, 0.005f);
  }
  for (int i = 0; i < 3; ++i) {
    const float z = 0.60f + 0.085f * static_cast<float>(i), y = 0.217f + 0.177f * (z - 0.55f);
    b.Place(Turn(-10, 0, 0, {0, y, z}));
    b.BevelBox({-0.20f, -0.020f, -0.03f}, {0.20f, -0.006f, 0.03f}, 0.005f);
  }
  return b.Finish();
}

// Park bench: cast-iron ends with arm rests, five seat slats, four back slats.
Model MakeBenchWood(uint32_t variant, uint64_t) {
  PropBuilder b("bench_wood");
  b.Use(CastIron());
  for (float x : {-0.72f, 0.72f}) {
    const Vec3f front[] = {{x, -0.30f, 0.0f}, {x, -0.26f, 0.05f}, {x, -0.20f, 0.20f}, {x, -0.23f, 0.38f}, {x, -0.22f, 0.43f}};
    const Vec3f back[] = {{x, 0.34f, 0.0f}, {x, 0.28f, 0.06f}, {x, 0.20f, 0.22f}, {x, 0.18f, 0.42f}, {x, 0.23f, 0.60f}, {x, 0.31f, 0.86f}};
    const Vec3f seat[] = {{x, -0.25f, 0.42f}, {x, 0.0f, 0.405f}, {x, 0.19f, 0.40f}};
    const Vec3f arm[] = {{x, -0.22f, 0.42f},  {x, -0.27f, 0.52f}, {x, -0.25f, 0.62f},
                         {x, -0.15f, 0.655f}, {x, 0.10f, 0.64f},  {x, 0.245f, 0.63f}};
    for (std::span<const Vec3f> path :
         {std::span<const Vec3f>(front), std::span<const Vec3f>(back), std::span<const Vec3f>(seat), std::span<const Vec3f>(arm)}) {
      b.Bar(path, 0.020f, 8);
    }
    for (float y : {-0.30f, 0.34f}) b.BevelBox({x - 0.035f, y - 0.05f, 0}, {x + 0.035f, y + 0.05f, 0.018f}, 0.006f);
  }
  UseWood(b, kTopTones[variant], Grain::kAlongX);
  for (int i = 0; i < 5; ++i) {
    const float y = -0.27f + 0.095f * static_cast<float>(i), z = 0.432f - 0.016f * static_cast<float>(i % 5 == 0 ? 0 : 1);
    b.BevelBox({-0.9f, y, z}, {0.9f, y + 0.080f, z + 0.032f}, 0.007f);
  }
  for (int i = 0; i < 4; ++i) {
    const float z = 0.53f + 0.098f * static_cast<float>(i);
    b.Place(Turn(-17, 0, 0, {0, 0.195f + 0.30f * (z - 0.52f), z}));
    b.BevelBox({-0.9f, -0.030f, -0.04f}, {0.9f, -0.002f, 0.04f}, 0.007f);
  }
  return b.Finish();
}

}  // namespace

std::vector<PropKind> SeatingKinds() {
  return {
      {"dining_table", "furniture/table/dining_table", 4, MakeDiningTable, 0.6f, 0.70f, 0.80f, 3000},
      {"street_table", "furniture/table", 4, MakeDiningTable, 0.6f, 0.70f, 0.80f, 3000},
      {"dining_chair", "furniture/seating/chair", 4, MakeDiningChair, 0.4f, 0.80f, 1.00f, 4000},
      {"bench_wood", "furniture/seating/bench/wood", 3, MakeBenchWood, 1.0f, 0.80f, 1.00f, 3500},
  };
}

}  // namespace airsim360::internal
