#include "airsim360/scene/road_network.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "airsim360/base/error.h"

namespace airsim360 {
namespace {

constexpr float kMaxGap = 0.5f;      // metres between the end of a lane and the beginning of the next
constexpr float kMinLength = 1;      // metres
constexpr int32_t kMaxSignals = 32;  // bits of SignalPhase::green

[[noreturn]] void Refuse(const char* kind, size_t index, const std::string& what) {
  throw InputError(std::string("road network: ") + kind + " " + std::to_string(index) + " " + what);
}

bool Finite(Vec3f p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

float Length(const Lane& lane) {
  float length = 0;
  for (size_t i = 1; i < lane.points.size(); ++i) length += Norm(lane.points[i] - lane.points[i - 1]);
  return length;
}

void CheckShape(const Lane& lane, size_t i) {
  if (lane.points.size() < 2) Refuse("lane", i, "has fewer than 2 points");
  if (!std::ranges::all_of(lane.points, Finite)) Refuse("lane", i, "has a point that is not finite");
  for (size_t k = 1; k < lane.points.size(); ++k)
    if (lane.points[k] == lane.points[k - 1]) Refuse("lane", i, "has the same point twice in a row");
  if (Length(lane) < kMinLength) Refuse("lane", i, "is shorter than a metre");
  if (!(lane.width >= 1 && lane.width <= 20)) Refuse("lane", i, "has a width outside of 1 ... 20 m");
  if (!(lane.speed >= 0.5f && lane.speed <= 70)) Refuse("lane", i, "has a speed outside of 0.5 ... 70 m/s");
}

void CheckLinks(const RoadNetwork& roads, size_t i) {
  const Lane& lane = roads.lanes[i];
  if (lane.next.empty()) Refuse("lane", i, "leads nowhere");
  for (const LaneId next : lane.next) {
    if (next >= roads.lanes.size()) Refuse("lane", i, "leads to lane " + std::to_string(next) + ", which does not exist");
    if (Norm(roads.lanes[next].points.front() - lane.points.back()) > kMaxGap)
      Refuse("lane", i, "ends more than half a metre from the beginning of lane " + std::to_string(next));
  }
  for (const LaneId beside : {lane.left, lane.right})
    if (beside != kNoLane && (beside >= roads.lanes.size() || beside == i)) Refuse("lane", i, "has a neighbour that does not exist");
}

void CheckControl(const RoadNetwork& roads, size_t i) {
  const Lane& lane = roads.lanes[i];
  if (lane.junction < -1 || lane.junction >= static_cast<int64_t>(roads.junctions.size()))
    Refuse("lane", i, "leads through junction " + std::to_string(lane.junction) + ", which does not exist");
  if (lane.signal < -1 || lane.signal >= kMaxSignals) Refuse("lane", i, "has a signal outside of -1 ... 31");
  if (lane.signal >= 0 && lane.junction < 0) Refuse("lane", i, "has a signal but no junction");
}

void CheckJunction(const Junction& junction, size_t i) {
  if (!Finite(junction.center) || !std::isfinite(junction.radius) || !std::isfinite(junction.offset))
    Refuse("junction", i, "has a number that is not finite");
  for (const SignalPhase& phase : junction.phases)
    if (!(phase.seconds >= 1 && phase.seconds <= 600 && phase.amber >= 0 && phase.amber <= 60 && phase.all_red >= 0 && phase.all_red <= 60))
      Refuse("junction", i, "has a phase outside of 1 ... 600 s of green, 0 ... 60 s of amber and red");
}

}  // namespace

void CheckRoads(const RoadNetwork& roads) {
  for (size_t i = 0; i < roads.junctions.size(); ++i) CheckJunction(roads.junctions[i], i);
  for (size_t i = 0; i < roads.lanes.size(); ++i) CheckShape(roads.lanes[i], i);
  for (size_t i = 0; i < roads.lanes.size(); ++i) {
    CheckLinks(roads, i);
    CheckControl(roads, i);
  }
}

}  // namespace airsim360
