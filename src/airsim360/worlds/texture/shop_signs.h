// The sheet of shop signs: 208 fascias of 5 x 0.8 m, each of a name, colours and lettering of its own.
#pragma once

#include <string>

#include "airsim360/scene/material.h"
#include "airsim360/worlds/texture/surfaces.h"

namespace airsim360::internal {

/// Name on sign i, 0 … kSignCount - 1: no two alike.
std::string ShopName(int i, ShopSigns signs = ShopSigns::kToday);
/// The sheet as ShopSignBox (surfaces.h) divides it: base colour, about 1 cm a texel.
Texture MakeShopSigns(ShopSigns signs = ShopSigns::kToday);

}  // namespace airsim360::internal
