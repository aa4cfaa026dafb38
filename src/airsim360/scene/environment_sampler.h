// Plausible environments by lot: dates, hours, clouds, air and weather as a climate has them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "airsim360/scene/environment.h"

namespace airsim360 {

/// Where the samples are drawn from. Default: a town of the middle latitudes by day.
struct Climate {
  static constexpr double kMaxLatitude = 70;  ///< beyond it the statistics below do not hold
  static constexpr double kMaxLeastSun = 20;  ///< degrees; reached on some hour of the year at every latitude allowed
  double latitude_deg = 45;                   ///< north positive, ± kMaxLatitude
  double least_sun_elevation_deg = 2;         ///< samples have the sun at least so high, -90 … kMaxLeastSun
  bool urban = true;                          ///< town air is hazier by a third of Linke's turbidity above 2
};

/// What an environment was drawn as.
struct EnvironmentSample {
  Environment environment;
  std::string sky;     ///< a preset of CloudPresetNames(): the kind of sky before its covers were drawn
  std::string season;  ///< spring, summer, autumn, winter of its hemisphere
  int month = 1, day = 1;
  double solar_hour = 12;  ///< mean solar time
};

/// One sample, the same for the same seed and climate. Kinds of sky have the shares that land observers report by day
/// (average amounts: stratus and nimbostratus 10, stratocumulus 12, cumulus and cumulonimbus 9, altocumulus and altostratus
/// 21, high cloud 22 per cent; total 54): Warren, Eastman & Hahn, "A survey of changes in cloud cover and cloud types over
/// land from surface observations, 1971-96", J. Climate 20 (2007), doi 10.1175/JCLI4031.1; cumulus more in summer and about
/// noon, stratus more in winter (the same; Hahn & Warren, NDP-026D, 2002). Rounded to kinds that a picture tells apart, with
/// closed, broken and stratocumulus skies 0.4 of all at 45 degrees. Turbidity after Remund et al., "Worldwide Linke turbidity
/// information" (ISES Solar World Congress 2003): 2.5 in winter, 3.5 in summer, log-normal with a fifth of scatter. Rain falls
/// from a quarter of the closed skies, its rate exponential about 1.5 mm/h; in winter poleward of 35 degrees part of it as
/// snow. Fog (below 1 km) lies in 3 per cent of the hours of low sun. InputError for a climate out of its ranges.
EnvironmentSample DrawEnvironment(uint64_t seed, const Climate& climate = {});

/// The environment of DrawEnvironment.
Environment SampleEnvironment(uint64_t seed, const Climate& climate = {});

}  // namespace airsim360
