#include "airsim360/worlds/town_maker/town_relief.h"

#include <algorithm>
#include <cmath>

#include "airsim360/base/random.h"
#include "airsim360/math/geodesy.h"
#include "airsim360/worlds/texture/texture_synth.h"
#include "airsim360/worlds/town_maker/town_drawer.h"

namespace airsim360::internal {
namespace {

constexpr double kAround = 1200, kCell = 14, kNoiseTile = 4096;  // metres

double Smooth(double t) {
  t = std::clamp(t, 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

class Heights {
 public:
  Heights(const TownSpec& spec, uint64_t seed, const TownMap& map) : spec_(spec), seed_(static_cast<uint32_t>(MixBits(seed))), map_(map) {}

  double At(Vec2d p) const {
    double h = spec_.climb * Shape(p);
    // Hills beyond the town.
    const double out = std::max({std::abs(p.x) - spec_.width / 2, std::abs(p.y) - spec_.depth / 2, 0.0});
    if (out > 0) h += (60 + spec_.climb) * Smooth((out - 60) / 900) * std::max(0.0, 0.45 + 0.9 * Noise(p, 11));
    // The sides of a valley go on rising: a town alone is too small for one that is seen from above.
    if (spec_.relief == TownRelief::kValley) h += (60 + 1.5 * spec_.climb) * Smooth((std::abs(p.y) - spec_.depth / 2) / 560);
    return h * Smooth((Shore(p) - 8) / 85);
  }

 private:
  double Noise(Vec2d p, int period) const {
    const auto wrap = [](double v) { return static_cast<float>(v / kNoiseTile - std::floor(v / kNoiseTile)); };
    return static_cast<double>(TilingFbm(seed_, wrap(p.x + 31), wrap(p.y + 77), period, 3));
  }

  // 0 … 1 over the town.
  double Shape(Vec2d p) const {
    const double w = spec_.width / 2, d = spec_.depth / 2;
    const double soft = 0.08 * Noise(p, 29);
    switch (spec_.relief) {
      case TownRelief::kFlat:
        return 0;
      case TownRelief::kRolling:
        return 0.5 + 0.6 * Noise(p, 19);
      case TownRelief::kSlope:
        return Smooth(0.5 + 0.42 * std::clamp(p.y / d, -1.2, 1.2)) + soft;
      case TownRelief::kHill:
        return Smooth(1 - std::hypot((p.x + 0.12 * w) / (1.25 * w), (p.y - 0.35 * d) / (1.25 * d))) + soft;
      case TownRelief::kValley:
        return Smooth(std::min(1.0, std::abs(p.y) / (1.15 * d))) + soft;
    }
    return 0;
  }

  // Metres to the nearest water: 0 in it.
  double Shore(Vec2d p) const {
    double nearest = 1e9;
    for (const Patch& patch : map_.wet) {
      if (Inside(patch, p)) return 0;
      nearest = std::min(nearest, DistanceToShore(patch, p));
    }
    return nearest;
  }

  const TownSpec& spec_;
  uint32_t seed_;
  const TownMap& map_;
};

}  // namespace

HeightGrid ReliefOf(const TownSpec& spec, uint64_t seed, const TownMap& map) {
  if (spec.relief == TownRelief::kFlat || spec.climb <= 0) return {};
  const GeoFrame frame(map.data.origin);
  const double x0 = -spec.width / 2 - kAround, x1 = -x0, y0 = -spec.depth / 2 - kAround, y1 = -y0;
  HeightGrid grid;
  grid.columns = static_cast<int>((x1 - x0) / kCell);
  grid.rows = static_cast<int>((y1 - y0) / kCell);
  const GeoPoint low = frame.ToGeodetic({x0, y0, 0}), high = frame.ToGeodetic({x1, y1, 0});
  grid.longitude_west = low.longitude_deg;
  grid.latitude_north = high.latitude_deg;
  grid.cell_lon = (high.longitude_deg - low.longitude_deg) / grid.columns;
  grid.cell_lat = (high.latitude_deg - low.latitude_deg) / grid.rows;
  const Heights heights(spec, seed, map);
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column)
      grid.heights.push_back(
          static_cast<float>(heights.At({x0 + (x1 - x0) * (column + 0.5) / grid.columns, y1 - (y1 - y0) * (row + 0.5) / grid.rows})));
  return grid;
}

}  // namespace airsim360::internal
