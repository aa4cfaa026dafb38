// Stanford PLY: ASCII and binary of both byte orders.
#pragma once

#include <span>
#include <string>

#include "airsim360/assets/imported.h"
#include "airsim360/assets/limits.h"

namespace airsim360::internal {

/// Reads polygons and triangle strips with normals, texture coordinates (of vertices or of corners), pictures named by
/// "comment TextureFile", and colours of vertices or faces, as one node; other elements and properties are
/// skipped. +Z of the file is up. InputError "file:line: …" for damage in the header or in ASCII data, "file:
/// vertex 7: …" in binary data.
ImportedFile ReadPly(const std::string& file, std::span<const std::byte> bytes, const ResourceLoader& load,
                     const ImportLimits& limits = {});

}  // namespace airsim360::internal
