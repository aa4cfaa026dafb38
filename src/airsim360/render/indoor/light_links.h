// What every surfel sees: the ways that light takes between the surfaces of rooms, the sky and what is outside.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "airsim360/render/indoor/plain_lamps.h"
#include "airsim360/render/indoor/surfels.h"

namespace airsim360::internal {

/// Places without surfels that surfels see, thinned out: their light is what it is, whatever happens in the rooms.
struct OutsidePlace {
  Vec3f p, n, albedo;
  Vec3f radiance;  ///< fixed part
};

/// A ray of a surfel, towards LinkDirection.
struct LightLink {
  uint32_t target;  ///< surfel, then outside places; kSky, kNothing
  uint16_t weight;  ///< share of the hemisphere's cosine that it stands for, in steps of LightLinks::unit
  uint8_t u, v;
  static constexpr uint32_t kSky = UINT32_MAX, kNothing = UINT32_MAX - 1;
};

/// The steps of links, by which their directions are kept.
struct LinkTable {
  float out[256], up[256], cosine[256], sine[256];
  LinkTable();
};
const LinkTable& LinkSteps();
/// The step of a number in [0, 1).
inline uint8_t LinkStep(float x) { return static_cast<uint8_t>(std::min(x, 0.99999f) * 256); }
/// Of the point ((u + 0.5) / 256, (v + 0.5) / 256): even density over points is a density as the cosine over the hemisphere of n.
inline Vec3f LinkDirection(const LinkTable& t, const Surfel& s, uint8_t u, uint8_t v) {
  return s.t * (t.out[u] * t.cosine[v]) + s.b * (t.out[u] * t.sine[v]) + s.n * t.up[u];
}

/// Where rays end.
struct Landing {
  uint32_t target;  ///< as LightLink, or kOutside
  float share;      ///< of light that panes and mirrors on the way leave
  Vec3f direction;  ///< at its end
  OutsidePlace outside;
  MetGlow glow;  ///< of the first surface met
  static constexpr uint32_t kOutside = UINT32_MAX - 2;
};

/// Sends rays from all over a surfel to the surfels of `coarse`. The first lamps.even of them meet lamps: they leave from where the
/// rays to lamps do, or the heuristic that weights both would lose the light of lamps that are near.
void SendRays(const IndoorWorld& world, const Reflectance& reflectance, const SurfelSet& coarse, const Surfel& from,
              std::span<const Vec2f> points, const LampMix& lamps, std::vector<Landing>& landings);

/// Where over the hemisphere most light comes from, in 16 x 16 cells of (u, v).
class LightGuide {
 public:
  static constexpr int kSide = 16, kCells = kSide * kSide;
  LightGuide() { density_.fill(1); }
  /// `sum` of radiance and `count` of rays by cell.
  LightGuide(const std::array<float, kCells>& sum, const std::array<float, kCells>& count);
  /// Density over (u, v), 1 on average.
  float Density(Vec2f point) const { return density_[CellOf(point)]; }
  /// `count` points with that density, evenly spread.
  void Sample(int count, Vec2f shift, std::vector<Vec2f>& points) const;
  static size_t CellOf(Vec2f point);

 private:
  std::array<float, kCells> density_;
};

/// Points in the unit square, `count` of them, stratified.
void SampleEvenly(int count, Vec2f shift, std::vector<Vec2f>& points);

}  // namespace airsim360::internal
