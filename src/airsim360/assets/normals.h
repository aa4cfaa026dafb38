// Shading normals for meshes that come without.
#pragma once

#include "airsim360/scene/mesh.h"

namespace airsim360::internal {

/// Gives a normal to every corner whose vertex has none: no normals at all, or a zero or non-finite one. The
/// normal is the mean of the faces around the position (welded by coordinates), weighted by their angle there
/// (Thürmer and Wüthrich 1998), over those faces that turn less than `crease_deg` from the corner's own. A
/// vertex is split where its corners disagree. Other normals are scaled to length 1.
void FillMissingNormals(Mesh& mesh, double crease_deg = 40);

}  // namespace airsim360::internal
