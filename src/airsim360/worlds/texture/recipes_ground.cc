// Loose and grown grounds, and the far country.
#include <algorithm>
#include <array>
#include <cmath>

#include "airsim360/worlds/texture/recipe_shapes.h"
#include "airsim360/worlds/texture/texture_maps.h"

namespace airsim360::internal {
namespace {

// Stones of several rocks, `pale` times as bright as basalt and sandstone are, on fines.
void PaintGravel(SurfaceMaps& m, const StoneOptions& stones, Vec3f fines, float pale, uint32_t seed) {
  static constexpr std::array<Vec3f, 6> kRocks = {{{0.21f, 0.20f, 0.185f},
                                                   {0.13f, 0.13f, 0.132f},
                                                   {0.27f, 0.245f, 0.205f},
                                                   {0.22f, 0.185f, 0.15f},
                                                   {0.34f, 0.335f, 0.32f},
                                                   {0.17f, 0.15f, 0.125f}}};
  const StoneField stone = DropStones(m.size, m.tile, -0.012f, stones, seed);
  const Field fine = m.Noise(seed + 1, 0.012f, 3, 0.7f), soft = m.Noise(seed + 2, 0.25f, 5, 0.55f);
  m.ForEach([&](size_t i, float, float) {
    const uint32_t id = stone.id[i];
    const Vec3f rock = kRocks[static_cast<size_t>(HashUnit(id, seed, 1) * 6)] * (pale * (0.8f + 0.4f * HashUnit(id, seed, 2)));
    // Deep stones and the rims between them lie in each other's shade.
    const float shade = 0.62f + 0.38f * Step(-0.011f, 0.0f, stone.height[i]);
    const Vec3f c = id == 0 ? fines * 0.7f : rock * (1 - 0.22f * Step(0.7f, 1.0f, stone.rim[i]));
    m.SetColor(i, c * shade * (1 + 0.07f * fine[i] + 0.04f * soft[i]));
    m.height[i] = stone.height[i] + 0.0002f * fine[i];
    m.roughness[i] = (id == 0 ? 0.7f : 0.45f + 0.14f * HashUnit(id, seed, 3)) + 0.02f * fine[i];
  });
  Flatten(m, 0.22f);
}

// Blades as short bent strokes, the later ones over the earlier.
struct Turf {
  float per_square_metre, shortest, longest;
  float dry;     // share of dead blades
  float clover;  // three-leaved clusters per square metre
  uint32_t seed;
  Vec3f dead[2] = {{0.33f, 0.275f, 0.13f}, {0.25f, 0.20f, 0.12f}};  // its colours lie between these
  float rise = 1;                                                   // how far blades stand up
};

void PaintBlade(SurfaceMaps& m, const Turf& turf, uint32_t k) {
  const auto h = [&](uint32_t c) { return HashUnit(k, turf.seed, c); };
  const float scale = m.texels_per_metre(), length = Mix(turf.shortest, turf.longest, h(1)) * scale;
  const float width = (0.0012f + 0.0016f * h(2)) * scale, bend = 1.6f * (h(3) - 0.5f);
  const float foot = -0.012f + 0.010f * h(4), rise = turf.rise * (0.004f + 0.016f * h(5)), n = static_cast<float>(m.size);
  const bool dead = h(6) < turf.dry;
  const Vec3f green = Mix(Vec3f{0.075f, 0.112f, 0.026f}, Vec3f{0.205f, 0.235f, 0.070f}, h(7) * h(7) * 0.6f + 0.4f * h(8));
  const Vec3f color = dead ? Mix(turf.dead[0], turf.dead[1], h(7)) : green;
  float x = h(9) * n, y = h(10) * n, angle = 6.2831853f * h(11);
  const int steps = std::max(2, static_cast<int>(length));
  for (int q = 0; q < steps; ++q) {
    const float t = static_cast<float>(q) / static_cast<float>(steps), w = width * (1 - 0.75f * t);
    const float height = foot + rise * t * (1.6f - t), light = 0.62f + 0.5f * t;
    const float across_x = -std::sin(angle), across_y = std::cos(angle);
    for (float s = -w; s <= w + 0.01f; s += 0.5f) {
      const size_t i = m.height.Index(static_cast<int>(std::floor(x + s * across_x)), static_cast<int>(std::floor(y + s * across_y)));
      if (height < m.height[i]) continue;
      m.height[i] = height - 0.0006f * s * s / std::max(w * w, 0.1f);
      m.SetColor(i, color * light);
      m.roughness[i] = dead ? 0.72f : 0.56f;
    }
    x += std::cos(angle);
    y += std::sin(angle);
    angle += bend / static_cast<float>(steps);
  }
}

void PaintTurf(SurfaceMaps& m, const Turf& turf) {
  const Field soil = m.Noise(turf.seed + 1, 0.03f, 4, 0.6f);
  m.ForEach([&](size_t i, float, float) {
    m.SetColor(i, Vec3f{0.085f, 0.066f, 0.042f} * (1 + 0.25f * soil[i]));
    m.height[i] = -0.014f + 0.001f * soil[i];
    m.roughness[i] = 0.8f;
  });
  const auto blades = static_cast<uint32_t>(turf.per_square_metre * m.tile * m.tile);
  for (uint32_t k = 0; k < blades; ++k) PaintBlade(m, turf, k);
  const auto leaves = static_cast<uint32_t>(turf.clover * m.tile * m.tile);
  for (uint32_t k = 0; k < leaves; ++k) {
    const float n = static_cast<float>(m.size), x = HashUnit(k, turf.seed, 31) * n, y = HashUnit(k, turf.seed, 32) * n;
    const float r = (0.003f + 0.003f * HashUnit(k, turf.seed, 33)) * m.texels_per_metre(), a = 6.28f * HashUnit(k, turf.seed, 34);
    for (int leaf = 0; leaf < 3; ++leaf) {
      const float b = a + 2.094f * static_cast<float>(leaf);
      Stamp(m.height, x + 0.9f * r * std::cos(b), y + 0.9f * r * std::sin(b), r, [&](size_t i, float d) {
        m.SetColor(i, Vec3f{0.072f, 0.125f, 0.036f} * (0.8f + 0.45f * HashUnit(k, turf.seed, 35)) * (1.1f - 0.3f * d));
        m.height[i] = 0.004f - 0.001f * d * d;
        m.roughness[i] = 0.55f;
      });
    }
  }
  // Blades stand far steeper than a normal map can hold: what it shows is their sway.
  for (float& h : m.height.values) h *= 0.38f;
  Flatten(m, 0.18f);
}

}  // namespace

void GravelPath(SurfaceMaps& m) {
  PaintGravel(m, {0.003f, 0.011f, 1.7f, 0.45f, 0.42f, -0.008f, -0.002f, 0.15f}, {0.30f, 0.25f, 0.19f}, 1.4f, 61);
}

void RoofGravel(SurfaceMaps& m) {
  PaintGravel(m, {0.004f, 0.018f, 2.0f, 0.35f, 0.75f, -0.010f, -0.002f, 0.15f}, {0.12f, 0.115f, 0.11f}, 1, 131);
}

void Grass(SurfaceMaps& m) { PaintTurf(m, {26000, 0.012f, 0.055f, 0.13f, 260, 71}); }

// Needles and rotting leaves over dark earth, moss and seedlings here and there.
void ForestFloor(SurfaceMaps& m) {
  PaintTurf(m, {17000, 0.015f, 0.060f, 0.90f, 45, 141, {{0.200f, 0.120f, 0.062f}, {0.085f, 0.055f, 0.034f}}, 0.45f});
  const auto leaves = static_cast<uint32_t>(190 * m.tile * m.tile);
  const float n = static_cast<float>(m.size);
  for (uint32_t k = 0; k < leaves; ++k) {
    const auto h = [&](uint32_t c) { return HashUnit(k, 142, c); };
    const float r = (0.008f + 0.012f * h(1)) * m.texels_per_metre(), x = n * h(2), y = n * h(3), a = 6.2831853f * h(4);
    const Vec3f color = Mix(Vec3f{0.24f, 0.145f, 0.065f}, Vec3f{0.095f, 0.060f, 0.038f}, h(5));
    Stamp(m.height, x, y, r, [&](size_t i, float d) {
      // Narrow across, with a rib.
      const float dx = static_cast<float>(static_cast<int>(i) % m.size) - x, dy = static_cast<float>(static_cast<int>(i) / m.size) - y,
                  across = std::abs(-dx * std::sin(a) + dy * std::cos(a)) / r;
      if (across > 0.55f * (1 - d * d)) return;
      m.SetColor(i, color * (across < 0.06f ? 0.7f : 1.08f - 0.3f * d));
      m.height[i] = 0.0008f + 0.0012f * h(6) - 0.0012f * across;
      m.roughness[i] = 0.66f;
    });
  }
  const Field moss = m.Noise(143, 0.35f, 4, 0.55f), fine = m.Noise(144, 0.015f, 3, 0.7f);
  m.ForEach([&](size_t i, float, float) {
    const float share = Step(1.05f, 1.5f, moss[i] + 0.25f * fine[i]);
    if (share <= 0) return;
    m.SetColor(i, Mix(Vec3f{m.red[i], m.green[i], m.blue[i]}, Vec3f{0.062f, 0.085f, 0.022f} * (1 + 0.2f * fine[i]), 0.85f * share));
  });
}

// Crumbs and clods on fine earth, damp below, with bits of straw.
void Soil(SurfaceMaps& m) {
  const StoneOptions clods{0.002f, 0.022f, 0.9f, 0.15f, 0.34f, -0.006f, 0.0f, 0.1f};
  const StoneField clod = DropStones(m.size, m.tile, -0.006f, clods, 81);
  const Field fine = m.Noise(82, 0.01f, 3, 0.75f), mid = m.Noise(83, 0.08f, 5, 0.6f);
  m.ForEach([&](size_t i, float, float) {
    const bool pebble = clod.id[i] != 0 && HashUnit(clod.id[i], 84) < 0.10f;
    const Vec3f earth = Vec3f{0.165f, 0.118f, 0.076f} * (0.85f + 0.3f * HashUnit(clod.id[i], 85));
    const Vec3f stone = Mix(Vec3f{0.24f, 0.22f, 0.19f}, Vec3f{0.34f, 0.31f, 0.27f}, HashUnit(clod.id[i], 86));
    m.SetColor(i, (pebble ? stone : earth) * (1 + 0.10f * fine[i] + 0.09f * mid[i]));
    m.height[i] = clod.height[i] + 0.0004f * fine[i] + 0.0019f * mid[i];
    m.roughness[i] = (pebble ? 0.5f : 0.68f) + 0.03f * fine[i];
  });
  Flatten(m, 0.2f);
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
  constexpr std::array<Vec3f, 5> kCrops = {
      {{0.12f, 0.17f, 0.06f}, {0.20f, 0.20f, 0.09f}, {0.16f, 0.13f, 0.08f}, {0.09f, 0.14f, 0.05f}, {0.24f, 0.22f, 0.14f}}};
  const Vec3f crop = kCrops[static_cast<size_t>(HashUnit(field.cell, 1) * 5)];
  return {Mix(crop * (1 + 0.25f * soft), {0.05f, 0.08f, 0.035f}, hedge), 0, 0.9f};
}

}  // namespace airsim360::internal
