// 3D Tiles 1.0 and 1.1: tilesets, and batched and composite tiles by themselves.
#pragma once

#include <string>

#include "airsim360/assets/imported.h"
#include "airsim360/assets/limits.h"

namespace airsim360::internal {

/// Is this JSON text a tileset (and not, say, CityJSON)?
bool LooksLikeTileset(std::string_view text);

/// How many tiles are read at most; beyond them the ones of the largest geometric error are refined first.
inline constexpr size_t kMostTiles = 4096;

/// Reads the tiles of the finest level (REPLACE; with their ancestors where they ADD): .glb, .gltf, .b3dm and .cmpt
/// contents, also of tilesets within. Point clouds, instanced tiles and implicit tiling are left out with a warning.
/// A tileset on the Earth is brought into a frame of east, north and up at its middle, which lies at x = y = 0, its
/// lowest point at z = 0; others keep their coordinates. One node for each node of each tile. InputError that
/// names file and JSON pointer, or tile, for damage.
ImportedFile ReadTileset(const std::string& file, std::string_view text, const ResourceLoader& load, const ImportLimits& limits = {},
                         size_t most_tiles = kMostTiles);

/// One tile (.b3dm, .cmpt) in its own frame.
ImportedFile ReadTile(const std::string& file, std::span<const std::byte> bytes, const ResourceLoader& load,
                      const ImportLimits& limits = {});

}  // namespace airsim360::internal
