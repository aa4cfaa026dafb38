// Sea, river, lake or canal of a town, and what lies at their banks.
#include <algorithm>
#include <cmath>

#include "airsim360/worlds/town_maker/town_drawer.h"

namespace airsim360::internal {
namespace {

constexpr double kBeyond = 700;    // metres that waters go on outside the town
constexpr double kHorizon = 2700;  // rivers in open country: to behind the foot of the nearest hills

}  // namespace

void TownDrawer::LayWaters() {
  const double phase = rng_.Uniform(0, 6.28);
  switch (spec_.water) {
    case TownWater::kNone:
      return;
    case TownWater::kSea:
      return LayCoast();
    case TownWater::kIsland:
      return LayIsland();
    case TownWater::kRiver:
    case TownWater::kCanal: {
      const bool canal = spec_.water == TownWater::kCanal;
      const double bend = canal ? 0 : 0.06 * spec_.depth,
                   // Between the main street and the next one.
          y = spec_.central_water ? -std::min(0.5 * spec_.block, 0.08 * spec_.depth) : (canal ? -0.16 : -0.2) * spec_.depth;
      const double beyond = spec_.country == TownCountry::kCity ? kBeyond : kHorizon;
      for (double x = x0_ - beyond; x <= x1_ + beyond + 1; x += 22) map_.river.push_back({x, y + bend * std::sin(x / 85 + phase)});
      map_.river_half = canal ? 6.5 : std::clamp(0.04 * spec_.depth, 8.0, 26.0);
      map_.wet = Band(map_.river, map_.river_half, map_.river_half);
      for (const Patch& patch : map_.wet) AddArea(patch.outer, {{"natural", "water"}, {"name", canal ? "Canal" : "River"}});
      return;
    }
    case TownWater::kLake: {
      Ring shore;
      const Vec2d c = spec_.central_water ? Vec2d{0, 0} : Vec2d{-0.24 * spec_.width, -0.24 * spec_.depth};
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

// The town to its edges, with bays; the sea goes on past the horizon's hills.
void TownDrawer::LayIsland() {
  constexpr int kPoints = 96;
  constexpr double kPower = 0.4, kShare = 0.95;  // of cosine and sine: a rounded rectangle; of the town's half sides
  const double phase = rng_.Uniform(0, 6.28);
  // From the south counter-clockwise: water is to the right.
  for (int i = 0; i < kPoints; ++i) {
    const double a = 6.283185 * (i - 0.25 * kPoints) / kPoints, c = std::cos(a), s = std::sin(a);
    const double r = kShare + 0.03 * std::sin(3 * a + phase) + 0.018 * std::sin(7 * a + 2 * phase);
    coast_.push_back(
        {x1_ * r * std::copysign(std::pow(std::abs(c), kPower), c), y1_ * r * std::copysign(std::pow(std::abs(s), kPower), s)});
  }
  AddArea(coast_, {{"natural", "coastline"}});
  const double out = kBeyond + 700;
  map_.wet = Subtract(Patches{{{{x0_ - out, y0_ - out}, {x1_ + out, y0_ - out}, {x1_ + out, y1_ + out}, {x0_ - out, y1_ + out}}, {}}},
                      Patches{{coast_, {}}});
  coast_.push_back(Vec2d(coast_.front()));
}

double DistanceToShore(const Patch& water, Vec2d p) {
  double nearest = DistanceToRing(water.outer, p);
  for (const Ring& hole : water.holes) nearest = std::min(nearest, DistanceToRing(hole, p));
  return nearest;
}

bool TownDrawer::IsWet(Vec2d p, double margin) const {
  for (const Patch& patch : map_.wet)
    if (Inside(patch, p) || (margin > 0 && DistanceToShore(patch, p) < margin)) return true;
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
  const bool sea = spec_.at_sea(), island = spec_.water == TownWater::kIsland, wild = spec_.paving == TownPaving::kDirt;
  if (sea) {
    // Along the coast, and to the land from it: north, or into the island.
    std::vector<Vec2d> walk, along;
    for (size_t i = 0; i < coast_.size(); ++i) {
      if (!map_.data.extent.Contains(coast_[i], 60)) continue;
      const size_t n = coast_.size() - 1;
      const Vec2d v = coast_[(i + 1) % n] - coast_[(i + n - 1) % n];
      along.push_back(island ? v * (1 / Length(v)) : Vec2d{1, 0});
      walk.push_back(coast_[i] + Vec2d{-along.back().y, along.back().x} * (spec_.harbour ? 5.5 : 12.0));
    }
    AddLine(walk, {{"highway", "pedestrian"}, {"width", "10"}, {"name", "Promenade"}, {"surface", "sett"}});
    if (!spec_.harbour) {
      std::vector<Vec2d> sand;
      for (Vec2d p : coast_)
        if (map_.data.extent.Contains(p, 60)) sand.push_back(p);
      // A band that closes would be one area with the island in it.
      const size_t part = island ? sand.size() / 4 : sand.size();
      for (size_t from = 0; from + 1 < sand.size(); from += part) {
        const std::vector<Vec2d> piece(sand.begin() + static_cast<std::ptrdiff_t>(from),
                                       sand.begin() + static_cast<std::ptrdiff_t>(std::min(from + part + 1, sand.size())));
        for (const Patch& patch : Band(piece, 7.2, 0)) AddArea(patch.outer, {{"natural", "beach"}});
      }
    }
    for (size_t i = 0; i + 1 < walk.size(); ++i)
      if (Inside_(walk[i], 2)) {
        const Vec2d t = along[i], inland{-t.y, t.x};
        AddNode(walk[i] + t * 6.0 - inland * 2.5, {{"amenity", "bench"}});
        if (spec_.palms || spec_.trees > 0.2) AddTree(walk[i] + inland * 3.6, 6, 8);
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
    if (left > 0 || !Inside_(a, island ? 0 : 12) || piers >= 8) continue;
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
      const double off = island ? 55 : 0;  // metres farther out
      const Vec2d p{rng_.Uniform(x0_, x1_), rng_.Uniform(y0_ - 20 - off, y0_ + 0.1 * spec_.depth - off)};
      if (IsWet(p, 0) && IsWet(p + Vec2d{0, 30}, 0)) AddSpot("boat", p, {1, 0}, 0);
    }
}

}  // namespace airsim360::internal
