#include "airsim360/traffic/occupancy.h"

#include <algorithm>

namespace airsim360::internal {
namespace {

constexpr double kSight = 120;  // metres: more than anybody needs to stop

// Calls body(lane, occupant) for all lanes that a vehicle is on.
template <class Body>
void VisitLanesOf(const TrafficModel& model, const DrivingVehicle& vehicle, uint32_t index, const Body& body) {
  if (IsParked(vehicle)) return;
  const double length = model.vehicles[index].shape.length;
  Occupant here{vehicle.s, vehicle.s - length, index};
  body(vehicle.lane, here);
  for (const LaneId behind : vehicle.behind) {
    if (here.rear >= 0 || behind == kNoLane) break;
    const double back = model.lanes.length(behind);
    here = {here.front + back, here.rear + back, index};
    body(behind, here);
  }
  if (vehicle.left_lane == kNoLane) return;
  const double s = vehicle.s / model.lanes.length(vehicle.lane) * model.lanes.length(vehicle.left_lane);
  body(vehicle.left_lane, Occupant{s, s - length, index});
}

}  // namespace

Occupancy::Occupancy(const TrafficModel& model, const TrafficState& state) : first_(model.lanes.size() + 1) {
  const auto count = static_cast<uint32_t>(state.vehicles.size());
  for (uint32_t i = 0; i < count; ++i) VisitLanesOf(model, state.vehicles[i], i, [&](LaneId lane, const Occupant&) { ++first_[lane + 1]; });
  for (size_t lane = 0; lane + 1 < first_.size(); ++lane) first_[lane + 1] += first_[lane];
  list_.resize(first_.back());
  std::vector<size_t> next = first_;
  for (uint32_t i = 0; i < count; ++i)
    VisitLanesOf(model, state.vehicles[i], i, [&](LaneId lane, const Occupant& o) { list_[next[lane]++] = o; });
  for (size_t lane = 0; lane + 1 < first_.size(); ++lane) {
    const auto begin = list_.begin() + static_cast<ptrdiff_t>(first_[lane]), end = list_.begin() + static_cast<ptrdiff_t>(first_[lane + 1]);
    std::sort(begin, end,
              [](const Occupant& a, const Occupant& b) { return a.front != b.front ? a.front < b.front : a.vehicle < b.vehicle; });
  }
}

const Occupant* Occupancy::Ahead(LaneId lane, double s, uint32_t self) const {
  for (const Occupant& o : On(lane))
    if (o.vehicle != self && (o.front > s || (o.front == s && o.vehicle > self))) return &o;
  return nullptr;
}

const Occupant* Occupancy::Behind(LaneId lane, double s, uint32_t self) const {
  const Occupant* last = nullptr;
  for (const Occupant& o : On(lane)) {
    if (o.front > s) break;
    if (o.vehicle != self) last = &o;
  }
  return last;
}

namespace {

// The nearest whose front is farther than `s` on a lane, or on a way that has not parted from it where its rear is.
const Occupant* AheadOnWays(const TrafficModel& model, const Occupancy& occupancy, LaneId lane, double s, uint32_t self) {
  const Occupant* nearest = occupancy.Ahead(lane, s, self);
  for (const LaneConflict& other : model.lanes.diverging(lane)) {
    const Occupant* o = occupancy.Ahead(other.other, s, self);
    if (o && o->rear < other.clear && (!nearest || o->rear < nearest->rear)) nearest = o;
  }
  return nearest;
}

}  // namespace

InFront FindInFront(const TrafficModel& model, const TrafficState& state, const Occupancy& occupancy, uint32_t vehicle) {
  const DrivingVehicle& self = state.vehicles[vehicle];
  const auto at = [&](const Occupant& o, double distance) { return InFront{distance + o.rear, state.vehicles[o.vehicle].v, o.vehicle}; };
  if (const Occupant* o = AheadOnWays(model, occupancy, self.lane, self.s, vehicle)) return at(*o, -self.s);
  double distance = model.lanes.length(self.lane) - self.s;
  for (const LaneId lane : self.ahead) {
    if (lane == kNoLane || distance > kSight) break;
    if (const Occupant* o = AheadOnWays(model, occupancy, lane, -INFINITY, vehicle)) return at(*o, distance);
    distance += model.lanes.length(lane);
  }
  return {};
}

}  // namespace airsim360::internal
