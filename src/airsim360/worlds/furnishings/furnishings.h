// Furniture and fittings of interiors: procedural kinds at the sizes of standards and catalogues, and where each goes.
#pragma once

#include <span>
#include <string_view>

#include "airsim360/worlds/props/props.h"

namespace airsim360 {

/// Where a piece goes. Every piece has its lowest point at z = 0, whatever it hangs on.
enum class Mount {
  kFloor,    ///< stands on the floor, centred; rugs and papers lie on it
  kWall,     ///< back on the plane y = 0, all of it at y <= 0 but for what sinks into the wall: turn -Y into the room
  kCeiling,  ///< centred; its top touches the ceiling: raise it by ceiling height minus its own height
  kSurface   ///< stands on a table, shelf or worktop, centred
};

/// A furnishing's place and how high it usually is above the floor: the bottom edge of wall pieces, 0 for the rest.
struct Furnishing {
  std::string_view kind;
  Mount mount = Mount::kFloor;
  float sill = 0;  ///< metres
};

/// All furnishings, sorted by name; each is a kind of PropKinds().
std::span<const Furnishing> Furnishings();
/// One by name; InputError naming the nearest.
const Furnishing& FindFurnishing(std::string_view kind);
/// Box of one individual as MakeProp makes it without a library, in its own frame (metres).
Box3f FurnishingBox(std::string_view kind, uint32_t variant);

}  // namespace airsim360
