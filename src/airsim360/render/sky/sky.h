// The sky as tables: atmosphere, clouds, stars or a picture, what lies below the horizon, and what surfaces
// need to know of all that.
#pragma once

#include <array>
#include <vector>

#include "airsim360/math/vector.h"
#include "airsim360/render/shared/shading_data.h"
#include "airsim360/render/sky/cloud_shadow.h"
#include "airsim360/render/sky/sky_sampler.h"
#include "airsim360/render/sky/sky_table.h"
#include "airsim360/scene/scene.h"

namespace airsim360::internal {

/// The sun as a light: a disc of even mean radiance (darker towards its limb when seen, see SunDisc in
/// light_kernel.cc). At night it is the moon. Black where neither shines.
struct SunLight {
  Vec3f direction;       ///< unit, towards its centre
  float angular_radius;  ///< radians
  Vec3f radiance;        ///< mean over the disc
  Vec3f irradiance;      ///< on a plane facing it, outside of cloud shadows
};

/// Immutable, built once per environment.
class Sky {
 public:
  static constexpr int kBlurLevels = 3;
  /// Roughness of the blurred tables; table 0 of roughness 0 is `table()`.
  static constexpr std::array<float, kBlurLevels> kBlurRoughness{0.30f, 0.55f, 0.85f};

  /// Black, to be filled by Visit.
  Sky() = default;
  /// `place` (in W) stands in the sun between the clouds, and fog lies on its height. `like`, if not null: a sky over the same
  /// place whose environment differs in haze, visibility, rain, falling and lying snow and wetness alone; its table is taken.
  /// `town`: how much light the lamps around send up while they burn, 1 = as in a large city (TownLight).
  explicit Sky(const Environment& environment, Vec3f place = {}, const Sky* like = nullptr, float town = 1);

  // ---- the directional light
  Vec3f to_sun() const { return to_sun_; }
  /// On a plane facing the sun.
  Vec3f sun_irradiance() const { return sun_irradiance_; }
  /// Mean radiance of the sun's disc (0.53 degrees wide); darker towards the limb.
  Vec3f sun_radiance() const;
  SunLight sun() const;
  /// Whether the light is the moon's, and the direction from there to the sun: its lit limb looks to where the sun stands.
  bool is_moon() const { return moon_light_ != Vec3f{}; }
  Vec3f moon_light() const { return moon_light_; }
  /// Share of the sun's disc that is seen from the place through the clouds: exp(-depth), while light from about it counts as direct
  /// on surfaces, see Clouds::SunAt.
  float sun_seen() const;
  /// Share of the sun's light that clouds leave at a point of W, (0, 1].
  float CloudShadow(Vec3f p) const { return cloud_shadow_.At(p); }
  const CloudShadowMap& cloud_shadow() const { return cloud_shadow_; }

  // ---- the sky without the sun's disc
  const SkyTable& table() const { return table_; }
  /// What lies below the horizon in a sky picture (mirrored: the row of elevation e holds -e); empty else.
  const SkyTable& below() const { return below_; }
  const SkyTable& blurred(int level) const { return blurred_[level]; }
  /// Radiance from the ground; below the horizon far sunlit ground in haze, or the sky picture.
  Vec3f Radiance(Vec3f direction) const;
  /// A direction for u in [0, 1)^2 with density about proportional to Radiance, over the whole sphere.
  SkySample Sample(Vec2f u) const;
  /// Density per solid angle with which Sample gives this direction.
  float Pdf(Vec3f direction) const { return sampler_.Pdf(direction); }
  const SkySampler& sampler() const { return sampler_; }

  // ---- light on surfaces
  /// Irradiance coefficients of the upper hemisphere in the order of sh9_irradiance (shading_shared.h).
  const std::array<Vec3f, 9>& irradiance_sh() const { return sh_; }
  Vec3f Irradiance(Vec3f normal) const;
  /// Radiance of sunlit ground of average reflectance.
  Vec3f ground_radiance() const { return ground_radiance_; }
  /// Illuminance of level open ground by everything above, in units (1 unit = kLuxPerUnit lux).
  float GroundIlluminance() const;

  // ---- the air
  /// For the kernels and shading_air.h.
  const AirView& air() const { return air_; }
  /// `light` that starts at `origin + direction * distance`, seen from `origin`: less what the air takes,
  /// plus what it adds. INFINITY: light of the sky, which fog and rain alone still change.
  Vec3f ThroughAir(Vec3f origin, Vec3f direction, float distance, Vec3f light) const;
  /// Extinction of clear air at the ground, 1 / m.
  Vec3f extinction() const { return extinction_; }

  /// All fields, for the disk cache.
  template <class Archive, class Self>
  static void Visit(Archive& archive, Self& s) {
    archive(s.place_, s.to_sun_, s.sun_irradiance_, s.clear_sun_, s.extinction_, s.ground_radiance_, s.sun_radius_, s.moon_light_);
    SkyTable::Visit(archive, s.table_);
    SkyTable::Visit(archive, s.below_);
    for (auto& level : s.blurred_) SkyTable::Visit(archive, level);
    archive(s.sh_, s.clear_sh_, s.air_);
    CloudShadowMap::Visit(archive, s.cloud_shadow_);
    SkySampler::Visit(archive, s.sampler_);
  }

 private:
  void BakeSky(const Environment& environment);
  void BakePicture(const Environment& environment);
  void TakeTable(const Sky& like);
  void BakeIrradiance();
  void BakeGround();
  void BakeAir(const Environment& environment);
  void BakeWeather(const Environment& environment);
  void BakeBlurred();
  void BakeSampler();

  Vec3f place_, to_sun_, sun_irradiance_, extinction_, ground_radiance_;
  Vec3f clear_sun_;  // irradiance before weather
  Vec3f moon_light_;
  float sun_radius_ = 0;
  float town_ = 0;  // while baking: what the lamps send up, 0 while they are off
  SkyTable table_, below_;
  std::array<SkyTable, kBlurLevels> blurred_;
  std::array<Vec3f, 9> sh_{}, clear_sh_{};  // with and before weather
  AirView air_{};
  CloudShadowMap cloud_shadow_;
  SkySampler sampler_;
};

}  // namespace airsim360::internal
