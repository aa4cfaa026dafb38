// Ground inside the blocks: yards, the plaza, the building site; medians of the boulevards.
#include <cmath>

#include "airsim360/base/random.h"
#include "airsim360/math/angles.h"
#include "airsim360/worlds/new_york_city/city.h"

namespace airsim360::internal {
namespace {

void LayYards(District& d, const Block& block, size_t index) {
  // Slabs under the fronts: rounded corners and recessed doors leave some of them open.
  const GroundRect whole = block.inner(), inner = whole.Inset(6);
  d.ground.Begin("forecourts", "ground/sidewalk", Surface::kSlabs);
  for (const GroundRect& strip : {GroundRect{whole.x0, whole.y0, whole.x1, inner.y0}, GroundRect{whole.x0, inner.y1, whole.x1, whole.y1},
                                  GroundRect{whole.x0, inner.y0, inner.x0, inner.y1}, GroundRect{inner.x1, inner.y0, whole.x1, inner.y1}})
    d.ground.Rect(strip, 0);
  RngStream rng(d.seed, "yards", index);
  // Under the houses and behind them: squares of dirt or old asphalt by turns, entities of their own.
  constexpr int kPieces = 4;
  for (int i = 0; i < kPieces; ++i) {
    const float w = inner.width() / kPieces, x = inner.x0 + w * static_cast<float>(i);
    const bool dirt = i % 2 == 0;
    d.ground.Begin(dirt ? "yard soil" : "yard", dirt ? "ground/dirt" : "ground/sidewalk", dirt ? Surface::kDirt : Surface::kAsphaltOld);
    d.ground.Rect({x, inner.y0, x + w, inner.y1}, 0);
  }
  if (block.kind == BlockKind::kBackdrop) return;
  const float y = inner.center().y;
  for (float x = whole.x0 + 30; x < whole.x1 - 30; x += 5.5f) {
    const double pick = rng.Uniform();
    if (pick < 0.28) {
      const float at = y + static_cast<float>(rng.Uniform(-0.6, 0.6));
      d.placer.Try("tree_narrowleaf", {x, at, -0.02f}, static_cast<float>(rng.Uniform(0, kTauF)), 0.72f, {1, 1, 1}, rng.Index(3));
    } else if (pick < 0.36) {
      d.placer.Try("plant", {x, y + static_cast<float>(rng.Uniform(-1.8, 1.8)), 0}, static_cast<float>(rng.Uniform(0, kTauF)), 1.2f);
    } else if (pick < 0.5) {
      d.placer.Try("trash_can", {x, y + 1.9f, 0});
    } else if (pick < 0.65) {
      d.placer.Try("green_pot", {x, y - 1.5f, 0});
    }
  }
}

void PlaceCafeSet(District& d, Vec2f at, float z, int umbrella, Vec3f cloth) {
  RngStream& rng = d.placer.rng();
  const auto style = static_cast<uint32_t>(rng.Index(4));
  if (!d.placer.Try("street_table", {at.x, at.y, z}, 0, 1, {1, 1, 1}, style)) return;
  if (umbrella > 0) {
    PlaceNamed(d, umbrella == 2 ? "yellow sunshade" : "umbrella", "umbrella", {at.x, at.y, z}, 0, 0, 1, cloth);
  }
  const auto turn = static_cast<float>(rng.Uniform(0, kTauF));
  for (int i = 0; i < 3; ++i) {
    const float a = turn + kTauF * static_cast<float>(i) / 3;
    const Vec2f p{at.x + 0.9f * std::cos(a), at.y + 0.9f * std::sin(a)};
    d.placer.Put("dining_chair", {p.x, p.y, z}, FacingYaw(at - p), 1, {1, 1, 1}, style);
  }
}

void BuildPocketPlaza(District& d, const Lot& lot) {
  const GroundRect& r = lot.rect;
  d.ground.Begin("plaza", "ground/sidewalk", Surface::kPlazaStone);
  d.ground.Rect(r, 0.006f);
  const Vec2f c = r.center();
  PlaceNamed(d, "small fountain", "fountain", {c.x, c.y - 2, 0.006f}, 0, 0, 0.8f);
  d.placer.Reserve({{c.x, c.y - 2}, {2.4f, 2.4f}, 0});
  // Umbrellas of three colours; exactly one of them is yellow.
  int n = 0;
  for (float y = c.y + 3.6f; y < r.y1 - 1.5f; y += 3.2f) {
    for (float x = r.x0 + 2.2f; x < r.x1 - 1.5f; x += 3.2f, ++n)
      PlaceCafeSet(d, {x, y}, 0.006f, n == 4 ? 2 : 1,
                   n == 4  ? Vec3f{1.15f, 0.75f, 0.02f}
                   : n % 2 ? Vec3f{0.10f, 0.28f, 0.14f}
                           : Vec3f{0.62f, 0.05f, 0.04f});
  }
  for (float x = r.x0 + 1; x < r.x1; x += 2.9f) d.placer.Try("green_pot", {x, r.y0 + 1.1f, 0.006f});
  for (float s : {-1.0f, 1.0f}) {
    d.placer.Try("bench_wood", {c.x + 4.6f * s, c.y - 2, 0.006f}, FacingYaw({-s, 0}));
    for (float y : {c.y - 6.0f, c.y + 1.2f}) {
      const Vec2f at{c.x + 4.4f * s, y};
      LayTreePit(d.ground, at, 0.006f);
      d.placer.Try("tree_narrowleaf", {at.x, at.y, 0.006f}, y, 0.75f, {1, 1, 1}, 1u);
    }
  }
}

void BuildSite(District& d, const Lot& lot) {
  const GroundRect& r = lot.rect;
  RngStream rng(d.seed, "site");
  d.ground.Begin("building site", "ground/dirt", Surface::kDirt);
  d.ground.Rect(r, 0.01f);
  const bool north = lot.row == 1;
  const float street = north ? r.y1 - 0.2f : r.y0 + 0.2f, way = north ? -1.0f : 1.0f;
  PlaceRun(d, "metal_fence", {r.x0 + 0.2f, street}, {r.x1 - 0.2f, street}, 0);
  const auto at = [&](float x, float y) { return Vec3f{r.x0 + x, street + way * y, 0.01f}; };
  // Rows of blocks, cones around a pit, stacks, a container-like heap of pallets, scaffold against the
  // neighbour.
  for (int i = 0; i < 4; ++i) d.placer.Try("concrete_block", at(2.2f + 2.6f * static_cast<float>(i), 3), 0, 1, {1, 1, 1}, 2u);
  for (int i = 0; i < 10; ++i) {
    const float a = kTauF * static_cast<float>(i) / 10;
    d.placer.Try("traffic_cone", at(r.width() / 2 + 3.2f * std::cos(a), 11 + 3.2f * std::sin(a)));
  }
  d.ground.Begin("pit", "ground/dirt", Surface::kSoil);
  d.ground.RingSector({r.center().x, street + way * 11}, 0, 2.6f, 0, kTauF, 0.018f, 24);
  for (float x = 1.4f; x < r.width() - 1.4f; x += 2.4f) d.placer.Try("scaffold", at(x, r.depth() - 3.2f), north ? kTauF / 2 : 0.0f);
  for (int i = 0; i < 14; ++i)
    d.placer.Try(i % 3 == 0   ? "plant"
                 : i % 3 == 1 ? "rock"
                              : "traffic_cone",
                 at(static_cast<float>(rng.Uniform(1, r.width() - 1)), static_cast<float>(rng.Uniform(4, r.depth() - 5))),
                 static_cast<float>(rng.Uniform(0, kTauF)), 0.9f);
}

// An island with round ends, kerbed, planted with grass and small trees.
void LayMedian(District& d, const StreetStretch& street, uint64_t id) {
  constexpr float kHalf = 1.9f, kTop = 0.27f;
  RngStream rng(d.seed, "median", id);
  const float s0 = street.s0 + 6.5f, s1 = street.s1 - 6.5f;
  const auto outline = [&](float inset) {
    std::vector<Vec2f> line;
    const float r = kHalf - inset;
    for (int end = 0; end < 2; ++end) {
      for (int i = 0; i <= 10; ++i) {
        const float a = kTauF * (0.5f * static_cast<float>(i) / 10 - 0.25f) + (end ? kTauF / 2 : 0);
        const float s = (end ? s0 + kHalf : s1 - kHalf) + r * std::cos(a), across = r * std::sin(a);
        const Vec3f p = street.At(s, across);
        line.push_back({p.x, p.y});
      }
    }
    return line;
  };
  const std::vector<Vec2f> outer = outline(0), inner = outline(0.18f);
  d.ground.Begin("median kerb", "ground/kerb", Surface::kKerb);
  d.ground.mesh().Walls(outer, -0.2f, kTop);
  for (size_t i = 0; i < outer.size(); ++i) {
    const size_t k = (i + 1) % outer.size();
    d.ground.Quad({outer[i].x, outer[i].y, kTop}, {outer[k].x, outer[k].y, kTop}, {inner[k].x, inner[k].y, kTop},
                  {inner[i].x, inner[i].y, kTop});
  }
  const EntityId lawn = d.ground.Begin("median lawn", "ground/grass", Surface::kLawn);
  d.ground.Polygon(inner, kTop);
  GrowGrass(d, lawn, inner, kTop, 2);
  for (float s = s0 + 5; s < s1 - 4; s += 8.5f) {
    const Vec3f p = street.At(s, 0);
    if (rng.Chance(0.55)) {
      d.placer.Try("tree_generic", {p.x, p.y, kTop - 0.02f}, static_cast<float>(rng.Uniform(0, kTauF)), 0.62f, {1, 1, 1}, 3u);
    } else {
      d.placer.Try("shrub", {p.x, p.y, kTop - 0.03f}, static_cast<float>(rng.Uniform(0, kTauF)), 0.7f);
    }
    const Vec3f q = street.At(s + 4, 0);
    if (rng.Chance(0.5)) d.placer.Try("flower_bed", {q.x, q.y, kTop}, 0, 0.9f);
  }
  d.placer.Reserve({{street.At((s0 + s1) / 2, 0).x, street.At((s0 + s1) / 2, 0).y},
                    street.along_x ? Vec2f{(s1 - s0) / 2, kHalf} : Vec2f{kHalf, (s1 - s0) / 2},
                    0});
}

}  // namespace

void LayMedians(District& d, const std::vector<StreetStretch>& streets) {
  for (size_t i = 0; i < streets.size(); ++i)
    if (streets[i].line.kind == StreetKind::kBoulevard) LayMedian(d, streets[i], i);
}

void BuildOpenLots(District& d, const Manhattan& city) {
  for (size_t i = 0; i < d.plan.blocks.size(); ++i)
    if (d.plan.blocks[i].kind != BlockKind::kPark) LayYards(d, d.plan.blocks[i], i);
  for (const Lot& lot : city.lots) {
    if (lot.use == LotUse::kPlaza) BuildPocketPlaza(d, lot);
    if (lot.use == LotUse::kDirt) BuildSite(d, lot);
    if (lot.role == "deco corner") {
      // Its round corner leaves a piece of pavement.
      d.ground.Begin("round corner", "ground/sidewalk", Surface::kSlabs);
      d.ground.Rect({lot.rect.x0, lot.rect.y0, lot.rect.x0 + 4, lot.rect.y0 + 4}, 0.004f);
    }
  }
}

}  // namespace airsim360::internal
