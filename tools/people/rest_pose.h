// The pose that characters are baked in: nearer to how people stand than the one they were modelled in, so that
// little is left for four bones a vertex to do.
#pragma once

#include "airsim360/math/transform.h"
#include "mh_data.h"

namespace airsim360::bake {

/// Where every bone of the package goes, in its axes: upper arms 20 degrees from hanging instead of 40, the way shared
/// by collar bone, shoulder and upper arm as in people; elbows less bent; fingers side by side instead of spread.
/// `v` are the vertices as modelled.
std::vector<RigidTransform> RelaxedBones(const BaseHuman& base, const std::vector<Vec3f>& v);

/// Vertices of the base mesh or of a garment with these bones.
std::vector<Vec3f> Posed(const SourceMesh& mesh, const std::vector<Vec3f>& at, const std::vector<RigidTransform>& bones);

/// The mean of the vertices that mark an end of a bone ("wrist.L____head"), as modelled. InputError if there is none.
Vec3d BoneEnd(const BaseHuman& base, const std::vector<Vec3f>& v, const std::string& end);

/// The same where `bones` moved it.
Vec3d PosedEnd(const BaseHuman& base, const std::vector<Vec3f>& v, const std::vector<RigidTransform>& bones, const std::string& end);

}  // namespace airsim360::bake
