// Ground around the houses: front gardens with drives, back yards; squares, alleys and parking behind the shops.
#include <algorithm>
#include <cmath>

#include "airsim360/base/random.h"
#include "airsim360/math/angles.h"
#include "airsim360/worlds/sf_city/city.h"

namespace airsim360::internal {
namespace {

constexpr float kTop = 0.03f;

GroundRect Spanning(Vec2f a, Vec2f b) { return {std::min(a.x, b.x), std::min(a.y, b.y), std::max(a.x, b.x), std::max(a.y, b.y)}; }

// Between pavement and front: the drive, the way to the stoop, beds for the rest.
void LayFrontGarden(District& d, const RowHouse& house, RngStream& rng) {
  const BayHouse& h = house.shape;
  const float stoop = BayHouseStoop(h), drive = h.door_right ? (h.width - 2.2f) / 2 : 2.2f + (h.width - 2.2f) / 2;
  const auto strip = [&](float s0, float s1) { return Spanning(house.At(s0, -kSetback), house.At(s1, 0)); };
  d.ground.Begin("drive", "ground/sidewalk", rng.Chance(0.6) ? Surface::kConcrete : Surface::kSlabsWarm);
  d.ground.Rect(strip(drive - 1.45f, drive + 1.45f), 0);
  d.ground.Begin("garden path", "ground/sidewalk", Surface::kSlabsWarm);
  d.ground.Rect(strip(stoop - 0.95f, stoop + 0.95f), 0.002f);
  // Beds fill what is left.
  std::vector<std::pair<float, float>> taken{{drive - 1.45f, drive + 1.45f}, {stoop - 0.95f, stoop + 0.95f}};
  std::sort(taken.begin(), taken.end());
  float from = 0;
  for (const auto& [s0, s1] : {taken[0], taken[1], std::pair{h.width, h.width}}) {
    if (s0 - from > 0.15f) {
      const bool green = rng.Chance(0.5);
      const EntityId bed = d.ground.Begin("front bed", green ? "ground/grass" : "ground/dirt", green ? Surface::kLawn : Surface::kSoil);
      d.ground.Rect(strip(from, s0), 0.04f);
      GrowGrass(d, bed, strip(from, s0).Outline(), 0.04f, green ? 2 : 1.5f);
      for (float s = from + 0.4f; s < s0 - 0.3f; s += static_cast<float>(rng.Uniform(0.6, 1.2))) {
        static constexpr const char* kGreen[] = {"shrub", "plant", "flower_bed", "green_pot", "shrub"};
        const Vec2f p = house.At(s, -static_cast<float>(rng.Uniform(0.5, kSetback - 0.4)));
        d.placer.Try(kGreen[rng.Index(5)], {p.x, p.y, 0.03f}, static_cast<float>(rng.Uniform(0, kTauF)),
                     static_cast<float>(rng.Uniform(0.5, 0.8)));
      }
      if (s0 - from > 1.2f && rng.Chance(0.35))
        PlaceRun(d, "picket_fence", house.At(from + 0.1f, -kSetback + 0.12f), house.At(s0 - 0.1f, -kSetback + 0.12f), 0.0f);
    }
    from = std::max(from, s1);
  }
  // Bins by the garage.
  if (rng.Chance(0.55)) {
    for (uint32_t i = 0; i < 3; ++i) {
      const Vec2f p = house.At(drive + (drive < stoop ? -1.75f : 1.75f) + (drive < stoop ? -0.05f : 0.05f) * static_cast<float>(i),
                               -0.45f - 0.7f * static_cast<float>(i));
      d.placer.Try("wheelie_bin", {p.x, p.y, 0.03f}, FacingYaw(house.inward * -1.0f), 1, {1, 1, 1}, i);
    }
  }
}

void LayBackYard(District& d, const HillYard& yard, size_t index) {
  RngStream rng(d.seed, "hill yard", index);
  const auto uniform = [&](float a, float b) { return static_cast<float>(rng.Uniform(a, b)); };
  const GroundRect plot = yard.rect;
  if (plot.width() < 1 || plot.depth() < 1) return;
  const double pick = rng.Uniform();
  const bool lawn = pick<0.74, terrace = pick> 0.8;
  const EntityId ground = d.ground.Begin(lawn      ? "garden lawn"
                                         : terrace ? "terrace"
                                                   : "yard soil",
                                         lawn      ? "ground/grass"
                                         : terrace ? "ground/sidewalk"
                                                   : "ground/dirt",
                                         lawn      ? Surface::kLawn
                                         : terrace ? Surface::kPlazaBrick
                                                   : Surface::kSoil);
  d.ground.Rect(plot, kTop);
  const Vec2f middle = plot.center();
  const float lane = yard.out > 0 ? plot.y1 : plot.y0, house = yard.out > 0 ? plot.y0 : plot.y1;
  const bool backdrop = d.plan.blocks[yard.block].kind == BlockKind::kBackdrop;
  for (int i = 0; i < (backdrop ? 1 : 2); ++i) {
    const Vec2f p{uniform(plot.x0 + 1.6f, plot.x1 - 1.6f), house + yard.out * uniform(plot.depth() * 0.35f, plot.depth() - 1.5f)};
    const char* kind = rng.Chance(0.55) ? "tree_generic" : rng.Chance(0.6) ? "tree_narrowleaf" : "tree_pine";
    if (rng.Chance(0.62) && d.placer.Try(kind, {p.x, p.y, kTop - 0.05f}, uniform(0, kTauF), uniform(0.5f, 0.8f)) && !backdrop)
      DropLeaves(d, ground, p, 2.2f, 9, kTop);
  }
  if (backdrop) return;
  PlaceRun(d, "wood_fence", {plot.x0 + 0.06f, house + 0.3f * yard.out}, {plot.x0 + 0.06f, lane - 0.1f * yard.out}, 0);
  if (yard.out > 0) PlaceRun(d, "wood_fence", {plot.x0 + 0.2f, lane - 0.05f}, {plot.x1, lane - 0.05f}, 0);
  if (rng.Chance(0.4)) d.placer.Try("bench_wood", {middle.x, house + 1.3f * yard.out, kTop}, FacingYaw({0, yard.out}));
  for (float t = 2; t < plot.depth() - 1.2f; t += uniform(1.0f, 2.2f)) {
    static constexpr const char* kGreen[] = {"shrub", "plant", "green_pot", "shrub", "flower_bed"};
    d.placer.Try(kGreen[rng.Index(5)], {rng.Chance(0.5) ? plot.x0 + 0.75f : plot.x1 - 0.65f, house + t * yard.out, kTop - 0.01f},
                 uniform(0, kTauF), uniform(0.5f, 0.85f));
  }
  if (lawn) GrowGrass(d, ground, plot.Outline(), kTop, 2);
}

// An open lot among the towers: slabs, a fountain, trees in pots, seats, ropes.
void LayPlaza(District& d, const GroundRect& lot, size_t index) {
  RngStream rng(d.seed, "tower plaza", index);
  d.ground.Begin("plaza", "ground/sidewalk", Surface::kPlazaStone);
  d.ground.Rect(lot, 0.012f);
  const Vec2f c = lot.center();
  d.placer.Try("fountain", {c.x, c.y, 0.01f}, 0, 1);
  for (int i = 0; i < 4; ++i) {
    const Vec2f p{i % 2 ? lot.x0 + 5 : lot.x1 - 5, i / 2 ? lot.y0 + 5 : lot.y1 - 5};
    if (d.placer.Try("tree_generic", {p.x, p.y, 0}, static_cast<float>(i), 0.75f, {1, 1, 1}, 2u)) LayTreePit(d.ground, p, 0.012f);
    d.placer.Try("bench_wood", {p.x + (i % 2 ? 2.5f : -2.5f), p.y, 0.012f}, FacingYaw(c - p));
    d.placer.Try("boulevard_lamp", {i % 2 ? lot.x0 + 9 : lot.x1 - 9, i / 2 ? lot.y0 + 3 : lot.y1 - 3, 0.012f});
    d.placer.Try("planter", {i % 2 ? lot.x0 + 2 : lot.x1 - 2, i / 2 ? lot.y0 + 9 : lot.y1 - 9, 0.012f});
  }
  for (float y : {lot.y0 + 1.2f, lot.y1 - 1.2f}) PlaceRun(d, "rope_bollard", {c.x - 5, y}, {c.x + 5, y}, 0.012f);
}

// Grass and trees in the yards of the houses at the ends of the blocks.
void PlantBetweenHouses(District& d) {
  for (size_t i = 0; i < d.plan.blocks.size(); ++i) {
    const Block& block = d.plan.blocks[i];
    if (QuarterOf(block) != Quarter::kHouses) continue;
    const GroundRect inner = block.inner();
    RngStream rng(d.seed, "end yards", i);
    for (const GroundRect& strip : {GroundRect{inner.x0 + kSetback + 16.1f, inner.y0 + 19, inner.x0 + 24, inner.y1 - 19},
                                    GroundRect{inner.x1 - 24, inner.y0 + 19, inner.x1 - kSetback - 16.1f, inner.y1 - 19}}) {
      const EntityId grass = d.ground.Begin("garden lawn", "ground/grass", Surface::kLawn);
      d.ground.Rect(strip, 0.02f);
      for (float y = strip.y0 + 3; y < strip.y1 - 2; y += static_cast<float>(rng.Uniform(6, 11))) {
        const Vec2f p{strip.center().x, y};
        d.placer.Try(rng.Chance(0.7) ? "tree_generic" : "tree_pine", {p.x, p.y, 0}, static_cast<float>(rng.Uniform(0, kTauF)),
                     static_cast<float>(rng.Uniform(0.5, 0.7)));
      }
      if (block.kind == BlockKind::kBuilt) GrowGrass(d, grass, strip.Outline(), 0.02f, 2);
    }
  }
}

}  // namespace

void LaySfYards(District& d, const SfPlan& city) {
  // Soil under everything shows between the lots.
  for (const Block& block : d.plan.blocks) {
    if (QuarterOf(block) != Quarter::kHouses) continue;
    d.ground.Begin("ground between houses", "ground/dirt", Surface::kSoil);
    d.ground.Rect(block.inner(), -0.03f);
  }
  PlantBetweenHouses(d);
  for (size_t i = 0; i < city.houses.size(); ++i) {
    const RowHouse& house = city.houses[i];
    RngStream rng(d.seed, "front garden", i);
    if (!house.shape.flat) LayFrontGarden(d, house, rng);
  }
  for (size_t i = 0; i < city.yards.size(); ++i) LayBackYard(d, city.yards[i], i);
  // The strip before far houses in one piece a block.
  for (const Block& block : d.plan.blocks) {
    if (block.kind != BlockKind::kBackdrop || QuarterOf(block) != Quarter::kHouses) continue;
    const GroundRect inner = block.inner();
    d.ground.Begin("far gardens", "ground/sidewalk", Surface::kSlabsWarm);
    for (float y : {inner.y0, inner.y1 - kSetback}) d.ground.Rect({inner.x0, y, inner.x1, y + kSetback}, 0);
    for (float x : {inner.x0, inner.x1 - kSetback}) d.ground.Rect({x, inner.y0 + kSetback, x + kSetback, inner.y1 - kSetback}, 0);
  }
}

void LayOpenGround(District& d, const SfPlan& city) {
  for (size_t i = 0; i < d.plan.blocks.size(); ++i) {
    const Block& block = d.plan.blocks[i];
    const Quarter quarter = QuarterOf(block);
    if (quarter != Quarter::kShops && quarter != Quarter::kTowers) continue;
    const GroundRect inner = block.inner();
    d.ground.Begin(quarter == Quarter::kShops ? "yard" : "alley", "ground/sidewalk",
                   quarter == Quarter::kShops ? Surface::kAsphaltOld : Surface::kSlabs);
    d.ground.Rect(inner, 0);
    if (block.kind != BlockKind::kBuilt || quarter != Quarter::kShops) continue;
    RngStream rng(d.seed, "shop yard", i);
    const float middle = inner.center().y;
    for (float x = inner.x0 + 6; x < inner.x1 - 6; x += 3.0f) {
      if (rng.Chance(0.6))
        d.placer.Try(rng.Chance(0.8) ? "car" : "van", {x, middle + (rng.Chance(0.5) ? 3.2f : -3.2f), 0},
                     FacingYaw({0, rng.Chance(0.5) ? 1.0f : -1.0f}));
      if (rng.Chance(0.2)) d.placer.Try("wheelie_bin", {x, middle + 7.0f, 0}, 0);
    }
    for (int k = 0; k < 6; ++k) {
      const Vec2f p{static_cast<float>(rng.Uniform(inner.x0 + 8, inner.x1 - 8)), middle};
      if (d.placer.Try("tree_generic", {p.x, p.y, 0}, static_cast<float>(k), 0.7f)) LayTreePit(d.ground, p);
    }
  }
  for (size_t i = 0; i < city.plazas.size(); ++i) LayPlaza(d, city.plazas[i], i);
}

}  // namespace airsim360::internal
