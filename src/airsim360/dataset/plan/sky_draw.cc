#include "airsim360/dataset/plan/sky_draw.h"

#include <algorithm>
#include <cmath>

#include "airsim360/scene/environment_sampler.h"

namespace airsim360::internal {
namespace {

const SkyChoice& Choose(const SkyMixture& mixture, double at) {
  double weights = 0;
  for (const SkyChoice& choice : mixture.choices) weights += choice.weight;
  at *= weights;
  for (const SkyChoice& choice : mixture.choices) {
    if (at < choice.weight) return choice;
    at -= choice.weight;
  }
  return mixture.choices.back();
}

}  // namespace

PlannedSky DrawSky(const SkyMixture& mixture, RngStream random, const Environment& world) {
  const SkyChoice& choice = Choose(mixture, random.Uniform());
  PlannedSky sky{choice.weather.empty() ? world : ParseEnvironmentPreset(choice.weather, world), 0};
  if (choice.climate)
    sky.environment =
        SampleEnvironment(random.Bits(), {.latitude_deg = choice.latitude_deg, .least_sun_elevation_deg = choice.least_sun_elevation_deg});
  for (const SettingRange& range : choice.settings) {
    const auto field = std::ranges::find_if(EnvironmentFields(), [&](const EnvironmentField& f) { return f.name == range.setting; });
    // Few digits, as people and flags write them; never outside the range, as rounding could be.
    const double parts = range.high - range.low > 50 ? 1 : 100;
    const double drawn = std::round(random.Uniform(range.low, range.high) * parts) / parts;
    (field == EnvironmentFields().end() ? sky.exposure_ev : sky.environment.*(field->value)) = std::clamp(drawn, range.low, range.high);
  }
  return sky;
}

}  // namespace airsim360::internal
