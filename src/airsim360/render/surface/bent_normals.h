// Vertex normals of meshes that bend.
#pragma once

#include <span>
#include <vector>

#include "airsim360/scene/scene.h"

namespace airsim360::internal {

/// By vertex, the first of those that share its place and normal in the mesh as built: they move as one.
std::vector<uint32_t> WeldVertices(const Mesh& mesh);

/// Into `normals`, of the vertices at `positions`: sums of the faces around, weighted by area, not normalised.
/// `weld` is WeldVertices of the mesh as built.
void BendNormals(const Mesh& mesh, std::span<const Vec3f> positions, std::span<const uint32_t> weld, std::span<Vec3f> normals);

}  // namespace airsim360::internal
