// What walls are made of: brick, dressed stone, render, cast concrete.
#include <algorithm>
#include <cmath>

#include "airsim360/worlds/texture/recipe_shapes.h"
#include "airsim360/worlds/texture/texture_maps.h"

namespace airsim360::internal {
namespace {

struct BrickStyle {
  Vec3f low, high;  // colours between which bricks vary
  Vec3f odd;        // of the over- or underburnt ones
  float odd_share;
  Vec3f mortar;
  float chips;  // how ragged the edges are
  float soot;
  float paint;  // share of the wall under white paint
  uint32_t seed;
};

void PaintBricks(SurfaceMaps& m, const BrickStyle& s) {
  const Field grain = m.Noise(s.seed, 0.012f, 4, 0.7f), chip = m.Noise(s.seed + 1, 0.035f, 4, 0.6f),
              soft = m.Noise(s.seed + 2, 0.4f, 6, 0.55f), drag = FractalField(m.size, s.seed + 3, m.Cells(0.12f), m.Cells(0.01f), 3, 0.6f);
  const Field run = DripField(m.size, m.tile, 5, 0.05f, 1.2f, s.seed + 4);
  m.ForEach([&](size_t i, float u, float v) {
    const Unit brick = Bond(u, v, m.tile, kBrickUnits.columns, kBrickUnits.rows, 0.5f);
    const float tone = HashUnit(brick.id, s.seed, 5), d = brick.edge + 0.0007f * s.chips * chip[i];
    const float joint = Step(0.0062f, 0.0040f, d), rim = Step(0.0115f, 0.0055f, d);
    Vec3f color = Mix(s.low, s.high, tone) * (0.90f + 0.20f * HashUnit(brick.id, s.seed, 6));
    if (HashUnit(brick.id, s.seed, 8) < s.odd_share) color = Mix(color, s.odd, 0.75f);
    color = color * (1 + 0.07f * grain[i] + 0.04f * drag[i]) * (1 - 0.06f * rim);
    const Vec3f mortar = s.mortar * (1 + 0.05f * grain[i] + 0.05f * soft[i]);
    Vec3f shown = Mix(color, mortar, joint);
    float rough = 0.58f + 0.035f * grain[i] + 0.09f * joint;
    if (s.paint > 0) {
      // Paint bridges the joint and flakes off where bricks spall: in specks, since larger bare places would repeat with the tile.
      const float left = Step(-0.10f, 0.06f, s.paint - 0.04f * soft[i] + 0.12f * chip[i] - 0.05f * rim);
      shown = Mix(shown, Vec3f{0.66f, 0.64f, 0.59f} * (1 + 0.03f * grain[i] - 0.07f * joint), left);
      rough = Mix(rough, 0.52f + 0.03f * grain[i], left);
    }
    shown = shown * (1 - s.soot * (0.10f * Step(0.0f, 1.6f, soft[i]) + 0.14f * Step(0.4f, 3.0f, run[i])));
    m.SetColor(i, shown);
    m.height[i] = 0.0022f * (tone - 0.5f) - 0.0055f * joint - 0.0010f * rim + 0.00030f * grain[i] + 0.00016f * drag[i];
    m.roughness[i] = rough;
  });
}

}  // namespace

void BrickRed(SurfaceMaps& m) {
  PaintBricks(
      m, {{0.35f, 0.135f, 0.090f}, {0.28f, 0.105f, 0.078f}, {0.105f, 0.072f, 0.066f}, 0.10f, {0.40f, 0.37f, 0.32f}, 1.0f, 0.6f, 0, 91});
}
void BrickStock(SurfaceMaps& m) {
  PaintBricks(
      m, {{0.40f, 0.295f, 0.155f}, {0.32f, 0.225f, 0.125f}, {0.165f, 0.125f, 0.095f}, 0.16f, {0.33f, 0.305f, 0.26f}, 1.5f, 1.0f, 0, 191});
}
void BrickPainted(SurfaceMaps& m) {
  PaintBricks(
      m, {{0.34f, 0.14f, 0.095f}, {0.27f, 0.105f, 0.078f}, {0.12f, 0.08f, 0.07f}, 0.08f, {0.36f, 0.33f, 0.29f}, 1.2f, 0.7f, 0.19f, 291});
}

// Dressed limestone in regular courses: fine tooling, pits, a weathered skin.
void Ashlar(SurfaceMaps& m) {
  const Field grain = m.Noise(101, 0.012f, 4, 0.7f), soft = m.Noise(102, 0.5f, 6, 0.55f),
              bed = FractalField(m.size, 103, m.Cells(0.5f), m.Cells(0.03f), 4, 0.6f), edge = m.Noise(104, 0.04f, 4, 0.6f);
  const Field run = DripField(m.size, m.tile, 4, 0.07f, 1.4f, 105);
  m.ForEach([&](size_t i, float u, float v) {
    const Unit stone = Bond(u, v, m.tile, kAshlarUnits.columns, kAshlarUnits.rows, 0.5f);
    const float tone = HashUnit(stone.id, 5), d = stone.edge + 0.0008f * edge[i];
    const float joint = Step(0.0052f, 0.0028f, d), arris = Step(0.014f, 0.004f, d);
    const float pit = Step(1.75f, 2.3f, grain[i] + 0.35f * edge[i]);
    float y = 0.5f * (0.93f + 0.14f * tone) * (1 + 0.035f * grain[i] + 0.045f * soft[i] + 0.025f * bed[i]);
    y *= (1 - 0.36f * joint) * (1 - 0.22f * pit) * (1 - 0.10f * Step(0.5f, 3.0f, run[i]));
    m.SetColor(i, Mix(Vec3f{1.03f, 1, 0.94f}, Vec3f{0.98f, 1, 1.02f}, HashUnit(stone.id, 6)) * y);
    m.height[i] = 0.0026f * (tone - 0.5f) - 0.0062f * joint - 0.0020f * arris - 0.0022f * pit + 0.0004f * grain[i] + 0.0003f * bed[i];
    m.roughness[i] = 0.60f + 0.035f * grain[i] + 0.06f * joint;
  });
}

// Float-finished render: grains of sand, the sweep of the float, runs under nothing in particular.
void Plaster(SurfaceMaps& m) {
  const Field grain = m.Noise(111, 0.016f, 3, 0.75f), sweep = m.Noise(112, 0.35f, 4, 0.5f), soft = m.Noise(113, 0.9f, 6, 0.55f);
  const Field run = DripField(m.size, m.tile, 5, 0.04f, 1.3f, 114);
  m.ForEach([&](size_t i, float, float) {
    const float stain = Step(0.4f, 3.2f, run[i]);
    const float y = 0.5f * (1 + 0.018f * grain[i] + 0.018f * sweep[i] + 0.038f * soft[i]) * (1 - 0.10f * stain);
    m.SetColor(i, Mix(Vec3f{1, 1, 1}, Vec3f{1.01f, 0.99f, 0.95f}, Step(0.0f, 2.0f, soft[i])) * y);
    m.height[i] = 0.00055f * grain[i] + 0.0012f * sweep[i];
    m.roughness[i] = 0.56f + 0.035f * grain[i] + 0.03f * soft[i];
  });
}

// Cast against smooth forms: panels of 1.2 m with tie holes, bug holes, dirty runs.
void Concrete(SurfaceMaps& m) {
  const Field fine = m.Noise(21, 0.012f, 3, 0.8f), mid = m.Noise(22, 0.16f, 6, 0.65f), soft = m.Noise(23, 1.0f, 7, 0.6f);
  const Field run = DripField(m.size, m.tile, 6, 0.035f, 1.5f, 24);
  m.ForEach([&](size_t i, float, float) {
    const float stain = Step(0.2f, 3.2f, run[i]) * std::clamp(0.7f + 0.3f * mid[i], 0.0f, 1.0f);
    const float tone = 1 + 0.040f * soft[i] + 0.026f * mid[i] + 0.012f * fine[i] - 0.10f * stain;
    m.SetColor(i, Mix(Vec3f{0.50f, 0.487f, 0.460f}, Vec3f{0.465f, 0.46f, 0.45f}, std::clamp(0.5f + 0.4f * mid[i], 0.0f, 1.0f)) * tone);
    m.height[i] = 0.0018f * soft[i] + 0.0006f * mid[i] + 0.00045f * fine[i];
    m.roughness[i] = 0.52f + 0.012f * mid[i] + 0.010f * fine[i] + 0.03f * stain;
  });
  const auto holes = static_cast<uint32_t>(300 * m.tile * m.tile);
  for (uint32_t k = 0; k < holes; ++k) {
    const float n = static_cast<float>(m.size), h = HashUnit(k, 25), radius = (0.0008f + 0.0042f * h * h * h * h) * m.texels_per_metre();
    Stamp(m.red, HashUnit(k, 26) * n, HashUnit(k, 27) * n, std::max(radius, 0.8f), [&](size_t i, float d) {
      m.SetColor(i, m.color(i) * (1 - 0.5f * Step(1.0f, 0.6f, d)));
      m.height[i] -= 0.7f * radius / m.texels_per_metre() * (1 - d * d);
    });
  }
}

Texel Stripes(float u, float v) {
  const bool white = static_cast<int>(u * 8) % 2 == 0;
  const float weave = TilingFbm(151, u, v, 128, 2);
  return {Vec3f{1, 1, 1} * ((white ? 0.80f : 0.30f) * (1 + 0.05f * weave)), 0.0005f * weave, 0.85f};
}

namespace {

// A distant pane: the dark of a room, or a blind drawn down some way.
Texel FarPane(const Unit& bay, float from_top) {
  const bool blind = HashUnit(bay.id, 3) < 0.45f && from_top < HashUnit(bay.id, 4) * 1.1f;
  const float dark = 0.05f + 0.06f * HashUnit(bay.id, 5);
  return {blind ? Vec3f{0.42f, 0.40f, 0.36f} * (0.75f + 0.4f * HashUnit(bay.id, 6)) : Vec3f{0.9f, 1.0f, 1.1f} * dark, -0.2f, 0.2f};
}

Texel FarStone(float y) { return {Vec3f{1.0f, 0.98f, 0.95f} * y, 0, 0.8f}; }

}  // namespace

// Eight bays by eight floors (24 x 24 m) of a distant facade with windows of two widths in a wall.
Texel FarWalls(float u, float v) {
  const Unit bay = Bond(u, v, 24.0f, 8, 8, 0), column = Bond(u, 0, 24.0f, 8, 1, 0);
  const float half = HashUnit(column.id, 7) < 0.35f ? 0.17f : 0.24f, x = std::abs(bay.x - 0.5f);
  const bool window = x < half && bay.y > 0.20f && bay.y < 0.74f;
  const bool frame = window && (x > half - 0.035f || bay.y < 0.24f || x < 0.02f || std::abs(bay.y - 0.48f) < 0.02f);
  const bool sill = bay.y > 0.74f && bay.y < 0.78f && x<half + 0.04f, lintel = bay.y> 0.14f && bay.y < 0.20f && x < half + 0.03f;
  // A box of an air conditioner in some.
  const bool cooler = HashUnit(bay.id, 8) < 0.12f && x < 0.11f && bay.y > 0.60f && bay.y < 0.74f;
  if (cooler) return FarStone(0.45f);
  if (window && !frame) return FarPane(bay, (bay.y - 0.24f) / 0.5f);
  const float soft = TilingFbm(161, u, v, 6, 5);
  return FarStone((frame ? 0.35f : sill ? 0.62f : lintel ? 0.58f : 0.5f) * (1 + 0.10f * soft));
}

// Piers that run up between strips of window and dark spandrel, two strips a bay.
Texel FarPiers(float u, float v) {
  const Unit bay = Bond(u, v, 24.0f, 12, 7, 0);
  const float x = std::abs(bay.x - 0.5f), soft = TilingFbm(162, u, v, 6, 5);
  if (x > 0.30f) return FarStone((x > 0.36f ? 0.55f : 0.36f) * (1 + 0.09f * soft));
  if (bay.y < 0.55f) return x < 0.025f || bay.y < 0.03f ? FarStone(0.30f) : FarPane(bay, bay.y / 0.55f);
  return FarStone((bay.y < 0.60f ? 0.40f : 0.26f) * (1 + 0.09f * soft));
}

// Bands of glass and wall by turns, a post every metre and a half.
Texel FarRibbons(float u, float v) {
  const Unit bay = Bond(u, v, 24.0f, 16, 7, 0);
  const float soft = TilingFbm(163, u, v, 6, 5);
  if (bay.y > 0.52f) return FarStone((bay.y < 0.56f ? 0.36f : 0.5f) * (1 + 0.09f * soft));
  return std::abs(bay.x - 0.5f) > 0.455f || bay.y < 0.03f ? FarStone(0.30f) : FarPane(bay, bay.y / 0.52f);
}

namespace {

// Light behind the panes of a bay by night: a third of the rooms of homes one by one, of offices floors as a whole. The
// whites are those of lamps of 2700, 3000 and 4500 K.
Vec3f LightBehind(uint32_t bay, uint32_t floor, bool offices) {
  constexpr Vec3f kWarm{1.0f, 0.40f, 0.10f}, kSoft{1.0f, 0.46f, 0.15f}, kCool{1.0f, 0.70f, 0.50f};
  const bool late = offices && HashUnit(floor, 31) < 0.30f, lit = HashUnit(bay, 32) < (late ? 0.85f : offices ? 0.10f : 0.34f);
  if (!lit) return {};
  const float pick = HashUnit(bay, 33), spread = std::exp2(-3.0f * HashUnit(bay, 34));
  return (late ? kCool : pick < 0.5f ? kWarm : pick < 0.85f ? kSoft : kCool) * (late ? 0.5f + 0.5f * spread : spread);
}

}  // namespace

Vec3f FarLights(Texel (*wall)(float u, float v), int columns, int rows, float u, float v) {
  const bool pane = wall(u, v).height < 0;
  const Unit bay = Bond(u, v, 24.0f, columns, rows, 0), floor = Bond(0, v, 24.0f, 1, rows, 0);
  return pane ? LightBehind(bay.id, floor.id, columns > 8) : Vec3f{};
}

}  // namespace airsim360::internal
