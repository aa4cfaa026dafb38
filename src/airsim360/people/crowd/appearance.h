// From what people think to what is seen of them.
#pragma once

#include "airsim360/people/crowd/agent.h"

namespace airsim360::internal {

inline constexpr double kPi = 3.14159265358979323846;

/// Where the feet are at the end of a tick: on the mesh, or on a seat beside it.
Vec3d FeetOf(const CrowdPlan& plan, const CrowdInternals& in, PersonIndex i);
inline Vec3d FeetOf(const CrowdTick& tick, PersonIndex i) { return FeetOf(tick.plan, tick.in, i); }

/// Heading at the end of the tick and the fields of PersonState but place and yaw.
void Show(CrowdTick& tick, PersonIndex i, double dt);

}  // namespace airsim360::internal
