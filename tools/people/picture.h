// Pictures of what is tinted later.
#pragma once

#include <array>
#include <vector>

#include "airsim360/image/image.h"
#include "airsim360/math/vector.h"

namespace airsim360::bake {

/// Leaves light and shade only, with mean 188 over what is not clear. The deviation of the logarithm of the light is at
/// most `spread`: more is pressed together, so that tints keep their colour.
void MakeTintable(double spread, Image<Rgba8>& image);

/// Prints, stripes and trims lose nearly all of their contrast, folds stay: light is kept within `most` of its logarithm.
void MakePlain(double most, Image<Rgba8>& image);

/// Scales each channel in linear light so that its median over what `uvs` covers is `albedo`'s. Skins painted by eye have
/// red two to five times as bright as green, where spectrophotometers find 1.6 to 2.2.
void MakeSkin(Vec3f albedo, const std::vector<std::array<Vec2f, 3>>& uvs, Image<Rgba8>& image);

/// Pixels that no triangle of `uvs` covers get the colour of what is near, so that simplified meshes, which cut corners
/// of the map, and blurred lookups show cloth there instead of the map's ground.
void FillAround(const std::vector<std::array<Vec2f, 3>>& uvs, Image<Rgba8>& image);

}  // namespace airsim360::bake
