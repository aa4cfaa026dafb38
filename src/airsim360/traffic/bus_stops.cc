#include "airsim360/traffic/bus_stops.h"

#include <algorithm>
#include <cmath>

#include "airsim360/base/random.h"

namespace airsim360 {
namespace internal {
namespace {

constexpr double kLookAhead = 120;        // metres
constexpr double kArrived = 1.5;          // metres before the stop
constexpr double kAtRest = 0.1;           // m/s
constexpr double kLeast = 8, kMost = 20;  // seconds

// The first stop of the lane beyond `s` metres; null: none.
const BusStop* NextStop(const TrafficModel& model, LaneId lane, double s) {
  const auto found = std::ranges::upper_bound(model.bus_stops, std::pair{lane, s}, {}, [](const BusStop& stop) {
    return std::pair{stop.lane, stop.s};
  });
  return found != model.bus_stops.end() && found->lane == lane ? &*found : nullptr;
}

// Stops that are served lie behind: so far along the lane a bus has none any more.
double ServedUpTo(const DrivingVehicle& own) { return std::max(own.served_s, own.s - kArrived); }

}  // namespace

double GapToBusStop(const TrafficModel& model, uint32_t vehicle, const DrivingVehicle& own) {
  if (!model.vehicles[vehicle].shape.bus || model.bus_stops.empty()) return INFINITY;
  double from = -own.s, gap = INFINITY;
  const BusStop* stop = NextStop(model, own.lane, ServedUpTo(own));
  if (stop != nullptr) gap = from + stop->s;
  from += model.lanes.length(own.lane);
  for (const LaneId lane : own.ahead) {
    if (std::isfinite(gap) || lane == kNoLane) break;
    if (const BusStop* next = NextStop(model, lane, 0)) gap = from + next->s;
    from += model.lanes.length(lane);
  }
  const double needed = own.v * own.v / (2 * 1.5 * model.vehicles[vehicle].driver.braking);
  return gap < kLookAhead && (gap >= needed || own.v < 1) ? gap : INFINITY;
}

bool ServesStopOn(const TrafficModel& model, uint32_t vehicle, LaneId lane, double s) {
  constexpr double kRoom = 25;  // metres to change the lane and to brake
  return model.vehicles[vehicle].shape.bus && NextStop(model, lane, s + kRoom) != nullptr;
}

void ServeBusStop(const TrafficModel& model, uint32_t vehicle, int64_t t_ns, DrivingVehicle& own) {
  if (own.halts_until_ns >= 0) {
    if (t_ns < own.halts_until_ns) return;
    own.halts_until_ns = -1;
    if (const BusStop* stop = NextStop(model, own.lane, ServedUpTo(own))) own.served_s = stop->s;
    return;
  }
  if (own.v > kAtRest || GapToBusStop(model, vehicle, own) > kArrived) return;
  RngStream rng(model.seed, "bus stop", uint64_t{vehicle} << 32 | own.choices++);
  own.halts_until_ns = t_ns + std::llround(rng.Uniform(kLeast, kMost) * 1e9);
}

}  // namespace internal

std::vector<BusStop> BusStopsBeside(const LaneMap& lanes, std::span<const Vec3d> places) {
  constexpr double kFarthest = 9, kPastTheSign = 2, kLongestBus = 13, kToTheEnd = 2;  // metres
  std::vector<BusStop> stops;
  for (const Vec3d p : places) {
    const auto between_junctions = [](const Lane& lane) { return lane.junction < 0 && !lane.cycle; };
    const auto on_the_right = [&](LaneId id, const NearestLanePoint& at) { return internal::LeftOfLane(lanes, id, at.s, p) <= 0; };
    const auto [beside, best] = internal::NearestLane(lanes, p, kFarthest, between_junctions, on_the_right);
    if (beside == kNoLane) continue;
    const double s = std::min(best.s + kPastTheSign, lanes.length(beside) - kToTheEnd);
    if (s > kLongestBus) stops.push_back({beside, s});
  }
  std::ranges::sort(stops, {}, [](const BusStop& stop) { return std::pair{stop.lane, stop.s}; });
  return stops;
}

}  // namespace airsim360
