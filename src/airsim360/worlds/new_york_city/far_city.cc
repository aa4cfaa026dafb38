// What lies around the streets that can be reached: far blocks, a skyline to the horizon, rivers.
#include <algorithm>
#include <cmath>
#include <map>

#include "airsim360/base/random.h"
#include "airsim360/math/angles.h"
#include "airsim360/worlds/new_york_city/far_city.h"

namespace airsim360::internal {
namespace {

Surface FarWall(const Period& period, RngStream& rng) { return period.far_walls[rng.Index(12)]; }

float FarHeight(RngStream& rng) { return std::clamp(static_cast<float>(34 * std::exp(0.55 * rng.Normal())), 12.0f, 190.0f); }

// A stepped box; each far building is an entity.
void BuildFarTower(District& d, const Period& period, GroundRect r, float height, RngStream& rng) {
  const Surface wall = FarWall(period, rng);
  const EntityId building = d.ground.Begin("far building", "construction/building", wall);
  const EntityId roof = d.builder.AddEntity("far roof", d.builder.tree().At("construction/building/roof"));
  float z = kFarGroundZ;
  const int tiers = height > 40 ? 1 + static_cast<int>(rng.Index(3)) : 1;
  for (int i = 0; i < tiers; ++i) {
    const float top = i + 1 == tiers ? height : height * (0.45f + 0.3f * static_cast<float>(i));
    d.ground.UseEntity(building);
    d.ground.Use(wall);
    d.ground.mesh().Walls(r.Outline(), z, top);
    d.ground.UseEntity(roof);
    d.ground.Use(Surface::kFarRoof);
    d.ground.Rect(r, top);
    z = top;
    r = r.Inset(std::min(r.width(), r.depth()) * static_cast<float>(rng.Uniform(0.1, 0.2)));
  }
  // A bulkhead, sometimes a tank.
  const GroundRect hut = r.Inset(std::min(r.width(), r.depth()) * 0.25f);
  d.ground.UseEntity(building);
  d.ground.Use(Surface::kFarWalls2);
  d.ground.mesh().Walls(hut.Outline(), height, height + 3.2f);
  d.ground.UseEntity(roof);
  d.ground.Use(Surface::kFarRoof);
  d.ground.Rect(hut, height + 3.2f);
  if (height > 120)
    d.ground.mesh().Tube({hut.center().x, hut.center().y, height + 3}, {hut.center().x, hut.center().y, height + 25}, 0.6f, 0.2f, 6);
}

void BuildFarBlocks(District& d, const Period& period, const GroundRect& ring) {
  const int nx = static_cast<int>(kFarCityEdge / kFarPitchX) + 1, ny = static_cast<int>(kFarCityEdge / kFarPitchY) + 1;
  for (int j = -ny; j <= ny; ++j) {
    for (int i = -nx; i <= nx; ++i) {
      const GroundRect block{kFarPitchX * static_cast<float>(i) + 13, kFarPitchY * static_cast<float>(j) + 6.5f,
                             kFarPitchX * static_cast<float>(i + 1) - 13, kFarPitchY * static_cast<float>(j + 1) - 6.5f};
      const Vec2f c = block.center();
      if (ring.Contains(c) || std::abs(c.x) > kFarCityEdge || std::abs(c.y) > kFarCityEdge) continue;
      RngStream rng(d.seed, "far manhattan", static_cast<uint64_t>((j + 64) * 256 + i + 64));
      d.ground.Begin("far block", "ground/sidewalk", Surface::kSlabs);
      d.ground.Rect(block, kFarPavementZ);
      const GroundRect inner = block.Inset(4.5f);
      for (int row = 0; row < 2; ++row) {
        float x = inner.x0;
        while (x < inner.x1 - 8) {
          const float w = std::min(static_cast<float>(rng.Uniform(13, 30)), inner.x1 - x);
          const float mid = inner.center().y;
          const GroundRect lot{x, row ? mid : inner.y0, x + w - 0.3f, row ? inner.y1 : mid - 0.3f};
          x += w;
          if (!rng.Chance(0.04)) BuildFarTower(d, period, lot, FarHeight(rng), rng);
        }
      }
    }
  }
}

// Beyond the blocks: single boxes on the same grid, taller in two clusters, one entity a square of 400 m.
void BuildSkyline(District& d, const Period& period) {
  RngStream rng(d.seed, "skyline");
  std::map<std::pair<int, int>, EntityId> squares;
  for (int j = -34; j <= 34; ++j) {
    for (int i = -18; i <= 18; ++i) {
      const float x0 = kFarPitchX * static_cast<float>(i) + 15, y0 = kFarPitchY * static_cast<float>(j) + 8;
      const float cx = x0 + 52, cy = y0 + 34, r = std::hypot(cx, cy);
      if (std::max(std::abs(cx), std::abs(cy)) < kFarCityEdge || std::abs(cx) > 1500 || r > 2900) continue;
      const auto bump = [&](float bx, float by, float s) {
        return std::exp(-((cx - bx) * (cx - bx) + (cy - by) * (cy - by)) / (2 * s * s));
      };
      const float tall = 1 + 2.0f * bump(-250, -2200, 420) + 1.6f * bump(300, 1500, 500);
      const std::pair<int, int> key{static_cast<int>(std::floor(cx / 400)), static_cast<int>(std::floor(cy / 400))};
      auto it = squares.find(key);
      if (it == squares.end())
        it = squares.emplace(key, d.builder.AddEntity("skyline", d.builder.tree().At("construction/building"))).first;
      d.ground.UseEntity(it->second);
      for (int k = 0; k < 4; ++k) {
        const float w = static_cast<float>(rng.Uniform(18, 44)), depth = static_cast<float>(rng.Uniform(18, 30)),
                    h = std::clamp(FarHeight(rng) * tall * 0.8f, 10.0f, 330.0f);
        const float px = x0 + (k % 2 ? 56.0f : 0.0f), py = y0 + (k / 2 ? 36.0f : 0.0f);
        const GroundRect box{px, py, px + w, py + depth};
        d.ground.Use(FarWall(period, rng));
        d.ground.mesh().Walls(box.Outline(), kFarGroundZ, h);
        d.ground.Use(Surface::kFarRoof);
        d.ground.Rect(box, h);
      }
    }
  }
}

}  // namespace

void BuildFarManhattan(District& d, const Period& period, const Density& density) {
  const Block &first = d.plan.blocks.front(), &last = d.plan.blocks.back();
  const GroundRect ring{first.kerb.x0 - 26, first.kerb.y0 - 13, last.kerb.x1 + 26, last.kerb.y1 + 13};
  BuildFarBlocks(d, period, ring);
  LayFarStreets(d, ring, density);
  BuildSkyline(d, period);
  // Asphalt under the far blocks: four sheets around the ring, then the island's ground to both rivers.
  const float ex = 1560, ey = 3000;
  const GroundRect sheets[] = {
      {-ex, -ey, ex, ring.y0}, {-ex, ring.y1, ex, ey}, {-ex, ring.y0, ring.x0, ring.y1}, {ring.x1, ring.y0, ex, ring.y1}};
  for (const GroundRect& sheet : sheets) {
    d.ground.Begin("outer streets", "ground/road", Surface::kAsphalt);
    d.ground.Rect(sheet, kFarGroundZ);
  }
  d.ground.Begin("river", "water/river", Surface::kWater);
  for (float side : {-1.0f, 1.0f}) {
    const float x0 = side > 0 ? ex : -2700.0f, x1 = side > 0 ? 2700.0f : -ex;
    d.ground.Rect({x0, -9000, x1, 9000}, -2.5f);
  }
  // Low land beyond, a disc to the horizon; under the streets so close below them that nobody can walk there.
  d.ground.Begin("far land", "ground/terrain/landscape", Surface::kPlain);
  float r0 = 0;
  for (float r1 : {600.0f, 1500.0f, 3500.0f, 7000.0f, 15000.0f}) {
    d.ground.RingSector({0, 0}, r0, r1, 0, kTauF, r1 > 600 ? -3.2f : -1.2f, 72);
    r0 = r1;
  }
}

}  // namespace airsim360::internal
