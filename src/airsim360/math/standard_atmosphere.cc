#include "airsim360/math/standard_atmosphere.h"

#include <algorithm>
#include <cmath>

namespace airsim360 {
namespace {

constexpr double kLapse = 0.0065;                                 // K/m
constexpr double kGasConstant = 287.05287;                        // J/(kg K), of dry air
constexpr double kExponent = kGravity / (kLapse * kGasConstant);  // 5.2559

}  // namespace

Air StandardAir(double height, double sea_level_pressure) {
  const double temperature = kSeaLevelTemperature - kLapse * std::clamp(height, -2000.0, 11000.0);
  const double pressure = sea_level_pressure * std::pow(temperature / kSeaLevelTemperature, kExponent);
  return {temperature, pressure, pressure / (kGasConstant * temperature)};
}

double PressureAltitude(double pressure, double sea_level_pressure) {
  return kSeaLevelTemperature / kLapse * (1 - std::pow(pressure / sea_level_pressure, 1 / kExponent));
}

}  // namespace airsim360
