// Sea, river, lake or canal of a town, and what lies at their banks.
#include <algorithm>
#include <cmath>

#include "airsim360/worlds/town_maker/town_drawer.h"

namespace airsim360::internal {
namespace {

constexpr double kBeyond = 700;  // metres that waters go on outside the town

}  // namespace

void TownDrawer::LayWaters() {
  const double phase = rng_.Uniform(0, 6.28);
  switch (spec_.water) {
    case TownWater::kNone:
      return;
    case TownWater::kSea:
      return LayCoast();
    case TownWater::kRiver:
    case TownWater::kCanal: {
      const bool canal = spec_.water == TownWater::kCanal;
      const double bend = canal ? 0 : 0.06 * spec_.depth, y = canal ? -0.16 * spec_.depth : -0.2 * spec_.depth;
      for (double x = x0_ - kBeyond; x <= x1_ + kBeyond + 1; x += canal ? 2 * kBeyond : 22)
        river_.push_back({x, y + bend * std::sin(x / 85 + phase)});
      if (canal) river_ = {{x0_ - kBeyond, y}, {x1_ + kBeyond, y}};
      const double half = canal ? 6.5 : std::clamp(0.04 * spec_.depth, 8.0, 26.0);
      map_.wet = Band(river_, half, half);
      for (const Patch& patch : map_.wet) AddArea(patch.outer, {{"natural", "water"}, {"name", canal ? "Canal" : "River"}});
      return;
    }
    case TownWater::kLake: {
      Ring shore;
      const Vec2d c{-0.24 * spec_.width, -0.24 * spec_.depth};
      const double r = 0.2 * std::min(spec_.width, spec_.depth);
      for (int i = 0; i < 40; ++i) {
        const double a = 6.283185 * i / 40;
        const double w = r * (1.15 + 0.13 * std::sin(2 * a + phase) + 0.09 * std::sin(5 * a + 2 * phase));
        shore.push_back({c.x + 1.25 * w * std::cos(a), c.y + w * std::sin(a)});
      }
      map_.wet = Unite(Patches{{shore, {}}});
      AddArea(shore, {{"natural", "water"}, {"name", "Lake"}});
      return;
    }
  }
}

// The sea is in the south; a bay goes into the town.
void TownDrawer::LayCoast() {
  const double phase = rng_.Uniform(0, 6.28), y = y0_ + 0.22 * spec_.depth;
  for (double x = x0_ - kBeyond; x <= x1_ + kBeyond + 1; x += 18) {
    const double far = std::max(0.0, std::abs(x) - spec_.width / 2);
    coast_.push_back({x, y + 0.045 * spec_.depth * std::sin(x / 75 + phase) +
                             0.05 * spec_.depth * std::exp(-x * x / (0.05 * spec_.width * spec_.width)) - 0.12 * far});
  }
  // Water is to the right of a coastline.
  AddLine(coast_, {{"natural", "coastline"}});
  Ring sea = coast_;
  sea.push_back({x1_ + kBeyond, y0_ - kBeyond});
  sea.push_back({x0_ - kBeyond, y0_ - kBeyond});
  map_.wet = Unite(Patches{{sea, {}}});
}

bool TownDrawer::IsWet(Vec2d p, double margin) const {
  for (const Patch& patch : map_.wet)
    if (Inside(patch, p) || (margin > 0 && DistanceToRing(patch.outer, p) < margin)) return true;
  return false;
}

void TownDrawer::FurnishWaters() {
  if (spec_.water == TownWater::kNone) return;
  // Shore lines on land, from which piers go out.
  std::vector<Vec2d> shore = coast_;
  if (shore.empty() && !map_.wet.empty()) {
    shore = map_.wet[0].outer;
    shore.push_back(shore[0]);
  }
  const bool sea = spec_.water == TownWater::kSea, wild = spec_.paving == TownPaving::kDirt;
  if (sea) {
    std::vector<Vec2d> walk;
    for (Vec2d p : coast_)
      if (map_.data.extent.Contains(p, 60)) walk.push_back({p.x, p.y + (spec_.harbour ? 5.5 : 12.0)});
    AddLine(walk, {{"highway", "pedestrian"}, {"width", "10"}, {"name", "Promenade"}, {"surface", "sett"}});
    if (!spec_.harbour) {
      std::vector<Vec2d> sand;
      for (Vec2d p : coast_)
        if (map_.data.extent.Contains(p, 60)) sand.push_back(p);
      const Patches beach = Band(sand, 7.2, 0);
      for (const Patch& patch : beach) AddArea(patch.outer, {{"natural", "beach"}});
    }
    for (size_t i = 0; i + 1 < walk.size(); ++i)
      if (Inside_(walk[i], 2)) {
        AddNode(walk[i] + Vec2d{6, -2.5}, {{"amenity", "bench"}});
        if (spec_.palms || spec_.trees > 0.2) AddTree(walk[i] + Vec2d{0, 3.6}, 6, 8);
      }
  }
  if (!spec_.harbour) return;
  int piers = 0;
  const double pitch = wild ? 95 : 46;
  double left = pitch * 0.4;
  for (size_t i = 0; i + 1 < shore.size(); ++i) {
    const Vec2d a = shore[i], v = shore[i + 1] - a;
    const double length = std::hypot(v.x, v.y);
    left -= length;
    if (left > 0 || !Inside_(a, 12) || piers >= 8) continue;
    left = pitch;
    // Towards the water.
    Vec2d out{v.y / length, -v.x / length};
    if (!IsWet(a + out * 6, 0)) out = out * -1.0;
    double reach = wild ? 13 : 30;
    while (reach > 6 && !IsWet(a + out * (reach + 6), 0)) reach -= 3;
    if (reach <= 6) continue;
    ++piers;
    AddSpot("jetty", a, out, reach);
    const Vec2d side{-out.y, out.x};
    for (double s = wild ? 7 : 8; s < reach - 1; s += wild ? 8 : 5.2)
      for (int hand : {1, -1})
        if (rng_.Chance(wild ? 0.45 : 0.8))
          AddSpot(wild               ? "rowboat"
                  : rng_.Chance(0.5) ? "yacht"
                                     : "boat",
                  a + out * s + side * (hand * (wild ? 2.3 : 3.4)), wild ? out : side * static_cast<double>(hand), 0);
  }
  if (sea && piers > 0)
    for (int i = 0; i < 5; ++i) {
      const Vec2d p{rng_.Uniform(x0_, x1_), rng_.Uniform(y0_ - 20, y0_ + 0.1 * spec_.depth)};
      if (IsWet(p, 0) && IsWet(p + Vec2d{0, 30}, 0)) AddSpot("boat", p, {1, 0}, 0);
    }
}

}  // namespace airsim360::internal
