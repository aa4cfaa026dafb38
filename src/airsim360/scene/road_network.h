// Lanes of a world as vehicles drive them: the constant input of traffic.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "airsim360/math/vector.h"

namespace airsim360 {

using LaneId = uint32_t;
inline constexpr LaneId kNoLane = UINT32_MAX;

/// A lane between two junctions, or a way through one.
struct Lane {
  std::vector<Vec3f> points;  ///< centre line in W on the carriageway, in driving direction; at least 2
  float width = 3.2f;         ///< metres
  float speed = 13.9f;        ///< limit, m/s
  std::vector<LaneId> next;   ///< lanes that begin where this one ends; at least one
  LaneId left = kNoLane;      ///< beside it in the same direction, to change to; kNoLane: none
  LaneId right = kNoLane;
  int32_t junction = -1;  ///< index of the junction that it leads through; -1: between junctions
  int32_t signal = -1;    ///< head of the junction's signals that holds at its beginning; -1: none
  uint8_t priority = 0;   ///< where no signal decides, lanes of a lower number give way
  bool bus = false;       ///< for buses alone
  bool cycle = false;     ///< for bicycles alone
};

/// Green of some heads of a junction, then amber of the same, then red of all.
struct SignalPhase {
  uint32_t green = 0;  ///< bit i: head i
  float seconds = 20;  ///< of green
  float amber = 3;     ///< seconds
  float all_red = 2;   ///< seconds
};

struct Junction {
  Vec3f center;
  float radius = 8;                 ///< metres: covers all its lanes
  std::vector<SignalPhase> phases;  ///< in turn, for ever; empty: no signals
  float offset = 0;                 ///< seconds into the first phase at time 0
};

struct RoadNetwork {
  std::vector<Lane> lanes;
  std::vector<Junction> junctions;
};

/// InputError naming the first lane or junction that breaks what is said above.
void CheckRoads(const RoadNetwork& roads);

}  // namespace airsim360
