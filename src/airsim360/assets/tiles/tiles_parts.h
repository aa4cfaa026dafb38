// The parts of the 3D Tiles reader.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "airsim360/assets/axes.h"
#include "airsim360/assets/gltf/gltf_json_internal.h"
#include "airsim360/assets/imported.h"
#include "airsim360/assets/limits.h"

namespace airsim360::internal {

/// Affine maps of tiles, in double: the Earth is large.
struct TileTransform {
  Mat3d A;
  Vec3d p;
  friend TileTransform operator*(const TileTransform& a, const TileTransform& b) { return {a.A * b.A, a.A * b.p + a.p}; }
};

/// A tile that is shown: where its content lies and how it is placed.
struct ShownTile {
  std::string uri;    ///< relative to the first tileset's folder, or a data URI
  std::string name;   ///< for messages and nodes
  TileTransform X;    ///< tile to tileset
  bool up_z = false;  ///< its glTF has +Z up (asset.gltfUpAxis of old tilesets)
  double error = 0;   ///< geometric error, metres
};

struct TileSelection {
  std::vector<ShownTile> tiles;
  std::optional<Vec3d> earth;  ///< middle of a tileset whose coordinates are Earth-centred
};

/// What of a tileset is shown. `load` reads tilesets within.
TileSelection SelectTiles(const std::string& file, std::string_view text, const ResourceLoader& load, size_t most_tiles,
                          Warnings& warnings);

/// Gathers contents of tiles in one file; limits hold for all of them together.
class TileGatherer {
 public:
  TileGatherer(const ResourceLoader& load, const ImportLimits& limits, Warnings& warnings)
      : load_(load), limits_(limits), warnings_(warnings) {}
  /// A content (.glb, .gltf, .b3dm, .cmpt by its first bytes); `X` is the tile's, already in W; `uri` names it and says
  /// where its pictures start.
  void Add(const std::string& name, const std::string& uri, std::span<const std::byte> bytes, const TileTransform& X, bool up_z,
           int depth = 0);
  ImportedFile Take();

 private:
  void AddComposite(const std::string& name, const std::string& uri, std::span<const std::byte> bytes, const TileTransform& X, bool up_z,
                    int depth);
  void AddGltf(const std::string& name, const std::string& uri, std::span<const std::byte> bytes, const TileTransform& X, bool up_z);

  const ResourceLoader& load_;
  ImportLimits limits_;
  Warnings& warnings_;
  ImportedFile out_;
};

/// "a/b/" of "a/b/c.json".
std::string FolderOf(const std::string& uri);

}  // namespace airsim360::internal
