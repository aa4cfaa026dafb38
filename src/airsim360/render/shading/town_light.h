// How much of a town's light stands over a scene by night.
#pragma once

#include "airsim360/render/lights/light_table.h"

namespace airsim360::internal {

/// Light that the lamps around a scene's spawn give, lm, for each square metre of its ground there (DetailAround, 500 m).
float LampsPerArea(const Scene& scene, const LightTable& lights);

/// What lamps send up into sky, clouds, fog and rain, of what those of a large city do: 1 from kTownLamps on, below it in
/// proportion, so that a few lamps in the country bring no glow.
float TownLight(const Scene& scene, const LightTable& lights);

/// lm / m^2.
inline constexpr float kTownLamps = 1.0f;

}  // namespace airsim360::internal
