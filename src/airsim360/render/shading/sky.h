// The sky as a table: clear atmosphere, clouds, what lies below the horizon, and what surfaces need to know of all that.
#pragma once

#include <array>
#include <vector>

#include "airsim360/math/vector.h"
#include "airsim360/scene/scene.h"

namespace airsim360::internal {

/// A lat-long picture of directions: row r holds elevations from `SkyTable::ElevationOfRow`; texels are r, g, b, unused.
/// Column i is azimuth (i + 0.5) * 2 pi / width from +X towards +Y; one more column repeats the first, so that bilinear
/// look-up never wraps. The last row is the zenith.
struct SkyTable {
  int width = 0, height = 0;
  bool full_sphere = false;  ///< rows from nadir to zenith, linear in elevation; else from the horizon up, finer near it
  std::vector<float> texels;

  int stride() const { return width + 1; }
  float ElevationOfRow(int row) const;
  Vec3f Texel(int x, int y) const;
  void SetTexel(int x, int y, Vec3f c);
  /// Bilinear; below its lowest row the table repeats it.
  Vec3f At(Vec3f direction) const;
};

/// Elevation of the upper-hemisphere tables, as a share e of pi/2, is kSkyRowSlope * t + (1 - kSkyRowSlope) * t^2 of the row t.
inline constexpr float kSkyRowSlope = 0.6f;

/// Immutable, built once per daylight.
class Sky {
 public:
  static constexpr int kBlurLevels = 3;
  /// Roughness of the blurred tables; table 0 of roughness 0 is `table()`.
  static constexpr std::array<float, kBlurLevels> kBlurRoughness{0.30f, 0.55f, 0.85f};

  explicit Sky(const Daylight& daylight);

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
  /// Extinction of the air, 1 / m, and the light it adds at infinity: horizon_mean + horizon_x * dx + horizon_y * dy.
  Vec3f extinction() const { return extinction_; }
  Vec3f horizon_mean() const { return horizon_mean_; }
  Vec3f horizon_x() const { return horizon_x_; }
  Vec3f horizon_y() const { return horizon_y_; }
  /// Radiance of sunlit ground of average reflectance.
  Vec3f ground_radiance() const { return ground_radiance_; }

 private:
  void BakeTable(const Daylight& daylight);
  void BakeIrradiance();
  void BakeHorizon();
  void BakeBlurred();

  Vec3f to_sun_, sun_irradiance_, extinction_, horizon_mean_, horizon_x_, horizon_y_, ground_radiance_;
  SkyTable table_;
  std::array<SkyTable, kBlurLevels> blurred_;
  std::array<Vec3f, 9> sh_{};
};

}  // namespace airsim360::internal
