// What lies on the ground: asphalt, paving, lawn, gravel, rock.
#include <algorithm>
#include <array>
#include <cmath>

#include "airsim360/worlds/recipe_shapes.h"

namespace airsim360::internal {

Texel Asphalt(float u, float v) {
  const float grain = HashUnit(static_cast<uint32_t>(u * 512), static_cast<uint32_t>(v * 512), 7);
  const WorleyResult stone = TilingWorley(3, u, v, 220);
  const float mottle = TilingFbm(11, u, v, 5, 5);
  const float exposed = Step(0.55f, 0.15f, stone.first) * (0.6f + 0.4f * HashUnit(stone.cell, 1));
  const float y =
      0.105f + 0.055f * exposed * HashUnit(stone.cell, 2) + 0.022f * mottle + 0.03f * (grain - 0.5f);
  return {Vec3f{1.02f, 1.0f, 0.97f} * y, 0.0022f * exposed + 0.0006f * grain,
          0.74f - 0.06f * exposed + 0.05f * mottle};
}

Texel Concrete(float u, float v) {
  const float soft = TilingFbm(21, u, v, 3, 6), fine = TilingFbm(22, u, v, 64, 2);
  const float pore = Step(0.16f, 0.05f, TilingWorley(23, u, v, 60).first) * 0.5f;
  const float y = 0.48f + 0.05f * soft + 0.02f * fine - 0.12f * pore;
  return {Vec3f{1.0f, 0.985f, 0.95f} * y, 0.0010f * fine - 0.002f * pore + 0.001f * soft,
          0.6f + 0.05f * soft};
}

Texel Slabs(float u, float v) {
  const Unit slab = Bond(u, v, 3.0f, 4, 6, 0.5f);
  const float tone = HashUnit(slab.id, 5), grain = TilingFbm(31, u, v, 96, 2),
              stain = TilingFbm(32, u, v, 4, 5);
  const float joint = Step(0.009f, 0.003f, slab.edge);
  const float gum = Step(0.055f, 0.035f, TilingWorley(33, u, v, 14).first) * (HashUnit(slab.id, 9) < 0.35f);
  float y = 0.36f * (0.90f + 0.16f * tone) + 0.03f * grain + 0.05f * std::min(stain, 0.2f);
  y *= (1 - 0.25f * gum) * (1 - 0.55f * joint) * (1 - 0.10f * Step(0.05f, 0.0f, slab.edge));
  const Vec3f hue = Mix({1.03f, 1, 0.93f}, {0.98f, 1, 1.0f}, HashUnit(slab.id, 6));
  return {hue * y, -0.004f * joint + 0.0008f * grain + 0.003f * (tone - 0.5f), 0.66f + 0.06f * grain};
}

Texel PavingBrick(float u, float v) {
  const Unit brick = Herringbone(u, v, 2.0f, 20);
  const float tone = HashUnit(brick.id, 5), grain = TilingFbm(41, u, v, 128, 2),
              dirt = TilingFbm(42, u, v, 4, 5);
  const float joint = Step(0.008f, 0.003f, brick.edge);
  const Vec3f hue = Mix({0.42f, 0.160f, 0.092f}, {0.30f, 0.120f, 0.080f}, tone);
  Vec3f color = hue * (0.85f + 0.3f * HashUnit(brick.id, 6)) * (1 + 0.18f * grain) * (1 + 0.16f * dirt);
  color = Mix(color, {0.17f, 0.14f, 0.11f}, joint * 0.85f);
  const float bevel = Step(0.0f, 0.014f, brick.edge);
  return {color, 0.005f * bevel + 0.0008f * grain + 0.002f * (tone - 0.5f), 0.68f + 0.08f * grain};
}

Texel StoneSetts(float u, float v) {
  const Unit stone = Bond(u, v, 2.0f, 10, 10, 0.5f);
  const float tone = HashUnit(stone.id, 5);
  const float speckle = HashUnit(static_cast<uint32_t>(u * 512), static_cast<uint32_t>(v * 512), 3) - 0.5f;
  const float joint = Step(0.011f, 0.004f, stone.edge), soft = TilingFbm(52, u, v, 6, 4);
  const float y = (0.33f + 0.12f * tone + 0.10f * speckle + 0.04f * soft) * (1 - 0.6f * joint);
  const float dome = Step(0.0f, 0.05f, stone.edge);
  return {Vec3f{1.0f, 0.98f, 0.95f} * y, 0.006f * dome + 0.0006f * speckle, 0.58f + 0.1f * soft};
}

Texel GravelPath(float u, float v) {
  const WorleyResult stone = TilingWorley(61, u, v, 150), big = TilingWorley(62, u, v, 60);
  const float soft = TilingFbm(63, u, v, 3, 5);
  const float tone = HashUnit(stone.cell, 1), lump = 1 - stone.first;
  const Vec3f hue = Mix({0.40f, 0.33f, 0.24f}, {0.48f, 0.43f, 0.35f}, tone);
  return {hue * (0.75f + 0.35f * lump) * (1 + 0.14f * soft) * (1 - 0.1f * (big.first < 0.2f)), 0.004f * lump,
          0.8f + 0.05f * soft};
}

Texel Grass(float u, float v) {
  const float clump = TilingFbm(71, u, v, 6, 5), blade = TilingFbm(72, u * 1.0f, v, 128, 2);
  const float streak = HashUnit(static_cast<uint32_t>(u * 512), static_cast<uint32_t>(v * 256), 9);
  const float dry = Step(0.1f, 0.8f, TilingFbm(73, u, v, 4, 4));
  const Vec3f green = Mix({0.105f, 0.130f, 0.038f}, {0.165f, 0.185f, 0.066f}, streak);
  const Vec3f color = Mix(green, {0.25f, 0.23f, 0.09f}, 0.55f * dry) * (1 + 0.25f * clump + 0.3f * blade);
  return {color, 0.010f * blade + 0.012f * clump + 0.004f * streak, 0.75f};
}

Texel Soil(float u, float v) {
  const float clod = TilingFbm(81, u, v, 12, 5);
  const WorleyResult stone = TilingWorley(82, u, v, 50);
  const float pebble = Step(0.3f, 0.15f, stone.first) * (HashUnit(stone.cell, 3) < 0.25f);
  const Vec3f color = Mix(Vec3f{0.16f, 0.115f, 0.075f} * (1 + 0.35f * clod), {0.3f, 0.27f, 0.23f}, pebble);
  return {color, 0.012f * clod + 0.006f * pebble, 0.85f};
}

Texel RoofGravel(float u, float v) {
  const WorleyResult stone = TilingWorley(131, u, v, 120);
  const float soft = TilingFbm(132, u, v, 3, 5), damp = Step(0.25f, 0.6f, TilingFbm(133, u, v, 2, 4));
  const float tone = HashUnit(stone.cell, 2);
  const float y =
      (0.6f + 0.7f * tone) * (1.15f - 0.6f * stone.first) * (1 + 0.12f * soft) * (1 - 0.2f * damp);
  return {Vec3f{1.02f, 1, 0.95f} * (0.4f * y), 0.008f * (1 - stone.first), 0.85f};
}

Texel Rock(float u, float v) {
  const float big = TilingFbm(171, u, v, 4, 6), fine = TilingFbm(172, u, v, 40, 3);
  const float forest = Step(-0.05f, 0.25f, TilingFbm(173, u, v, 6, 5));
  const Vec3f stone = Vec3f{0.27f, 0.25f, 0.22f} * (1 + 0.3f * big);
  return {Mix(stone, Vec3f{0.07f, 0.11f, 0.05f} * (1 + 0.4f * fine), forest), 2.0f * big, 0.9f};
}

Texel Fields(float u, float v) {
  const WorleyResult field = TilingWorley(181, u, v, 9);
  const float hedge = Step(0.06f, 0.02f, field.second - field.first), soft = TilingFbm(182, u, v, 12, 5);
  constexpr std::array<Vec3f, 5> kCrops = {{{0.12f, 0.17f, 0.06f},
                                            {0.20f, 0.20f, 0.09f},
                                            {0.16f, 0.13f, 0.08f},
                                            {0.09f, 0.14f, 0.05f},
                                            {0.24f, 0.22f, 0.14f}}};
  const Vec3f crop = kCrops[static_cast<size_t>(HashUnit(field.cell, 1) * 5)];
  return {Mix(crop * (1 + 0.25f * soft), {0.05f, 0.08f, 0.035f}, hedge), 0, 0.9f};
}

Texel PaintWorn(float u, float v) {
  const float wear = TilingFbm(191, u, v, 40, 3) + 0.5f * TilingFbm(192, u, v, 4, 3);
  const float left = Step(0.75f, 0.35f, wear);
  return {Vec3f{1, 1, 1} * Mix(0.22f, 0.62f, left), 0, 0.7f};
}

}  // namespace airsim360::internal
