// From what people think to what is seen of them.
#pragma once

#include "airsim360/math/angles.h"
#include "airsim360/people/crowd/agent.h"

namespace airsim360::internal {

/// Heading at the end of the tick and the fields of PersonState but place and yaw.
void Show(CrowdTick& tick, PersonIndex i, double dt);

}  // namespace airsim360::internal
