// What the files about roads share.
#pragma once

#include <vector>

#include "airsim360/worlds/city_park/park.h"

namespace airsim360::internal::park {

inline constexpr float kStretch = 80;  ///< metres of road per entity

/// Height of a carriageway over its edges at distance d from the middle.
float CarriagewayZ(float d, float half);

/// The face of a kerb, walked with the verge to its left; at a junction also the corner of the carriageways'
/// edges and the arc that cuts it.
struct KerbLine {
  Curve line;
  Vec2f corner;
  std::vector<Vec2f> arc;
};
std::vector<KerbLine> KerbLines(const Layout& layout);

/// Paint, drains, manholes.
void MarkRoads(Park& park);

}  // namespace airsim360::internal::park
