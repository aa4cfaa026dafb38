// What glTF has no word for travels in "extras" under these names, which Blender shows as custom properties.
#pragma once

#include <cstddef>

namespace airsim360::internal {

// Of nodes: entity id (nodes with the same one are one entity), category path, instance tint and glow (linear RGB).
inline constexpr char kExtraEntity[] = "airsim360_entity";
// Number of the node, in the order of the world's instances: a second node with the same one is a copy that somebody made, and a thing of its own.
inline constexpr char kExtraNode[] = "airsim360_node";
// The entity's name where it is longer than the 63 bytes that Blender keeps.
inline constexpr char kExtraName[] = "airsim360_name";
inline constexpr size_t kBlenderName = 63;
inline constexpr char kExtraCategory[] = "airsim360_category";
inline constexpr char kExtraTint[] = "airsim360_tint";
inline constexpr char kExtraGlow[] = "airsim360_glow";

// Of materials: SurfaceKind by name, then fields of Material.
inline constexpr char kExtraKind[] = "airsim360_kind";
inline constexpr char kExtraTransmission[] = "airsim360_transmission";
inline constexpr char kExtraMacroVariation[] = "airsim360_macro_variation";
inline constexpr char kExtraInterior[] = "airsim360_interior";
inline constexpr char kExtraLamp[] = "airsim360_lamp";
inline constexpr char kExtraBeam[] = "airsim360_beam";
inline constexpr char kExtraGround[] = "airsim360_ground";
inline constexpr char kExtraBlendTiles[] = "airsim360_blend_tiles";
inline constexpr char kExtraUnits[] = "airsim360_units";
// Times the base colour factor, which glTF keeps below 1; ours lightens dark pictures beyond it.
inline constexpr char kExtraBaseGain[] = "airsim360_base_gain";
inline constexpr const char* kGroundWearNames[] = {"none",   "asphalt", "carriageway", "paving",    "lawn",
                                                   "gravel", "soil",    "roof",        "roof_rolls"};
inline constexpr const char* kSurfaceKindNames[] = {"standard", "foliage", "glass", "water"};

// Of meshes without normals: every triangle is flat.
inline constexpr char kExtraFlat[] = "airsim360_flat";

// Of scenes: what is neither geometry nor material, as JSON in a text, which editors keep whole (written_world.h).
inline constexpr char kExtraWorld[] = "airsim360_world";
// Where the sun stands, in degrees; the first viewpoint in W.
inline constexpr char kExtraSun[] = "airsim360_sun_azimuth_elevation_deg";
inline constexpr char kExtraSpawn[] = "airsim360_spawn";

}  // namespace airsim360::internal
