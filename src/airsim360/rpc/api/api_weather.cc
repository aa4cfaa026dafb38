// Weather and time of day, as far as our sky and surfaces have them.
#include <algorithm>
#include <cmath>

#include "airsim360/rpc/api/api.h"
#include "airsim360/rpc/settings/time_of_day.h"

namespace airsim360 {
namespace {

enum class WeatherParameter : int { kRain, kRoadWetness, kSnow, kRoadSnow, kMapleLeaf, kRoadLeaf, kDust, kFog, kEnabled };

// AirSim's 0 ... 1 at 1: a cloudburst, a snowstorm, fog one sees 15 m in, dust one sees 100 m in.
constexpr double kHeaviestRain = 30, kHeaviestSnow = 8, kThickestFog = 15, kThickestDust = 100, kHaziest = 10;

double Of(const WorldView& world, WeatherParameter parameter) {
  return std::clamp(world.weather[static_cast<size_t>(parameter)], 0.0f, 1.0f);
}

// Clouds and the colour of the air follow in quarters: a new sky takes seconds, and fades come in small steps.
double InQuarters(double share) { return std::ceil(4 * share) / 4; }

bool IsSame(const Environment& a, const Environment& b) {
  return a.lamps == b.lamps && a.cloud_type == b.cloud_type && a.hdri == b.hdri &&
         std::ranges::all_of(EnvironmentFields(), [&](const EnvironmentField& field) { return a.*field.value == b.*field.value; });
}

// The environment with the weather that calls have asked for.
void ApplyWeather(Session& s) {
  WorldView& world = s.world();
  Environment weather = world.base_environment;
  if (world.weather_enabled) {
    const double rain = Of(world, WeatherParameter::kRain), snow = Of(world, WeatherParameter::kSnow);
    const double fog = Of(world, WeatherParameter::kFog), dust = Of(world, WeatherParameter::kDust);
    weather.rain_mm_h = std::max(weather.rain_mm_h, kHeaviestRain * rain);
    weather.snowfall_mm_h = std::max(weather.snowfall_mm_h, kHeaviestSnow * snow);
    const double rain_clouds = InQuarters(std::max(rain, snow));
    if (rain_clouds > weather.cloud_cover) weather.cloud_cover = rain_clouds, weather.cloud_type = CloudType::kAuto;
    weather.wetness = std::max(weather.wetness, Of(world, WeatherParameter::kRoadWetness));
    weather.snow_depth = std::max(weather.snow_depth, Of(world, WeatherParameter::kRoadSnow));
    weather.turbidity = std::max(weather.turbidity, 2.5 + (kHaziest - 2.5) * InQuarters(dust));
    const double visibility = std::min(fog > 0 ? kThickestFog / fog : 1e9, dust > 0 ? kThickestDust / dust : 1e9);
    if (visibility < 1e9) weather.visibility_m = visibility;
  }
  if (IsSame(weather, world.environment)) return;
  world.environment = weather;
  s.EnvironmentChanged();
}

}  // namespace

void AddWeatherCalls(Api& api) {
  api.Change("simEnableWeather", [](Session& s, bool enable) {
    s.world().weather_enabled = enable;
    ApplyWeather(s);
  });
  api.Change("simSetWeatherParameter", [](Session& s, WeatherParameter parameter, float value) {
    if (parameter < WeatherParameter::kRain || parameter > WeatherParameter::kEnabled) {
      throw std::invalid_argument("there is no weather parameter " + std::to_string(static_cast<int>(parameter)));
    }
    if (parameter == WeatherParameter::kMapleLeaf || parameter == WeatherParameter::kRoadLeaf) {
      NoticeOnce("simSetWeatherParameter: there are no falling leaves");
    }
    if (parameter == WeatherParameter::kEnabled) {
      s.world().weather_enabled = value > 0;
    } else {
      s.world().weather[static_cast<size_t>(parameter)] = value;
    }
    ApplyWeather(s);
  });
  api.Change("simSetTimeOfDay", [](Session& s, bool is_enabled, const std::string& start, bool /*is_dst*/, float celestial_clock_speed,
                                   float /*update_interval_secs*/, bool /*move_sun*/) {
    Environment& base = s.world().base_environment;
    if (!is_enabled) {
      base = s.world().first_environment;
      return ApplyWeather(s);
    }
    if (start.empty()) return;
    SetTimeOfDay(start, s.settings().origin, base);
    if (celestial_clock_speed != 1) NoticeOnce("simSetTimeOfDay: the sun is set once and stays there");
    ApplyWeather(s);
  });
}

}  // namespace airsim360
