#include <cmath>

#include "airsim360/base/random.h"
#include "airsim360/worlds/district.h"

namespace airsim360::internal {
namespace {

constexpr float kTau = 6.2831853f, kLawnZ = 0.06f;

// A lawn with trees in the middle of the yard.
void LayYardLawn(District& d, const GroundRect& lawn, RngStream& rng) {
  const EntityId entity = d.ground.Begin("yard lawn", "ground/terrain/landscape", Surface::kLawn);
  d.ground.Rect(lawn, kLawnZ);
  d.ground.Use(Surface::kKerb);
  d.ground.mesh().Walls(lawn.Outline(), 0, kLawnZ);
  const auto spot = [&](float margin) {
    return Vec2f{static_cast<float>(rng.Uniform(lawn.x0 + margin, lawn.x1 - margin)),
                 static_cast<float>(rng.Uniform(lawn.y0 + margin, lawn.y1 - margin))};
  };
  static constexpr const char* kTrees[] = {"tree_generic", "tree_generic", "tree_narrowleaf", "tree_pine"};
  for (int i = 0; i < 9; ++i) {
    const Vec2f p = spot(3);
    const auto turn = static_cast<float>(rng.Uniform(0, kTau));
    // A clearing of 5 m keeps crowns apart.
    const Footprint room{p, {2.6f, 2.6f}, 0};
    bool free = true;
    for (const Placement& other : d.placer.placements())
      free = free && !(other.kind.starts_with("tree") && room.Contains({other.p_W.x, other.p_W.y}));
    if (!free || !d.placer.Try(kTrees[rng.Index(4)], {p.x, p.y, kLawnZ - 0.02f}, turn, 0.8f)) continue;
    DropLeaves(d, entity, p, 2.5f, 6, kLawnZ);
  }
  for (int i = 0; i < 14; ++i) {
    const Vec2f p = spot(1);
    d.placer.Try(i % 3 ? "shrub" : "rock", {p.x, p.y, kLawnZ - 0.02f},
                 static_cast<float>(rng.Uniform(0, kTau)), 0.8f);
  }
  PlaceRun(d, "wood_fence", {lawn.x0 + 0.3f, lawn.y0 + 0.3f}, {lawn.x1 - 0.3f, lawn.y0 + 0.3f}, kLawnZ);
  PlaceRun(d, "wood_fence", {lawn.x1 - 0.3f, lawn.y1 - 0.3f}, {lawn.x0 + 0.3f, lawn.y1 - 0.3f}, kLawnZ);
  GrowGrass(d, entity, lawn.Outline(), kLawnZ, 0.8f);
}

}  // namespace

void BuildYard(District& d, const Block& block) {
  const GroundRect inner = block.inner();
  RngStream rng(d.seed, "yard", static_cast<uint64_t>(block.row * 8 + block.column));
  d.ground.Begin("yard", "ground/pavement/modular", Surface::kAsphaltOld);
  d.ground.Rect(inner, 0);
  if (block.kind == BlockKind::kBackdrop) return;

  // A lawn, a lane around it, cars and bins along the backs of the houses.
  const GroundRect yard = CourtyardOf(block), lawn = yard.Inset(9.5f);
  LayYardLawn(d, lawn, rng);
  for (float x = yard.x0 + 10; x < yard.x1 - 10; x += 3.1f) {
    for (float s : {-1.0f, 1.0f}) {
      if (!rng.Chance(0.5)) continue;
      const float y = s < 0 ? yard.y0 + 3.2f : yard.y1 - 3.2f;
      d.placer.Try(rng.Chance(0.8) ? "car" : "van", {x, y, 0.0f}, FacingYaw({0, s}));
    }
  }
  for (int i = 0; i < 10; ++i) {
    const float y = static_cast<float>(rng.Uniform(yard.y0 + 6, yard.y1 - 6)),
                x = i % 2 ? yard.x0 + 0.8f : yard.x1 - 0.8f;
    d.placer.Try(i % 3 == 0 ? "trash_can" : "recycle_bin", {x, y, 0}, FacingYaw({i % 2 ? 1.0f : -1.0f, 0}));
  }
}

}  // namespace airsim360::internal
