// The state of sun, sky and weather: everything about a world's light and air that a user may change without
// building the world again.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "airsim360/image/image.h"

namespace airsim360 {

/// When a world's lamps (street lamps, windows, head lights: materials with `lamp`) shine.
enum class Lamps { kAuto, kOn, kOff };  ///< kAuto: while the sun is lower than 3 degrees
inline constexpr const char* kLampsNames[] = {"auto", "on", "off"};

/// A picture of a whole sky in linear light, for Environment::hdri. Row 0 is the zenith side; the image
/// centre looks north (+Y) before `yaw_deg` turns it clockwise.
struct SkyPicture {
  std::string name;  ///< of its file, for messages and meta.json
  Image<Rgb32f> pixels;
};

/// Default: a clear early afternoon, dry. Every value has a physical meaning; out of range ones are refused
/// by ValidateEnvironment.
struct Environment {
  double sun_azimuth_deg = 215;   ///< compass, clockwise from north
  double sun_elevation_deg = 48;  ///< -90 … 90; below the horizon it is dusk, then night
  double turbidity = 2.5;         ///< Linke's: 2 very clear … 10 hazy
  double cloud_cover = 0.35;      ///< cumulus: 0 none … 1 overcast
  double cirrus_cover = 0.3;      ///< thin high cloud, 0 … 1
  double visibility_m = 0;        ///< meteorological range (contrast 0.05) of fog; 0 = clear air alone
  double wetness = 0;             ///< of upward surfaces, 0 dry … 1 wet with puddles
  double snow_depth = 0;          ///< lying snow, 0 none … 1 everything that faces up is white
  double rain_mm_h = 0;           ///< drops in the air; does not set wetness by itself
  double snowfall_mm_h = 0;       ///< flakes in the air (water equivalent)
  Lamps lamps = Lamps::kAuto;
  std::shared_ptr<const SkyPicture> hdri;  ///< replaces sky, clouds and sun where set
  double hdri_yaw_deg = 0;
  double hdri_scale = 1;  ///< from the picture's units to ours

  bool lamps_on() const { return lamps == Lamps::kOn || (lamps == Lamps::kAuto && sun_elevation_deg < 3); }
};

}  // namespace airsim360
