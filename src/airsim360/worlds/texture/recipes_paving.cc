// Laid grounds: concrete flags, clinker, setts.
#include <algorithm>
#include <cmath>

#include "airsim360/worlds/texture/recipe_shapes.h"
#include "airsim360/worlds/texture/texture_maps.h"

namespace airsim360::internal {

// Flags of 0.75 x 0.5 m with broom finish, worn edges, gum and hairline cracks.
void Slabs(SurfaceMaps& m) {
  const Field grain = m.Noise(31, 0.02f, 4, 0.7f), soft = m.Noise(32, 0.35f, 5, 0.55f),
              broom = FractalField(m.size, 33, m.Cells(0.4f), m.Cells(0.008f), 2, 0.6f), edge_noise = m.Noise(34, 0.06f, 4, 0.6f);
  const Field crack = LineField(m.size, m.tile, 3, 0.5f, 0.02f, 35);
  m.ForEach([&](size_t i, float u, float v) {
    const Unit slab = Bond(u, v, m.tile, kSlabUnits.columns, kSlabUnits.rows, 0.5f);
    const float tone = HashUnit(slab.id, 5), d = slab.edge + 0.0008f * edge_noise[i];
    const float joint = Step(0.0055f, 0.0030f, d), worn = Step(0.022f, 0.004f, d);
    const bool cracked = HashUnit(slab.id, 8) < 0.16f;
    const float split = cracked ? Step(0.0022f, 0.0008f, crack[i] + 0.0006f * grain[i]) : 0.0f;
    float y = 0.38f * (0.95f + 0.10f * tone) * (1 + 0.035f * grain[i] + 0.045f * soft[i] + 0.02f * broom[i]);
    y *= (1 - 0.58f * joint) * (1 - 0.55f * split) * (1 - 0.07f * worn);
    m.SetColor(i, Mix(Vec3f{1.03f, 1, 0.93f}, Vec3f{0.98f, 1, 1.0f}, HashUnit(slab.id, 6)) * y);
    m.height[i] = 0.0022f * (tone - 0.5f) - 0.0045f * joint - 0.0008f * worn - 0.002f * split + 0.00042f * broom[i] + 0.00030f * grain[i];
    m.roughness[i] = 0.58f + 0.035f * grain[i] + 0.05f * joint - 0.03f * soft[i] * 0.5f;
  });
  // Trodden gum.
  for (uint32_t k = 0; k < static_cast<uint32_t>(7 * m.tile * m.tile); ++k) {
    const float n = static_cast<float>(m.size), radius = (0.008f + 0.012f * HashUnit(k, 36)) * m.texels_per_metre();
    const float dark = HashUnit(k, 37) < 0.8f ? 0.62f : 1.15f;
    Stamp(m.red, HashUnit(k, 38) * n, HashUnit(k, 39) * n, radius, [&](size_t i, float d) {
      const float a = 0.8f * Step(1.0f, 0.75f, d + 0.06f * edge_noise[i]);
      m.SetColor(i, m.color(i) * Mix(1, dark, a));
      m.roughness[i] -= 0.12f * a;
    });
  }
}

// Clinker in herringbone, 2:1, with sand joints.
void PavingBrick(SurfaceMaps& m) {
  const Field grain = m.Noise(41, 0.015f, 4, 0.7f), soft = m.Noise(42, 0.3f, 5, 0.55f), chip = m.Noise(43, 0.03f, 4, 0.6f);
  m.ForEach([&](size_t i, float u, float v) {
    const Unit brick = Herringbone(u, v, m.tile, 20);
    const float tone = HashUnit(brick.id, 5), d = brick.edge + 0.0009f * chip[i];
    const float joint = Step(0.0048f, 0.0022f, d), bevel = Step(0.012f, 0.003f, d);
    Vec3f color = Mix(Vec3f{0.40f, 0.165f, 0.098f}, Vec3f{0.29f, 0.120f, 0.082f}, tone) * (0.88f + 0.24f * HashUnit(brick.id, 6));
    if (HashUnit(brick.id, 9) < 0.07f) color = color * 0.82f;  // darker ones would show the tile
    color = color * (1 + 0.07f * grain[i] + 0.05f * soft[i]);
    m.SetColor(i, Mix(color, Vec3f{0.155f, 0.13f, 0.10f} * (1 + 0.15f * grain[i]), 0.9f * joint));
    m.height[i] = 0.0018f * (tone - 0.5f) - 0.0040f * joint - 0.0016f * bevel + 0.00022f * grain[i];
    m.roughness[i] = 0.60f + 0.04f * grain[i] + 0.16f * joint - 0.03f * bevel;
  });
}

// Small granite setts with rounded heads, dark moss and sand between.
void StoneSetts(SurfaceMaps& m) {
  const Field grain = m.Noise(51, 0.01f, 3, 0.8f), soft = m.Noise(52, 0.3f, 5, 0.55f), bend = m.Noise(53, 0.09f, 3, 0.5f);
  const Field speck = WhiteField(m.size, 54);
  m.ForEach([&](size_t i, float u, float v) {
    const Unit stone = Bond(u, v, m.tile, kSettUnits.columns, kSettUnits.rows, 0.5f);
    const float tone = HashUnit(stone.id, 5), d = stone.edge + 0.0035f * bend[i];
    const float joint = Step(0.0105f, 0.0050f, d), head = Step(0.0f, 0.034f, d);
    const float y = 0.36f * (0.82f + 0.34f * tone) * (1 + 0.05f * grain[i] + 0.10f * speck[i] + 0.04f * soft[i]);
    const Vec3f stone_color = Mix(Vec3f{1.03f, 1.0f, 0.95f}, Vec3f{0.96f, 1.0f, 1.02f}, HashUnit(stone.id, 7)) * y;
    const Vec3f moss = Mix(Vec3f{0.12f, 0.105f, 0.085f}, Vec3f{0.075f, 0.09f, 0.045f}, Step(0.0f, 1.4f, soft[i]));
    m.SetColor(i, Mix(stone_color, moss * (1 + 0.15f * grain[i]), joint));
    m.height[i] = 0.0140f * head + 0.006f * (tone - 0.5f) * head + 0.0007f * grain[i];
    m.roughness[i] = 0.56f + 0.05f * grain[i] + 0.2f * joint - 0.05f * head;
  });
}

}  // namespace airsim360::internal
