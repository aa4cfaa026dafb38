// What closes the view around a town in open country: woods, then ridges.
#include <algorithm>
#include <cmath>

#include "airsim360/math/angles.h"
#include "airsim360/worlds/texture/texture_synth.h"
#include "airsim360/worlds/town_maker/town_drawer.h"
#include "airsim360/worlds/town_maker/town_finisher.h"

namespace airsim360::internal {
void TownFinisher::FarWoods() {
  const bool forest = spec_.country == TownCountry::kForest;
  const double reach = forest ? 420 : 900;
  const int tries = static_cast<int>((forest ? 5200 : 2600) * std::max(1.0, spec_.trees));
  const OsmBox& e = scene_.data.extent;
  for (int i = 0; i < tries; ++i) {
    const Vec2d p{rng_.Uniform(e.x0 - reach, e.x1 + reach), rng_.Uniform(e.y0 - reach, e.y1 + reach)};
    const double out = std::max({e.x0 - p.x, p.x - e.x1, e.y0 - p.y, p.y - e.y1});
    const double keep = rng_.Uniform(), turn = rng_.Uniform(0, kTau);
    // In fields only groves and rows stand.
    const double grove = std::sin(p.x / 61) * std::sin(p.y / 47) + 0.5 * std::sin(p.x / 23 + p.y / 31);
    // Few trees are few all around.
    const double share = std::min(1.0, spec_.trees);
    if (out < 32 || (forest ? keep > (1.1 - out / reach) * share : grove < 0.72 || keep > share)) continue;
    bool wet = false;
    for (const Patch& patch : map_.wet) wet = wet || Inside(patch, p) || DistanceToShore(patch, p) < 6;
    if (wet) continue;
    const bool needles = forest ? rng_.Chance(0.86) : rng_.Chance(0.2);
    const auto scale = static_cast<float>(rng_.Uniform(0.75, 1.45));
    scene_.Put(forest ? "far forest tree" : "far tree", needles ? "tree_pine" : "tree_generic", scene_.On(p, -0.5), turn, scale,
               rng_.Index(6));
  }
}

// The country knows nothing of the map's river: a ribbon on it, from a low weir at the map's edge to the hills.
void TownFinisher::RiverBeyond() {
  constexpr double kOver = 0.04, kWeir = 0.4, kRise = 0.002;  // metres over the country, of the weir; rise a metre over coarse ground
  const OsmBox e = GroundBox(scene_.data);
  const auto out = [&](Vec2d p) { return std::max(e.x0 - p.x, p.x - e.x1); };
  const bool flat = scene_.relief.flat();
  const auto at = [&](size_t i, double hand, double lift) {
    const std::vector<Vec2d>& line = map_.river;
    Vec2d p = line[i];
    // The first cut lies on the edge.
    for (const size_t k : {i - 1, i + 1})
      if (k < line.size() && out(p) <= 0 && out(line[k]) > 0) p = p + (line[k] - p) * (-out(p) / (out(line[k]) - out(p)));
    const Vec2d v = line[std::min(i + 1, line.size() - 1)] - line[i > 0 ? i - 1 : 0];
    return At(p + Vec2d{-v.y, v.x} * (hand * map_.river_half / Length(v)), lift + (flat ? 0 : kRise * std::max(0.0, out(p))));
  };
  mesh_.SetTransform({});
  mesh_.SetEntity(scene_.builder.AddEntity("river beyond", scene_.builder.tree().At("water/lake")));
  mesh_.SetMaterial(scene_.surfaces[Surface::kWater]);
  for (size_t i = 0; i + 1 < map_.river.size(); ++i) {
    const double a = out(map_.river[i]), b = out(map_.river[i + 1]);
    if (a <= 0 && b <= 0) continue;
    const Vec3f p[4] = {at(i, -1, kOver), at(i + 1, -1, kOver), at(i + 1, 1, kOver), at(i, 1, kOver)};
    mesh_.QuadUv(p[0], p[1], p[2], p[3], {p[0].x, -p[0].y}, {p[1].x, -p[1].y}, {p[2].x, -p[2].y}, {p[3].x, -p[3].y});
    if (a <= 0) mesh_.Quad(at(i, 1, -kWeir), at(i, -1, -kWeir), p[0], p[3]);
    if (b <= 0) mesh_.Quad(at(i + 1, -1, -kWeir), at(i + 1, 1, -kWeir), p[2], p[1]);
  }
}

// Ridges on the horizon, each a band of hills, farther ones higher.
void TownFinisher::Ridges() {
  struct Row {
    double radius, width, height;
    Surface surface;
  };
  const bool forest = spec_.country == TownCountry::kForest;
  const Row rows[] = {{3100, 700, forest ? 190.0 : 90.0, Surface::kMountain},
                      {5200, 1000, forest ? 460.0 : 240.0, Surface::kMountainFar},
                      {8600, 1500, forest ? 900.0 : 480.0, Surface::kMountainFar}};
  constexpr int kAlong = 220, kAcross = 10;
  mesh_.SetTransform({});
  for (const Row& row : rows) {
    mesh_.SetEntity(scene_.builder.AddEntity("hills", scene_.builder.tree().At("nature/mountain")));
    mesh_.SetMaterial(scene_.surfaces[row.surface]);
    const auto seed = static_cast<uint32_t>(MixBits(scene_.options.seed + static_cast<uint64_t>(row.radius)));
    const auto at = [&](int i, int j) {
      const double a = kTau * (i % kAlong) / kAlong, t = 2.0 * j / kAcross - 1, r = row.radius + row.width * t;
      const auto u = static_cast<float>(a / kTau), v = static_cast<float>(0.5 + 0.2 * t);
      const auto crest = static_cast<double>(TilingFbm(seed, u, v, 9, 5));
      const double z = -40 + row.height * std::pow(std::max(0.0, 1 - t * t), 1.2) * std::max(0.12, 0.62 + 0.95 * crest);
      return Vec3f{static_cast<float>(r * std::cos(a)), static_cast<float>(r * std::sin(a)), static_cast<float>(z)};
    };
    const auto normal = [&](int i, int j) {
      const Vec3f n = Normalized(Cross(at(i, std::min(j + 1, kAcross)) - at(i, std::max(j - 1, 0)), at(i + 1, j) - at(i + kAlong - 1, j)));
      return n.z < 0 ? n * -1.0f : n;
    };
    const auto uv = [](Vec3f p) { return Vec2f{p.x, -p.y - p.z}; };
    for (int i = 0; i < kAlong; ++i)
      for (int j = 0; j < kAcross; ++j) {
        const Vec3f p[4] = {at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j)},
                    n[4] = {normal(i, j), normal(i, j + 1), normal(i + 1, j + 1), normal(i + 1, j)};
        mesh_.SmoothTriangle({p[0], p[1], p[2]}, {n[0], n[1], n[2]}, {uv(p[0]), uv(p[1]), uv(p[2])});
        mesh_.SmoothTriangle({p[0], p[2], p[3]}, {n[0], n[2], n[3]}, {uv(p[0]), uv(p[2]), uv(p[3])});
      }
  }
}

}  // namespace airsim360::internal
