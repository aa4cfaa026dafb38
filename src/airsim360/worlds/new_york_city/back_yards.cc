// Gardens, terraces and bare soil behind the houses of new_york_city.
#include <algorithm>
#include <cmath>

#include "airsim360/base/random.h"
#include "airsim360/math/angles.h"
#include "airsim360/worlds/new_york_city/city.h"

namespace airsim360::internal {
namespace {

constexpr float kTop = 0.03f;

enum class YardKind { kLawn, kTerrace, kSoil };

EntityId LayYardGround(District& d, const GroundRect& plot, YardKind kind, RngStream& rng) {
  const bool lawn = kind == YardKind::kLawn, terrace = kind == YardKind::kTerrace;
  const Surface surface = lawn ? Surface::kLawn : !terrace ? Surface::kDirt : rng.Chance(0.5) ? Surface::kSlabsWarm : Surface::kPlazaBrick;
  const EntityId entity = d.ground.Begin(lawn      ? "garden lawn"
                                         : terrace ? "terrace"
                                                   : "yard soil",
                                         lawn      ? "ground/grass"
                                         : terrace ? "ground/sidewalk"
                                                   : "ground/dirt",
                                         surface);
  d.ground.Rect(plot, kTop);
  d.ground.Use(Surface::kKerb);
  d.ground.mesh().Walls(plot.Outline(), 0, kTop);
  return entity;
}

// A tree if none stands near, as the gardens of downtown_west.
void PlantYardTree(District& d, Vec2f p, EntityId ground, RngStream& rng) {
  const auto& others = d.placer.placements();
  const bool crowded = std::any_of(others.begin(), others.end(), [&](const Placement& other) {
    return other.kind.starts_with("tree") && std::hypot(other.p_W.x - p.x, other.p_W.y - p.y) < 7.9f;
  });
  const char* kind = rng.Chance(0.6) ? "tree_generic" : "tree_narrowleaf";
  const auto turn = static_cast<float>(rng.Uniform(0, kTauF)), scale = static_cast<float>(rng.Uniform(0.55, 0.75));
  if (!crowded && d.placer.Try(kind, {p.x, p.y, kTop - 0.02f}, turn, scale)) DropLeaves(d, ground, p, 2.2f, 5, kTop);
}

}  // namespace

void LayBackYards(District& d, const Manhattan& city) {
  for (size_t i = 0; i < city.yards.size(); ++i) {
    const BackYard& yard = city.yards[i];
    RngStream rng(d.seed, "back yard", i);
    const auto uniform = [&](float a, float b) { return static_cast<float>(rng.Uniform(a, b)); };
    const GroundRect plot{yard.rect.x0 + 0.08f, yard.rect.y0, yard.rect.x1 - 0.08f, yard.rect.y1};
    const double pick = rng.Uniform();
    const YardKind kind = pick < 0.45 ? YardKind::kLawn : pick < 0.8 ? YardKind::kTerrace : YardKind::kSoil;
    const EntityId ground = LayYardGround(d, plot, kind, rng);

    // Nobody stands between the blocks of the ring: a tree and the ground are all that is seen from above.
    const Vec2f middle = plot.center();
    const float lane = yard.out > 0 ? plot.y1 : plot.y0;
    if (kind != YardKind::kTerrace || rng.Chance(0.4))
      PlantYardTree(d, {middle.x + uniform(-0.8f, 0.8f), lane - yard.out * uniform(1.8f, 3.0f)}, ground, rng);
    if (d.plan.blocks[yard.block].kind != BlockKind::kBuilt) continue;

    // Boards towards one neighbour and the lane; a gate's width stays open.
    const float house = yard.out > 0 ? plot.y0 : plot.y1;
    PlaceRun(d, "wood_fence", {plot.x0 + 0.1f, house + 0.3f * yard.out}, {plot.x0 + 0.1f, lane - 0.2f * yard.out}, kTop);
    PlaceRun(d, "wood_fence", {plot.x0 + 0.3f, lane - 0.15f * yard.out}, {plot.x1 - 1.4f, lane - 0.15f * yard.out}, kTop);

    // A seat near the house, green along the boards.
    if (rng.Chance(0.4)) d.placer.Try("bench_wood", {middle.x, house + 1.0f * yard.out, kTop}, FacingYaw({0, yard.out}));
    if (rng.Chance(0.5)) d.placer.Try("trash_can", {plot.x1 - 0.7f, house + 0.8f * yard.out, kTop});
    for (float t = 2; t < plot.depth() - 1.5f; t += uniform(1.2f, 2.4f)) {
      static constexpr const char* kGreen[] = {"shrub", "plant", "green_pot", "shrub", "flower_bed"};
      const bool west = rng.Chance(0.5);
      d.placer.Try(kGreen[rng.Index(5)], {west ? plot.x0 + 0.75f : plot.x1 - 0.65f, house + t * yard.out, kTop - 0.01f}, uniform(0, kTauF),
                   uniform(0.5f, 0.8f));
    }
    if (kind == YardKind::kLawn) GrowGrass(d, ground, plot.Outline(), kTop, 1.2f);
  }
}

}  // namespace airsim360::internal
