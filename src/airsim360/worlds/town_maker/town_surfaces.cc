#include "airsim360/worlds/town_maker/town_surfaces.h"

#include <algorithm>
#include <cmath>

#include "airsim360/math/angles.h"
#include "airsim360/worlds/texture/recipe_shapes.h"
#include "airsim360/worlds/texture/texture_maps.h"

namespace airsim360::internal {
namespace {

// Tiles of 14 cm with a painted ornament of eightfold symmetry in `ink` on glaze of `ground`.
void Azulejo(SurfaceMaps& m, Vec3f ground, Vec3f ink) {
  const Field soft = m.Noise(701, 0.3f, 5, 0.55f), grain = m.Noise(702, 0.01f, 3, 0.7f);
  const float tile = 0.14f;
  m.ForEach([&](size_t i, float u, float v) {
    const float x = u * m.tile / tile, y = v * m.tile / tile;
    const auto column = static_cast<uint32_t>(x), row = static_cast<uint32_t>(y);
    const float fx = x - std::floor(x) - 0.5f, fy = y - std::floor(y) - 0.5f;
    const float r = std::hypot(fx, fy), a = std::atan2(fy, fx);
    // A rosette in the middle, a quarter of one in every corner, a frame.
    const float petal = 0.23f + 0.09f * std::cos(8 * a), corner = std::hypot(0.5f - std::abs(fx), 0.5f - std::abs(fy));
    const float line = std::min({std::abs(r - petal), std::abs(corner - 0.2f), std::abs(r - 0.07f)});
    float paint = std::max(Step(0.045f, 0.02f, line), Step(0.075f, 0.055f, r));
    paint = std::max(paint, Step(0.13f, 0.105f, corner) * 0.9f);
    const float edge = std::min(0.5f - std::abs(fx), 0.5f - std::abs(fy)) * tile, joint = Step(0.0028f, 0.0012f, edge);
    const float tone = 0.93f + 0.12f * HashUnit(column, row, 5);
    Vec3f c = Mix(ground, ink, 0.85f * paint) * tone * (1 + 0.03f * soft[i] + 0.012f * grain[i]);
    if (HashUnit(column, row, 9) < 0.012f) c = Vec3f{0.42f, 0.37f, 0.30f};  // one is gone
    m.SetColor(i, Mix(c, Vec3f{0.42f, 0.39f, 0.34f}, joint));
    m.height[i] = -0.0016f * joint + 0.0003f * tone;
    m.roughness[i] = 0.28f + 0.3f * joint + 0.03f * soft[i];
  });
}

// Boards of 18 cm one over the other, with grain, knots and joints of their ends.
void Boards(SurfaceMaps& m) {
  const Field grain = FractalField(m.size, 711, m.Cells(0.6f), m.Cells(0.012f), 4, 0.6f), soft = m.Noise(712, 0.25f, 5, 0.55f);
  const float board = m.tile / 12;
  m.ForEach([&](size_t i, float u, float v) {
    const float y = v * 12, f = y - std::floor(y);
    const auto row = static_cast<uint32_t>(y);
    const float tone = 0.86f + 0.28f * HashUnit(row, 3), end = std::abs(std::fmod(u + HashUnit(row, 7), 1.0f) - 0.5f) * m.tile;
    const float gap = std::max(Step(0.10f, 0.02f, f), Step(0.004f, 0.002f, end));
    const float body = 0.5f * tone * (1 + 0.14f * grain[i] + 0.07f * soft[i]) * (1 - 0.66f * gap);
    m.SetColor(i, Vec3f{1.05f, 1.0f, 0.93f} * body);
    m.height[i] = 0.016f * std::sqrt(std::max(0.0f, 1 - (2 * f - 1) * (2 * f - 1))) * (board / 0.18f) + 0.0007f * grain[i] - 0.006f * gap;
    m.roughness[i] = 0.72f + 0.05f * soft[i];
  });
}

// Small limestone cubes, pale, with waves of dark ones between them.
void Calcada(SurfaceMaps& m) {
  const CellPattern cells(64, 64, 0.55f, 721);
  const Field soft = m.Noise(722, 0.4f, 5, 0.55f), grain = m.Noise(723, 0.01f, 3, 0.7f);
  m.ForEach([&](size_t i, float u, float v) {
    const CellPattern::Cell cell = cells.At(u, v);
    const float wave = v + 0.075f * std::sin(kTauF * u * 2);
    const float band = std::abs(wave * 3 - std::floor(wave * 3) - 0.5f);
    const bool dark = band + 0.02f * (HashUnit(cell.id, 4) - 0.5f) < 0.13f;
    const float tone = 0.84f + 0.3f * HashUnit(cell.id, 5), joint = Step(0.085f, 0.03f, cell.edge);
    const float y = (dark ? 0.17f : 0.62f) * tone * (1 + 0.04f * soft[i] + 0.03f * grain[i]);
    m.SetColor(i, Mix(Vec3f{1.03f, 1, 0.94f} * y, Vec3f{0.20f, 0.185f, 0.16f}, 0.8f * joint));
    m.height[i] = -0.006f * joint + 0.0025f * (tone - 1) + 0.0004f * grain[i];
    m.roughness[i] = 0.42f + 0.25f * joint + 0.05f * soft[i];
  });
}

// Sampietrini: cubes of basalt set in arcs, rounded by centuries.
void Sampietrini(SurfaceMaps& m) {
  const CellPattern cells(22, 22, 0.3f, 731, 0.5f);
  const Field soft = m.Noise(732, 0.5f, 5, 0.55f), grain = m.Noise(733, 0.008f, 3, 0.75f);
  m.ForEach([&](size_t i, float u, float v) {
    // Rows bend in fans.
    const float fan = 0.028f * std::abs(std::sin(kTauF * u));
    const CellPattern::Cell cell = cells.At(u, v + fan);
    const float tone = 0.8f + 0.4f * HashUnit(cell.id, 5), joint = Step(0.14f, 0.05f, cell.edge), head = Step(0.0f, 0.34f, cell.edge);
    const float y = 0.135f * tone * (1 + 0.07f * soft[i] + 0.06f * grain[i]);
    m.SetColor(i, Mix(Vec3f{1.0f, 0.985f, 0.96f} * y, Vec3f{0.115f, 0.10f, 0.08f}, joint));
    m.height[i] = 0.012f * head + 0.004f * (tone - 1) * head + 0.0004f * grain[i];
    m.roughness[i] = 0.5f + 0.25f * joint - 0.06f * head + 0.04f * soft[i];
  });
}

class Painter {
 public:
  Painter(SceneBuilder& builder, Surfaces& surfaces) : builder_(builder), surfaces_(surfaces) {}

  MaterialId Make(const char* name, float tile, float luminance, const std::function<void(SurfaceMaps&)>& paint, int size,
                  float roughness = 0) {
    TextureSet set = SynthesizeTextures({name, tile, luminance, nullptr, paint, roughness, 0}, size);
    Material material;
    material.name = name;
    material.base_color = {1, 1, 1};
    material.roughness = 1;
    material.base_color_texture = builder_.AddTexture(std::move(set.color));
    material.normal_texture = builder_.AddTexture(std::move(set.normal));
    material.metallic_roughness_texture = builder_.AddTexture(std::move(set.roughness));
    material.uv_scale = {1 / tile, 1 / tile};
    material.macro_variation = 0.07f;
    return builder_.AddMaterial(std::move(material));
  }
  /// A copy of a surface in other colours.
  MaterialId Tinted(Surface base, const char* name, Vec3f factor) {
    Material material = builder_.material(surfaces_[base]);
    material.name = name;
    material.base_color = {material.base_color.x * factor.x, material.base_color.y * factor.y, material.base_color.z * factor.z};
    return builder_.AddMaterial(std::move(material));
  }
  MaterialId Of(Surface surface) const { return surfaces_[surface]; }
  void Use(Surface surface, MaterialId material) { surfaces_ = surfaces_.With(surface, material); }
  Material Copy(MaterialId id) const { return builder_.material(id); }
  MaterialId Add(Material material) { return builder_.AddMaterial(std::move(material)); }

 private:
  SceneBuilder& builder_;
  Surfaces& surfaces_;
};

void PaintGround(const TownSpec& spec, Painter& painter) {
  using S = Surface;
  const auto paving = [&](MaterialId id) {
    Material material = painter.Copy(id);
    material.ground = GroundWear::kPaving;
    return painter.Add(std::move(material));
  };
  if (spec.paving == TownPaving::kCalcada) {
    const MaterialId pale = paving(painter.Make("calcada", 3.2f, 0.44f, Calcada, 1024));
    for (S s : {S::kSlabs, S::kSlabsWarm}) painter.Use(s, pale);
    const MaterialId setts = painter.Tinted(S::kPlazaStone, "basalt setts", {0.52f, 0.52f, 0.53f});
    painter.Use(S::kPlazaStone, setts);
    painter.Use(S::kAsphalt, setts);  // of junctions
  }
  if (spec.paving == TownPaving::kCobbles && spec.style != TownStyle::kOchre)
    painter.Use(S::kAsphalt, painter.Tinted(S::kPlazaStone, "setts", {0.9f, 0.88f, 0.85f}));
  if (spec.paving == TownPaving::kCobbles && spec.style == TownStyle::kOchre) {
    const MaterialId stone = paving(painter.Make("sampietrini", 2.4f, 0.13f, Sampietrini, 1024));
    painter.Use(S::kPlazaStone, stone);
    painter.Use(S::kAsphalt, stone);
    painter.Use(S::kSlabs, painter.Tinted(S::kSlabs, "travertine flags", {1.02f, 0.92f, 0.78f}));
  }
  if (spec.paving == TownPaving::kDirt) {
    const MaterialId track = painter.Tinted(S::kPath, "dirt track", {0.86f, 0.70f, 0.52f});
    painter.Use(S::kPath, track);
    // Tracks have no kerbs: their edges are earth.
    for (S s : {S::kPlazaStone, S::kSlabs, S::kAsphalt, S::kAsphaltOld, S::kKerb, S::kGutter}) painter.Use(s, track);
  }
  if (spec.country == TownCountry::kForest) {
    painter.Use(S::kLawn, painter.Of(S::kForestFloor));
    painter.Use(S::kPlain, painter.Tinted(S::kPlain, "far forest", {0.42f, 0.62f, 0.40f}));
  }
  if (spec.country == TownCountry::kDesert) {
    const MaterialId sand = painter.Tinted(S::kPath, "dry ground", {1.15f, 0.92f, 0.66f});
    for (S s : {S::kLawn, S::kPlain, S::kSoil}) painter.Use(s, sand);
  }
}

void PaintWalls(const TownSpec& spec, Painter& painter, MapDress& dress) {
  if (spec.style == TownStyle::kAzulejo) {
    struct Glaze {
      const char* name;
      Vec3f ground, ink;
    };
    constexpr Glaze kGlazes[] = {{"azulejo_blue", {0.70f, 0.72f, 0.72f}, {0.035f, 0.10f, 0.36f}},
                                 {"azulejo_green", {0.66f, 0.69f, 0.58f}, {0.06f, 0.24f, 0.14f}},
                                 {"azulejo_yellow", {0.71f, 0.65f, 0.48f}, {0.50f, 0.28f, 0.035f}},
                                 {"azulejo_white", {0.74f, 0.73f, 0.69f}, {0.30f, 0.36f, 0.48f}}};
    for (const Glaze& glaze : kGlazes) {
      const MaterialId id = painter.Make(
          glaze.name, 1.12f, 0.33f, [&](SurfaceMaps& m) { Azulejo(m, glaze.ground, glaze.ink); }, 512);
      dress.walls[glaze.name] = {FacadeStyle::kStuccoShutters, id, 0.33f};
    }
  }
  if (spec.style == TownStyle::kTimber || spec.style == TownStyle::kSuburban)
    dress.walls["timber"] = {FacadeStyle::kStuccoShutters, painter.Make("boards", 2.16f, 0.4f, Boards, 512), 0.4f};
}

}  // namespace

void PaintTown(const TownSpec& spec, SceneBuilder& builder, Surfaces& surfaces, MapDress& dress) {
  Painter painter(builder, surfaces);
  PaintGround(spec, painter);
  PaintWalls(spec, painter, dress);
}

}  // namespace airsim360::internal
