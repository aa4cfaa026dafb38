// The International Standard Atmosphere (ISO 2533:1975) below 11 km, and its gravity.
#pragma once

namespace airsim360 {

struct Air {
  double temperature;  ///< K
  double pressure;     ///< Pa
  double density;      ///< kg/m^3
};

inline constexpr double kGravity = 9.80665;             ///< m/s^2 (ISO 80000-3), along -Z of W everywhere
inline constexpr double kSeaLevelTemperature = 288.15;  ///< K
inline constexpr double kSeaLevelPressure = 101325;     ///< Pa

/// Air at a height over sea level, metres, clamped to [-2000, 11000]; `sea_level_pressure` is the weather's
/// (QNH). Height and geopotential height are taken for the same (0.2 % apart at 11 km).
Air StandardAir(double height, double sea_level_pressure = kSeaLevelPressure);

/// Height at which StandardAir has this pressure: what an altimeter set to the QNH shows.
double PressureAltitude(double pressure, double sea_level_pressure = kSeaLevelPressure);

}  // namespace airsim360
