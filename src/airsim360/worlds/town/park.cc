#include <algorithm>
#include <cmath>

#include "airsim360/base/random.h"
#include "airsim360/math/angles.h"
#include "airsim360/worlds/town/district.h"

namespace airsim360::internal {
namespace {

constexpr float kPond = 17.0f, kCoping = 17.6f, kRingIn = 18.9f, kRingOut = 22.5f, kPathHalf = 1.35f, kWaterZ = -0.22f;
constexpr int kPaths = 8, kSteps = 14;

// One of the curved paths from the ring walk to the edge of the park.
struct ParkPath {
  std::vector<Vec2f> left, right;  // from the ring outwards
};

ParkPath TracePath(const GroundRect& area, int index) {
  const Vec2f c = area.center();
  const float angle = kTauF * (static_cast<float>(index) + 0.5f) / kPaths;
  const Vec2f dir{std::cos(angle), std::sin(angle)}, normal{-dir.y, dir.x};
  const float bend = index % 2 ? 2.2f : -2.2f, start = std::sqrt(kRingOut * kRingOut - kPathHalf * kPathHalf);
  const auto side = [&](float offset) {
    // Where the straight side line meets the edge of the park.
    const bool across_x = std::abs(dir.x) > std::abs(dir.y);
    const float half = across_x ? area.width() / 2 : area.depth() / 2;
    const float end =
        across_x ? (std::copysign(half, dir.x) - normal.x * offset) / dir.x : (std::copysign(half, dir.y) - normal.y * offset) / dir.y;
    std::vector<Vec2f> line;
    for (int i = 0; i <= kSteps; ++i) {
      const float t = static_cast<float>(i) / kSteps, r = start + (end - start) * t;
      const float sway = offset + bend * std::sin(kTauF / 2 * t) * std::sin(kTauF / 2 * t);
      line.push_back(c + dir * r + normal * sway);
    }
    return line;
  };
  return {side(kPathHalf), side(-kPathHalf)};
}

// The lawn between path k and the next one counter-clockwise.
std::vector<Vec2f> LawnOutline(const GroundRect& area, const ParkPath& path, const ParkPath& next) {
  std::vector<Vec2f> outline = path.left;
  // Along the edge of the park, over its corner if there is one between.
  const Vec2f a = path.left.back(), b = next.right.back();
  for (Vec2f corner : area.Outline()) {
    const bool touches_a = std::abs(corner.x - a.x) < 0.01f || std::abs(corner.y - a.y) < 0.01f;
    const bool touches_b = std::abs(corner.x - b.x) < 0.01f || std::abs(corner.y - b.y) < 0.01f;
    const bool same_side = std::abs(a.x - b.x) < 0.01f || std::abs(a.y - b.y) < 0.01f;
    if (touches_a && touches_b && !same_side) outline.push_back(corner);
  }
  outline.insert(outline.end(), next.right.rbegin(), next.right.rend());
  // Back along the ring walk, clockwise.
  const Vec2f c = area.center(), from = next.right.front() - c, to = path.left.front() - c;
  float a0 = std::atan2(from.y, from.x);
  const float a1 = std::atan2(to.y, to.x);
  if (a0 < a1) a0 += kTauF;
  for (int i = 1; i < 8; ++i) outline.push_back(Polar(c, kRingOut, a0 + (a1 - a0) * static_cast<float>(i) / 8));
  return outline;
}

void LayLake(District& d, Vec2f c) {
  Ground& g = d.ground;
  g.Begin("lake", "water/water_plane", Surface::kWater);
  g.RingSector(c, 0, kPond, 0, kTauF, kWaterZ, 64);
  g.Begin("lake edge", "construction/wall", Surface::kLimestone);
  std::vector<Vec2f> inner, outer;
  for (int i = 0; i <= 64; ++i) {
    inner.push_back(Polar(c, kPond, kTauF - kTauF * static_cast<float>(i) / 64));
    outer.push_back(Polar(c, kCoping, kTauF * static_cast<float>(i) / 64));
  }
  g.Wall(inner, -0.6f, 0.38f);
  g.Wall(outer, 0, 0.38f);
  g.Use(Surface::kTrimStone);
  g.RingSector(c, kPond - 0.04f, kCoping + 0.05f, 0, kTauF, 0.42f, 64);
  std::vector<Vec2f> lip_in, lip_out;
  for (int i = 0; i <= 64; ++i) {
    lip_in.push_back(Polar(c, kPond - 0.04f, kTauF - kTauF * static_cast<float>(i) / 64));
    lip_out.push_back(Polar(c, kCoping + 0.05f, kTauF * static_cast<float>(i) / 64));
  }
  g.Wall(lip_in, 0.36f, 0.42f);
  g.Wall(lip_out, 0.36f, 0.42f);
  // Paving between coping and walk, then the ring walk in eight segments.
  g.Begin("lake paving", "ground/pavement/modular", Surface::kPlazaStone);
  g.RingSector(c, kCoping, kRingIn, 0, kTauF, 0, 64);
  for (int i = 0; i < kPaths; ++i) {
    const float a = kTauF * static_cast<float>(i) / kPaths;
    g.Begin("ring walk", "ground/path/park_walkway", Surface::kPath);
    g.RingSector(c, kRingIn, kRingOut, a, a + kTauF / kPaths, 0.004f, 8);
  }
  // An island, a bridge that lands where two paths arrive, rocks along the edge.
  RaiseIsland(d, "ground/terrain/landscape", {c.x - 4.5f, c.y}, {5.6f, 4.8f}, kWaterZ);
  d.placer.Reserve({{c.x - 4.5f, c.y}, {5.9f, 5.1f}, 0});
  const float landing = kTauF * 1.5f / kPaths;
  BuildRedBridge(d, {c.x + (kCoping + 0.4f) * std::cos(landing), c.y}, (kRingIn - 0.1f) * std::sin(landing));
  RngStream& rng = d.placer.rng();
  for (int i = 0; i < 14; ++i) {
    const Vec2f p = Polar(c, static_cast<float>(rng.Uniform(13.5, 16)), static_cast<float>(rng.Uniform(0, kTauF)));
    d.placer.Try("rock", {p.x, p.y, -0.45f}, static_cast<float>(rng.Uniform(0, kTauF)), static_cast<float>(rng.Uniform(0.6, 1.1)));
  }
}

void LayPath(Ground& ground, const ParkPath& path) {
  for (int i = 0; i < kSteps; ++i) {
    if (i % (kSteps / 2) == 0) ground.Begin("park path", "ground/path/park_walkway", Surface::kPath);
    const auto at = [](Vec2f p) { return Vec3f{p.x, p.y, 0}; };
    const auto k = static_cast<size_t>(i);
    ground.Quad(at(path.right[k]), at(path.right[k + 1]), at(path.left[k + 1]), at(path.left[k]));
  }
}

// Railing on the street half of the lake, with gaps where the paths arrive.
void FenceLake(District& d, Vec2f c) {
  for (int k = 0; k < kPaths; ++k) {
    const float a0 = kTauF * (static_cast<float>(k) + 0.66f) / kPaths, a1 = kTauF * (static_cast<float>(k) + 1.34f) / kPaths;
    for (int i = 0; i < 4; ++i) {
      const auto at = [&](int n) { return Polar(c, kCoping + 0.7f, a0 + (a1 - a0) * static_cast<float>(n) / 4); };
      PlaceRun(d, "rail", at(i), at(i + 1), 0, "rail_pillar");
    }
  }
}

// Fence along the outer edges of a lawn: the edges that lie on the park's boundary.
void FenceLawn(District& d, const GroundRect& area, const std::vector<Vec2f>& outline) {
  const auto on_boundary = [&](Vec2f a, Vec2f b) {
    const auto same = [](float u, float v, float edge) { return std::abs(u - edge) < 0.01f && std::abs(v - edge) < 0.01f; };
    return same(a.x, b.x, area.x0) || same(a.x, b.x, area.x1) || same(a.y, b.y, area.y0) || same(a.y, b.y, area.y1);
  };
  for (size_t i = 0; i < outline.size(); ++i) {
    const Vec2f a = outline[i], b = outline[(i + 1) % outline.size()];
    const float length = std::hypot(b.x - a.x, b.y - a.y);
    if (!on_boundary(a, b) || length < 3) continue;
    const Vec2f along = (b - a) * (1 / length), inward{-along.y, along.x};
    PlaceRun(d, "wood_fence", a + along * 0.5f + inward * 0.35f, b - along * 0.5f + inward * 0.35f, kLawnZ);
  }
}

void PlantLawn(District& d, const std::vector<Vec2f>& outline, EntityId lawn, int index) {
  RngStream rng(d.seed, "park planting", static_cast<uint64_t>(index));
  GroundRect box{1e9f, 1e9f, -1e9f, -1e9f};
  for (Vec2f p : outline) box = {std::min(box.x0, p.x), std::min(box.y0, p.y), std::max(box.x1, p.x), std::max(box.y1, p.y)};
  const auto spot = [&] { return Vec2f{static_cast<float>(rng.Uniform(box.x0, box.x1)), static_cast<float>(rng.Uniform(box.y0, box.y1))}; };
  const auto turn = [&] { return static_cast<float>(rng.Uniform(0, kTauF)); };
  // Trees with room between them; each lawn has its leading species.
  std::vector<Vec2f> trees;
  const char* lead = index % 4 == 1 ? "tree_pine" : index % 4 == 3 ? "tree_narrowleaf" : "tree_generic";
  for (int i = 0; i < 160 && trees.size() < 12; ++i) {
    const Vec2f p = spot();
    const bool crowded = std::any_of(trees.begin(), trees.end(), [&](Vec2f q) { return std::hypot(p.x - q.x, p.y - q.y) < 7.9f; });
    if (crowded || !InPolygon(outline, p) || EdgeDistance(outline, p) < 2.2f) continue;
    const double pick = rng.Uniform();
    const char* kind = pick < 0.66 ? lead : pick < 0.8 ? "tree_generic" : pick < 0.9 ? "tree_pine" : "tree_narrowleaf";
    if (!d.placer.Try(kind, {p.x, p.y, kLawnZ - 0.02f}, turn(), static_cast<float>(rng.Uniform(0.75, 1.1)))) continue;
    trees.push_back(p);
    DropLeaves(d, lawn, p, 3.2f, 12, kLawnZ);
  }
  // Groups of rocks and shrubs, single flower patches near the edges.
  for (int group = 0; group < 3; ++group) {
    const Vec2f middle = spot();
    if (!InPolygon(outline, middle) || EdgeDistance(outline, middle) < 2) continue;
    for (int i = 0; i < 6; ++i) {
      const Vec2f p = Polar(middle, static_cast<float>(rng.Uniform(0, 2.2)), turn());
      if (!InPolygon(outline, p) || EdgeDistance(outline, p) < 0.9f) continue;
      d.placer.Try(i < 3 ? "rock" : "shrub", {p.x, p.y, kLawnZ - 0.03f}, turn(), static_cast<float>(rng.Uniform(0.6, 1.2)));
    }
  }
  for (int i = 0; i < 60; ++i) {
    const Vec2f p = spot();
    const float edge = EdgeDistance(outline, p);
    if (!InPolygon(outline, p) || edge < 0.7f || edge > 1.6f) continue;
    d.placer.Try(rng.Chance(0.6) ? "flower_bed" : "shrub", {p.x, p.y, kLawnZ}, turn(), static_cast<float>(rng.Uniform(0.7, 1.0)));
  }
  GrowGrass(d, lawn, outline, kLawnZ, 2);
}

// Lamps and benches along a path, on both of its banks.
void FurnishPath(District& d, const ParkPath& path, int index) {
  for (size_t i = 2; i + 2 < path.left.size(); i += 3) {
    const Vec2f l = path.left[i], r = path.right[i], across = (l - r) * (1 / std::hypot(l.x - r.x, l.y - r.y));
    const bool left = (i / 3 + static_cast<size_t>(index)) % 2 == 0;
    const Vec2f p = left ? l + across * 0.7f : r - across * 0.7f;
    const float yaw = FacingYaw(left ? across * -1.0f : across);
    if (i == 8) {
      d.placer.Try("lamp_post", {p.x, p.y, kLawnZ - 0.02f}, yaw);
    } else {
      d.placer.Try("bench_wood", {p.x, p.y, kLawnZ}, yaw);
    }
    if (i == 5) {
      const Vec2f q = left ? r - across * 0.6f : l + across * 0.6f;
      d.placer.Try("recycle_bin", {q.x, q.y, kLawnZ}, FacingYaw(left ? across : across * -1.0f));
    }
  }
}

}  // namespace

void BuildPark(District& d, const Block& block) {
  const GroundRect area = block.inner();
  const Vec2f c = area.center();
  LayLake(d, c);
  std::vector<ParkPath> paths;
  for (int i = 0; i < kPaths; ++i) {
    paths.push_back(TracePath(area, i));
    LayPath(d.ground, paths.back());
  }
  FenceLake(d, c);
  for (int i = 0; i < kPaths; ++i) FurnishPath(d, paths[static_cast<size_t>(i)], i);
  // Benches and lamps outside the ring walk.
  for (int i = 0; i < 16; ++i) {
    const Vec2f p = Polar(c, kRingOut + 0.8f, kTauF * (static_cast<float>(i) + 0.5f) / 16);
    d.placer.Try(i % 2 ? "bench_wood" : "lamp_post", {p.x, p.y, kLawnZ - 0.01f}, FacingYaw(c - p));
  }
  for (int i = 0; i < 96; ++i) {
    const float a = kTauF * (static_cast<float>(i) + 0.5f) / 96;
    const Vec2f p = Polar(c, kRingOut + 0.75f, a);
    bool on_path = false;
    for (const ParkPath& path : paths) {
      const Vec2f m = (path.left.front() + path.right.front()) * 0.5f;
      on_path = on_path || std::hypot(m.x - p.x, m.y - p.y) < kPathHalf + 1.2f;
    }
    if (!on_path) d.placer.Try("hedge", {p.x, p.y, kLawnZ - 0.02f}, FacingYaw(p - c));
  }
  for (int i = 0; i < kPaths; ++i) {
    const std::vector<Vec2f> outline = LawnOutline(area, paths[static_cast<size_t>(i)], paths[static_cast<size_t>((i + 1) % kPaths)]);
    const EntityId lawn = d.ground.Begin("park lawn", "ground/terrain/landscape", Surface::kLawn);
    d.ground.Polygon(outline, kLawnZ);
    d.ground.Use(Surface::kKerb);
    d.ground.mesh().Walls(outline, 0, kLawnZ);
    FenceLawn(d, area, outline);
    PlantLawn(d, outline, lawn, i);
  }
}

}  // namespace airsim360::internal
