// Whether points lie inside a body: keypoints must, or a camera sees past the person where a label says
// "visible".
#pragma once

#include <span>
#include <vector>

#include "airsim360/people/body/body.h"

namespace airsim360 {

/// Generalised winding number of the body's own triangles (props left out) around a point of P at rest: about 0
/// outside, 1 and more inside, in between where clothes leave gaps (Jacobson et al. 2013, solid angles by van
/// Oosterom and Strackee 1983).
double WindingNumber(const BodyLevel& level, Vec3d p_P);

/// Whether the camera cannot look past the body at a point of P at rest: the winding number is more than half.
inline bool IsInside(const BodyLevel& level, Vec3d p_P) { return WindingNumber(level, p_P) > 0.5; }

/// Moves sockets that lie outside, or less than `margin` metres inside, of a level towards the middle of their limb,
/// by at most `farthest` metres. Coarser levels yield where all cannot be satisfied. Empty levels count for nothing.
void SeatSockets(std::span<const BodyLevel> levels, const std::array<Vec3d, kJointCount>& p_PJ, double margin, double farthest,
                 std::vector<Socket>& sockets);

}  // namespace airsim360
