#include "airsim360/assets/obj/obj_geometry.h"

#include <algorithm>
#include <utility>

#include "airsim360/assets/normals.h"
#include "airsim360/assets/polygon.h"

namespace airsim360::internal {

void ObjGeometry::StartGroup(std::string name) {
  // A named group may be continued later in the file; nameless ones are each their own.
  const auto known = group_of_name_.find(name);
  if (!name.empty() && known != group_of_name_.end()) {
    current_ = known->second;
    return;
  }
  if (current_ != SIZE_MAX && groups_[current_].corners.empty()) {
    group_of_name_.erase(groups_[current_].name);
  } else {
    current_ = groups_.size();
    groups_.emplace_back();
  }
  if (!name.empty()) group_of_name_[name] = current_;
  groups_[current_].name = std::move(name);
}

void ObjGeometry::AddFace(std::span<const ObjCorner> face, MaterialId material) {
  if (current_ == SIZE_MAX) StartGroup({});
  std::vector<Vec3f> outline;
  for (const ObjCorner& corner : face) outline.push_back(positions[corner.position]);
  std::vector<ObjCorner>& corners = groups_[current_].corners[material];
  for (Vec3u t : TriangulateFace(outline)) {
    // Triangles that repeat a vertex have no area.
    const ObjCorner abc[3] = {face[t.x], face[t.y], face[t.z]};
    const bool degenerate = abc[0].position == abc[1].position || abc[1].position == abc[2].position || abc[2].position == abc[0].position;
    if (!degenerate) corners.insert(corners.end(), abc, abc + 3);
  }
}

Mesh ObjGeometry::MakeMesh(Group& group) const {
  Mesh mesh;
  mesh.name = group.name;

  // Vertices are the distinct corners, in sorted order.
  std::vector<ObjCorner> all;
  for (const auto& [material, corners] : group.corners) all.insert(all.end(), corners.begin(), corners.end());
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  const bool any_uv = std::any_of(all.begin(), all.end(), [](const ObjCorner& c) { return c.uv != ObjCorner::kAbsent; });
  for (const ObjCorner& c : all) {
    mesh.positions.push_back(positions[c.position]);
    mesh.normals.push_back(c.normal < normals.size() ? normals[c.normal] : Vec3f{});
    if (any_uv) mesh.uvs.push_back(c.uv == ObjCorner::kAbsent ? Vec2f{} : uvs[c.uv]);
    if (!colors.empty()) mesh.colors.push_back(c.position < colors.size() ? colors[c.position] : VertexColor{});
  }

  // One part a material.
  const auto vertex = [&](const ObjCorner& c) { return static_cast<uint32_t>(std::lower_bound(all.begin(), all.end(), c) - all.begin()); };
  for (const auto& [material, corners] : group.corners) {
    if (corners.empty()) continue;
    mesh.parts.push_back({static_cast<uint32_t>(mesh.triangles.size()), static_cast<uint32_t>(corners.size() / 3), material, kNoEntity});
    for (size_t i = 0; i < corners.size(); i += 3) {
      mesh.triangles.push_back({vertex(corners[i]), vertex(corners[i + 1]), vertex(corners[i + 2])});
    }
  }
  group.corners.clear();
  FillMissingNormals(mesh);
  return mesh;
}

std::vector<Mesh> ObjGeometry::TakeMeshes() {
  std::vector<Mesh> meshes;
  for (Group& group : std::exchange(groups_, {})) {
    Mesh mesh = MakeMesh(group);
    if (!mesh.triangles.empty()) meshes.push_back(std::move(mesh));
  }
  return meshes;
}

}  // namespace airsim360::internal
