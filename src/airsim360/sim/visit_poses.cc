#include "airsim360/sim/visit_poses.h"

#include <algorithm>
#include <memory>

#include "airsim360/sim/people/people.h"

namespace airsim360 {

Flight VisitPoses(const SimModel& model, std::span<const TimedPose> poses) {
  Flight flight;
  flight.least_clearance = model.contact_range;
  std::optional<PeopleState> people;
  if (model.people) people = *model.people->start;
  std::shared_ptr<const PeopleState> shown = model.people ? model.people->start : nullptr;
  int64_t ticked_ns = 0;
  Vec3d eye = poses.front().body.X_WB.p;
  for (const TimedPose& pose : poses) {
    // People are shown at most a tick after their state.
    bool moved = false;
    for (; people && ticked_ns + kCrowdTickNs <= pose.t_ns; ticked_ns += kCrowdTickNs) {
      const CrowdDrone drone{eye, {}};
      TickPeople(*model.people, {&drone, 1}, *people);
      moved = true;
    }
    if (moved) shown = std::make_shared<const PeopleState>(*people);
    eye = pose.body.X_WB.p;
    flight.shots.push_back({pose.t_ns, pose.body, shown});
    flight.trajectory.push_back({pose.t_ns, pose.body, {}});
    const double clearance = model.tracer->Clearance(VecCast<float>(eye), model.contact_range);
    flight.least_clearance = std::min(flight.least_clearance, clearance);
  }
  return flight;
}

}  // namespace airsim360
