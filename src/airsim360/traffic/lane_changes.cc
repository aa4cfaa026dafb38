#include "airsim360/traffic/lane_changes.h"

#include <algorithm>
#include <cmath>

#include "airsim360/traffic/bus_stops.h"
#include "airsim360/traffic/turns.h"

namespace airsim360::internal {
namespace {

constexpr int64_t kConsiderEvery = 10;                // ticks
constexpr int64_t kBetweenChangesNs = 8'000'000'000;  // of one vehicle
constexpr double kRunIn = 12, kRunOut = 45;           // metres of lane before and behind
constexpr double kLeastSpeed = 3;                     // m/s
constexpr double kLeastGap = 3;                       // metres to those in front and behind
constexpr double kToTheEdge = 1.5;                    // m/s^2 that a bicycle gives up to be on the lane on the right
constexpr double kToTheStop = 1.5;                    // m/s^2 that a bus gives up to be on the lane of its next stop

}  // namespace

bool LaneChanges::Allowed(uint32_t vehicle, const DrivingVehicle& own) const {
  if ((state_.t_ns / kTrafficTickNs + vehicle) % kConsiderEvery != 0) return false;
  const double rest = model_.lanes.length(own.lane) - own.s, rear = own.s - model_.vehicles[vehicle].shape.length;
  return model_.lanes.lane(own.lane).junction < 0 && rear > kRunIn && rest > kRunOut && own.v > kLeastSpeed && !own.granted &&
         own.parking == Parking::kNone && state_.t_ns - own.changed_ns > kBetweenChangesNs;
}

// Acceleration of `follower` with its front at `s` of a lane behind `front`.
double LaneChanges::Follow(uint32_t follower, LaneId lane, double s, const Occupant* front) const {
  const Driver& driver = model_.vehicles[follower].driver;
  const double v0 = WantedSpeed(driver, model_.lanes.speed(lane)), v = state_.vehicles[follower].v;
  if (front == nullptr) return IdmAcceleration(driver, v, v0, INFINITY, 0);
  return IdmAcceleration(driver, v, v0, front->rear - s, state_.vehicles[front->vehicle].v);
}

bool LaneChanges::Pays(uint32_t vehicle, LaneId target, double s) const {
  const DrivingVehicle& own = state_.vehicles[vehicle];
  const Occupant self{s, s - model_.vehicles[vehicle].shape.length, vehicle};
  const Occupant* front = occupancy_.Ahead(target, s, vehicle);
  const Occupant* behind = occupancy_.Behind(target, s, vehicle);
  if (front != nullptr && front->rear - s < kLeastGap) return false;
  if (behind != nullptr && self.rear - behind->front < kLeastGap) return false;

  const Occupant* old_front = occupancy_.Ahead(own.lane, own.s, vehicle);
  const Occupant* old_behind = occupancy_.Behind(own.lane, own.s, vehicle);
  const Occupant here{own.s, own.s - model_.vehicles[vehicle].shape.length, vehicle};
  LaneChangeCase c{.own_before = Follow(vehicle, own.lane, own.s, old_front), .own_after = Follow(vehicle, target, s, front)};
  if (behind != nullptr) {
    c.new_follower_before = Follow(behind->vehicle, target, behind->front, front);
    c.new_follower_after = Follow(behind->vehicle, target, behind->front, &self);
  }
  if (old_behind != nullptr) {
    c.old_follower_before = Follow(old_behind->vehicle, own.lane, old_behind->front, &here);
    c.old_follower_after = Follow(old_behind->vehicle, own.lane, old_behind->front, old_front);
  }
  c.bias = (own.lane == model_.lanes.lane(target).left ? kToTheEdge * model_.vehicles[vehicle].shape.bicycle : 0) +
           kToTheStop * (ServesStopOn(model_, vehicle, target, s) - ServesStopOn(model_, vehicle, own.lane, own.s));
  return PaysToChange(model_.vehicles[vehicle].driver, c);
}

bool LaneChanges::TakenThisTick(LaneId lane, double s) const {
  constexpr double kApart = 30;  // metres
  return std::ranges::any_of(taken_, [&](const auto& taken) { return taken.first == lane && std::abs(taken.second - s) < kApart; });
}

void LaneChanges::Consider(uint32_t vehicle, DrivingVehicle& own) {
  if (!Allowed(vehicle, own)) return;
  const Lane& lane = model_.lanes.lane(own.lane);
  for (const LaneId target : {lane.left, lane.right}) {
    const VehicleShape& shape = model_.vehicles[vehicle].shape;
    if (target == kNoLane || (model_.lanes.lane(target).bus && !shape.bus) || (target == lane.left && shape.bicycle)) continue;
    if (model_.lanes.lane(target).cycle && !shape.bicycle) continue;
    const double s = own.s / model_.lanes.length(own.lane) * model_.lanes.length(target);
    if (TakenThisTick(target, s) || !Pays(vehicle, target, s)) continue;
    Take(target, s);
    const LanePoint from = model_.lanes.At(own.lane, own.s), to = model_.lanes.At(target, s);
    own.shift = (from.p.x - to.p.x) * -to.direction.y + (from.p.y - to.p.y) * to.direction.x;
    own.shift += shape.aside(lane) - shape.aside(model_.lanes.lane(target));
    own.left_lane = own.lane;
    own.lane = target;
    own.s = s;
    own.changed_ns = state_.t_ns;
    own.behind = {kNoLane, kNoLane, kNoLane};
    own.served_s = -1;
    ChooseAhead(model_, vehicle, own);
    return;
  }
}

}  // namespace airsim360::internal
