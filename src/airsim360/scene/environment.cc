#include "airsim360/scene/environment.h"

#include <algorithm>
#include <cmath>

#include "airsim360/base/error.h"
#include "airsim360/base/random.h"
#include "airsim360/base/text.h"

namespace airsim360 {
namespace {

/// Light and weather of a preset.
struct Preset {
  const char* name;
  double azimuth, elevation, cloud_cover, cirrus_cover, visibility, wetness, snow_depth, rain, snowfall;
};
constexpr Preset kPresets[] = {
    {"day", 215, 48, 0.35, 0.3, 0, 0, 0, 0, 0},     {"clear", 215, 48, 0, 0, 0, 0, 0, 0, 0},
    {"morning", 105, 22, 0.25, 0.4, 0, 0, 0, 0, 0}, {"golden", 262, 9, 0.3, 0.5, 0, 0, 0, 0, 0},
    {"sunset", 285, 1.5, 0.3, 0.6, 0, 0, 0, 0, 0},  {"dusk", 290, -4, 0.2, 0.4, 0, 0, 0, 0, 0},
    {"night", 330, -25, 0.15, 0.2, 0, 0, 0, 0, 0},  {"overcast", 200, 40, 1, 0, 0, 0, 0, 0, 0},
    {"fog", 150, 28, 0.6, 0, 180, 0.2, 0, 0, 0},    {"mist", 110, 16, 0.2, 0.3, 1500, 0.1, 0, 0, 0},
    {"rain", 200, 32, 1, 0, 4000, 1, 0, 6, 0},      {"storm", 200, 25, 1, 0, 1500, 1, 0, 30, 0},
    {"snow", 190, 24, 1, 0, 0, 0.1, 0.8, 0, 1.5},   {"winter", 190, 22, 0.25, 0.4, 0, 0, 0.9, 0, 0},
};

/// The clouds of a word. Covers as observers of the type report them when it is there (Warren, Eastman & Hahn 2007).
struct CloudPreset {
  const char* name;
  CloudType type;
  double cover, altocumulus, cirrus, turbidity;  // turbidity 0: as it was
};
constexpr CloudPreset kCloudPresets[] = {
    {"clear", CloudType::kAuto, 0, 0, 0, 0},
    {"haze", CloudType::kAuto, 0, 0, 0.1, 7},
    {"humilis", CloudType::kHumilis, 0.2, 0, 0, 0},
    {"mediocris", CloudType::kMediocris, 0.32, 0, 0.15, 0},
    {"congestus", CloudType::kCongestus, 0.35, 0, 0.2, 0},
    {"stratocumulus", CloudType::kStratocumulus, 0.75, 0, 0, 0},
    {"altocumulus", CloudType::kAuto, 0, 0.55, 0.2, 0},
    {"cirrus", CloudType::kAuto, 0, 0, 0.65, 0},
    {"broken", CloudType::kAuto, 0.7, 0.15, 0.2, 0},
    {"overcast", CloudType::kStratus, 1, 0, 0, 0},
};

}  // namespace

const std::vector<EnvironmentField>& EnvironmentFields() {
  using E = Environment;
  static const std::vector<EnvironmentField> fields = {
      {"sun_azimuth_deg", "of the sun, compass, clockwise from north", &E::sun_azimuth_deg, -360, 360},
      {"sun_elevation_deg", "of the sun over the horizon", &E::sun_elevation_deg, -90, 90},
      {"turbidity", "Linke's: 2 very clear, 10 hazy", &E::turbidity, 1.8, 10},
      {"haze", "clear air before surfaces: 1 as dense as it is, 0 none", &E::haze, 0, 10},
      {"cloud_cover", "of the low clouds: 0 none, 1 overcast", &E::cloud_cover, 0, 1},
      {"altocumulus_cover", "fleecy cloud of middle height, 0 to 1", &E::altocumulus_cover, 0, 1},
      {"cirrus_cover", "thin high cloud, 0 to 1", &E::cirrus_cover, 0, 1},
      {"cloud_base_m", "of the low clouds above the ground; 0 = usual for their type", &E::cloud_base_m, 0, 4000},
      {"sky_seed", "draws the clouds, a whole number; 0 = the world's own", &E::sky_seed, 0, 4294967295.0},
      {"visibility_m", "range at which fog leaves a contrast of 0.05; 0 = clear", &E::visibility_m, 0, 1e6},
      {"wetness", "of upward surfaces: 0 dry, 1 wet with puddles", &E::wetness, 0, 1},
      {"snow_depth", "lying snow: 0 none, 1 everything that faces up", &E::snow_depth, 0, 1},
      {"rain_mm_h", "drops in the air", &E::rain_mm_h, 0, 150},
      {"snowfall_mm_h", "flakes in the air, as water", &E::snowfall_mm_h, 0, 15},
      {"hdri_yaw_deg", "turns the sky picture clockwise", &E::hdri_yaw_deg, -360, 360},
      {"hdri_scale", "from the sky picture's units to ours", &E::hdri_scale, 1e-6, 1e6},
      {"moon_azimuth_deg", "of the moon, compass", &E::moon_azimuth_deg, -360, 360},
      {"moon_elevation_deg", "of the moon over the horizon", &E::moon_elevation_deg, -90, 90},
      {"moon_phase", "lit share of the moon: 0 new, 1 full", &E::moon_phase, 0, 1},
  };
  return fields;
}

void ValidateEnvironment(const Environment& environment, std::string_view where) {
  for (const EnvironmentField& field : EnvironmentFields()) {
    const double value = environment.*field.value;
    if (value >= field.low && value <= field.high) continue;
    const double nearest = std::isnan(value) ? Environment{}.*field.value : std::clamp(value, field.low, field.high);
    throw InputError(std::string(where) + ": " + field.name + " is " + ShortestText(value) + ", not in " + ShortestText(field.low) + " … " +
                     ShortestText(field.high) + "; the nearest is " + ShortestText(nearest));
  }
  if (environment.sky_seed != std::floor(environment.sky_seed)) {
    throw InputError(std::string(where) + ": sky_seed is " + ShortestText(environment.sky_seed) + ", not a whole number; the nearest is " +
                     ShortestText(std::round(environment.sky_seed)));
  }
  constexpr double kLowest = 100;  // below it a cloud is fog
  if (environment.cloud_base_m > 0 && environment.cloud_base_m < kLowest) {
    throw InputError(std::string(where) + ": cloud_base_m is " + ShortestText(environment.cloud_base_m) +
                     ", neither 0 (usual) nor at least 100; the nearest is 100");
  }
  constexpr double kThickest = 20;  // metres; a ray would see nothing else
  if (environment.visibility_m > 0 && environment.visibility_m < kThickest) {
    throw InputError(std::string(where) + ": visibility_m is " + ShortestText(environment.visibility_m) +
                     ", neither 0 (clear) nor at least 20; the nearest is 20");
  }
}

Environment ParseEnvironmentPreset(std::string_view name, const Environment& base) {
  for (const Preset& preset : kPresets) {
    if (preset.name != name) continue;
    Environment e = base;
    e.sun_azimuth_deg = preset.azimuth, e.sun_elevation_deg = preset.elevation;
    e.cloud_type = CloudType::kAuto, e.cloud_base_m = 0;
    e.cloud_cover = preset.cloud_cover, e.altocumulus_cover = 0, e.cirrus_cover = preset.cirrus_cover;
    e.visibility_m = preset.visibility, e.wetness = preset.wetness, e.snow_depth = preset.snow_depth;
    e.rain_mm_h = preset.rain, e.snowfall_mm_h = preset.snowfall;
    return e;
  }
  throw InputError(UnknownChoiceMessage("weather", std::string(name), EnvironmentPresetNames()));
}

std::vector<std::string> EnvironmentPresetNames() {
  std::vector<std::string> names;
  for (const Preset& preset : kPresets) names.emplace_back(preset.name);
  return names;
}

Environment ParseCloudPreset(std::string_view name, const Environment& base) {
  for (const CloudPreset& preset : kCloudPresets) {
    if (preset.name != name) continue;
    Environment e = base;
    e.cloud_type = preset.type, e.cloud_cover = preset.cover, e.cloud_base_m = 0;
    e.altocumulus_cover = preset.altocumulus, e.cirrus_cover = preset.cirrus;
    if (preset.turbidity > 0) e.turbidity = preset.turbidity;
    return e;
  }
  throw InputError(UnknownChoiceMessage("clouds", std::string(name), CloudPresetNames()));
}

std::vector<std::string> CloudPresetNames() {
  std::vector<std::string> names;
  for (const CloudPreset& preset : kCloudPresets) names.emplace_back(preset.name);
  return names;
}

double SkySeedOf(std::string_view world, uint64_t seed) {
  return std::max<double>(1, static_cast<uint32_t>(RngStream(seed, world).Bits()));
}

std::string DescribeEnvironment(const Environment& environment) {
  const Environment usual;
  std::string text;
  const auto add = [&](const std::string& name, const std::string& value) { text += (text.empty() ? "" : ",") + name + "=" + value; };
  for (const EnvironmentField& field : EnvironmentFields()) {
    if (environment.*field.value != usual.*field.value) add(field.name, ShortestText(environment.*field.value));
  }
  if (environment.cloud_type != usual.cloud_type) add("cloud_type", kCloudTypeNames[static_cast<int>(environment.cloud_type)]);
  if (environment.lamps != usual.lamps) add("lamps", kLampsNames[static_cast<int>(environment.lamps)]);
  if (environment.hdri) add("hdri", environment.hdri->name);
  return text;
}

}  // namespace airsim360
