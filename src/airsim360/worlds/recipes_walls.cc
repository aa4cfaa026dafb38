// What walls and pitched roofs are made of.
#include <algorithm>
#include <cmath>

#include "airsim360/worlds/recipe_shapes.h"

namespace airsim360::internal {

Texel Brick(float u, float v) {
  const Unit brick = Bond(u, v, 2.0f, 8, 26, 0.5f);
  const float tone = HashUnit(brick.id, 5), grain = TilingFbm(91, u, v, 100, 3),
              soot = TilingFbm(92, u, v, 3, 4);
  const float joint = Step(0.0075f, 0.0045f, brick.edge + 0.0012f * grain);
  Vec3f color = Mix({0.90f, 0.88f, 0.86f}, {1.12f, 1.1f, 1.08f}, tone);
  if (HashUnit(brick.id, 8) < 0.09f) color = color * 0.68f;
  color = color * (1 + 0.10f * grain) * (1 + 0.10f * soot);
  color = Mix(color, Vec3f{1.35f, 1.4f, 1.5f} * (1 + 0.08f * grain), joint);
  return {color * 0.5f, -0.006f * joint + 0.0010f * grain + 0.0015f * (tone - 0.5f), 0.72f + 0.1f * joint};
}

Texel Ashlar(float u, float v) {
  const Unit stone = Bond(u, v, 3.0f, 5, 10, 0.5f);
  const float tone = HashUnit(stone.id, 5), grain = TilingFbm(101, u, v, 48, 4),
              soft = TilingFbm(102, u, v, 3, 5);
  const float joint = Step(0.008f, 0.003f, stone.edge);
  const float y = (0.92f + 0.14f * tone) * (1 + 0.06f * grain + 0.06f * soft) * (1 - 0.35f * joint);
  const Vec3f hue = Mix({1.02f, 1, 0.96f}, {0.99f, 1, 1.0f}, HashUnit(stone.id, 6));
  return {hue * (y * 0.5f), -0.005f * joint + 0.0012f * grain, 0.66f + 0.05f * grain};
}

Texel Plaster(float u, float v) {
  const float soft = TilingFbm(111, u, v, 3, 5), grain = TilingFbm(112, u, v, 128, 2);
  const float drip = TilingNoise(113, u * 40, v * 2, 40) * 0.5f + 0.5f;
  const float y = 0.5f * (1 + 0.06f * soft + 0.03f * grain - 0.06f * drip * Step(0.0f, 0.6f, soft));
  return {Vec3f{1, 1, 1} * y, 0.0012f * grain + 0.002f * soft, 0.75f + 0.05f * soft};
}

Texel Planks(float u, float v) {
  const Unit plank = Bond(u, v, 2.0f, 14, 1, 0);
  const float tone = HashUnit(plank.id, 5);
  const float ring = TilingNoise(121 + plank.id, u * 140, v * 6 + tone * 9, 140),
              fiber = TilingNoise(122, u * 500, v * 24, 500);
  const float joint = Step(0.006f, 0.003f, plank.edge);
  const float y = (0.8f + 0.35f * tone) * (1 + 0.16f * ring + 0.1f * fiber) * (1 - 0.75f * joint);
  return {Vec3f{1.15f, 0.92f, 0.68f} * (0.5f * y), -0.006f * joint + 0.0006f * ring, 0.68f};
}

Texel RoofTile(float u, float v) {
  const Unit tile = Bond(u, v, 2.4f, 12, 8, 0);
  const float tone = HashUnit(tile.id, 5), grain = TilingFbm(141, u, v, 60, 3),
              lichen = TilingFbm(142, u, v, 5, 5);
  const float arch = std::sin(3.14159265f * tile.x), lap = tile.y;
  Vec3f color =
      Mix({0.46f, 0.20f, 0.11f}, {0.36f, 0.15f, 0.09f}, tone) * (1 + 0.12f * grain) * (0.65f + 0.35f * arch);
  color = Mix(color, {0.35f, 0.33f, 0.24f}, 0.4f * Step(0.3f, 0.8f, lichen)) * (lap < 0.08f ? 0.5f : 1.0f);
  return {color, 0.035f * arch + 0.02f * lap, 0.75f};
}

Texel Stripes(float u, float v) {
  const bool white = static_cast<int>(u * 8) % 2 == 0;
  const float weave = TilingFbm(151, u, v, 128, 2);
  return {Vec3f{1, 1, 1} * ((white ? 0.80f : 0.30f) * (1 + 0.05f * weave)), 0.0005f * weave, 0.85f};
}

// Four bays by four floors (12 x 12 m) of a distant facade.
Texel FarWalls(float u, float v) {
  const Unit bay = Bond(u, v, 12.0f, 4, 4, 0);
  const bool window = bay.x > 0.26f && bay.x < 0.74f && bay.y > 0.20f && bay.y < 0.74f;
  const bool frame =
      window && (bay.x < 0.30f || bay.x > 0.70f || bay.y < 0.24f || std::abs(bay.x - 0.5f) < 0.02f);
  const bool sill = bay.y > 0.74f && bay.y < 0.78f && bay.x > 0.22f && bay.x < 0.78f;
  const float soft = TilingFbm(161, u, v, 4, 5);
  if (window && !frame) {
    const float blind =
        HashUnit(bay.id, 3) < 0.4f && bay.y < 0.2f + 0.5f * HashUnit(bay.id, 4) ? 0.30f : 0.0f;
    return {Vec3f{0.9f, 1.0f, 1.1f} * (0.06f + blind + 0.04f * HashUnit(bay.id, 5)), -0.2f, 0.2f};
  }
  return {Vec3f{1.0f, 0.98f, 0.95f} * ((frame ? 0.35f : sill ? 0.62f : 0.5f) * (1 + 0.08f * soft)), 0, 0.8f};
}

}  // namespace airsim360::internal
