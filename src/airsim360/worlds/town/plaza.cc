#include <cmath>

#include "airsim360/base/random.h"
#include "airsim360/math/angles.h"
#include "airsim360/worlds/town/district.h"
#include "airsim360/worlds/town/market_stall.h"
#include "airsim360/worlds/town/street_wear.h"

namespace airsim360::internal {
namespace {

constexpr float kTerraceZ = 0.6f;

constexpr int kCells = 9;  // brick fields along each side

// Brick fields in stone bands; rings of setts around the fountain, a few millimetres proud. Entities of the fields, row by row.
std::vector<EntityId> LayPaving(Ground& ground, const GroundRect& area, RngStream& rng) {
  std::vector<EntityId> fields;
  const float w = area.width() / kCells, h = area.depth() / kCells, band = 0.3f;
  for (int j = 0; j < kCells; ++j) {
    for (int i = 0; i < kCells; ++i) {
      const GroundRect cell{area.x0 + w * static_cast<float>(i), area.y0 + h * static_cast<float>(j),
                            area.x0 + w * static_cast<float>(i + 1), area.y0 + h * static_cast<float>(j + 1)};
      const GroundRect field = cell.Inset(band);
      const Surface brick = (i + j) % 2 ? Surface::kPlazaBrickDark : Surface::kPlazaBrick;
      fields.push_back(ground.Begin("plaza field", "ground/pavement/modular", brick));
      ground.Rect(field, 0);
      LayPavementWear(
          ground,
          [&](float s, float d, float lift) {
            return Vec3f{field.x0 + s, field.y0 + d, lift};
          },
          0, field.width(), 0, field.depth(), brick, rng);
      ground.Use(Surface::kPlazaStone);
      ground.Rect({cell.x0, cell.y0, cell.x1, field.y0}, 0);
      ground.Rect({cell.x0, field.y1, cell.x1, cell.y1}, 0);
      ground.Rect({cell.x0, field.y0, field.x0, field.y1}, 0);
      ground.Rect({field.x1, field.y0, cell.x1, field.y1}, 0);
    }
  }
  struct RingRow {
    float r0, r1;
    Surface surface;
  };
  constexpr RingRow kRings[] = {{0, 6, Surface::kPlazaStone},
                                {6, 9, Surface::kPlazaBrickDark},
                                {9, 9.6f, Surface::kPlazaStone},
                                {9.6f, 13, Surface::kPlazaBrick},
                                {13, 14, Surface::kPlazaStone}};
  for (const RingRow& ring : kRings) {
    ground.Begin("plaza ring", "ground/pavement/modular", ring.surface);
    ground.RingSector(area.center(), ring.r0, ring.r1, 0, kTauF, 0.005f, 72);
  }
  return fields;
}

// A raised terrace with stone walls and a flight of four steps to the south.
void LayTerrace(Ground& ground, const GroundRect& terrace, float steps_half) {
  const float cx = terrace.center().x;
  const int fields = 6;
  for (int i = 0; i < fields; ++i) {
    const float w = terrace.width() / fields, x = terrace.x0 + w * static_cast<float>(i);
    ground.Begin("terrace field", "ground/pavement/modular", Surface::kSlabsWarm);
    ground.Rect({x, terrace.y0, x + w, terrace.y1}, kTerraceZ);
  }
  ground.Begin("terrace wall", "construction/wall", Surface::kLimestone);
  ground.mesh().Walls(terrace.Outline(), 0, kTerraceZ - 0.08f);
  // Coping as a proud band.
  ground.Use(Surface::kTrimStone);
  const GroundRect lip = terrace.Inset(-0.06f);
  ground.mesh().Walls(lip.Outline(), kTerraceZ - 0.08f, kTerraceZ + 0.005f);
  ground.Rect({lip.x0, lip.y0, lip.x1, lip.y0 + 0.4f}, kTerraceZ + 0.005f);
  ground.Rect({lip.x0, lip.y1 - 0.4f, lip.x1, lip.y1}, kTerraceZ + 0.005f);
  ground.Rect({lip.x0, lip.y0 + 0.4f, lip.x0 + 0.4f, lip.y1 - 0.4f}, kTerraceZ + 0.005f);
  ground.Rect({lip.x1 - 0.4f, lip.y0 + 0.4f, lip.x1, lip.y1 - 0.4f}, kTerraceZ + 0.005f);
  ground.Begin("terrace steps", "construction/stairs", Surface::kTrimStone);
  for (int i = 0; i < 3; ++i) {
    const float z = 0.15f * static_cast<float>(3 - i), y0 = terrace.y0 - 0.06f - 0.36f * static_cast<float>(i + 1);
    ground.mesh().Box({cx - steps_half, y0, 0}, {cx + steps_half, y0 + 0.36f, z},
                      MeshBuilder::kFront | MeshBuilder::kTop | MeshBuilder::kLeft | MeshBuilder::kRight);
  }
}

// A table with an umbrella and chairs around it.
void PlaceCafeTable(District& d, Vec2f at, float z, bool yellow) {
  RngStream& rng = d.placer.rng();
  const auto style = static_cast<uint32_t>(rng.Index(4));
  const auto turn = static_cast<float>(rng.Uniform(0, kTauF));
  if (!d.placer.Try("dining_table", {at.x, at.y, z}, turn, 1, {1, 1, 1}, style)) return;
  const auto cloth = static_cast<uint32_t>(rng.Index(2));
  if (yellow)
    PlaceNamed(d, "yellow sunshade", "umbrella", {at.x, at.y, z}, turn, 0, 1, {1.15f, 0.75f, 0.02f});
  else
    d.placer.Put("umbrella", {at.x, at.y, z}, turn, 1, {1, 1, 1}, cloth);
  const int chairs = 3 + static_cast<int>(rng.Index(2));
  for (int i = 0; i < chairs; ++i) {
    const float a = turn + kTauF * static_cast<float>(i) / static_cast<float>(chairs);
    const Vec2f p = Polar(at, 0.95f, a);
    d.placer.Put("dining_chair", {p.x, p.y, z}, FacingYaw(at - p) + static_cast<float>(rng.Uniform(-0.3, 0.3)), 1, {1, 1, 1}, style);
  }
}

void FurnishTerrace(District& d, const GroundRect& t, float steps_half) {
  const float z = kTerraceZ + 0.005f, in = 0.2f, cx = t.center().x;
  PlaceRun(d, "rail", {t.x0 + in, t.y0 + in}, {cx - steps_half, t.y0 + in}, z, "rail_pillar");
  PlaceRun(d, "rail", {cx + steps_half, t.y0 + in}, {t.x1 - in, t.y0 + in}, z, "rail_pillar");
  PlaceRun(d, "rail", {t.x1 - in, t.y0 + in + 2}, {t.x1 - in, t.y1 - in}, z, "rail_pillar");
  PlaceRun(d, "rail", {t.x1 - in - 2, t.y1 - in}, {t.x0 + in + 2, t.y1 - in}, z, "rail_pillar");
  PlaceRun(d, "rail", {t.x0 + in, t.y1 - in}, {t.x0 + in, t.y0 + in + 2}, z, "rail_pillar");
  int table = 0;
  for (float y : {t.y0 + 3.2f, t.y0 + 7.6f}) {
    for (float x = t.x0 + 3.5f; x < t.x1 - 3; x += 4.6f) PlaceCafeTable(d, {x, y}, kTerraceZ, table++ == 3);
  }
  for (float x = t.x0 + 1.2f; x < t.x1 - 1; x += 3.1f) d.placer.Try("pot", {x, t.y1 - 0.9f, kTerraceZ});
  for (float x : {cx - steps_half - 0.9f, cx + steps_half + 0.9f}) d.placer.Try("planter", {x, t.y0 + 1.3f, kTerraceZ});
}

// Two rows of stalls back to back with the lane between them: tarp on four posts over a counter of goods.
void BuildMarket(District& d, Vec2f c) {
  constexpr uint32_t kKinds = 4;
  MeshId counters[kKinds];
  for (uint32_t i = 0; i < kKinds; ++i) counters[i] = AddStallMesh(d.builder, d.surfaces, i);
  const float y_rows[] = {c.y - 26.5f, c.y - 33.5f};
  for (int row = 0; row < 2; ++row) {
    for (int i = -5; i <= 5; ++i) {
      const Vec2f at{c.x + 4.3f * static_cast<float>(i), y_rows[row]};
      // Fronts look at the lane.
      const float lane = row == 0 ? -1.0f : 1.0f, yaw = FacingYaw({0, lane});
      d.placer.Put("tarp", {at.x, at.y, 0}, yaw);
      for (int corner = 0; corner < 4; ++corner) {
        const float x = corner & 1 ? 1.5f : -1.5f, y = corner & 2 ? 1.5f : -1.5f;
        d.placer.Put("tarp_post", {at.x + x, at.y + y, 0}, yaw, 1, {1, 1, 1}, static_cast<uint32_t>(row));
      }
      const EntityId stall = d.builder.AddEntity("market stall", d.builder.tree().At("furniture/vending/food_stall"));
      const auto kind = static_cast<uint32_t>(i + 6 + 3 * row) % kKinds;
      d.builder.AddInstance({counters[kind], PlaceUpright({at.x, at.y + 0.75f * lane, 0}, yaw), stall});
      if (i % 2 == 0) d.placer.Put("pot", {at.x - 1.0f, at.y - 1.0f * lane, 0});
      if (i % 3 == 0) d.placer.Put("dining_chair", {at.x + 0.4f, at.y - 0.5f * lane, 0}, FacingYaw({0, lane}));
      if (i % 2 != 0) d.placer.Put("recycle_bin", {at.x + 2.15f, at.y - 0.9f * lane, 0}, yaw);
    }
  }
}

// A stone-edged bed of soil with shrubs, flowers and a tree.
void BuildBed(District& d, Vec2f at, float half) {
  const GroundRect outer{at.x - half, at.y - half, at.x + half, at.y + half}, inner = outer.Inset(0.4f);
  d.ground.Begin("bed wall", "construction/wall", Surface::kLimestone);
  d.ground.mesh().Walls(outer.Outline(), 0, 0.45f);
  std::vector<Vec2f> back = inner.Outline();
  std::swap(back[1], back[3]);
  d.ground.mesh().Walls(back, 0.35f, 0.45f);
  d.ground.Use(Surface::kTrimStone);
  for (const GroundRect& r : {GroundRect{outer.x0, outer.y0, outer.x1, inner.y0}, GroundRect{outer.x0, inner.y1, outer.x1, outer.y1},
                              GroundRect{outer.x0, inner.y0, inner.x0, inner.y1}, GroundRect{inner.x1, inner.y0, outer.x1, inner.y1}}) {
    d.ground.Rect(r, 0.45f);
  }
  const EntityId soil = d.ground.Begin("bed", "ground/terrain/landscape", Surface::kSoil);
  d.ground.Rect(inner, 0.38f);
  d.placer.Try("tree_generic", {at.x, at.y, 0.36f}, static_cast<float>(d.placer.rng().Uniform(0, kTauF)), 0.85f);
  RngStream& rng = d.placer.rng();
  // Flowers and shrubs first, then whatever fits between.
  for (int i = 0; i < 44; ++i) {
    const Vec2f p{static_cast<float>(rng.Uniform(inner.x0 + 0.5, inner.x1 - 0.5)),
                  static_cast<float>(rng.Uniform(inner.y0 + 0.5, inner.y1 - 0.5))};
    const char* kind = i < 10 ? "flower_bed" : i < 18 ? "shrub" : i < 20 ? "rock" : i % 3 == 0 ? "fern" : "plant";
    d.placer.Try(kind, {p.x, p.y, 0.37f}, static_cast<float>(rng.Uniform(0, kTauF)), i < 18 ? 0.7f : i < 20 ? 0.35f : 0.8f);
  }
  GrowGrass(d, soil, inner.Outline(), 0.38f, 1.9f);
}

void PlantAllees(District& d, Vec2f c) {
  for (float x : {-38.5f, -29.5f, 29.5f, 38.5f}) {
    for (int i = 0; i < 8; ++i) {
      const Vec2f at{c.x + x, c.y - 37 + 8.2f * static_cast<float>(i)};
      LayTreePit(d.ground, at);
      const bool outer = std::abs(x) > 35;
      d.placer.Try(outer ? "tree_generic" : "tree_narrowleaf", {at.x, at.y, 0}, static_cast<float>(d.placer.rng().Uniform(0, kTauF)), 0.9f);
      if (i == 7) continue;
      // Between the trees: lamps and benches by turns, on the inner side bins too.
      const Vec2f gap{at.x, at.y + 4.1f};
      if (i % 2 == 0) {
        d.placer.Try("lamp_post", {gap.x, gap.y, 0});
      } else {
        d.placer.Try("bench_wood", {gap.x, gap.y, 0}, FacingYaw({x < 0 ? (outer ? 1.0f : -1.0f) : (outer ? -1.0f : 1.0f), 0}));
        d.placer.Try(outer ? "recycle_bin" : "trash_can", {gap.x, gap.y + 1.7f, 0}, FacingYaw({x < 0 ? 1.0f : -1.0f, 0}));
      }
    }
  }
}

void FurnishEdges(District& d, const GroundRect& area) {
  // Bollards keep cars off; gaps towards the crossings.
  const GroundRect line = area.Inset(0.35f);
  const auto row = [&](Vec2f a, Vec2f b) {
    const int n = static_cast<int>(std::hypot(b.x - a.x, b.y - a.y) / 2.3f);
    for (int i = 0; i <= n; ++i) {
      const Vec2f p = a + (b - a) * (static_cast<float>(i) / static_cast<float>(n));
      d.placer.Try("car_pillar", {p.x, p.y, 0}, 0, 1, {1, 1, 1}, 1u);
    }
  };
  row({line.x0, line.y0}, {line.x1, line.y0});
  row({line.x1, line.y0 + 2.3f}, {line.x1, line.y1});
  row({line.x1 - 2.3f, line.y1}, {line.x0, line.y1});
  row({line.x0, line.y1 - 2.3f}, {line.x0, line.y0 + 2.3f});
  const Vec2f c = area.center();
  for (float s : {-1.0f, 1.0f}) {
    d.placer.Try("poster_stand", {c.x + s * 20, c.y - 41, 0}, 0.3f * s);
    d.placer.Try("poster_stand", {c.x + s * 24, c.y + 20, 0}, s * 1.2f);
    d.placer.Try("poster_stand", {c.x + s * 7, c.y - 20.5f, 0}, s * 0.2f);
    d.placer.Try("food_cart", {c.x + s * 23.5f, c.y - 8, 0}, FacingYaw({-s, 0}));
    d.placer.Try("food_cart", {c.x + s * 22.5f, c.y + 8, 0}, FacingYaw({-s, 0.2f}));
    d.placer.Try("food_cart", {c.x + s * 9, c.y - 38.8f, 0}, FacingYaw({0, 1}));
    for (int i = 0; i < 6; ++i) d.placer.Try("bicycle", {c.x + s * (33 + 0.75f * static_cast<float>(i)), c.y + 28.5f, 0}, 0.12f);
  }
}

// Leaves lie under every tree of the plaza, most of them near the trunk, and belong to the field that they lie on.
void LitterPlaza(District& d, const GroundRect& area, const std::vector<EntityId>& fields) {
  RngStream rng(d.seed, "plaza litter");
  for (const Placement& tree : d.placer.placements()) {
    if (!tree.kind.starts_with("tree_") || !area.Contains({tree.p_W.x, tree.p_W.y}) || tree.p_W.z > 0.1f) continue;
    for (int i = 0; i < 9; ++i) {
      const float u = static_cast<float>(rng.Uniform());
      const Vec2f p = Polar({tree.p_W.x, tree.p_W.y}, 0.4f + 4.2f * u * std::sqrt(u), static_cast<float>(rng.Uniform(0, kTauF)));
      if (!area.Inset(0.2f).Contains(p)) continue;
      const auto cell = [&](float at, float from, float size) { return static_cast<size_t>((at - from) / size * kCells); };
      const size_t field = cell(p.y, area.y0, area.depth()) * kCells + cell(p.x, area.x0, area.width());
      d.placer.shelf().PlaceAs(fields[field], "leaf_litter", PlaceUpright({p.x, p.y, 0.006f}, static_cast<float>(rng.Uniform(0, kTauF))),
                               rng.Index(16));
    }
  }
}

}  // namespace

void BuildPlaza(District& d, const Block& block) {
  const GroundRect area = block.inner();
  const Vec2f c = area.center();
  const GroundRect terrace{c.x - 25.2f, c.y + 27, c.x + 25.2f, c.y + 38};
  constexpr float kStepsHalf = 5;
  RngStream wear(d.seed, "plaza wear");
  const std::vector<EntityId> fields = LayPaving(d.ground, area, wear);
  LayTerrace(d.ground, terrace, kStepsHalf);
  d.placer.Reserve({{c.x, terrace.y0 - 0.6f}, {kStepsHalf, 0.7f}, 0});

  // The fountain, a ring of benches that look at it and of lamps with globes.
  d.placer.Try("fountain", {c.x, c.y, 0.004f}, 0, 1.5f);
  for (int i = 0; i < 12; ++i) {
    const float a = kTauF * (static_cast<float>(i) + 0.5f) / 12;
    const Vec2f p = Polar(c, 12.2f, a);
    d.placer.Try("bench_wood", {p.x, p.y, 0.005f}, FacingYaw(c - p), 1, {1, 1, 1}, 0u);
  }
  for (int i = 0; i < 8; ++i) {
    const Vec2f p = Polar(c, 15.2f, kTauF * static_cast<float>(i) / 8);
    d.placer.Try("lamp_post", {p.x, p.y, 0}, FacingYaw(c - p), 1, {1, 1, 1}, 0u);
  }
  // An inner grove: trees between the lamps, further out.
  for (int i = 0; i < 12; ++i) {
    const Vec2f p = Polar(c, 20.5f, kTauF * (static_cast<float>(i) + 0.5f) / 12);
    if (std::abs(p.x - c.x) < 6 || (std::abs(std::abs(p.x - c.x) - 17.5f) < 4 && std::abs(std::abs(p.y - c.y) - 14.7f) < 5)) continue;
    LayTreePit(d.ground, p);
    d.placer.Try("tree_generic", {p.x, p.y, 0}, static_cast<float>(d.placer.rng().Uniform(0, kTauF)), 0.75f);
  }
  for (Vec2f offset : {Vec2f{25, 0}, Vec2f{24.5f, 20.5f}, Vec2f{11, -19.5f}}) {
    for (float side : {-1.0f, 1.0f}) {
      const Vec2f p{c.x + side * offset.x, c.y + offset.y};
      LayTreePit(d.ground, p);
      d.placer.Try("tree_generic", {p.x, p.y, 0}, static_cast<float>(d.placer.rng().Uniform(0, kTauF)), 0.8f);
    }
  }
  FurnishTerrace(d, terrace, kStepsHalf);
  BuildMarket(d, c);
  for (float x : {-17.5f, 17.5f}) {
    for (float y : {-13.5f, 16.0f}) BuildBed(d, {c.x + x, c.y + y}, 2.6f);
  }
  PlantAllees(d, c);
  FurnishEdges(d, area);
  LitterPlaza(d, area, fields);
}

}  // namespace airsim360::internal
