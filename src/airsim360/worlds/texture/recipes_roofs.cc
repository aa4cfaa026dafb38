// Pitched roofs, timber, zinc.
#include <algorithm>
#include <cmath>

#include "airsim360/worlds/texture/recipe_shapes.h"
#include "airsim360/worlds/texture/texture_maps.h"

namespace airsim360::internal {

// Pan and cover tiles: barrels 0.2 m wide, each lapping 0.3 m over the one below, lichen on the old ones.
void RoofTile(SurfaceMaps& m) {
  const Field grain = m.Noise(141, 0.015f, 4, 0.7f), soft = m.Noise(142, 0.3f, 5, 0.6f), wobble = m.Noise(143, 0.2f, 3, 0.5f);
  m.ForEach([&](size_t i, float u, float v) {
    const auto wrap = [](float x) { return x - std::floor(x); };
    const Unit tile = Bond(wrap(u + 0.0012f * wobble[i]), wrap(v + 0.0015f * wobble[i]), m.tile, 12, 8, 0);
    const float tone = HashUnit(tile.id, 5), x = 2 * tile.x - 1;
    // A cover in the middle, pans to both sides.
    const float arch = std::sqrt(std::max(0.0f, 1 - x * x * 1.9f)), pan = 0.35f * x * x;
    const float lip = Step(0.93f, 0.985f, tile.y), gap = Step(0.045f, 0.0f, tile.y);
    Vec3f color = Mix(Vec3f{0.48f, 0.215f, 0.115f}, Vec3f{0.34f, 0.155f, 0.095f}, tone);
    if (HashUnit(tile.id, 7) < 0.14f) color = Mix(color, Vec3f{0.50f, 0.36f, 0.22f}, 0.6f);
    color = color * (1 + 0.06f * grain[i] + 0.06f * soft[i]) * (0.66f + 0.34f * std::max(arch, pan * 2)) * (1 - 0.5f * gap);
    const float lichen = Step(1.0f, 1.9f, soft[i] + 0.5f * grain[i]);
    m.SetColor(i, Mix(color, Vec3f{0.36f, 0.35f, 0.25f}, 0.55f * lichen));
    m.height[i] = 0.055f * std::max(arch, pan) + 0.022f * tile.y + 0.004f * lip - 0.010f * gap + 0.0004f * grain[i];
    m.roughness[i] = 0.50f + 0.04f * grain[i] + 0.12f * lichen;
  });
}

// Slates of 0.25 x 0.2 m in the weather, split along the bed, a few slipped or patched.
void Slate(SurfaceMaps& m) {
  const Field grain = m.Noise(144, 0.02f, 4, 0.65f), bed = m.Noise(145, 0.07f, 4, 0.5f), edge = m.Noise(146, 0.03f, 3, 0.6f);
  m.ForEach([&](size_t i, float u, float v) {
    const Unit slate = Bond(u, v, m.tile, kSlateUnits.columns, kSlateUnits.rows, 0.5f);
    const float tone = HashUnit(slate.id, 5), h = HashUnit(slate.id, 6), d = slate.edge + 0.0016f * edge[i];
    const float joint = Step(0.0045f, 0.0015f, d);
    Vec3f color = Mix(Vec3f{0.040f, 0.045f, 0.053f}, Vec3f{0.060f, 0.062f, 0.066f}, tone);
    if (h < 0.12f) color = {0.058f, 0.050f, 0.058f};
    if (h > 0.90f) color = {0.050f, 0.060f, 0.052f};
    const float step = std::floor(1.4f * bed[i]);
    m.SetColor(i, color * (1 + 0.10f * grain[i] + 0.06f * step) * (1 - 0.5f * joint));
    m.height[i] = 0.019f * slate.y + 0.0048f * (tone - 0.5f) - 0.013f * joint + 0.0014f * step + 0.0005f * grain[i];
    m.roughness[i] = 0.62f + 0.10f * grain[i] * 0.6f + 0.10f * (h - 0.5f);
  });
}

// Boards of 0.14 m: rings that run along them, checks, nail-dark joints.
void Planks(SurfaceMaps& m) {
  const Field ring = FractalField(m.size, 121, m.Cells(0.03f), m.Cells(0.8f), 4, 0.6f),
              fibre = FractalField(m.size, 122, m.Cells(0.005f), m.Cells(0.2f), 3, 0.7f), soft = m.Noise(123, 0.5f, 4, 0.5f);
  m.ForEach([&](size_t i, float u, float v) {
    const Unit plank = Bond(u, v, m.tile, 14, 1, 0);
    const float tone = HashUnit(plank.id, 5);
    // Every board is cut from elsewhere in the log.
    const int dx = static_cast<int>(HashUnit(plank.id, 6) * static_cast<float>(m.size)),
              dy = static_cast<int>(HashUnit(plank.id, 7) * static_cast<float>(m.size));
    const int x = static_cast<int>(u * static_cast<float>(m.size)), y = static_cast<int>(v * static_cast<float>(m.size));
    const float r = ring.At(x + dx, y + dy), check = Step(2.0f, 2.5f, fibre.At(x + dx, y + dy) + 0.4f * r);
    const float joint = Step(0.0050f, 0.0025f, plank.edge);
    const float c =
        0.5f * (0.82f + 0.34f * tone) * (1 + 0.10f * r + 0.05f * fibre[i] + 0.05f * soft[i]) * (1 - 0.75f * joint) * (1 - 0.4f * check);
    m.SetColor(i, Vec3f{1.15f, 0.92f, 0.68f} * c);
    m.height[i] = -0.0096f * joint - 0.0019f * check + 0.00045f * r + 0.00029f * fibre[i];
    m.roughness[i] = 0.60f + 0.035f * r + 0.1f * joint;
  });
}

// Hot-dip zinc: crystals that shine each in its own direction.
void Galvanised(SurfaceMaps& m) {
  const CellPattern spangle(m.Cells(0.022f), m.Cells(0.022f), 0.8f, 151);
  const Field fine = m.Noise(152, 0.01f, 3, 0.6f), soft = m.Noise(153, 0.3f, 5, 0.55f);
  m.ForEach([&](size_t i, float u, float v) {
    const CellPattern::Cell cell = spangle.At(u + 0.0015f * fine[i], v + 0.0015f * soft[i]);
    const float tone = HashUnit(cell.id, 1), feather = std::sin(60 * (cell.x * std::cos(6.28f * tone) + cell.y * std::sin(6.28f * tone)));
    m.SetColor(i, Vec3f{0.98f, 1.0f, 1.02f} * (0.42f * (0.88f + 0.22f * tone + 0.025f * feather + 0.035f * soft[i])));
    m.height[i] = 0.00010f * (cell.x * std::cos(6.28f * tone) + cell.y * std::sin(6.28f * tone)) * 4 + 0.00002f * fine[i];
    m.roughness[i] = 0.34f + 0.10f * (tone - 0.5f) + 0.02f * soft[i];
  });
}

}  // namespace airsim360::internal
