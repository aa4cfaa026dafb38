// The shapes of an OBJ file while it is read: shared lists of numbers, groups of faces by material.
#pragma once

#include <compare>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "airsim360/assets/imported.h"

namespace airsim360::internal {

/// One corner of a face: indices into the file's lists.
struct ObjCorner {
  static constexpr uint32_t kAbsent = UINT32_MAX;
  uint32_t position = 0, uv = kAbsent, normal = kAbsent;
  auto operator<=>(const ObjCorner&) const = default;
};

class ObjGeometry {
 public:
  std::vector<Vec3f> positions, normals;  ///< frame W
  std::vector<Vec2f> uvs;
  std::vector<VertexColor> colors;  ///< of the first positions; the rest are white

  /// What follows belongs to this object or group. A named one may be continued; nameless ones are each their
  /// own.
  void StartGroup(std::string name);
  /// Adds a polygon (its position indices checked) to the current group.
  void AddFace(std::span<const ObjCorner> face, MaterialId material);
  /// One mesh for each group with triangles, normals generated where missing; indices of positions
  /// and uvs must be valid; a normal that is not there counts as missing.
  std::vector<Mesh> TakeMeshes();

 private:
  struct Group {
    std::string name;
    std::map<MaterialId, std::vector<ObjCorner>> corners;  // three a triangle
  };
  Mesh MakeMesh(Group& group) const;

  std::vector<Group> groups_;
  std::map<std::string, size_t> group_of_name_;
  size_t current_ = SIZE_MAX;
};

}  // namespace airsim360::internal
