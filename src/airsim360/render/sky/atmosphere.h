// Light of the clear sky and of the sun through the air.
#pragma once

#include <vector>

#include "airsim360/math/vector.h"

namespace airsim360::internal {

/// Irradiance of the sun outside the atmosphere on a plane facing it, in the units of all radiance of `fast`:
/// linear sRGB of a camera balanced for daylight, so that ground in sun and sky comes out neutral. In
/// photometric terms 20 units of luminance are 133.3 klx.
inline constexpr Vec3f kSolarIrradiance{19.1f, 20.0f, 21.2f};
inline constexpr float kLuxPerUnit = 133300.0f / 20.0f;
inline constexpr float kRayleighHeight = 8000, kAerosolHeight = 1400;  ///< scale heights, m

/// Extinction of clear air at the ground, 1 / m.
struct ClearAir {
  Vec3f rayleigh, aerosol;
  /// `turbidity` is Linke's, 2 very clear … 10 hazy.
  explicit ClearAir(double turbidity);
};

/// Rayleigh, aerosol and ozone atmosphere over a sphere with one sun position, seen from near the ground.
/// Single scattering is integrated along each ray, with the sun's height over the horizon of each place (so
/// that dusk is right); all higher orders are the isotropic closed-form series of Hillaire, "A Scalable and
/// Production Ready Sky and Atmosphere Rendering Technique" (2020), tabulated over height and sun.
class Atmosphere {
 public:
  /// `to_sun` is a unit vector of W; `turbidity` is Linke's, 2 very clear … 10 hazy.
  Atmosphere(Vec3f to_sun, double turbidity);
  /// The same air with the sun elsewhere; cheap.
  Atmosphere WithSun(Vec3f to_sun) const;

  /// Radiance of the clear sky in a unit direction; below the horizon that of the horizon.
  Vec3f Radiance(Vec3f direction) const;
  /// Irradiance of the sun near the ground, on a plane facing it; `height` in metres above it.
  Vec3f SunIrradiance(float height = 60) const;
  /// Extinction of the air at the ground, 1 / m.
  Vec3f GroundExtinction() const { return air_.rayleigh + air_.aerosol; }

 private:
  struct Medium {
    Vec3f rayleigh;    // scattering, 1 / m
    Vec3f aerosol;     // scattering, 1 / m
    Vec3f extinction;  // of both and ozone, 1 / m
  };
  Medium At(float height) const;
  Vec3f OpticalDepth(Vec3f p, Vec3f direction) const;
  void TabulateSun();
  void TabulateMultiple();
  Vec3f SunTransmittance(float height, float mu) const;
  Vec3f MultipleAt(float height, float mu) const;
  Vec3f Scattered(Vec3f p, Vec3f direction, Vec3f to_sun, bool isotropic, Vec3f* multiple_factor) const;

  Vec3f to_sun_;
  ClearAir air_;
  std::vector<Vec3f> sun_transmittance_;  // rows of heights, columns of the sun's cosine
  std::vector<Vec3f> multiple_;           // radiance of all orders above the first, isotropic
};

}  // namespace airsim360::internal
