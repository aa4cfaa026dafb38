// Lamps of homes. Flux of LED bulbs by what they replace (EU 2019/2020): 60 W 806 lm, 75 W 1055 lm, 100 W 1521 lm; 2700 K.
// They burn in the dark hours.
#include <array>
#include <cmath>
#include <numbers>

#include "airsim360/worlds/furnishings/furnishing_families.h"
#include "airsim360/worlds/furnishings/interior_finishes.h"
#include "airsim360/worlds/furnishings/lamp_area.h"
#include "airsim360/worlds/furnishings/soft_shapes.h"

namespace airsim360::internal {
namespace {

constexpr float kWarm = 2700;

// Shade of cloth from radius r0 at z0 to r1 at z1, seen lit from inside: it passes about half of the bulb's flux, whose
// glow sits on its outside; the rest leaves by the bulb within, up and down.
void ClothShade(PropBuilder& b, Vec3f p, float r0, float r1, float z0, float z1, float lumens) {
  const Vec2f skin[] = {{r0, z0}, {r1, z1}};
  b.Use(LampSurface(0.45f * lumens, LatheArea(skin), kWarm, Burns::kAtNight));
  b.Lathe(skin, 32, p);
  b.Use(Stone({0.76f, 0.74f, 0.69f}, 0.9f));
  const Vec2f inside[] = {{r1 - 0.003f, z1}, {r0 - 0.003f, z0}};
  b.Lathe(inside, 32, p);
  for (const auto& [r, z] : {std::pair{r0, z0}, std::pair{r1, z1}}) {
    std::vector<Vec3f> wire;
    for (int i = 0; i <= 32; ++i) wire.push_back(p + Around(i % 32, 32) * (r - 0.001f) + Vec3f{0, 0, z});
    b.Bar(wire, 0.0025f, 5);
  }
}

void Bulb(PropBuilder& b, Vec3f p, float radius, float lumens) {
  const float area = 4 * std::numbers::pi_v<float> * radius * radius;
  b.Use(LampSurface(lumens, area, kWarm, Burns::kAtNight));
  b.mesh().Sphere(p, {radius, radius, radius}, 10, 16);
}

// Drum of cloth on a tripod, an arc with a steel bowl, a reading lamp.
Model MakeFloorLamp(uint32_t variant, uint64_t) {
  PropBuilder b("floor_lamp");
  if (variant == 0) {
    UseTimber(b, Timber::kOak);
    for (int i = 0; i < 3; ++i) {
      const Vec3f d = Around(i, 3, 0.5f);
      b.mesh().Tube(d * 0.30f, d * 0.03f + Vec3f{0, 0, 1.18f}, 0.013f, 0.017f, 12);
    }
    b.Use(Metal({0.45f, 0.36f, 0.18f}, 0.3f));
    b.mesh().Tube({0, 0, 1.14f}, {0, 0, 1.38f}, 0.012f, 0.012f, 12);
    ClothShade(b, {}, 0.24f, 0.21f, 1.26f, 1.56f, 1055);
    Bulb(b, {0, 0, 1.42f}, 0.03f, 0.55f * 1055);
  } else if (variant == 1) {
    UseStoneTop(b, {0.60f, 0.59f, 0.56f});
    const Vec2f foot[] = {{0.15f, 0}, {0.155f, 0.01f}, {0.15f, 0.05f}, {0, 0.055f}};
    b.Lathe(foot, 36, {0.55f, 0, 0});
    b.Use(Chrome());
    std::vector<Vec3f> arc;
    for (int i = 0; i <= 20; ++i) {
      const float a = 1.75f * static_cast<float>(i) / 20;
      arc.push_back({0.55f - 1.08f * (1 - std::cos(a)), 0, 0.05f + (a < 1.571f ? 1.85f * std::sin(a) : 1.85f * std::sin(a))});
    }
    b.Bar(arc, 0.010f, 10);
    const Vec3f tip = arc.back();
    const Vec2f bowl[] = {{0.16f, -0.19f}, {0.155f, -0.12f}, {0.11f, -0.05f}, {0.04f, -0.01f}, {0, 0.0f}};
    b.Lathe(bowl, 32, tip);
    b.Use(Paint({0.74f, 0.73f, 0.70f}));
    const Vec2f inside[] = {{0, -0.012f}, {0.038f, -0.018f}, {0.107f, -0.058f}, {0.150f, -0.122f}, {0.156f, -0.19f}};
    b.Lathe(inside, 32, tip);
    Bulb(b, tip + Vec3f{0, 0, -0.11f}, 0.04f, 1055);
  } else {
    b.Use(Paint({0.02f, 0.021f, 0.023f}, 0.4f));
    const Vec2f foot[] = {{0.13f, 0}, {0.13f, 0.018f}, {0.02f, 0.026f}, {0.011f, 0.04f}, {0.011f, 1.30f}, {0, 1.305f}};
    b.Lathe(foot, 28);
    const Vec3f arm[] = {{0, 0, 1.28f}, {0, -0.12f, 1.44f}, {0, -0.26f, 1.46f}, {0, -0.31f, 1.42f}};
    b.Bar(arm, 0.008f, 8);
    b.Place(Turn(-30, 0, 0, {0, -0.315f, 1.41f}));
    const Vec2f cone[] = {{0.095f, -0.15f}, {0.07f, -0.07f}, {0.03f, -0.02f}, {0, 0}};
    b.Lathe(cone, 24);
    b.Use(Paint({0.72f, 0.71f, 0.68f}));
    const Vec2f inside[] = {{0, -0.012f}, {0.027f, -0.026f}, {0.066f, -0.074f}, {0.091f, -0.15f}};
    b.Lathe(inside, 24);
    Bulb(b, {0, 0, -0.085f}, 0.03f, 806);
    b.Place({});
  }
  return b.Finish();
}

Model MakeTableLamp(uint32_t variant, uint64_t) {
  PropBuilder b("table_lamp");
  if (variant < 2) {
    UseCeramic(b, variant == 0 ? Vec3f{0.12f, 0.22f, 0.26f} : Vec3f{0.64f, 0.60f, 0.52f});
    const Vec2f round[] = {{0, 0},          {0.06f, 0},      {0.065f, 0.015f}, {0.085f, 0.07f}, {0.08f, 0.13f},
                           {0.045f, 0.19f}, {0.022f, 0.23f}, {0.022f, 0.25f},  {0, 0.25f}};
    const Vec2f tall[] = {{0, 0}, {0.07f, 0}, {0.07f, 0.02f}, {0.035f, 0.05f}, {0.03f, 0.14f}, {0.045f, 0.20f}, {0.03f, 0.25f}, {0, 0.26f}};
    variant == 0 ? b.Lathe(round, 28) : b.Lathe(tall, 28);
    b.Use(Metal({0.45f, 0.36f, 0.18f}, 0.3f));
    b.mesh().Tube({0, 0, 0.24f}, {0, 0, 0.33f}, 0.008f, 0.008f, 10);
    ClothShade(b, {}, 0.15f, 0.11f, 0.27f, 0.47f, 470);
    Bulb(b, {0, 0, 0.37f}, 0.025f, 0.55f * 470);
    return b.Finish();
  }
  // Jointed desk lamp.
  b.Use(Paint(variant == 2 ? Vec3f{0.45f, 0.06f, 0.04f} : Vec3f{0.50f, 0.51f, 0.52f}, 0.35f));
  const Vec2f foot[] = {{0.085f, 0}, {0.088f, 0.012f}, {0.08f, 0.022f}, {0.015f, 0.03f}, {0, 0.03f}};
  b.Lathe(foot, 28, {0, 0.10f, 0});
  const Vec3f elbow{0, 0.20f, 0.29f}, wrist{0, -0.04f, 0.46f};
  for (float x : {-0.012f, 0.012f}) {
    b.mesh().Tube({x, 0.10f, 0.03f}, elbow + Vec3f{x, 0, 0}, 0.005f, 0.005f, 8);
    b.mesh().Tube(elbow + Vec3f{x, 0, 0}, wrist + Vec3f{x, 0, 0}, 0.005f, 0.005f, 8);
  }
  for (Vec3f p : {Vec3f{0, 0.10f, 0.035f}, elbow, wrist})
    b.mesh().Tube(p - Vec3f{0.022f, 0, 0}, p + Vec3f{0.022f, 0, 0}, 0.014f, 0.014f, 12);
  b.Place(Turn(-28, 0, 0, wrist));
  const Vec2f shade[] = {{0.085f, -0.12f}, {0.075f, -0.07f}, {0.035f, -0.02f}, {0.03f, 0.02f}, {0, 0.025f}};
  b.Lathe(shade, 26);
  b.Use(Paint({0.74f, 0.73f, 0.70f}));
  const Vec2f inside[] = {{0, -0.02f}, {0.032f, -0.026f}, {0.071f, -0.074f}, {0.081f, -0.12f}};
  b.Lathe(inside, 26);
  Bulb(b, {0, 0, -0.072f}, 0.027f, 470);
  b.Place({});
  return b.Finish();
}

// On a cord 1.1 m long from its rose: an enamel dome, a globe of opal glass, a drum of cloth, a woven bell.
Model MakePendantLamp(uint32_t variant, uint64_t) {
  PropBuilder b("pendant_lamp");
  const float top = 1.10f;
  b.Use(Plastic({0.70f, 0.70f, 0.68f}));
  const Vec2f rose[] = {{0.012f, top - 0.035f}, {0.045f, top - 0.028f}, {0.055f, top}, {0, top}};
  b.Lathe(rose, 22);
  b.Use(Plastic({0.03f, 0.03f, 0.03f}, 0.6f));
  b.mesh().Tube({0, 0, 0.27f}, {0, 0, top - 0.03f}, 0.0035f, 0.0035f, 6);
  if (variant == 1) {
    const float r = 0.15f;
    b.Use(LampSurface(1055, 4 * std::numbers::pi_v<float> * r * r, kWarm, Burns::kAtNight));
    b.mesh().Sphere({0, 0, r}, {r, r, r}, 18, 32);
    b.Use(Metal({0.5f, 0.4f, 0.2f}, 0.3f));
    b.mesh().Tube({0, 0, 0.29f}, {0, 0, 0.335f}, 0.035f, 0.02f, 18);
    return b.Finish();
  }
  if (variant == 2) {
    ClothShade(b, {}, 0.25f, 0.25f, 0.0f, 0.24f, 1521);
    Bulb(b, {0, 0, 0.13f}, 0.035f, 0.55f * 1521);
    b.Use(Metal());
    for (int i = 0; i < 3; ++i) b.mesh().Tube({0, 0, 0.215f}, Around(i, 3) * 0.248f + Vec3f{0, 0, 0.235f}, 0.002f, 0.002f, 5);
    b.mesh().Tube({0, 0, 0.16f}, {0, 0, 0.28f}, 0.018f, 0.014f, 12);
    return b.Finish();
  }
  variant == 0 ? UseLacquer(b, {0.035f, 0.05f, 0.045f}, 0.25f) : b.Use(Stone({0.42f, 0.30f, 0.16f}, 0.85f));
  const Vec2f dome[] = {{0.20f, 0}, {0.195f, 0.03f}, {0.15f, 0.10f}, {0.08f, 0.16f}, {0.04f, 0.20f}, {0.03f, 0.26f}, {0, 0.28f}};
  b.Lathe(dome, 36);
  b.Use(Paint({0.76f, 0.75f, 0.72f}, 0.5f));
  const Vec2f inside[] = {{0, 0.19f}, {0.036f, 0.192f}, {0.076f, 0.154f}, {0.146f, 0.096f}, {0.191f, 0.03f}, {0.197f, 0}};
  b.Lathe(inside, 36);
  Bulb(b, {0, 0, 0.09f}, 0.045f, variant == 0 ? 1055 : 806);
  return b.Finish();
}

}  // namespace

FurnishingRows HomeLampRows() {
  return {{{"floor_lamp", "furniture/lighting/lamp", 3, MakeFloorLamp, 0.6f, 1.40f, 1.95f, 3000}},
          {{"table_lamp", "furniture/lighting/lamp", 4, MakeTableLamp, 0.2f, 0.40f, 0.52f, 2500}, Mount::kSurface},
          {{"pendant_lamp", "furniture/lighting/lamp", 4, MakePendantLamp, 0.3f, 1.09f, 1.11f, 2500}, Mount::kCeiling}};
}

}  // namespace airsim360::internal
