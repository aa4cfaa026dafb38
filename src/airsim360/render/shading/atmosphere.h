// Light of the clear sky and of the sun through the air.
#pragma once

#include <array>

#include "airsim360/math/vector.h"

namespace airsim360::internal {

/// Irradiance of the sun outside the atmosphere on a plane facing it, in the units of all radiance of `fast`:
/// linear sRGB of a camera balanced for daylight, so that ground in sun and sky comes out neutral. In
/// photometric terms 20 units of luminance are 133.3 klx.
inline constexpr Vec3f kSolarIrradiance{19.1f, 20.0f, 21.2f};
inline constexpr float kLuxPerUnit = 133300.0f / 20.0f;

/// Rayleigh, aerosol and ozone atmosphere over a sphere with one sun position, seen from near the ground.
/// Single scattering is integrated along each ray; all higher orders are the isotropic closed-form series of
/// Hillaire, "A Scalable and Production Ready Sky and Atmosphere Rendering Technique" (2020), tabulated over
/// height.
class Atmosphere {
 public:
  /// `to_sun` is a unit vector of W; `turbidity` is Linke's, 2 very clear … 10 hazy.
  Atmosphere(Vec3f to_sun, double turbidity);

  /// Radiance of the clear sky in a unit direction; below the horizon that of the horizon.
  Vec3f Radiance(Vec3f direction) const;
  /// Irradiance of the sun at the ground, on a plane facing it.
  Vec3f SunIrradiance() const { return sun_irradiance_; }
  /// Extinction of the air at the ground, 1 / m.
  Vec3f GroundExtinction() const;

 private:
  struct Medium {
    Vec3f rayleigh;    // scattering, 1 / m
    Vec3f aerosol;     // scattering, 1 / m
    Vec3f extinction;  // of both and ozone, 1 / m
  };
  Medium At(float height) const;
  Vec3f OpticalDepth(Vec3f p, Vec3f direction) const;
  Vec3f SunTransmittance(float height) const;
  Vec3f Scattered(Vec3f p, Vec3f direction, bool isotropic, Vec3f* multiple_factor) const;
  Vec3f MultipleAt(float height) const;

  static constexpr int kHeights = 48;
  Vec3f to_sun_;
  Vec3f aerosol_scattering_, aerosol_extinction_;  // at the ground
  Vec3f sun_irradiance_;
  std::array<Vec3f, kHeights> sun_transmittance_{};
  std::array<Vec3f, kHeights> multiple_{};  // radiance of all orders above the first, isotropic
};

}  // namespace airsim360::internal
