// Wavefront OBJ.
#pragma once

#include <string>
#include <string_view>

#include "airsim360/assets/imported.h"
#include "airsim360/assets/limits.h"
#include "airsim360/assets/obj/mtl.h"

namespace airsim360::internal {

/// One node with a mesh per object or group (`o`, `g`), named by it; parts by material. Axes are converted
/// from +Y up; units are kept. Normals are generated where the file has none. Missing MTL files and textures
/// are warnings, and the materials are then plain but keep their names. InputError naming file:line for
/// everything damaged.
ImportedFile ReadObj(const std::string& file, std::string_view text, const ResourceLoader& load, const ImportLimits& limits = {},
                     const MtlContext& context = {});

}  // namespace airsim360::internal
