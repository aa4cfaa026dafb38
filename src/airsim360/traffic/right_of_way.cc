#include "airsim360/traffic/right_of_way.h"

#include <algorithm>
#include <cmath>

namespace airsim360::internal {
namespace {

constexpr double kAsk = 3.5;          // seconds before the line at which a way is asked for
constexpr double kCriticalGap = 4.5;  // seconds: Highway Capacity Manual 2010, exhibit 19-10, left turns from a two-lane street 4.1
constexpr int64_t kPatienceNs = 25'000'000'000;  // after so long at the line others let one go
constexpr double kAtLine = 6;                    // metres
constexpr double kLeftTurn = 0.6;                // radians
constexpr double kFirmBraking = 3;               // m/s^2

// Metres that a vehicle needs on each side of the middle of a way: half of its width, and what its corners come out where it bends.
double RoomBeside(const TrafficModel& model, uint32_t vehicle, LaneId way) {
  constexpr double kBends = 0.1, kSpare = 0.1;  // metres
  const VehicleShape& shape = model.vehicles[vehicle].shape;
  // With both axles on an arc.
  const double swing = shape.length * shape.length / (13.5 * model.lanes.radius(way));
  return std::max(kPassingWidth / 2, shape.width / 2 + (swing < kBends ? 0 : swing + kSpare));
}

bool Stops(const DrivingVehicle& own, double distance, double braking) { return own.v * own.v / (2 * braking) < distance; }

}  // namespace

RightOfWay::RightOfWay(const TrafficModel& model, const TrafficState& state, const Occupancy& occupancy)
    : model_(model), state_(state), occupancy_(occupancy), granted_(model.lanes.size()) {
  for (uint32_t i = 0; i < state.vehicles.size(); ++i)
    if (state.vehicles[i].granted) granted_[state.vehicles[i].ahead[0]].push_back(i);
}

bool RightOfWay::IsBusy(uint32_t vehicle, LaneId way) const {
  const double room = RoomBeside(model_, vehicle, way);
  for (const LaneConflict& conflict : model_.lanes.conflicts(way)) {
    const auto meets = [&](uint32_t other) { return room + RoomBeside(model_, other, conflict.other) > conflict.apart; };
    if (std::ranges::any_of(granted_[conflict.other], meets)) return true;
    for (const Occupant& o : occupancy_.On(conflict.other))
      if (o.rear < conflict.clear && meets(o.vehicle)) return true;
  }
  return false;
}

int RightOfWay::Rank(LaneId way) const {
  const double turn = model_.lanes.turn(way);
  return 4 * model_.lanes.lane(way).priority + (turn > kLeftTurn ? 0 : turn < -kLeftTurn ? 1 : 2);
}

RightOfWay::Coming RightOfWay::ComingTo(LaneId way) const {
  Coming coming;
  for (const LaneId from : model_.lanes.previous(way)) {
    const std::span<const Occupant> there = occupancy_.On(from);
    // The first whose front is still on the lane.
    const auto first =
        std::find_if(there.rbegin(), there.rend(), [&](const Occupant& o) { return state_.vehicles[o.vehicle].lane == from; });
    if (first == there.rend()) continue;
    const DrivingVehicle& other = state_.vehicles[first->vehicle];
    if (other.ahead[0] != way) continue;
    const double distance = model_.lanes.length(from) - other.s;
    const double seconds = distance / std::max(other.v, 2.0);
    if (seconds >= coming.seconds) continue;
    const bool waits = other.stopped_ns >= 0 && distance < kAtLine;
    coming = {seconds, waits ? state_.t_ns - other.stopped_ns : 0, HasRoomBehind(first->vehicle), other.ahead[1], first->vehicle};
  }
  return coming;
}

bool RightOfWay::MustYield(uint32_t vehicle, LaneId way) const {
  const DrivingVehicle& own = state_.vehicles[vehicle];
  const int64_t own_wait = own.stopped_ns >= 0 ? state_.t_ns - own.stopped_ns : 0;
  const double beside = RoomBeside(model_, vehicle, way);
  LaneId looked_at = kNoLane;
  Coming coming;
  for (const LaneConflict& conflict : model_.lanes.conflicts(way)) {
    if (model_.lanes.LightAt(conflict.other, state_.t_ns + model_.signal_ns) != SignalLight::kGreen) continue;
    if (conflict.other != looked_at) coming = ComingTo(conflict.other);
    looked_at = conflict.other;
    if (!std::isfinite(coming.seconds) || beside + RoomBeside(model_, coming.vehicle, conflict.other) <= conflict.apart) continue;
    // Who has waited for long goes first, and keeps its turn for the room on the road that both want.
    const bool can_go = coming.room || coming.exit == own.ahead[1];
    if (coming.waited_ns > kPatienceNs && coming.waited_ns > own_wait && can_go) return true;
    if (!coming.room) continue;
    if (Rank(conflict.other) > Rank(way) && coming.seconds < kCriticalGap && own_wait <= kPatienceNs) return true;
  }
  return false;
}

bool RightOfWay::HasRoomBehind(uint32_t vehicle) const {
  const LaneId exit = state_.vehicles[vehicle].ahead[1];
  if (exit == kNoLane || !model_.lanes.shared(state_.vehicles[vehicle].ahead[0])) return true;
  // Behind all who are there, should they have to wait at its end. Who is longer than the road has it alone.
  const double needed = model_.vehicles[vehicle].shape.length + 1;
  double room = std::max(needed, model_.lanes.length(exit));
  const auto take = [&](uint32_t other) { room -= model_.vehicles[other].shape.length + model_.vehicles[other].driver.gap; };
  if (const Occupant* last = occupancy_.Ahead(exit, -INFINITY, vehicle)) {
    for (const Occupant& o : occupancy_.On(exit))
      if (o.vehicle != vehicle) take(o.vehicle);
    // As far as it comes if it brakes now.
    const double v = state_.vehicles[last->vehicle].v;
    room = std::min(room, std::max(0.0, last->rear) + v * v / (2 * kFirmBraking));
  }
  for (const LaneId before : model_.lanes.previous(exit)) {
    for (const uint32_t other : granted_[before]) take(other);
    for (const Occupant& o : occupancy_.On(before))
      if (o.vehicle != vehicle && state_.vehicles[o.vehicle].lane == before && model_.lanes.lane(before).junction >= 0) take(o.vehicle);
  }
  return room >= needed;
}

bool RightOfWay::MayEnter(uint32_t vehicle, double distance, bool first, DrivingVehicle& own) {
  const LaneId way = own.ahead[0];
  const SignalLight light = model_.lanes.LightAt(way, state_.t_ns + model_.signal_ns);
  const bool stops = Stops(own, distance, model_.vehicles[vehicle].driver.braking);
  if (own.granted) {
    constexpr double kEase = 1.5;  // metres more, so that nobody who was let go brakes hard
    if (light == SignalLight::kGreen || !Stops(own, distance - kEase, model_.vehicles[vehicle].driver.braking)) return true;
    own.granted = false;
    std::erase(granted_[way], vehicle);
    return false;
  }
  // Who waits to turn left goes when the others have stopped, at the end of green.
  const bool last_chance = model_.lanes.turn(way) > kLeftTurn && own.stopped_ns >= 0 && distance < kAtLine && first;
  if (light == SignalLight::kRed || (light != SignalLight::kGreen && stops && !last_chance)) return false;
  if (!first) return true;                                               // held by the one in front
  if (stops && distance > kAsk * std::max(own.v, 3.0) + 2) return true;  // too early to ask
  if (IsBusy(vehicle, way) || MustYield(vehicle, way) || !HasRoomBehind(vehicle)) return false;
  own.granted = true;
  granted_[way].push_back(vehicle);
  return true;
}

}  // namespace airsim360::internal
