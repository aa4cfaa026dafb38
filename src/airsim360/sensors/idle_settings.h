// Settings of a picture that its tier makes nothing of.
#pragma once

#include <string_view>

#include "airsim360/render/products.h"
#include "airsim360/sensors/rig.h"

namespace airsim360 {

/// InputError naming a setting, after `prefix` ("--" of flags), that the tier has no use for: what is given is not ignored.
/// For what somebody asked for; a plan may well say more than a row of it needs.
void RefuseIdleSettings(const PictureSettings& settings, const Products& products, std::string_view prefix = {});

}  // namespace airsim360
