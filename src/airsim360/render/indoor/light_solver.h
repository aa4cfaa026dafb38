// The light of rooms from their surfels: direct light, then as many bounces as matter.
#pragma once

#include <memory>
#include <unordered_map>
#include <vector>

#include "airsim360/render/indoor/light_links.h"

namespace airsim360::internal {

struct IndoorOptions {
  float cell = 0;      ///< m, of the coarse level; 0 = by the area: 0.12 m in homes, more in halls
  int rays = 128;      ///< of a coarse surfel by the cosine, and as many by where light comes from
  int fine_rays = 32;  ///< likewise of a fine surfel
  int lamp_rays = 96;
  bool fine = true;
};

/// Light of a level's surfels, by surfel.
struct LevelLight {
  std::vector<Vec3f> light;                    ///< irradiance but for sun and lamps of the grid
  std::vector<Vec3f> lamps;                    ///< of the lamps of the grid
  std::vector<float> variance, lamp_variance;  ///< of the luminances of `light` and `lamps`
  std::vector<float> mean;                     ///< integral of luminance over the hemisphere …
  std::vector<Vec3f> bend;                     ///< … and of luminance times direction
  std::vector<float> open;                     ///< share of the cosine from where the sky is seen
};

/// Immutable once made. The same with any number of threads.
class LightSolver {
 public:
  LightSolver(const IndoorWorld& world, const Enclosure& enclosure, const IndoorOptions& options);
  LightSolver(const IndoorWorld& world, const std::vector<SurfacePiece>& pieces, const IndoorOptions& options);

  const SurfelSet& coarse() const { return coarse_; }
  const LevelLight& coarse_light() const { return coarse_light_; }
  const SurfelSet* fine() const { return fine_.get(); }
  const LevelLight& fine_light() const { return fine_light_; }
  /// Radiance of the coarse surfels.
  std::vector<Vec3f> Radiances() const { return {radiance_.begin(), radiance_.begin() + static_cast<int64_t>(coarse_.surfels().size())}; }
  /// Calls each(target, share) for the links of a coarse surfel: shares of its hemisphere's cosine, 1 in all.
  template <class Each>
  void ForLinks(uint32_t surfel, const Each& each) const {
    const auto rays = static_cast<size_t>(2 * options_.rays);
    for (size_t k = surfel * rays; k < (surfel + 1) * rays; ++k)
      each(links_[k].target, static_cast<double>(links_[k].weight) / (65535.0 * options_.rays));
  }
  /// Share of the rays that ended at surfaces without surfels and inside of things.
  double lost() const { return lost_; }

 private:
  struct Sum;
  void FindLamps();
  void TraceEven();
  void TraceGuided();
  void AddOutside(std::vector<std::vector<std::pair<size_t, OutsidePlace>>>& found);
  void FindDirect();
  void Bounce(int most);
  void Finish();
  void MakeFine(std::span<const SurfacePiece> pieces);
  /// What fine surfels near one coarse one share.
  struct KeptGuides {
    std::unordered_map<uint32_t, LightGuide> light;
    std::unordered_map<uint32_t, LampGuide> lamps;
  };
  void LightFine(size_t i, KeptGuides& kept);
  /// Of the lamps that a coarse surfel and its neighbours have found.
  LampGuide LampsNear(uint32_t at) const;
  /// For a surfel near the coarse one `at`, of what its neighbours see; `own`: and of what that one sees.
  LightGuide GuideOf(const Surfel& surfel, uint32_t at, bool own) const;
  /// The same. Those of surfels that face as the coarse one does are kept: many fine ones beside each other share one.
  LightGuide KeptGuide(const Surfel& surfel, uint32_t at, std::unordered_map<uint32_t, LightGuide>& kept) const;
  std::vector<uint8_t> NeedFine() const;
  /// Rays to lamps of a fine surfel near a coarse one.
  int FineLampRays(uint32_t near) const;
  Vec3f RadianceOutside(const OutsidePlace& place, size_t seed) const;
  Vec3f Seen(uint32_t target, const Surfel& from, const LightLink& link) const;
  struct Plane {
    std::vector<float> neighbours, variance, lamp_variance;  ///< by surfel
  };
  Plane PlaneOf(const SurfelSet& set, int step, const LevelLight& light) const;
  void Smooth(const SurfelSet& set, int passes, LevelLight& light) const;
  uint16_t WeightOf(float share) const;

  const IndoorWorld& world_;
  IndoorOptions options_;
  Reflectance reflectance_;
  PlainLamps plain_;
  SurfelSet coarse_;
  std::vector<LightLink> links_;               ///< 2 x rays a surfel
  std::vector<std::vector<FoundLamp>> found_;  ///< by coarse surfel
  std::vector<Vec3f> direct_;                  ///< irradiance of sun and lamps, by coarse surfel
  std::vector<Vec3f> others_;                  ///< of it, lamps that the grid does not hold
  std::vector<Vec3f> radiance_;                ///< by target
  std::vector<float> bright_;                  ///< luminance along the first half of links
  LevelLight coarse_light_, fine_light_;
  std::unique_ptr<SurfelSet> fine_;
  double lost_ = 0;
};

}  // namespace airsim360::internal
