// The park's own textures: colours of the ground at three scales, road surface, mulch, pavement, grass.
#pragma once

#include <array>

#include "airsim360/scene/scene.h"
#include "airsim360/worlds/city_park/layout.h"

namespace airsim360::internal::park {

/// Squares around the spawn, half widths in metres: each has a picture of the ground of its own.
inline constexpr std::array<float, 3> kGroundSquares = {64, 512, 8192};
/// The picture of the road covers so many metres of its length, then comes back mirrored.
inline constexpr float kRoadPictureLength = 204.8f;

struct ParkMaterials {
  std::array<MaterialId, 3> ground{};
  MaterialId main_road = 0, side_road = 0, mulch = 0, pavement = 0, gravel = 0;
};

/// Generates the pictures in parallel.
ParkMaterials AddParkMaterials(SceneBuilder& builder, const Layout& layout);

/// Albedo of the ground at a point, as drawn in the picture of square `level`.
Vec3f GroundColor(const Layout& layout, Vec2f p, int level);

}  // namespace airsim360::internal::park
