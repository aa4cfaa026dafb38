// Asphalt of two ages, road paint, bitumen felt: stones in a binder.
#include <algorithm>
#include <cmath>

#include "airsim360/worlds/texture/recipe_shapes.h"
#include "airsim360/worlds/texture/texture_maps.h"

namespace airsim360::internal {
namespace {

// Age shows in how many stones have lost their film of binder, and how pale what is left of it has become.
struct AsphaltAge {
  float bare;  // 0 all stones covered … 1 all bare
  Vec3f binder;
  float chips;  // brightness of bare stones
  uint32_t seed;
};

// Basalt to limestone chips, a few of quartz and rusty ones.
Vec3f ChipColor(uint32_t id, uint32_t seed) {
  const float tone = HashUnit(id, seed, 1), kind = HashUnit(id, seed, 2);
  if (kind > 0.91f) return {0.24f, 0.175f, 0.13f};
  if (kind > 0.86f) return {0.42f, 0.41f, 0.39f};
  return Mix(Vec3f{0.10f, 0.098f, 0.095f}, Vec3f{0.28f, 0.265f, 0.24f}, tone * tone);
}

// Share of binder gone from a stone of id at height `top` (0 deep … 1 proud).
float Bareness(const AsphaltAge& age, uint32_t id, float top, float rim, float noise) {
  if (id == 0) return 0;
  const float kept = HashUnit(id, age.seed, 3) < 0.25f ? 0.35f : 0.0f;
  return std::clamp(age.bare * (0.55f + 0.75f * top) + 0.1f * noise - kept, 0.0f, 1.0f) * (1 - 0.5f * Step(0.6f, 1.0f, rim));
}

Field PaintAsphalt(SurfaceMaps& m, const AsphaltAge& age) {
  const StoneOptions stones{0.0024f, 0.0085f, 1.3f, 0.85f, 0.42f, -0.0034f, -0.0004f, 0.12f};
  const StoneField stone = DropStones(m.size, m.tile, -0.0022f, stones, age.seed);
  const Field fine = m.Noise(age.seed + 3, 0.012f, 3, 0.7f), mid = m.Noise(age.seed + 5, 0.3f, 5, 0.6f);
  Field tops(m.size);
  m.ForEach([&](size_t i, float, float) {
    const float top = Step(-0.0024f, -0.0004f, stone.height[i]);
    const float bare = Bareness(age, stone.id[i], top, stone.rim[i], mid[i]);
    const float dust = std::clamp(0.35f * age.bare * (1 - top), 0.0f, 1.0f);
    const Vec3f binder = Mix(age.binder * (1 + 0.10f * fine[i]), Vec3f{0.20f, 0.185f, 0.165f}, 0.55f * dust);
    m.SetColor(i, Mix(binder, ChipColor(stone.id[i], age.seed) * age.chips, 0.8f * bare) * (1 + 0.05f * mid[i]));
    m.height[i] = std::max(stone.height[i], -0.0023f) + 0.0001f * fine[i] + 0.0002f * mid[i];
    m.roughness[i] = 0.66f + 0.025f * fine[i] + 0.07f * (1 - top) - 0.05f * bare;
    tops[i] = top;
  });
  return tops;
}

constexpr AsphaltAge kAged{0.75f, {0.088f, 0.086f, 0.082f}, 1.0f, 11}, kFresh{0.12f, {0.044f, 0.044f, 0.046f}, 0.6f, 12},
    kUnderPaint{0.8f, {0.095f, 0.092f, 0.087f}, 1.0f, 13};

}  // namespace

void AsphaltAged(SurfaceMaps& m) {
  PaintAsphalt(m, kAged);
  Flatten(m, 0.18f);
}

void AsphaltFresh(SurfaceMaps& m) {
  PaintAsphalt(m, kFresh);
  Flatten(m, 0.18f);
}

// Thermoplastic on asphalt: stones that stand proud and cracks lose it first.
void PaintWorn(SurfaceMaps& m) {
  const Field top = PaintAsphalt(m, kUnderPaint);
  const Field grain = m.Noise(191, 0.02f, 5, 0.65f), soft = m.Noise(192, 0.4f, 5, 0.6f);
  const Field crack = LineField(m.size, m.tile, 4, 0.35f, 0.03f, 193);
  m.ForEach([&](size_t i, float, float) {
    const float wear =
        0.45f + 0.20f * soft[i] + 0.22f * grain[i] - 0.55f * top[i] * Step(-1.2f, 1.4f, -soft[i]) - 1.2f * Step(0.008f, 0.002f, crack[i]);
    const float left = Step(-0.35f, 0.05f, wear), dirt = std::clamp(0.20f - 0.10f * soft[i], 0.0f, 1.0f);
    const Vec3f paint = Mix(Vec3f{0.70f, 0.695f, 0.66f}, Vec3f{0.19f, 0.175f, 0.15f}, 0.7f * dirt) * (1 + 0.03f * grain[i]);
    // What is gone leaves paint in the pores.
    m.SetColor(i, Mix(Mix(m.color(i), Vec3f{0.34f, 0.335f, 0.32f}, 0.25f), paint, left));
    m.height[i] = Mix(m.height[i], 0.45f * m.height[i] + 0.0011f, 0.8f * left);
    m.roughness[i] = Mix(m.roughness[i], 0.52f + 0.1f * dirt, left);
  });
}

// Granules of 0.8 to 3 mm on felt, with bald spots; the rolls and puddles are added in the world.
void Bitumen(SurfaceMaps& m) {
  const StoneOptions granules{0.0016f, 0.0034f, 1.1f, 0.9f, 0.6f, -0.001f, 0.0f, 0.1f};
  const StoneField stone = DropStones(m.size, m.tile, -0.0012f, granules, 21);
  const Field soft = m.Noise(22, 0.25f, 5, 0.55f), fine = m.Noise(23, 0.02f, 3, 0.6f);
  m.ForEach([&](size_t i, float, float) {
    const bool bald = stone.id[i] == 0 || soft[i] + 0.8f * fine[i] > 2.1f;
    const float tone = HashUnit(stone.id[i], 5);
    const Vec3f granule = Mix(Vec3f{0.10f, 0.105f, 0.11f}, Vec3f{0.19f, 0.185f, 0.18f}, tone);
    m.SetColor(i, (bald ? Vec3f{0.045f, 0.045f, 0.046f} : granule) * (1 + 0.06f * soft[i]));
    m.height[i] = (bald ? -0.0012f : stone.height[i]) + 0.0006f * soft[i];
    m.roughness[i] = (bald ? 0.50f : 0.70f) + 0.02f * fine[i];
  });
  Flatten(m, 0.2f);
}

}  // namespace airsim360::internal
