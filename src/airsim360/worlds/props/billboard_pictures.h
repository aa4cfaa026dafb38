// Pictures for billboards, bare walls and banners, drawn here.
#pragma once

#include "airsim360/scene/material.h"
#include "airsim360/worlds/props/drawing.h"

namespace airsim360::internal {

/// Ink on `sheets` pasted sheets after some summers: colours fade towards grey, blacks lift, sheets differ a little and show
/// their seams, rain leaves streaks and dust.
void PrintAndAge(Canvas& c, uint32_t seed, int sheets_x, int sheets_y);

/// The picture of a board of 10 x 6 m: `variant` < kDrawnBoards + kVistaBoards.
Texture BoardPicture(uint32_t variant);
/// Old advertisements, a sunset, shapes, painted on bare walls of 12.6 x 9 m: `variant` < 4. Part of each has weathered off.
Texture MuralPicture(uint32_t variant);
/// The picture of a banner of 4 x 11 m: `variant` < 4.
Texture BannerPicture(uint32_t variant);

}  // namespace airsim360::internal
