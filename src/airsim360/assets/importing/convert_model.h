// Models in formats of other programs, through those programs.
#pragma once

#include <filesystem>

#include "airsim360/assets/imported.h"
#include "airsim360/assets/importing/foreign_format.h"

namespace airsim360::internal {

/// What a program made of a model.
struct ConvertedModel {
  Bytes glb;
  bool up_z = false;  ///< +Z of the .glb is up, against the rule of glTF
  double scale = 1;   ///< metres a unit of the .glb
};

/// Blender, else assimp, as a process of its own, at most five minutes each; the result is kept in the user's
/// cache under the content of the file and the size and time of those beside it. A line in the log says which
/// program it was. InputError with the way round where none is installed, with their complaints where all fail.
ConvertedModel ConvertModel(const std::filesystem::path& file, const ForeignFormat& format);

/// Loader for pictures that a converted model refers to by the paths of its maker's machine: by its relative
/// path, else by its bare name beside the model or in one of the usual folders below it.
ResourceLoader SearchingLoader(const std::filesystem::path& model);

/// Metres a unit of an .fbx file: 0.01 times the UnitScaleFactor that it names.
double FbxUnit(std::span<const std::byte> fbx);

}  // namespace airsim360::internal
