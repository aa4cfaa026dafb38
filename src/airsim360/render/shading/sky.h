// The sky as a table: clear atmosphere, clouds, what lies below the horizon, and what surfaces need to know
// of all that.
#pragma once

#include <array>
#include <vector>

#include "airsim360/math/vector.h"
#include "airsim360/render/shading/sky_table.h"
#include "airsim360/scene/scene.h"

namespace airsim360::internal {

/// Immutable, built once per environment.
class Sky {
 public:
  static constexpr int kBlurLevels = 3;
  /// Roughness of the blurred tables; table 0 of roughness 0 is `table()`.
  static constexpr std::array<float, kBlurLevels> kBlurRoughness{0.30f, 0.55f, 0.85f};

  explicit Sky(const Environment& environment);

  Vec3f to_sun() const { return to_sun_; }
  /// On a plane facing the sun.
  Vec3f sun_irradiance() const { return sun_irradiance_; }
  /// Mean radiance of the sun's disc (0.53 degrees wide); darker towards the limb.
  Vec3f sun_radiance() const;
  const SkyTable& table() const { return table_; }
  const SkyTable& blurred(int level) const { return blurred_[level]; }
  /// Irradiance coefficients of the upper hemisphere in the order of sh9_irradiance (shading_shared.h).
  const std::array<Vec3f, 9>& irradiance_sh() const { return sh_; }
  Vec3f Irradiance(Vec3f normal) const;
  /// Radiance without the sun's disc; below the horizon far sunlit ground in haze.
  Vec3f Radiance(Vec3f direction) const;
  /// Extinction of the air, 1 / m, and the light it adds at infinity: horizon_mean + horizon_x * dx +
  /// horizon_y * dy.
  Vec3f extinction() const { return extinction_; }
  Vec3f horizon_mean() const { return horizon_mean_; }
  Vec3f horizon_x() const { return horizon_x_; }
  Vec3f horizon_y() const { return horizon_y_; }
  /// Radiance of sunlit ground of average reflectance.
  Vec3f ground_radiance() const { return ground_radiance_; }

 private:
  void BakeTable(const Environment& environment);
  void BakeIrradiance();
  void BakeHorizon();
  void BakeBlurred();

  Vec3f to_sun_, sun_irradiance_, extinction_, horizon_mean_, horizon_x_, horizon_y_, ground_radiance_;
  SkyTable table_;
  std::array<SkyTable, kBlurLevels> blurred_;
  std::array<Vec3f, 9> sh_{};
};

}  // namespace airsim360::internal
