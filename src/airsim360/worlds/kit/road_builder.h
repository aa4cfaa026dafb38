// Lanes from streets: beside an axis, round corners, back at dead ends.
#pragma once

#include <functional>
#include <vector>

#include "airsim360/scene/road_network.h"

namespace airsim360 {

/// Heads of the signals of two streets that cross.
inline constexpr int32_t kNorthSouthHead = 0, kEastWestHead = 1;
/// Their phases: east-west and north-south by turns in a cycle of 44 s, so that each drives while those walk who walk along
/// it (people/crowd).
std::vector<SignalPhase> CrossStreetSignals();

/// One lane of a road.
struct RoadLane {
  float offset = 1.8f;  ///< metres from the axis to the middle of the lane, to the right of its own driving direction
  float width = 3.2f;
  bool bus = false;
  bool cycle = false;  ///< for bicycles alone: the outermost lane, or the innermost beside others
};

/// A road between two junctions. Traffic keeps right.
struct RoadSpec {
  size_t from = 0, to = 0;                  ///< junctions
  std::vector<Vec2f> axis;                  ///< from stop line to stop line, at least two points
  std::vector<RoadLane> forward, backward;  ///< along the axis and against it, from the axis outwards
  float speed = 13.9f;                      ///< m/s
  uint8_t priority = 0;
  int32_t signal_to = -1, signal_from = -1;  ///< heads that those who come along the axis, and against it, obey
};

/// Metres between stop lines: on a shorter road a car would stand in one junction while it waits for the next.
inline constexpr float kHoldsACar = 7;

/// Joins roads at junctions: every lane leads straight on, left from the innermost and right from the outermost lane, back
/// only where no other road begins. Cycle lanes are entered from all sides; they lead straight on and right, those at the left
/// kerb straight on and left. Junctions with a road shorter than kHoldsACar between them are one: ways lead through it from road to
/// road, where the short ones lead there. It has the signals of the first of them that has any; heads of roads count there only.
/// Where a one-way road ends for good beside one that comes from nowhere, the first leads back into the second.
class RoadBuilder {
 public:
  /// `height`: of the carriageway at a place.
  explicit RoadBuilder(std::function<float(Vec2f)> height) : height_(std::move(height)) {}

  size_t AddJunction(Vec2f center, float radius, std::vector<SignalPhase> phases = {}, float offset = 0);
  /// A road so short and bent that a lane of it has no length is built straight; one that is too short even so, not at all.
  void AddRoad(RoadSpec road);
  RoadNetwork Build() const;

 private:
  std::function<float(Vec2f)> height_;
  std::vector<Junction> junctions_;
  std::vector<RoadSpec> roads_, inner_;  // inner: within what becomes one junction
};

}  // namespace airsim360
