// Who is where at the beginning of a tick, by lane.
#pragma once

#include <span>
#include <vector>

#include "airsim360/traffic/traffic.h"

namespace airsim360::internal {

/// A vehicle on a lane: its body covers rear ... front, metres from the beginning of the lane. Vehicles that reach over the
/// ends of lanes are on all of them; those that change lanes are on both.
struct Occupant {
  double front = 0, rear = 0;
  uint32_t vehicle = 0;
};

class Occupancy {
 public:
  Occupancy(const TrafficModel& model, const TrafficState& state);

  /// By growing front.
  std::span<const Occupant> On(LaneId lane) const { return {list_.data() + first_[lane], first_[lane + 1] - first_[lane]}; }
  /// The nearest on the lane whose front is farther than `s`, or not, but for `self`; null: nobody.
  const Occupant* Ahead(LaneId lane, double s, uint32_t self) const;
  const Occupant* Behind(LaneId lane, double s, uint32_t self) const;

 private:
  std::vector<size_t> first_;  // by lane, and the end
  std::vector<Occupant> list_;
};

/// What is in front of a vehicle on its way: `gap` metres from its front, at speed `v`, and who. Infinite: nothing.
struct InFront {
  double gap = INFINITY;
  double v = 0;
  uint32_t vehicle = 0;
};
InFront FindInFront(const TrafficModel& model, const TrafficState& state, const Occupancy& occupancy, uint32_t vehicle);

}  // namespace airsim360::internal
