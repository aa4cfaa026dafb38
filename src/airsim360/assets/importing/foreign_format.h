// Formats that users have and that are not read here: what they are, and the way round.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace airsim360::internal {

/// ".fbx" of "Model.FBX"; "" if there is none.
std::string LowerExtension(const std::filesystem::path& file);

/// One extension of a format that is known, but not read by code of ours.
struct ForeignFormat {
  std::string_view extension;  ///< with its dot, lower case
  std::string_view what;       ///< "Autodesk FBX"
  std::string_view blender;    ///< Python statement that opens the file named `f`; "" = Blender cannot
  bool assimp = false;         ///< `assimp export` reads it
  std::string_view advice;     ///< the way round where no program converts it
  bool assimp_up_z = false;    ///< assimp leaves it with +Z up
  double assimp_scale = 1;     ///< metres a unit of what assimp makes of it
};

/// nullptr for other extensions.
const ForeignFormat* FindForeignFormat(std::string_view extension);

/// The formats that are read, for messages: ".glb, .gltf, …".
std::string ReadFormats();

/// Message for a file that is not read, by its extension: what it is, what is read, the way round.
std::string UnreadMessage(const std::filesystem::path& file);

}  // namespace airsim360::internal
