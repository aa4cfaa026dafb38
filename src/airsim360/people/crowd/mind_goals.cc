#include <algorithm>
#include <cmath>
#include <utility>

#include "airsim360/people/crowd/mind.h"

namespace airsim360::internal {
namespace {

constexpr double kRightHere = 0.15;  // metres: reach of a place

}  // namespace

Status Mind::OnTheWay() {
  if (agent_.walk == Walk::kArrived) return agent_.walk = Walk::kNone, Status::kSuccess;
  if (agent_.walk == Walk::kFailed || agent_.walk == Walk::kNone) return agent_.walk = Walk::kNone, Status::kFailure;
  return Status::kRunning;
}

// A goal that was broken off (by a chat, by a drone) is taken up again.
Status Mind::WanderTo(bool fresh, uint32_t area, double speed) {
  if (fresh) {
    LeavePlace(tick_, self_);
    if (!agent_.has_errand) {
      const NavArea& ground = tick_.plan.ground[std::min<size_t>(area, tick_.plan.ground.size() - 1)];
      for (int attempt = 0; attempt < 8; ++attempt) {
        agent_.errand = tick_.model.navmesh->Pick(ground, agent_.rng);
        if (agent_.errand.valid() && (attempt == 7 || FlatDistance(agent_.errand.p_W, walker_.at.p_W) > 6)) break;
      }
      if (!agent_.errand.valid()) return Status::kFailure;
      agent_.has_errand = true;
    }
    SetGoal(tick_, self_, agent_.errand, speed, 0.6);
    return Status::kRunning;
  }
  const Status status = OnTheWay();
  if (status != Status::kRunning) agent_.has_errand = false;
  return status;
}

Status Mind::GoTo(bool fresh, const Value& point, double speed) {
  if (!fresh) return OnTheWay();
  LeavePlace(tick_, self_);
  if (point.kind == Value::Kind::kNone || point.kind == Value::Kind::kText) return Status::kFailure;
  Vec3d p = point.point;
  if (point.kind == Value::Kind::kPerson && point.index < tick_.in.walkers.size()) p = tick_.in.walkers[point.index].at.p_W;
  if (!point.has_height && point.kind != Value::Kind::kPerson) p.z = walker_.at.p_W.z;
  const NavPoint goal = tick_.model.navmesh->Nearest(p, 3);
  if (!goal.valid()) return Status::kFailure;
  SetGoal(tick_, self_, goal, speed, 0.5);
  return Status::kRunning;
}

Status Mind::GoToPlace(bool fresh, PlaceKind kind, double reach) {
  if (fresh && std::exchange(agent_.begins, false) && agent_.at_place) return Status::kSuccess;
  if (fresh) {
    LeavePlace(tick_, self_);
    // One of the three nearest free ones.
    std::vector<std::pair<double, int32_t>> found;
    const NavMesh& mesh = *tick_.model.navmesh;
    for (size_t k = 0; k < tick_.plan.places.size(); ++k) {
      const Place& place = tick_.plan.places[k];
      if (place.kind != kind || tick_.in.place_taken[k] != kNoPerson || !Fits(place, tick_.model.people[self_].stature)) continue;
      const double d = FlatDistance(place.p_W, walker_.at.p_W);
      if (d < reach && d > 2 && mesh.Component(place.approach) == mesh.Component(walker_.at))
        found.emplace_back(d, static_cast<int32_t>(k));
    }
    if (found.empty()) return Status::kFailure;
    const size_t n = std::min<size_t>(3, found.size());
    std::partial_sort(found.begin(), found.begin() + static_cast<int64_t>(n), found.end());
    agent_.place = found[agent_.rng.Index(static_cast<uint32_t>(n))].second;
    tick_.in.place_taken[static_cast<size_t>(agent_.place)] = self_;
    SetGoal(tick_, self_, tick_.plan.places[static_cast<size_t>(agent_.place)].approach, 0, kRightHere);
    return Status::kRunning;
  }
  // Whoever stepped away from a drone meanwhile, or was sent elsewhere, has no place any more.
  if (agent_.place < 0) return Status::kFailure;
  if (!agent_.at_place) {
    const Status status = OnTheWay();
    if (status == Status::kFailure) LeavePlace(tick_, self_);
    if (status != Status::kSuccess) return status;
    const Place& place = tick_.plan.places[static_cast<size_t>(agent_.place)];
    MoveFeet(tick_, self_, true);
    agent_.has_face = true;
    agent_.face_yaw = place.yaw;
  }
  return Turned() ? Status::kSuccess : Status::kRunning;
}

void Mind::Face(Vec3d p) {
  agent_.has_face = true;
  agent_.face_yaw = std::atan2(p.y - walker_.at.p_W.y, p.x - walker_.at.p_W.x);
}
bool Mind::Turned() const { return std::cos(tick_.in.to_yaw[self_] - agent_.face_yaw) > 0.95; }

Status Mind::LookAtDrone(bool fresh, double distance, double min_s, double max_s, const std::string& cause) {
  double d = 0;
  const int drone = NearestDrone(tick_, self_, &d);
  if (fresh) {
    if (drone < 0) return Status::kFailure;
    // Most look, some point at it or take a photo.
    const double u = agent_.rng.Uniform();
    const BuiltInState state = u < 0.55 ? kLookingUp : u < 0.75 ? kPointing : kTakingPhoto;
    if (!EnterState(tick_, self_, state, min_s, max_s, cause)) return Status::kFailure;
  }
  const bool looks = agent_.state == kLookingUp || agent_.state == kPointing || agent_.state == kTakingPhoto;
  if (drone < 0 || d > distance || !looks) {
    agent_.gaze_drone = -1;
    agent_.has_face = agent_.at_place;
    if (looks) EnterState(tick_, self_, tick_.plan.states[agent_.state].next, -1, 0, "the drone is gone");
    return Status::kSuccess;
  }
  agent_.gaze_drone = drone;
  if (!agent_.at_place) Face(tick_.drones[static_cast<size_t>(drone)].p_W);
  return Status::kRunning;
}

Status Mind::StepAway(bool fresh, double distance) {
  double d = 0;
  const int drone = NearestDrone(tick_, self_, &d);
  if (!fresh) {
    const Status status = OnTheWay();
    return drone < 0 || d >= distance ? (DropGoal(tick_, self_), Status::kSuccess) : status;
  }
  if (drone < 0) return Status::kFailure;
  LeavePlace(tick_, self_);
  if (tick_.plan.states[agent_.state].stop) EnterState(tick_, self_, kWalking, -1, 0, "tree: StepAway");
  const Vec3d away = walker_.at.p_W - tick_.drones[static_cast<size_t>(drone)].p_W;
  const double n = std::hypot(away.x, away.y), ux = n > 0.1 ? away.x / n : 1, uy = n > 0.1 ? away.y / n : 0;
  const NavPoint goal = tick_.model.navmesh->Move(walker_.at, {walker_.at.p_W.x + ux * distance, walker_.at.p_W.y + uy * distance});
  if (FlatDistance(goal.p_W, walker_.at.p_W) < 0.5) return Status::kFailure;
  SetGoal(tick_, self_, goal, 0, 0.4);
  return Status::kRunning;
}

}  // namespace airsim360::internal
