// Our skeleton within the package's: which joint a bone stands for, weights, and sockets.
#pragma once

#include <array>
#include <vector>

#include "airsim360/math/transform.h"
#include "airsim360/people/body/body_pack.h"
#include "mh_data.h"

namespace airsim360::bake {

/// From the package's axes, decimetres, to P, metres.
Vec3f ToPerson(Vec3f v);

/// Our joints in P: each is an end of a bone where `bones` moved it. `v` are the vertices as modelled.
std::array<Vec3d, kJointCount> Joints(const BaseHuman& base, const std::vector<Vec3f>& v, const std::vector<RigidTransform>& bones);

/// Weights of the package folded onto our joints. A third of what lies on the lower forearm goes to the wrist,
/// so that the turn of the hand is spread.
Influences Folded(const BaseHuman& base, const std::array<int, 4>& bones, const std::array<float, 4>& weights);

/// The sockets in the order of kSocketNames. `v` are the vertices as modelled, `posed` those that are baked.
std::vector<Socket> Sockets(const BaseHuman& base, const std::vector<Vec3f>& v, const std::vector<RigidTransform>& bones,
                            const std::vector<Vec3f>& posed, const std::array<Vec3d, kJointCount>& q, double stature);

}  // namespace airsim360::bake
