#include "airsim360/traffic/traffic.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "airsim360/base/error.h"
#include "airsim360/base/random.h"
#include "airsim360/base/state_hash.h"
#include "airsim360/traffic/bus_stops.h"
#include "airsim360/traffic/lane_changes.h"
#include "airsim360/traffic/near_misses.h"
#include "airsim360/traffic/obstacles.h"
#include "airsim360/traffic/parking.h"
#include "airsim360/traffic/pedalling.h"
#include "airsim360/traffic/right_of_way.h"
#include "airsim360/traffic/turns.h"

namespace airsim360 {
namespace {

using internal::AlongWay;
using internal::InFront;
using internal::LaneChanges;
using internal::ObstacleGrid;
using internal::Occupancy;
using internal::ParkingTick;
using internal::RightOfWay;

constexpr double kStopBefore = 0.8;  // metres before a stop line
constexpr double kStopGap = 1.5;     // metres before somebody in the way
constexpr double kHaltBefore = 0.3;  // metres before a bus stop, and before the end of a bay
constexpr double kStands = 0.1;      // m/s
constexpr double kWalkingPace = 1;   // m/s
constexpr double kParkingSpeed = 3;  // m/s into a bay and out of it
constexpr double kTick = static_cast<double>(kTrafficTickNs) * 1e-9;
constexpr int64_t kLookForMisses = 2;  // ticks between looks at them
constexpr double kSlot = 14;           // metres of lane for each vehicle at the start: a bus of 12

// From which a driver is down to `v` in `distance` metres.
double SlowedBy(const Driver& driver, double v, double distance) {
  return std::sqrt(v * v + 2 * 0.7 * driver.braking * std::max(0.0, distance));
}

// With which one may come to a lane, so that one can stop at its end.
double SpeedInto(const LaneMap& lanes, LaneId lane) {
  constexpr double kFirmBraking = 3;  // m/s^2
  const bool ends_at_line = lanes.lane(lanes.lane(lane).next.front()).junction >= 0;
  return ends_at_line ? std::sqrt(2 * kFirmBraking * std::max(0.5, lanes.length(lane) - kStopBefore)) : INFINITY;
}

// The speed that a driver wants here: slower before bends and short lanes that come, and before its bay.
double SpeedHere(const TrafficModel& model, uint32_t vehicle, const DrivingVehicle& own) {
  const Driver& driver = model.vehicles[vehicle].driver;
  double wanted = WantedSpeed(driver, model.lanes.speed(own.lane)), distance = model.lanes.length(own.lane) - own.s;
  for (const LaneId lane : own.ahead) {
    if (lane == kNoLane) break;
    const double there = std::min(WantedSpeed(driver, model.lanes.speed(lane)), SpeedInto(model.lanes, lane));
    wanted = std::min(wanted, SlowedBy(driver, there, distance));
    distance += model.lanes.length(lane);
  }
  if (own.parking != Parking::kNone) wanted = std::min(wanted, SlowedBy(driver, kParkingSpeed, internal::ToParkingTurn(model, own)));
  return wanted;
}

// Acceleration towards something that stands `gap` metres ahead, to stop `before` metres from it.
double StopFor(const Driver& driver, double v, double v0, double gap, double before) {
  Driver stopping = driver;
  stopping.gap = before;
  return IdmAcceleration(stopping, v, v0, gap, 0);
}

// Everything that one vehicle looks at in a tick.
struct Look {
  const TrafficModel& model;
  const TrafficState& state;
  const Occupancy& occupancy;
  const ObstacleGrid& obstacles;
  RightOfWay& right_of_way;
};

double Accelerate(const Look& look, uint32_t i, DrivingVehicle& own) {
  const Driver& driver = look.model.vehicles[i].driver;
  if (own.halts_until_ns >= 0) return -driver.braking;
  const double reach = own.v * own.v / (2 * driver.braking) + own.v * driver.headway + 3;
  const internal::InTheWay way = look.obstacles.Find(look.model, look.state, i, reach);
  const double v0 = std::min(SpeedHere(look.model, i, own), SlowedBy(driver, kWalkingPace, way.beside));
  const InFront front = FindInFront(look.model, look.state, look.occupancy, i);
  double a = IdmAcceleration(driver, own.v, v0, front.gap, front.v);

  const double to_stop = std::min(internal::GapToBusStop(look.model, i, own), internal::GapToBay(look.model, own));
  if (std::isfinite(to_stop)) a = std::min(a, StopFor(driver, own.v, v0, to_stop, kHaltBefore));

  // Who halts before the line does not hold the junction meanwhile.
  const double to_line = look.model.lanes.length(own.lane) - own.s;
  const bool goes_on = to_stop > to_line;
  if (goes_on && look.model.lanes.lane(own.ahead[0]).junction >= 0 && !look.right_of_way.MayEnter(i, to_line, front.gap > to_line, own))
    a = std::min(a, StopFor(driver, own.v, v0, to_line, kStopBefore));

  if (std::isfinite(way.gap)) a = std::min(a, StopFor(driver, own.v, v0, way.gap, kStopGap));
  return a;
}

// Over the ends of lanes, as far as it has come.
void EnterNextLanes(const TrafficModel& model, uint32_t i, DrivingVehicle& own) {
  while (own.s > model.lanes.length(own.lane)) {
    own.s -= model.lanes.length(own.lane);
    own.behind = {own.lane, own.behind[0], own.behind[1]};
    own.lane = own.ahead[0];
    own.ahead[0] = own.ahead[1];
    own.ahead[1] = internal::ChooseNext(model, i, own.ahead[0], own);
    own.granted = false;
    own.left_lane = kNoLane;
    own.served_s = -1;
  }
}

int8_t IndicatorOf(const TrafficModel& model, const DrivingVehicle& own, int64_t t_ns) {
  constexpr double kTurns = 0.6, kSoon = 30;  // radians, metres
  if (own.halts_until_ns >= 0) return -1;
  if (own.parking == Parking::kArriving && internal::ToParkingTurn(model, own) < kSoon) return -1;
  if (own.parking == Parking::kLeaving) return 1;
  const auto side = [](double left) { return static_cast<int8_t>(left > 0 ? 1 : -1); };
  if (t_ns - own.changed_ns < kLaneChangeNs) return side(-own.shift);
  const double here = model.lanes.turn(own.lane), next = model.lanes.turn(own.ahead[0]);
  if (model.lanes.lane(own.lane).junction >= 0) return std::abs(here) > kTurns ? side(here) : int8_t{0};
  const bool soon = model.lanes.length(own.lane) - own.s < kSoon && model.lanes.lane(own.ahead[0]).junction >= 0;
  return soon && std::abs(next) > kTurns ? side(next) : int8_t{0};
}

// Who has waited at the line for long takes another way where there is one: else a ring of full roads would stand for ever.
void TryAnotherWay(const TrafficModel& model, uint32_t i, int64_t t_ns, DrivingVehicle& own) {
  constexpr int64_t kPatienceNs = 30'000'000'000, kEveryNs = 5'000'000'000;
  constexpr double kAtLine = 6;  // metres
  const int64_t waited = t_ns - own.stopped_ns;
  if (own.stopped_ns < 0 || own.granted || waited < kPatienceNs || waited % kEveryNs != 0) return;
  if (model.lanes.lane(own.lane).junction >= 0 || model.lanes.length(own.lane) - own.s > kAtLine) return;
  internal::ChooseAhead(model, i, own);
}

void Advance(const TrafficModel& model, uint32_t i, int64_t t_ns, DrivingVehicle& own) {
  const double before = own.v;
  own.v = std::max(0.0, own.v + own.a * kTick);
  own.s += (before + own.v) / 2 * kTick;
  EnterNextLanes(model, i, own);
  if (own.left_lane != kNoLane && t_ns - own.changed_ns > kLaneChangeNs * 3 / 4) own.left_lane = kNoLane;
  own.braking = own.a < -0.5 || (own.v < kStands && own.a <= 0);
  internal::ServeBusStop(model, i, t_ns, own);
  own.indicator = IndicatorOf(model, own, t_ns);
  if (own.v >= kStands) own.stopped_ns = -1;
  if (own.v < kStands && own.stopped_ns < 0) own.stopped_ns = t_ns;
  TryAnotherWay(model, i, t_ns, own);
}

struct Slot {
  LaneId lane;
  double s;
};

std::vector<Slot> SlotsOf(const LaneMap& lanes) {
  std::vector<Slot> slots;
  for (LaneId id = 0; id < lanes.size(); ++id) {
    if (lanes.lane(id).junction >= 0 || lanes.lane(id).bus || lanes.lane(id).cycle) continue;
    for (double s = kSlot; s + 2 < lanes.length(id); s += kSlot) slots.push_back({id, s});
  }
  return slots;
}

// Metres to the left of the lane, `late` seconds after the front axle.
double ShiftAt(const DrivingVehicle& vehicle, int64_t t_ns, double late) {
  const double t = (static_cast<double>(t_ns - vehicle.changed_ns) * 1e-9 - late) / (static_cast<double>(kLaneChangeNs) * 1e-9);
  const double u = std::clamp(t, 0.0, 1.0);
  return vehicle.shift * (1 - u * u * (3 - 2 * u));
}

Vec3d AxleAt(const TrafficModel& model, const DrivingVehicle& vehicle, const VehicleShape& shape, int64_t t_ns, double ahead, double late) {
  const LanePoint at = AlongWay(model, vehicle, shape, ahead);
  const double shift = ShiftAt(vehicle, t_ns, late);
  return at.p + Vec3d{-at.direction.y * shift, at.direction.x * shift, 0};
}

}  // namespace

size_t TrafficCapacity(const LaneMap& lanes) { return SlotsOf(lanes).size(); }

TrafficState StartTraffic(const TrafficModel& model) {
  std::vector<Slot> slots = SlotsOf(model.lanes);
  const size_t count = model.vehicles.size();
  if (count > slots.size())
    throw InputError("traffic: " + std::to_string(count) + " vehicles; the roads of this world hold " + std::to_string(slots.size()));
  RngStream rng(model.seed, "traffic start");
  for (size_t i = 0; i < count; ++i) std::swap(slots[i], slots[i + rng.Index(static_cast<uint32_t>(slots.size() - i))]);
  TrafficState state;
  for (uint32_t i = 0; i < count; ++i) {
    DrivingVehicle vehicle{.lane = slots[i].lane, .s = slots[i].s};
    internal::ChooseAhead(model, i, vehicle);
    state.vehicles.push_back(vehicle);
  }
  return state;
}

void TickTraffic(const TrafficModel& model, std::span<const TrafficObstacle> obstacles, TrafficState& state, std::vector<NearMiss>* over) {
  // All look at the beginning of the tick; grants and lane changes go one after the other.
  const TrafficState before = state;
  const Occupancy occupancy(model, before);
  const ObstacleGrid grid(obstacles);
  RightOfWay right_of_way(model, before, occupancy);
  LaneChanges lane_changes(model, before, occupancy);
  ParkingTick parking(model, before, occupancy, grid, lane_changes);
  const Look look{model, before, occupancy, grid, right_of_way};
  const int64_t t_ns = state.t_ns + kTrafficTickNs;
  if (before.t_ns % (kTrafficTickNs * kLookForMisses) == 0)
    internal::UpdateEncounters(internal::CriticalPairs(model, before, occupancy, obstacles), before.t_ns, state.encounters, over);
  for (uint32_t i = 0; i < state.vehicles.size(); ++i) {
    DrivingVehicle& own = state.vehicles[i];
    if (IsParked(own)) {
      parking.Stay(i, t_ns, own);
      continue;
    }
    own.a = Accelerate(look, i, own);
    lane_changes.Consider(i, own);
    Advance(model, i, t_ns, own);
    parking.Consider(i, t_ns, own);
  }
  state.t_ns = t_ns;
  for (uint32_t i = 0; i < state.vehicles.size(); ++i)
    if (model.vehicles[i].shape.bicycle) internal::Pedal(model, before, i, state);
}

RigidTransform PoseOf(const TrafficModel& model, const TrafficState& state, size_t vehicle, int64_t t_ns) {
  const DrivingVehicle& own = state.vehicles[vehicle];
  const VehicleShape& shape = model.vehicles[vehicle].shape;
  const double moved = own.v * static_cast<double>(t_ns - state.t_ns) * 1e-9, front = moved - shape.front_overhang();
  const double late = shape.wheelbase() / std::max(own.v, 2.0);
  const Vec3d f = AxleAt(model, own, shape, t_ns, front, 0), r = AxleAt(model, own, shape, t_ns, front - shape.wheelbase(), late);
  const Vec3d x = Normalized(f - r), left = Normalized(Vec3d{-x.y, x.x, 0});
  const Mat3d R = Mat3d::FromColumns(x, left, Cross(x, left));
  return {shape.bicycle ? R * RotationX(-internal::LeanInBend(model, own, shape, moved)) : R,
          f - x * (shape.length / 2 - shape.front_overhang())};
}

Vec3d VelocityOf(const TrafficModel& model, const TrafficState& state, size_t vehicle) {
  // The front goes along its lane at the speed of the vehicle; in a bend the middle goes slower, and not where the front looks.
  const Vec3d p = PoseOf(model, state, vehicle, state.t_ns).p, later = PoseOf(model, state, vehicle, state.t_ns + kTrafficTickNs).p;
  return (later - p) / (static_cast<double>(kTrafficTickNs) * 1e-9);
}

uint64_t HashTraffic(const TrafficState& state) {
  StateHasher hasher;
  hasher.Add(state.t_ns);
  for (const DrivingVehicle& v : state.vehicles) {
    for (const LaneId lane : {v.lane, v.ahead[0], v.ahead[1], v.behind[0], v.behind[1], v.behind[2], v.left_lane}) hasher.Add(lane);
    for (const double value : {v.s, v.v, v.a, v.shift, v.served_s, v.leaves_s}) hasher.Add(value);
    for (const int64_t value : {v.changed_ns, v.stopped_ns, v.halts_until_ns, v.parks_until_ns, int64_t{v.indicator}}) hasher.Add(value);
    hasher.Add(uint64_t{v.bay} << 8 | static_cast<uint8_t>(v.parking));
    for (const bool value : {v.granted, v.braking}) hasher.Add(value);
    hasher.Add(v.choices);
    for (const double value : {v.rolled, v.crank}) hasher.Add(value);
  }
  for (const Encounter& e : state.encounters) {
    for (const RoadUser& who : {e.worst.a, e.worst.b}) hasher.Add(uint64_t{static_cast<uint8_t>(who.kind)} << 32 | who.index);
    for (const int64_t value : {e.worst.t_ns, e.seen_ns}) hasher.Add(value);
    for (const double value : {e.worst.seconds, e.worst.braking}) hasher.Add(value);
    hasher.Add(e.worst.p);
  }
  return hasher.hash();
}

}  // namespace airsim360
