// Velocities that avoid each other: the linear programs of J. van den Berg, S. J. Guy, M. Lin, D. Manocha,
// "Reciprocal n-body collision avoidance", ISRR 2009 (sections 4 and 5), written from the paper.
#pragma once

#include <span>

#include "airsim360/math/vector.h"

namespace airsim360::internal {

/// Velocities v with Dot(v - point, normal) >= 0; `normal` is a unit vector.
struct HalfPlane {
  Vec2d point, normal;
};

/// The half-plane of velocities of A that A must keep to so that nobody touches within `horizon` seconds if B
/// does its part. `share`: how much of the change is A's (0.5 = both do half, 1 = B does nothing).
HalfPlane AvoidDisc(Vec2d p_AB, Vec2d v_A, Vec2d v_B, double radii, double horizon, double dt, double share);

/// The velocity nearest to `wanted` with |v| <= max_speed in all half-planes. The first `hard` ones hold in any
/// case (if they can); if the others cannot all hold, the largest violation is made as small as possible.
Vec2d SolveVelocity(std::span<const HalfPlane> planes, size_t hard, Vec2d wanted, double max_speed);

}  // namespace airsim360::internal
