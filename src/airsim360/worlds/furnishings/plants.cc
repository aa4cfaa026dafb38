// Potted plants of rooms and halls.
#include <array>
#include <cmath>

#include "airsim360/base/random.h"
#include "airsim360/worlds/furnishings/furnishing_families.h"
#include "airsim360/worlds/furnishings/interior_finishes.h"
#include "airsim360/worlds/furnishings/soft_shapes.h"
#include "airsim360/worlds/props/drawing.h"

namespace airsim360::internal {
namespace {

// A leaf with its rib and veins; u along, v across.
const Texture& LeafPicture() {
  static const Texture texture = Texture::FromImage(
      "house leaf",
      Shade(128, 64,
            [](float u, float v) {
              const float s = std::abs(2 * v - 1), vein = std::abs(std::fmod(u * 9 + s * 1.6f, 1.0f) - 0.5f);
              const float tone = 0.66f + 0.22f * TileFractal(u, v, 6, 6, 3, 861) + (s < 0.06f ? 0.30f : vein < 0.05f ? 0.10f : 0);
              return Vec3f{0.30f, 0.72f, 0.20f} * std::min(tone, 1.0f);
            }),
      true);
  return texture;
}
void UseLeaf(PropBuilder& b, Vec3f tint) {
  Material m = Leaf(tint, 0.35f);
  m.roughness = 0.38f;
  b.Use(m, LeafPicture());
}

// Pot of radius r at the rim and height h, filled with soil.
void Pot(PropBuilder& b, int style, float r, float h) {
  if (style == 0)
    b.Use(Stone({0.42f, 0.18f, 0.09f}, 0.8f), ConcreteTexture());
  else if (style == 1)
    UseCeramic(b, {0.74f, 0.73f, 0.70f});
  else if (style == 2)
    UseCeramic(b, {0.05f, 0.055f, 0.06f});
  else
    b.Use(Stone({0.46f, 0.45f, 0.43f}, 0.8f), ConcreteTexture());
  const Vec2f pot[] = {{0, 0},         {r * 0.72f, 0}, {r * 0.75f, 0.008f}, {r * 0.96f, h - 0.035f},
                       {r, h - 0.03f}, {r, h},         {r * 0.92f, h},      {r * 0.90f, h - 0.03f}};
  b.Lathe(pot, 26);
  b.Use(Stone({0.045f, 0.032f, 0.022f}, 0.95f), ConcreteTexture(), {0.12f, 0.12f});
  const Vec2f soil[] = {{r * 0.905f, h - 0.032f}, {r * 0.5f, h - 0.024f}, {0, h - 0.028f}};
  b.Lathe(soil, 20);
}

AffineTransform LeafPose(Vec3f at, float turn_deg, float rise_deg) { return Turn(0, -rise_deg, turn_deg, at); }

void RubberPlant(PropBuilder& b, RngStream& rng, float base, float height) {
  b.Use(Stone({0.20f, 0.15f, 0.10f}, 0.9f));
  const Vec3f stem[] = {{0, 0, base}, {0.02f, 0.01f, base + height * 0.4f}, {-0.02f, 0.02f, base + height}};
  const float radii[] = {0.014f, 0.011f, 0.006f};
  b.Bar(stem, radii, 8);
  UseLeaf(b, {0.28f, 0.34f, 0.26f});
  const int leaves = static_cast<int>(height * 26);
  for (int i = 0; i < leaves; ++i) {
    const float t = (static_cast<float>(i) + 0.7f) / static_cast<float>(leaves), z = base + height * (0.12f + 0.88f * t);
    const float length = Random(rng, 0.20f, 0.29f) * (1.1f - 0.45f * t);
    BroadLeaf(b, LeafPose({0.02f * std::sin(6 * t), 0.015f, z}, 137.5f * static_cast<float>(i), Random(rng, 12, 40) + 35 * t * t), length,
              length * 0.46f, Random(rng, 0.15f, 0.5f));
  }
}

void Monstera(PropBuilder& b, RngStream& rng, float base) {
  for (int i = 0; i < 13; ++i) {
    const float turn = 137.5f * static_cast<float>(i), reach = Random(rng, 0.10f, 0.34f), z = base + Random(rng, 0.30f, 0.72f);
    const Vec3f d{std::cos(turn * 0.01745f), std::sin(turn * 0.01745f), 0};
    UseLeaf(b, {0.42f, 0.50f, 0.36f});
    const Vec3f stalk[] = {{0, 0, base - 0.02f}, d * (reach * 0.35f) + Vec3f{0, 0, base + (z - base) * 0.6f}, d * reach + Vec3f{0, 0, z}};
    b.Bar(stalk, 0.006f, 6);
    UseLeaf(b, {0.34f, 0.42f, 0.30f});
    const float length = Random(rng, 0.24f, 0.36f);
    BroadLeaf(b, LeafPose(stalk[2], turn + Random(rng, -25, 25), Random(rng, -30, 12)), length, length * 0.85f, Random(rng, 0.2f, 0.5f),
              true);
  }
}

// Sword-shaped leaves that stand upright.
void SnakePlant(PropBuilder& b, RngStream& rng, float base, float r) {
  UseLeaf(b, {0.36f, 0.44f, 0.34f});
  for (int i = 0; i < 16; ++i) {
    const Vec3f d = Around(i, 16, 0.3f * static_cast<float>(i)) * (r * Random(rng, 0.1f, 0.65f));
    BroadLeaf(b, Turn(0, -Random(rng, 74, 90), 360.0f * Random(rng, 0, 1), d + Vec3f{0, 0, base - 0.02f}), Random(rng, 0.45f, 0.80f),
              0.068f, Random(rng, -0.02f, 0.06f));
  }
}

// Arching fronds of narrow leaflets.
void ParlourPalm(PropBuilder& b, RngStream& rng, float base, float height) {
  for (int f = 0; f < 11; ++f) {
    const float turn = 137.5f * static_cast<float>(f), lean = Random(rng, 0.25f, 0.75f), length = height * Random(rng, 0.75f, 1.0f);
    const Vec3f d{std::cos(turn * 0.01745f), std::sin(turn * 0.01745f), 0};
    std::vector<Vec3f> rib;
    for (int k = 0; k <= 8; ++k) {
      const float t = static_cast<float>(k) / 8;
      rib.push_back(d * (length * lean * t * t * 0.9f + 0.02f) + Vec3f{0, 0, base - 0.02f + length * (t - 0.42f * lean * t * t * t)});
    }
    UseLeaf(b, {0.40f, 0.46f, 0.30f});
    b.Bar(rib, 0.004f, 5);
    for (int k = 3; k < 9; ++k)
      for (float s : {-1.0f, 1.0f}) {
        const float t = static_cast<float>(k) / 8;
        BroadLeaf(b, LeafPose(rib[static_cast<size_t>(k)], turn + s * (62 - 30 * t), 10 - 25 * t), 0.24f * (1.15f - 0.5f * t), 0.032f,
                  0.35f);
      }
  }
}

Model MakePottedPlantIndoor(uint32_t variant, uint64_t seed) {
  PropBuilder b("potted_plant_indoor");
  RngStream rng(seed, "house plant");
  switch (variant) {
    case 0:
      Pot(b, 1, 0.17f, 0.32f);
      RubberPlant(b, rng, 0.30f, 1.05f);
      break;
    case 1:
      Pot(b, 3, 0.19f, 0.34f);
      Monstera(b, rng, 0.32f);
      break;
    case 2:
      Pot(b, 0, 0.14f, 0.25f);
      SnakePlant(b, rng, 0.23f, 0.13f);
      break;
    default:
      Pot(b, 2, 0.18f, 0.36f);
      ParlourPalm(b, rng, 0.34f, 1.15f);
  }
  return b.Finish();
}

// Small ones for sills, shelves and desks.
Model MakePlantSmall(uint32_t variant, uint64_t seed) {
  PropBuilder b("plant_small");
  RngStream rng(seed, "small plant");
  const float h = 0.11f;
  Pot(b, static_cast<int>(variant + 1) % 4, 0.065f, h);
  if (variant == 0) {  // succulent rosette
    UseLeaf(b, {0.55f, 0.46f, 0.44f});
    for (int i = 0; i < 26; ++i) {
      const float t = static_cast<float>(i) / 26;
      BroadLeaf(b, LeafPose({0, 0, h - 0.02f + 0.03f * t}, 137.5f * static_cast<float>(i), 8 + 70 * t), 0.085f * (1 - 0.5f * t), 0.036f,
                -0.2f);
    }
  } else if (variant == 1) {  // trailing
    UseLeaf(b, {0.60f, 0.60f, 0.40f});
    for (int i = 0; i < 34; ++i) {
      const float turn = 137.5f * static_cast<float>(i), out = Random(rng, 0.02f, 0.11f);
      const Vec3f d{std::cos(turn * 0.01745f), std::sin(turn * 0.01745f), 0};
      const float drop = out > 0.07f ? Random(rng, -0.07f, 0.03f) : Random(rng, 0.0f, 0.06f);
      BroadLeaf(b, LeafPose(d * out + Vec3f{0, 0, h + drop}, turn + Random(rng, -40, 40), Random(rng, -30, 40)), 0.065f, 0.045f, 0.4f);
    }
  } else {  // upright spikes
    UseLeaf(b, {0.42f, 0.52f, 0.40f});
    for (int i = 0; i < 30; ++i)
      BroadLeaf(b, LeafPose({0, 0, h - 0.02f}, 137.5f * static_cast<float>(i), Random(rng, 25, 85)), Random(rng, 0.12f, 0.19f), 0.013f,
                Random(rng, 0.1f, 0.6f));
  }
  return b.Finish();
}

}  // namespace

FurnishingRows PlantRows() {
  return {{{"potted_plant_indoor", "furniture/planter/pot", 4, MakePottedPlantIndoor, 0.35f, 0.65f, 1.65f, 7000}},
          {{"plant_small", "furniture/planter/pot", 3, MakePlantSmall, 0.15f, 0.14f, 0.32f, 2500}, Mount::kSurface}};
}

}  // namespace airsim360::internal
