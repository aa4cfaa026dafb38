// What the readers (OBJ, glTF) make of a file, before labels are given. Frame W (+Z up), metres.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "airsim360/base/file.h"
#include "airsim360/math/transform.h"
#include "airsim360/scene/environment.h"
#include "airsim360/scene/material.h"
#include "airsim360/scene/mesh.h"

namespace airsim360::internal {

/// A node of the file's hierarchy; parents come before their children.
struct ImportedNode {
  std::string name;  ///< may be empty
  int32_t parent = -1;
  int32_t mesh = -1;
  AffineTransform X_WM;  ///< mesh frame to W, the whole chain of parents included

  // What files written by `world export` say besides (gltf_extras.h).
  std::string category = {};  ///< path; "" = not said
  uint64_t entity = 0;        ///< nodes with the same number and `copy` are one entity; 0 = not said
  uint64_t copy = 0;          ///< 0 = the node that was written; else of the copies made of it since
  uint64_t number = 0;        ///< place among the world's instances; 0 = not said
  Vec3f tint{1, 1, 1}, glow{1, 1, 1};
  Vec3d p_exact = {};  ///< X_WM.p as glTF files have it, in double precision; zero = there is no more to it
  bool added = false;  ///< not of the file: the plain that a placement asks for
};

/// What a file written by `world export` says of the world beside its surfaces.
struct WrittenWorld {
  struct Unseen {
    uint64_t id = 0;
    std::string name, category;
    bool sky = false;
  };
  Environment environment;
  std::optional<Vec3f> spawn;
  float spawn_yaw_deg = 0;
  Vec3f interior_light;
  std::vector<std::string> attributions;
  std::vector<Unseen> unseen;  ///< entities without a surface, by id; the sky, if there is one, among them
};

/// Mesh parts refer to `materials` by index, materials to `textures` by index. Meshes have normals, but
/// for the flat ones of exported worlds.
struct ImportedFile {
  std::vector<Texture> textures;
  std::vector<Material> materials;
  std::vector<Mesh> meshes;
  std::vector<ImportedNode> nodes;
  std::optional<WrittenWorld> written = {};
  std::vector<MaterialId> unlit = {};  ///< materials whose colours have their light in them (KHR_materials_unlit)
  std::string copyright;               ///< as the file says, "" if it does not
  std::vector<std::string> warnings;
};

/// Reads a file that a model refers to by a relative name ('/' separated, not yet decoded); nullopt if there
/// is none. Throws InputError for a name that leads out of the model's folder.
using ResourceLoader = std::function<std::optional<Bytes>(const std::string& name)>;

/// Collects each warning once and at most 20 of them.
class Warnings {
 public:
  void Add(std::string text);
  std::vector<std::string> Take();

 private:
  std::set<std::string> seen_;
  std::vector<std::string> list_;
};

/// A name fit for output files: valid UTF-8 without control characters (bytes that are not UTF-8 are read as
/// Latin-1), no blanks at its ends, at most 120 bytes.
std::string CleanName(std::string_view raw);
/// CleanName in single quotes, for messages.
std::string Quoted(std::string_view raw);

/// Loader for the files beside a model. Refuses absolute names, drives, "..", URL schemes and links that lead
/// outside.
ResourceLoader FolderLoader(const std::string& model_name, const std::filesystem::path& folder);

}  // namespace airsim360::internal
