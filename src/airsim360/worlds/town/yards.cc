#include <algorithm>
#include <cmath>

#include "airsim360/base/random.h"
#include "airsim360/math/angles.h"
#include "airsim360/worlds/town/district.h"

namespace airsim360::internal {
namespace {

// A garden: lawn, slabs by the gate at its outer end (towards `out` in y), trees, shrubs and flowers along its fences.
void LayGarden(District& d, const GroundRect& plot, float out, RngStream& rng) {
  const EntityId lawn = d.ground.Begin("garden lawn", "ground/terrain/landscape", Surface::kLawn);
  d.ground.Rect(plot, kLawnZ);
  d.ground.Use(Surface::kKerb);
  d.ground.mesh().Walls(plot.Outline(), 0, kLawnZ);
  const auto uniform = [&](float a, float b) { return static_cast<float>(rng.Uniform(a, b)); };
  const float terrace = uniform(2.5f, 4.5f);
  const GroundRect slabs{plot.x0 + 1, out > 0 ? plot.y1 - terrace : plot.y0, plot.x1 - 1, out > 0 ? plot.y1 : plot.y0 + terrace};
  d.ground.Begin("garden terrace", "ground/pavement/modular", rng.Chance(0.5) ? Surface::kSlabsWarm : Surface::kPlazaBrick);
  d.ground.Rect(slabs, kLawnZ + 0.015f);
  const Vec2f seat{slabs.center().x + uniform(-2, 2), slabs.center().y};
  if (rng.Chance(0.7)) d.placer.Try(rng.Chance(0.5) ? "bench_wood" : "pot", {seat.x, seat.y, kLawnZ + 0.015f}, FacingYaw({0, -out}));
  const GroundRect green{plot.x0, out > 0 ? plot.y0 : plot.y0 + terrace, plot.x1, out > 0 ? plot.y1 - terrace : plot.y1};
  const auto spot = [&](float margin) {
    return Vec2f{uniform(green.x0 + margin, green.x1 - margin), uniform(green.y0 + margin, green.y1 - margin)};
  };
  static constexpr const char* kTrees[] = {"tree_generic", "tree_generic", "tree_narrowleaf", "tree_pine"};
  for (int i = 0; i < 4; ++i) {
    const Vec2f p = spot(2.2f);
    const auto turn = uniform(0, kTauF);
    const auto crowded = [&](const Placement& other) {
      return other.kind.starts_with("tree") && std::hypot(other.p_W.x - p.x, other.p_W.y - p.y) < 7.9f;
    };
    const auto& others = d.placer.placements();
    const bool free = std::none_of(others.begin(), others.end(), crowded);
    if (!free || !d.placer.Try(kTrees[rng.Index(4)], {p.x, p.y, kLawnZ - 0.02f}, turn, uniform(0.6f, 0.85f))) continue;
    DropLeaves(d, lawn, p, 2.5f, 6, kLawnZ);
  }
  // Beds along the long sides.
  for (float y = green.y0 + 0.9f; y < green.y1 - 0.8f; y += uniform(0.9f, 2.2f)) {
    for (float x : {plot.x0 + 0.8f, plot.x1 - 0.8f}) {
      if (!rng.Chance(0.6)) continue;
      static constexpr const char* kBed[] = {"shrub", "shrub", "flower_bed", "rock"};
      d.placer.Try(kBed[rng.Index(4)], {x, y, kLawnZ - 0.02f}, uniform(0, kTauF), uniform(0.5f, 0.9f));
    }
  }
  GrowGrass(d, lawn, green.Outline(), kLawnZ, 2);
}

// Back gardens in two rows, a path between them, fences around each.
void LayGardens(District& d, const GroundRect& land, RngStream& rng) {
  const float middle = land.center().y;
  d.ground.Begin("garden path", "ground/path/park_walkway", Surface::kPath);
  d.ground.Rect({land.x0, middle - 0.8f, land.x1, middle + 0.8f}, 0.02f);
  for (float out : {-1.0f, 1.0f}) {
    const float y0 = out < 0 ? land.y0 : middle + 1, y1 = out < 0 ? middle - 1 : land.y1;
    float x = land.x0;
    while (x < land.x1 - 5) {
      float w = static_cast<float>(rng.Uniform(8.5, 14));
      if (land.x1 - x - w < 8) w = land.x1 - x;
      const GroundRect plot{x + 0.12f, y0, x + w - 0.12f, y1};
      LayGarden(d, plot, out, rng);
      const char* fence = rng.Chance(0.3) ? "rail" : "wood_fence";
      PlaceRun(d, fence, {plot.x0 + 0.2f, y0 + 0.3f}, {plot.x0 + 0.2f, y1 - 0.3f}, kLawnZ);
      if (land.x1 - x - w < 1) PlaceRun(d, fence, {plot.x1 - 0.2f, y0 + 0.3f}, {plot.x1 - 0.2f, y1 - 0.3f}, kLawnZ);
      // A gate's width stays open towards the lane.
      const float gate = out > 0 ? y1 - 0.2f : y0 + 0.2f;
      PlaceRun(d, fence, {plot.x0 + 0.4f, gate}, {plot.x1 - 2.2f, gate}, kLawnZ);
      x += w;
    }
  }
}

}  // namespace

void BuildYard(District& d, const Block& block) {
  const GroundRect inner = block.inner();
  RngStream rng(d.seed, "yard", static_cast<uint64_t>(block.row * 8 + block.column));
  d.ground.Begin("yard", "ground/pavement/modular", Surface::kAsphaltOld);
  d.ground.Rect(inner, 0);
  if (block.kind == BlockKind::kBackdrop) return;

  // Gardens, a lane around them, cars and bins along the backs of the houses.
  const GroundRect yard = CourtyardOf(block), land = yard.Inset(9.5f);
  LayGardens(d, land, rng);
  for (float x = yard.x0 + 10; x < yard.x1 - 10; x += 3.1f) {
    for (float s : {-1.0f, 1.0f}) {
      if (!rng.Chance(0.5)) continue;
      const float y = s < 0 ? yard.y0 + 3.2f : yard.y1 - 3.2f;
      d.placer.Try(rng.Chance(0.8) ? "car" : "van", {x, y, 0.0f}, FacingYaw({0, s}));
    }
  }
  for (int i = 0; i < 10; ++i) {
    const float y = static_cast<float>(rng.Uniform(yard.y0 + 6, yard.y1 - 6)), x = i % 2 ? yard.x0 + 0.8f : yard.x1 - 0.8f;
    d.placer.Try(i % 3 == 0 ? "trash_can" : "recycle_bin", {x, y, 0}, FacingYaw({i % 2 ? 1.0f : -1.0f, 0}));
  }
}

}  // namespace airsim360::internal
