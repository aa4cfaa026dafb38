// The state of sun, sky and weather: everything about a world's light and air that a user may change without
// building the world again.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "airsim360/image/image.h"

namespace airsim360 {

/// When a world's lamps (street lamps, windows, head lights: materials with `lamp`) shine.
enum class Lamps { kAuto, kOn, kOff };  ///< kAuto: while the sun is lower than 3 degrees
inline constexpr const char* kLampsNames[] = {"auto", "on", "off"};

/// What the low clouds are (WMO International Cloud Atlas). kAuto: by their cover; humilis, mediocris, broken, stratus.
enum class CloudType { kAuto, kHumilis, kMediocris, kCongestus, kStratocumulus, kStratus };
inline constexpr const char* kCloudTypeNames[] = {"auto", "humilis", "mediocris", "congestus", "stratocumulus", "stratus"};

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
  double haze = 1;                ///< clear air between viewer and surfaces: 1 as dense as it is, 0 none
  double cloud_cover = 0.35;      ///< of the low clouds: 0 none … 1 overcast
  double altocumulus_cover = 0;   ///< fleecy cloud of middle height, 0 … 1
  double cirrus_cover = 0.3;      ///< thin high cloud, 0 … 1
  double cloud_base_m = 0;        ///< of the low clouds above the ground; 0 = as usual for their type
  double sky_seed = 0;            ///< draws the clouds, a whole number; 0 = the world's own (SkySeedOf)
  double visibility_m = 0;        ///< meteorological range (contrast 0.05) of fog; 0 = clear air alone
  double wetness = 0;             ///< of upward surfaces, 0 dry … 1 wet with puddles
  double snow_depth = 0;          ///< lying snow, 0 none … 1 everything that faces up is white
  double rain_mm_h = 0;           ///< drops in the air; does not set wetness by itself
  double snowfall_mm_h = 0;       ///< flakes in the air (water equivalent)
  Lamps lamps = Lamps::kAuto;
  CloudType cloud_type = CloudType::kAuto;
  std::shared_ptr<const SkyPicture> hdri = nullptr;  ///< replaces sky, clouds and sun where set
  double hdri_yaw_deg = 0;
  double hdri_scale = 1;  ///< from the picture's units to ours
  double moon_azimuth_deg = 130, moon_elevation_deg = 38;
  double moon_phase = 1;  ///< lit share of its disc, 0 new … 1 full; matters once the sun is down

  bool lamps_on() const { return lamps == Lamps::kOn || (lamps == Lamps::kAuto && sun_elevation_deg < 3); }
};

/// InputError "`name` is 120, not in 0 … 1; the nearest is 1" for the first value out of its range; `where`
/// (a flag, or file:line) starts the message.
void ValidateEnvironment(const Environment& environment, std::string_view where);

/// One number of an environment: what files, flags and checks call it, and what it may be.
struct EnvironmentField {
  const char* name;
  const char* help;
  double Environment::*value;
  double low, high;
};
const std::vector<EnvironmentField>& EnvironmentFields();

/// A named state of sun, sky and weather ("day", "sunset", "fog", "rain", …), laid over `base`: sets all of
/// light and weather but keeps the base's turbidity, haze, moon, picture and sky
/// seed. InputError naming the nearest.
Environment ParseEnvironmentPreset(std::string_view name, const Environment& base = {});
std::vector<std::string> EnvironmentPresetNames();

/// A named state of the clouds alone ("clear", "humilis", "broken", "overcast", "haze", …), laid over `base`: their type,
/// covers and base; "haze" sets turbidity too. InputError naming the nearest.
Environment ParseCloudPreset(std::string_view name, const Environment& base = {});
std::vector<std::string> CloudPresetNames();

/// The sky_seed of a world that says none: 1 … 2^32 - 1, by its name and seed.
double SkySeedOf(std::string_view world, uint64_t seed);

/// "name=value,…" of everything that differs from the default, for meta.json; "" = the default.
std::string DescribeEnvironment(const Environment& environment);

}  // namespace airsim360
