// What glTF has no word for travels in "extras" under these names, which Blender shows as custom properties.
#pragma once

#include <cstddef>

namespace airsim360::internal {

// Of nodes: entity id (nodes with the same one are one entity), category path, instance tint (linear RGB).
inline constexpr char kExtraEntity[] = "airsim360_entity";
// Number of the node in the file: a second node with the same one is a copy that somebody made, and a thing of its own.
inline constexpr char kExtraNode[] = "airsim360_node";
// The entity's name where it is longer than the 63 bytes that Blender keeps.
inline constexpr char kExtraName[] = "airsim360_name";
inline constexpr size_t kBlenderName = 63;
inline constexpr char kExtraCategory[] = "airsim360_category";
inline constexpr char kExtraTint[] = "airsim360_tint";

// Of materials: SurfaceKind by name, then fields of Material.
inline constexpr char kExtraKind[] = "airsim360_kind";
inline constexpr char kExtraTransmission[] = "airsim360_transmission";
inline constexpr char kExtraMacroVariation[] = "airsim360_macro_variation";
inline constexpr char kExtraInterior[] = "airsim360_interior";
inline constexpr char kExtraLamp[] = "airsim360_lamp";
inline constexpr const char* kSurfaceKindNames[] = {"standard", "foliage", "glass", "water"};

// Of scenes: where the sun stands, in degrees; the first viewpoint in W.
inline constexpr char kExtraSun[] = "airsim360_sun_azimuth_elevation_deg";
inline constexpr char kExtraSpawn[] = "airsim360_spawn";

}  // namespace airsim360::internal
