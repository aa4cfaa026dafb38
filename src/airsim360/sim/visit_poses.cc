#include "airsim360/sim/visit_poses.h"

#include <algorithm>
#include <memory>

#include "airsim360/sim/living_world.h"
#include "airsim360/sim/people/people.h"
#include "airsim360/sim/traffic/traffic.h"

namespace airsim360 {

Flight VisitPoses(const SimModel& model, std::span<const TimedPose> poses) {
  Flight flight;
  flight.least_clearance = model.contact_range;
  std::optional<PeopleState> people;
  if (model.people) people = *model.people->start;
  std::shared_ptr<const PeopleState> shown = model.people ? model.people->start : nullptr;
  std::shared_ptr<const TrafficState> traffic = model.traffic ? model.traffic->start : nullptr;
  static_assert(kCrowdTickNs == kTrafficTickNs);
  int64_t ticked_ns = 0;
  Vec3d eye = poses.front().body.X_WB.p;
  for (const TimedPose& pose : poses) {
    // People and traffic are shown at most a tick after their state.
    bool moved = false;
    std::optional<TrafficState> driven;
    if (traffic && ticked_ns + kCrowdTickNs <= pose.t_ns) driven = *traffic;
    for (; ticked_ns + kCrowdTickNs <= pose.t_ns && (people || traffic); ticked_ns += kCrowdTickNs) {
      const CrowdDrone drone{eye, {}};
      if (people) TickPeopleAmong(model, driven ? &*driven : nullptr, {&drone, 1}, *people);
      if (driven) TickTrafficAmong(model, people ? &*people : nullptr, *driven, &flight.near_misses);
      moved = true;
    }
    if (moved && people) shown = std::make_shared<const PeopleState>(*people);
    if (driven) traffic = std::make_shared<const TrafficState>(*driven);
    eye = pose.body.X_WB.p;
    flight.shots.push_back({.t_ns = pose.t_ns, .body = pose.body, .people = shown, .traffic = traffic});
    flight.trajectory.push_back({pose.t_ns, pose.body, {}});
    const double clearance = model.tracer->Clearance(VecCast<float>(eye), model.contact_range);
    flight.least_clearance = std::min(flight.least_clearance, clearance);
  }
  for (NearMiss& miss : flight.near_misses) miss.t_ns -= model.traffic->epoch_ns;
  return flight;
}

}  // namespace airsim360
