// What the houses of a style look like, as tags of a map say it.
#pragma once

#include <span>
#include <string_view>

#include "airsim360/worlds/town_spec.h"

namespace airsim360::internal {

struct HouseStyle {
  std::string_view kind;                        ///< building=
  std::span<const std::string_view> materials;  ///< building:material=, drawn evenly
  std::span<const std::string_view> colours;    ///< building:colour=, drawn evenly
  std::span<const std::string_view> roofs;      ///< roof:shape=
  std::string_view roof_material;               ///< "" = by the shape
  std::span<const std::string_view> roof_colours;
  double least_front, most_front, depth;  ///< metres of a house in a row
  double pitch;                           ///< height of the roof over its span
};

const HouseStyle& StyleOf(TownStyle style);
/// building:colour= of walls; empty: those of the style.
std::span<const std::string_view> ColoursOf(TownColours colours);

}  // namespace airsim360::internal
