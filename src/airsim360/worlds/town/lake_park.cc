// A park of one block: a lake with a wooded island, a red bridge, a walk around it.
#include <algorithm>
#include <cmath>

#include "airsim360/base/random.h"
#include "airsim360/math/angles.h"
#include "airsim360/worlds/town/district.h"

namespace airsim360::internal {
namespace {

constexpr Vec2f kLakeHalf{28, 16.5f};
constexpr float kLakeZ = -0.45f, kBank = 1.10f, kWalkIn = 1.18f;
constexpr int kShoreSteps = 96;

// The shore at angle a, scaled: an ellipse with bays.
Vec2f Shore(Vec2f c, float a, float scale) {
  const float wobble = 1 + 0.05f * std::sin(3 * a + 0.4f) + 0.035f * std::sin(5 * a + 2);
  return {c.x + kLakeHalf.x * wobble * scale * std::cos(a), c.y + kLakeHalf.y * wobble * scale * std::sin(a)};
}
Vec2f Walk(Vec2f c, float a, float offset) {
  const Vec2f p = Shore(c, a, kWalkIn), q = Shore(c, a, kWalkIn + 0.01f), v = q - p;
  const float l = std::hypot(v.x, v.y);
  return p + v * (offset / l);
}

void LayRing(Ground& g, Vec2f c, float s0, float s1, float z0, float z1) {
  for (int i = 0; i < kShoreSteps; ++i) {
    const float a0 = kTauF * static_cast<float>(i) / kShoreSteps, a1 = kTauF * static_cast<float>(i + 1) / kShoreSteps;
    const Vec2f p = Shore(c, a0, s0), q = Shore(c, a0, s1), r = Shore(c, a1, s1), t = Shore(c, a1, s0);
    g.Quad({p.x, p.y, z0}, {q.x, q.y, z1}, {r.x, r.y, z1}, {t.x, t.y, z0});
  }
}

void LayLakeOfPark(District& d, Vec2f c) {
  Ground& g = d.ground;
  g.Begin("lake", "water/lake", Surface::kWater);
  std::vector<Vec2f> shore;
  for (int i = 0; i < kShoreSteps; ++i) shore.push_back(Shore(c, kTauF * static_cast<float>(i) / kShoreSteps, 1.0f));
  g.Polygon(shore, kLakeZ);
  g.Begin("shore", "ground/dirt", Surface::kSoil);
  LayRing(g, c, 0.99f, 1.035f, kLakeZ - 0.06f, -0.22f);
  const EntityId bank = g.Begin("lake bank", "ground/grass", Surface::kLawn);
  LayRing(g, c, 1.035f, kBank, -0.22f, kLawnZ);
  std::vector<Vec2f> in, out;
  LayRing(g, c, kBank, kWalkIn - 0.005f, kLawnZ, kLawnZ);
  RngStream rng(d.seed, "lake bank");
  for (int i = 0; i < 900; ++i) {
    const float a = static_cast<float>(rng.Uniform(0, kTauF)), s = static_cast<float>(rng.Uniform(1.045, kWalkIn - 0.01));
    const Vec2f p = Shore(c, a, s);
    const float t = std::min(1.0f, (s - 1.035f) / (kBank - 1.035f)), tone = static_cast<float>(rng.Uniform(0.8, 1.2));
    d.placer.shelf().PlaceAs(bank, "grass_tuft",
                             PlaceUpright({p.x, p.y, -0.22f + (kLawnZ + 0.22f) * t}, a * 7, static_cast<float>(rng.Uniform(0.8, 1.7))),
                             rng.Index(16), {tone, tone, tone});
  }
  for (int i = 0; i < 46; ++i) {
    const float a = static_cast<float>(rng.Uniform(0, kTauF));
    const Vec2f p = Shore(c, a, static_cast<float>(rng.Uniform(0.965, 1.03)));
    d.placer.Try("rock", {p.x, p.y, kLakeZ - 0.12f}, a, static_cast<float>(rng.Uniform(0.4, 1.0)));
  }
  // The walk in eight segments.
  for (int k = 0; k < 8; ++k) {
    g.Begin("park walk", "ground/path/park_walkway", Surface::kPath);
    for (int i = 0; i < kShoreSteps / 8; ++i) {
      const float a0 = kTauF * static_cast<float>(k * kShoreSteps / 8 + i) / kShoreSteps, a1 = a0 + kTauF / kShoreSteps;
      const Vec2f p = Walk(c, a0, 0), q = Walk(c, a0, 2.8f), r = Walk(c, a1, 2.8f), t = Walk(c, a1, 0);
      g.Quad({p.x, p.y, 0.03f}, {q.x, q.y, 0.03f}, {r.x, r.y, 0.03f}, {t.x, t.y, 0.03f});
    }
  }
}

// Lawn of one quadrant between walk and pavement, leaving the crossing walks free.
std::vector<Vec2f> QuadrantOutline(const GroundRect& area, Vec2f c, int quadrant) {
  constexpr float kHalf = 1.5f;
  const float sx = quadrant == 0 || quadrant == 3 ? 1.0f : -1.0f, sy = quadrant < 2 ? 1.0f : -1.0f;
  const float a0 = kTauF / 4 * static_cast<float>(quadrant);
  std::vector<Vec2f> line;
  for (int i = 0; i <= 24; ++i) {
    const Vec2f p = Walk(c, a0 + kTauF / 4 * static_cast<float>(i) / 24, 2.85f);
    if ((p.x - c.x) * sx > kHalf && (p.y - c.y) * sy > kHalf) line.push_back(p);
  }
  const float ex = sx > 0 ? area.x1 : area.x0, ey = sy > 0 ? area.y1 : area.y0;
  const bool starts_on_x = quadrant % 2 == 0;  // the arc starts near the x axis
  const std::vector<Vec2f> rim = starts_on_x ? std::vector<Vec2f>{{c.x + sx * kHalf, ey}, {ex, ey}, {ex, c.y + sy * kHalf}}
                                             : std::vector<Vec2f>{{ex, c.y + sy * kHalf}, {ex, ey}, {c.x + sx * kHalf, ey}};
  line.insert(line.end(), rim.begin(), rim.end());
  float area2 = 0;
  for (size_t i = 0; i < line.size(); ++i) {
    const Vec2f a = line[i], b = line[(i + 1) % line.size()];
    area2 += a.x * b.y - b.x * a.y;
  }
  if (area2 < 0) std::reverse(line.begin(), line.end());
  return line;
}

void PlantQuadrant(District& d, const std::vector<Vec2f>& outline, EntityId lawn, int quadrant) {
  RngStream rng(d.seed, "lake park", static_cast<uint64_t>(quadrant));
  GroundRect box{1e9f, 1e9f, -1e9f, -1e9f};
  for (Vec2f p : outline) box = {std::min(box.x0, p.x), std::min(box.y0, p.y), std::max(box.x1, p.x), std::max(box.y1, p.y)};
  std::vector<Vec2f> trees;
  for (int i = 0; i < 400 && trees.size() < 30; ++i) {
    const Vec2f p{static_cast<float>(rng.Uniform(box.x0, box.x1)), static_cast<float>(rng.Uniform(box.y0, box.y1))};
    const bool crowded = std::any_of(trees.begin(), trees.end(), [&](Vec2f q) { return std::hypot(p.x - q.x, p.y - q.y) < 7.9f; });
    if (crowded || !InPolygon(outline, p) || EdgeDistance(outline, p) < 1.6f) continue;
    static constexpr const char* kKinds[] = {"tree_generic", "tree_generic", "tree_narrowleaf", "tree_pine"};
    if (!d.placer.Try(kKinds[rng.Index(4)], {p.x, p.y, kLawnZ - 0.02f}, static_cast<float>(rng.Uniform(0, kTauF)),
                      static_cast<float>(rng.Uniform(0.75, 1.1))))
      continue;
    trees.push_back(p);
    DropLeaves(d, lawn, p, 2.8f, 8, kLawnZ);
  }
  for (int i = 0; i < 30; ++i) {
    const Vec2f p{static_cast<float>(rng.Uniform(box.x0, box.x1)), static_cast<float>(rng.Uniform(box.y0, box.y1))};
    if (!InPolygon(outline, p) || EdgeDistance(outline, p) < 0.8f) continue;
    static constexpr const char* kKinds[] = {"shrub", "plant", "flower_bed", "rock"};
    d.placer.Try(kKinds[rng.Index(4)], {p.x, p.y, kLawnZ - 0.02f}, static_cast<float>(rng.Uniform(0, kTauF)), 0.9f);
  }
  GrowGrass(d, lawn, outline, kLawnZ, 2);
}

}  // namespace

void BuildLakePark(District& d, const Block& block) {
  const GroundRect area = block.inner();
  const Vec2f c = area.center();
  LayLakeOfPark(d, c);
  RaiseIsland(d, "ground/grass", {c.x - 7, c.y + 1}, {6.4f, 4.6f}, kLakeZ);
  BuildRedBridge(d, {c.x + 12, c.y}, 16.2f);
  // Four short walks from the ring to the pavements.
  for (int k = 0; k < 4; ++k) {
    d.ground.Begin("park entrance", "ground/path/park_walkway", Surface::kPath);
    const Vec2f p = Walk(c, kTauF / 4 * static_cast<float>(k), 2.4f);
    const GroundRect strips[] = {{p.x, c.y - 1.5f, area.x1, c.y + 1.5f},
                                 {c.x - 1.5f, p.y, c.x + 1.5f, area.y1},
                                 {area.x0, c.y - 1.5f, p.x, c.y + 1.5f},
                                 {c.x - 1.5f, area.y0, c.x + 1.5f, p.y}};
    d.ground.Rect(strips[k], 0.024f);
  }
  // Soil under everything; only rims of it show.
  d.ground.Begin("park soil", "ground/dirt", Surface::kSoil);
  for (int i = 0; i < kShoreSteps; ++i) {
    const float a0 = kTauF * static_cast<float>(i) / kShoreSteps, a1 = kTauF * static_cast<float>(i + 1) / kShoreSteps;
    const Vec2f p = Shore(c, a0, kBank + 0.01f), q = Walk(c, a0, 3.2f), r = Walk(c, a1, 3.2f), t = Shore(c, a1, kBank + 0.01f);
    d.ground.Quad({p.x, p.y, 0.0f}, {q.x, q.y, 0.0f}, {r.x, r.y, 0.0f}, {t.x, t.y, 0.0f});
  }
  for (int i = 0; i < 24; ++i) {
    const float a = kTauF * (static_cast<float>(i) + 0.5f) / 24;
    const Vec2f p = Walk(c, a, 3.5f);
    const float yaw = FacingYaw(c - p);
    d.placer.Try(i % 3 == 0 ? "lamp_post" : i % 3 == 1 ? "bench_wood" : i % 2 ? "trash_can" : "bench_wood", {p.x, p.y, kLawnZ}, yaw);
  }
  for (int quadrant = 0; quadrant < 4; ++quadrant) {
    const std::vector<Vec2f> outline = QuadrantOutline(area, c, quadrant);
    const EntityId lawn = d.ground.Begin("lawn", "ground/grass", Surface::kLawn);
    d.ground.Polygon(outline, kLawnZ);
    d.ground.Use(Surface::kKerb);
    d.ground.mesh().Walls(outline, 0, kLawnZ);
    // Iron fences along the streets.
    const GroundRect line = area.Inset(0.3f);
    const float sx = quadrant == 0 || quadrant == 3 ? 1.0f : -1.0f, sy = quadrant < 2 ? 1.0f : -1.0f;
    const float ex = sx > 0 ? line.x1 : line.x0, ey = sy > 0 ? line.y1 : line.y0;
    PlaceRun(d, "metal_fence", {c.x + sx * 2, ey}, {ex, ey}, kLawnZ);
    PlaceRun(d, "metal_fence", {ex, c.y + sy * 2}, {ex, ey}, kLawnZ);
    PlantQuadrant(d, outline, lawn, quadrant);
  }
}

}  // namespace airsim360::internal
