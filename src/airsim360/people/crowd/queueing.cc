// Lines before counters: one behind the other, a step up when the one before goes.
#include <algorithm>
#include <utility>

#include "airsim360/people/crowd/mind.h"

namespace airsim360::internal {

// The last place of a line is the first free one behind everybody who stands in it.
int32_t Mind::EndOfLine(double reach) const {
  const NavMesh& mesh = *tick_.model.navmesh;
  const std::vector<Place>& places = tick_.plan.places;
  int32_t best = -1;
  double nearest = reach;
  for (size_t k = 0; k < places.size();) {
    if (places[k].kind != PlaceKind::kQueue) {
      ++k;
      continue;
    }
    size_t end = k + 1;
    while (end < places.size() && places[end].kind == PlaceKind::kQueue && places[end].rank > 0) ++end;
    size_t last = end;
    while (last > k && tick_.in.place_taken[last - 1] == kNoPerson) --last;
    if (last < end && mesh.Component(places[last].approach) == mesh.Component(walker_.at)) {
      // Short lines are chosen rather than long ones.
      const double d = FlatDistance(places[last].p_W, walker_.at.p_W) + 4.0 * static_cast<double>(last - k);
      if (d < nearest) nearest = d, best = static_cast<int32_t>(last);
    }
    k = end;
  }
  return best;
}

void Mind::TakePlaceInLine(int32_t place) {
  LeavePlace(tick_, self_);
  agent_.place = place;
  tick_.in.place_taken[static_cast<size_t>(place)] = self_;
  SetGoal(tick_, self_, tick_.plan.places[static_cast<size_t>(place)].approach, 0, 0.15);
}

Status Mind::Queue(bool fresh, NodeMemory& memory, double reach, double min_s, double max_s, const std::string& cause) {
  if (fresh) {
    memory.t_ns = 0;
    if (std::exchange(agent_.begins, false) && agent_.at_place) return Status::kRunning;
    LeavePlace(tick_, self_);
    const int32_t place = EndOfLine(reach);
    if (place < 0) return Status::kFailure;
    TakePlaceInLine(place);
    return Status::kRunning;
  }
  if (agent_.place < 0) return Status::kFailure;
  const auto place = static_cast<size_t>(agent_.place);
  if (!agent_.at_place) {
    const Status status = OnTheWay();
    if (status == Status::kFailure) LeavePlace(tick_, self_);
    if (status != Status::kSuccess) return status;
    MoveFeet(tick_, self_, true);
    agent_.has_face = true;
    agent_.face_yaw = tick_.plan.places[place].yaw;
    EnterState(tick_, self_, kWaiting, 0, 0, cause);
    return Status::kRunning;
  }
  if (tick_.plan.places[place].rank > 0) {
    if (tick_.in.place_taken[place - 1] != kNoPerson) return Status::kRunning;
    EnterState(tick_, self_, kWalking, -1, 0, cause);
    TakePlaceInLine(agent_.place - 1);
    return Status::kRunning;
  }
  // First: served for a while.
  if (memory.t_ns == 0) memory.t_ns = tick_.t_ns + Seconds(agent_.rng.Uniform(min_s, std::max(min_s, max_s)));
  if (tick_.t_ns < memory.t_ns) return Status::kRunning;
  LeavePlace(tick_, self_);
  EnterState(tick_, self_, kWalking, -1, 0, cause);
  return Status::kSuccess;
}

}  // namespace airsim360::internal
