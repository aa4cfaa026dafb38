// A flight that is at given poses at given times, whatever is between.
#pragma once

#include <span>

#include "airsim360/sim/fly_route.h"
#include "airsim360/sim/pose_file.h"

namespace airsim360 {

/// One shot and one sample of the trajectory at each pose (at least one, ascending times from 0). Between them the people
/// and the traffic of the model go on; people see the body where it was last.
Flight VisitPoses(const SimModel& model, std::span<const TimedPose> poses);

}  // namespace airsim360
