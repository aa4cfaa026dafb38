#include <algorithm>
#include <cmath>

#include "airsim360/base/random.h"
#include "airsim360/math/angles.h"
#include "airsim360/worlds/texture/texture_synth.h"
#include "airsim360/worlds/town/district.h"

namespace airsim360::internal {
namespace {

constexpr float kPitch = 112, kRoad = 13, kCityEdge = 640, kPlainZ = -0.5f;

// A far building: walls with pictured windows, a deck, a box on top.
void BuildFarTower(District& d, const GroundRect& r, float height, RngStream& rng) {
  using S = Surface;
  static constexpr S kWalls[] = {S::kFarWalls0, S::kFarWalls1, S::kFarWalls2, S::kFarWalls3, S::kFarPiers0, S::kFarPiers1, S::kFarRibbons0};
  const S wall = kWalls[rng.Index(7)];
  d.ground.Begin("far building", "construction/building", wall);
  d.ground.mesh().Walls(r.Outline(), -0.02f, height);
  const GroundRect hut = r.Inset(std::min(r.width(), r.depth()) * 0.36f);
  d.ground.mesh().Walls(hut.Outline(), height, height + 3);
  d.ground.Begin("far roof", "construction/building/roof", Surface::kFarRoof);
  d.ground.Rect(r, height);
  d.ground.Rect(hut, height + 3);
}

void BuildFarBlock(District& d, const GroundRect& block, uint64_t id) {
  RngStream rng(d.seed, "far block", id);
  d.ground.Begin("far block", "ground/pavement/modular", Surface::kSlabs);
  d.ground.Rect(block, -0.02f);
  // Two or three columns of plots, two rows.
  const int columns = 2 + static_cast<int>(rng.Index(2));
  for (int j = 0; j < 2; ++j) {
    for (int i = 0; i < columns; ++i) {
      const float w = block.width() / static_cast<float>(columns), h = block.depth() / 2;
      const GroundRect plot{block.x0 + w * static_cast<float>(i), block.y0 + h * static_cast<float>(j),
                            block.x0 + w * static_cast<float>(i + 1), block.y0 + h * static_cast<float>(j + 1)};
      if (rng.Chance(0.06)) continue;
      const double tall = std::exp(0.45 * rng.Normal());
      const auto storeys = static_cast<float>(std::clamp(std::lround(7 * tall), 3l, 24l));
      BuildFarTower(d, plot.Inset(static_cast<float>(rng.Uniform(3, 7))), storeys * 3.0f, rng);
    }
  }
}

void BuildFarCity(District& d, const GroundRect& ring) {
  // Blocks on the pitch of the core, outside the ring of detailed ones.
  const int n = static_cast<int>(kCityEdge / kPitch) + 1;
  for (int j = -n; j <= n; ++j) {
    for (int i = -n; i <= n; ++i) {
      const float cx = ring.center().x + kPitch * static_cast<float>(i), cy = ring.center().y + kPitch * static_cast<float>(j);
      const float half = (kPitch - kRoad) / 2;
      const GroundRect block{cx - half, cy - half, cx + half, cy + half};
      const bool clear = block.x1 < ring.x0 || block.x0 > ring.x1 || block.y1 < ring.y0 || block.y0 > ring.y1;
      if (!clear || std::abs(cx) + half > kCityEdge || std::abs(cy) + half > kCityEdge) continue;
      BuildFarBlock(d, block, static_cast<uint64_t>((j + n) * 64 + i + n));
    }
  }
  // Streets between them: four sheets around the ring.
  const float e = kCityEdge, z = -0.13f;
  const GroundRect sheets[] = {{-e, -e, e, ring.y0}, {-e, ring.y1, e, e}, {-e, ring.y0, ring.x0, ring.y1}, {ring.x1, ring.y0, e, ring.y1}};
  for (const GroundRect& sheet : sheets) {
    d.ground.Begin("outer streets", "ground/road", Surface::kAsphalt);
    d.ground.Rect(sheet, z);
  }
}

// The plain, a disc to beyond the mountains; under the city it only closes what would be gaps.
void LayPlain(District& d) {
  d.ground.Begin("plain", "ground/terrain/landscape", Surface::kPlain);
  float r0 = 0;
  for (float r1 : {200.0f, 600.0f, 1500.0f, 3500.0f, 7000.0f, 14000.0f}) {
    d.ground.RingSector({0, 0}, r0, r1, 0, kTauF, kPlainZ, 72);
    r0 = r1;
  }
}

}  // namespace

// A ridge: an arc of mountains, its crest broken by noise, with spurs towards the city.
void RaiseRidge(District& d, int index, float radius, float from, float to, float height, Surface surface) {
  d.ground.Begin("ridge", "nature/mountain", surface);
  constexpr int kAcross = 14;
  const int along = std::max(24, static_cast<int>((to - from) * 60));
  const float width = radius * 0.22f;
  const auto seed = static_cast<uint32_t>(MixBits(d.seed + static_cast<uint64_t>(index)));
  const auto at = [&](int i, int j) {
    const float s = static_cast<float>(i) / static_cast<float>(along), t = 2 * static_cast<float>(j) / kAcross - 1;
    const float a = from + (to - from) * s, r = radius + width * t;
    const float x = r * std::cos(a), y = r * std::sin(a);
    // Noise over a tile of 16 km; the crest falls to both ends.
    const float u = x / 16000 + 0.5f, v = y / 16000 + 0.5f;
    const float crest = 0.55f + 0.75f * TilingFbm(seed, u, v, 12, 4), rough = TilingFbm(seed + 9, u, v, 48, 4);
    const float ends = std::min(1.0f, 4 * std::min(s, 1 - s));
    const float shape = std::pow(std::max(0.0f, 1 - t * t), 1.3f);
    const float z = kPlainZ - 8 + height * ends * shape * std::max(0.1f, crest + 0.28f * rough) * (1 + 0.15f * rough);
    return Vec3f{x, y, z};
  };
  const auto normal = [&](int i, int j) { return Normalized(Cross(at(i, j + 1) - at(i, j - 1), at(i + 1, j) - at(i - 1, j))); };
  const auto uv = [](Vec3f p) { return Vec2f{p.x, -p.y - p.z}; };
  for (int i = 0; i < along; ++i) {
    for (int j = 0; j < kAcross; ++j) {
      const Vec3f p[4] = {at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j)};
      const auto up = [](Vec3f n) { return n.z < 0 ? -n : n; };
      const Vec3f n[4] = {up(normal(i, j)), up(normal(i, j + 1)), up(normal(i + 1, j + 1)), up(normal(i + 1, j))};
      d.ground.mesh().SmoothTriangle({p[0], p[1], p[2]}, {n[0], n[1], n[2]}, {uv(p[0]), uv(p[1]), uv(p[2])});
      d.ground.mesh().SmoothTriangle({p[0], p[2], p[3]}, {n[0], n[2], n[3]}, {uv(p[0]), uv(p[2]), uv(p[3])});
    }
  }
}

namespace {

void RaiseMountains(District& d) {
  struct RidgeRow {
    float radius, from_deg, to_deg, height;
    Surface surface;
  };
  constexpr RidgeRow kRidges[] = {
      {3300, 20, 95, 260, Surface::kMountain},     {3700, 130, 200, 300, Surface::kMountain},
      {3500, 235, 320, 230, Surface::kMountain},   {5200, 60, 150, 560, Surface::kMountainFar},
      {5600, -30, 50, 520, Surface::kMountainFar}, {5400, 170, 260, 480, Surface::kMountainFar},
      {7800, 95, 215, 980, Surface::kMountainFar}, {8200, 300, 400, 900, Surface::kMountainFar},
  };
  int index = 0;
  for (const RidgeRow& row : kRidges) {
    RaiseRidge(d, index++, row.radius, row.from_deg * kTauF / 360, row.to_deg * kTauF / 360, row.height, row.surface);
  }
}

// Woods on the plain near the city.
void PlantFarWoods(District& d) {
  RngStream rng(d.seed, "far woods");
  for (int grove = 0; grove < 26; ++grove) {
    const double a = rng.Uniform(0, kTauF), r = rng.Uniform(760, 1500);
    for (int i = 0; i < 9; ++i) {
      const Vec3f p{static_cast<float>(r * std::cos(a) + 26 * rng.Normal()), static_cast<float>(r * std::sin(a) + 26 * rng.Normal()),
                    kPlainZ};
      d.placer.Put(rng.Chance(0.4) ? "tree_pine" : "tree_generic", p, static_cast<float>(rng.Uniform(0, kTauF)),
                   static_cast<float>(rng.Uniform(0.9, 1.4)));
    }
  }
}

}  // namespace

void BuildBackdrop(District& d) {
  const Block &first = d.plan.blocks.front(), &last = d.plan.blocks.back();
  const float road = 2 * d.plan.north_south.front().half_width;
  const GroundRect ring{first.kerb.x0 - road, first.kerb.y0 - road, last.kerb.x1 + road, last.kerb.y1 + road};
  BuildFarCity(d, ring);
  LayPlain(d);
  RaiseMountains(d);
  PlantFarWoods(d);
}

}  // namespace airsim360::internal
