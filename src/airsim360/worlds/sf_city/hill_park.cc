// A park on the slope between boulevard and hill: lawns under trees, walks, stairs to a look-out, a playground.
#include <algorithm>
#include <cmath>

#include "airsim360/base/random.h"
#include "airsim360/math/angles.h"
#include "airsim360/worlds/sf_city/city.h"

namespace airsim360::internal {
namespace {

constexpr float kHillLawnZ = 0.05f, kWalkHalf = 1.6f;

// Steps up the slope from x0 to x1 (downhill to uphill) along y = const: a rise of 15 cm each, as far apart as the ground asks.
void BuildStairs(District& d, const Hills& hills, float x0, float x1, float y) {
  const EntityId stairs = d.builder.AddEntity("park stairs", d.builder.tree().At("construction/stairs"));
  MeshBuilder mesh;
  mesh.SetEntity(stairs);
  mesh.SetMaterial(d.surfaces[Surface::kConcrete]);
  const float way = x1 > x0 ? 1.0f : -1.0f;
  float from = x0, level = hills.Height({x0, y}) + 0.06f;
  const auto tread = [&](float a, float b, float z) {
    const Drape& drape = hills.drape();
    const float low = std::min(a, b), high = std::max(a, b);
    const Vec3f p = drape.At({low, y - kWalkHalf, 0}), q = drape.At({high, y - kWalkHalf, 0}), r = drape.At({high, y + kWalkHalf, 0}),
                s = drape.At({low, y + kWalkHalf, 0});
    const std::vector<Vec2f> outline{{p.x, p.y}, {q.x, q.y}, {r.x, r.y}, {s.x, s.y}};
    mesh.Walls(outline, z - 0.6f, z);
    mesh.Polygon(outline, z);
  };
  for (float x = x0; (x1 - x) * way > 0; x += 0.3f * way) {
    const float here = hills.Height({x, y}) + 0.06f;
    if (here < level + 0.15f || std::abs(x - from) < 0.32f) continue;
    tread(from, x, level);
    from = x;
    level += 0.15f;
    level = std::max(level, here - 0.14f);
  }
  tread(from, x1, level);
  d.builder.AddInstance({d.builder.AddMesh(mesh.Finish("park stairs")), {}, kNoEntity});
}

void PlantLawn(District& d, const GroundRect& lawn, int index) {
  const EntityId grass = d.ground.Begin("lawn", "ground/grass", Surface::kLawn);
  const std::vector<Vec2f> outline = lawn.Outline();
  d.ground.Rect(lawn, kHillLawnZ);
  d.ground.Use(Surface::kKerb);
  d.ground.mesh().Walls(outline, -0.05f, kHillLawnZ);
  RngStream rng(d.seed, "hill lawn", static_cast<uint64_t>(index));
  const auto spot = [&](float margin) {
    return Vec2f{static_cast<float>(rng.Uniform(lawn.x0 + margin, lawn.x1 - margin)),
                 static_cast<float>(rng.Uniform(lawn.y0 + margin, lawn.y1 - margin))};
  };
  std::vector<Vec2f> trees;
  for (int i = 0; i < 400 && trees.size() < 16; ++i) {
    const Vec2f p = spot(2.5f);
    if (std::any_of(trees.begin(), trees.end(), [&](Vec2f q) { return std::hypot(p.x - q.x, p.y - q.y) < 7.5f; })) continue;
    static constexpr const char* kKinds[] = {"tree_pine", "tree_generic", "tree_generic", "tree_narrowleaf"};
    if (!d.placer.Try(kKinds[rng.Index(4)], {p.x, p.y, kHillLawnZ - 0.06f}, static_cast<float>(rng.Uniform(0, kTauF)),
                      static_cast<float>(rng.Uniform(0.8, 1.2))))
      continue;
    trees.push_back(p);
    DropLeaves(d, grass, p, 2.8f, 8, kHillLawnZ);
  }
  for (int i = 0; i < 26; ++i) {
    static constexpr const char* kKinds[] = {"shrub", "plant", "flower_bed", "rock"};
    const Vec2f p = spot(1.0f);
    d.placer.Try(kKinds[rng.Index(4)], {p.x, p.y, kHillLawnZ - 0.02f}, static_cast<float>(rng.Uniform(0, kTauF)), 0.9f);
  }
  GrowGrass(d, grass, outline, kHillLawnZ, 2);
}

}  // namespace

void BuildHillPark(District& d, const Hills& hills, const Block& block) {
  const GroundRect area = block.inner();
  const Vec2f c = area.center();
  // Two walks that cross; the one up the hill is of steps.
  d.ground.Begin("park walk", "ground/path/park_walkway", Surface::kPath);
  d.ground.Rect({c.x - kWalkHalf, area.y0, c.x + kWalkHalf, area.y1}, 0.03f);
  d.ground.Begin("walk beside the stairs", "ground/path/park_walkway", Surface::kPath);
  d.ground.Rect({area.x0, c.y - kWalkHalf - 0.6f, c.x - kWalkHalf, c.y + kWalkHalf + 0.6f}, 0.01f);
  d.ground.Rect({c.x + kWalkHalf, c.y - kWalkHalf - 0.6f, area.x1, c.y + kWalkHalf + 0.6f}, 0.01f);
  const auto climb = [&](float a, float b) {
    hills.Height({a, c.y}) < hills.Height({b, c.y}) ? BuildStairs(d, hills, a, b, c.y) : BuildStairs(d, hills, b, a, c.y);
  };
  climb(area.x1 - 3, c.x + kWalkHalf + 0.2f);
  climb(c.x - kWalkHalf - 0.2f, area.x0 + 13);
  // The look-out at the upper end.
  const GroundRect top{area.x0, c.y - 8, area.x0 + 12, c.y + 8};
  d.ground.Begin("look-out", "ground/path/park_walkway", Surface::kPlazaBrick);
  d.ground.Rect(top, 0.035f);
  for (float y : {top.y0 + 1.5f, top.y0 + 4.5f, top.y1 - 4.5f, top.y1 - 1.5f})
    d.placer.Try("bench_wood", {top.x0 + 1.2f, y, 0.035f}, FacingYaw({1, 0}));
  PlaceRun(d, "rope_bollard", {top.x1 - 0.3f, top.y0 + 0.5f}, {top.x1 - 0.3f, c.y - 2.6f}, 0.035f);
  PlaceRun(d, "rope_bollard", {top.x1 - 0.3f, c.y + 2.6f}, {top.x1 - 0.3f, top.y1 - 0.5f}, 0.035f);
  for (float s = 8; s < area.width() - 6; s += 14)
    for (float side : {-1.0f, 1.0f}) d.placer.Try("hill_lamp", {area.x1 - s, c.y + side * (kWalkHalf + 1.2f), 0.02f});
  for (float s = 6; s < area.depth() - 4; s += 11) {
    d.placer.Try("hill_lamp", {c.x + kWalkHalf + 0.5f, area.y0 + s, kHillLawnZ});
    d.placer.Try("bench_wood", {c.x - kWalkHalf - 0.7f, area.y0 + s + 4, kHillLawnZ}, FacingYaw({1, 0}));
    d.placer.Try("trash_can", {c.x + kWalkHalf + 0.6f, area.y0 + s + 5, kHillLawnZ});
  }
  const float gap = kWalkHalf + 0.05f, across = kWalkHalf + 0.65f;
  const GroundRect lawns[] = {{c.x + gap, area.y0, area.x1, c.y - across}, {c.x + gap, c.y + across, area.x1, area.y1},
                              {area.x0, area.y0, c.x - gap, top.y0},       {area.x0, top.y1, c.x - gap, area.y1},
                              {top.x1, top.y0, c.x - gap, c.y - across},   {top.x1, c.y + across, c.x - gap, top.y1}};
  const Vec2f play{(lawns[0].x0 + lawns[0].x1) / 2, (lawns[0].y0 + lawns[0].y1) / 2};
  for (uint32_t i = 0; i < 3; ++i)
    d.placer.Try("playground", {play.x - 8 + 8 * static_cast<float>(i), play.y, kHillLawnZ - 0.05f}, 0.3f, 1, {1, 1, 1}, i);
  for (int i = 0; i < 6; ++i) PlantLawn(d, lawns[i], i);
  // A fence along the streets, open where the walks begin.
  const GroundRect rim = area.Inset(0.25f);
  for (float y : {rim.y0, rim.y1}) {
    PlaceRun(d, "picket_fence", {rim.x0, y}, {c.x - 2.4f, y}, 0.02f);
    PlaceRun(d, "picket_fence", {c.x + 2.4f, y}, {rim.x1, y}, 0.02f);
  }
  PlaceRun(d, "picket_fence", {rim.x1, rim.y0}, {rim.x1, c.y - 3}, 0.02f);
  PlaceRun(d, "picket_fence", {rim.x1, c.y + 3}, {rim.x1, rim.y1}, 0.02f);
}

}  // namespace airsim360::internal
