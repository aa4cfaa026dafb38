// Moving meshes, and joining all nodes of a file into one prop.
#pragma once

#include <string>

#include "airsim360/assets/imported.h"
#include "airsim360/scene/model_source.h"

namespace airsim360::internal {

/// Puts the vertices through X, normals through its inverse transpose; a mirroring X turns the triangles
/// round.
void TransformMesh(Mesh& mesh, const AffineTransform& X);

/// All nodes in one mesh in W, parts joined by material. InputError if that is more than `max_triangles`.
Model MergeNodes(ImportedFile file, const std::string& name, uint64_t max_triangles);

/// Moves a model so that it stands on z = 0, centred on the z axis.
void StandOnGround(Model& model);

}  // namespace airsim360::internal
