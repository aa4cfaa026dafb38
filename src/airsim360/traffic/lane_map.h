// A road network with what driving needs to look up: lengths, places along lanes, which ways cross each other.
#pragma once

#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "airsim360/scene/road_network.h"

namespace airsim360 {

/// Light that drivers see. kClearing: red, and everybody else's too, just after one's own amber.
enum class SignalLight : uint8_t { kGreen, kAmber, kClearing, kRed };

/// A place on a lane: centre line and direction of driving, both in W; the direction is a unit vector.
struct LanePoint {
  Vec3d p;
  Vec3d direction;
};

/// The place of a lane that is nearest to somewhere.
struct NearestLanePoint {
  double s = 0;         ///< metres from its beginning
  double distance = 0;  ///< metres
};

/// Another way through the same junction that cannot be driven at the same time, or not beside this one.
struct LaneConflict {
  LaneId other = kNoLane;
  double clear = 0;  ///< metres along `other` past which the rear of a vehicle on it is out of the way
  double apart = 0;  ///< only for two who need more than so much between the middles of their ways, metres
};

/// Metres between the middles of two ways in which any two cars that go straight on pass each other.
inline constexpr double kPassingWidth = 2.3;

/// Constant.
class LaneMap {
 public:
  /// InputError as CheckRoads.
  explicit LaneMap(std::shared_ptr<const RoadNetwork> roads);

  const RoadNetwork& roads() const { return *roads_; }
  const Lane& lane(LaneId id) const { return roads_->lanes[id]; }
  size_t size() const { return roads_->lanes.size(); }
  double length(LaneId id) const { return tables_[id].lengths.back(); }
  /// m/s, slower where the lane bends: 2 m/s^2 sideways at most.
  double speed(LaneId id) const { return tables_[id].speed; }
  /// Metres: the smallest that it bends with; infinite: straight.
  double radius(LaneId id) const { return tables_[id].radius; }
  /// Change of direction from beginning to end, radians in (-pi, pi], left positive.
  double turn(LaneId id) const { return tables_[id].turn; }
  /// At `s` metres from the beginning; before it and past the end the lane goes on straight.
  LanePoint At(LaneId id, double s) const;
  NearestLanePoint Nearest(LaneId id, Vec3d p) const;
  /// A way may be named more than once, for those who need little room and for those who need more.
  std::span<const LaneConflict> conflicts(LaneId id) const { return tables_[id].conflicts; }
  /// Whether others cross this way, join it or leave it: who stands on it is in their way.
  bool shared(LaneId id) const { return tables_[id].shared; }
  /// Other ways that begin where this one does, and how far along them a rear must be to leave room for a vehicle on this one.
  std::span<const LaneConflict> diverging(LaneId id) const { return tables_[id].diverging; }
  /// Lanes that end where this one begins.
  std::span<const LaneId> previous(LaneId id) const { return tables_[id].previous; }
  /// Of lanes without a signal: green.
  SignalLight LightAt(LaneId id, int64_t t_ns) const;

 private:
  struct Table {
    std::vector<double> lengths;  // metres to each point
    double speed = 0, turn = 0, radius = 0;
    std::vector<LaneConflict> conflicts, diverging;
    std::vector<LaneId> previous;
    bool shared = false;
  };

  void FindConflicts();

  std::shared_ptr<const RoadNetwork> roads_;
  std::vector<Table> tables_;
};

namespace internal {

/// The lane whose middle is nearest to `p`, nearer than `farthest` metres, of those for which counts(lane) and then
/// fits(lane, its nearest place); kNoLane: none.
template <class Counts, class Fits>
std::pair<LaneId, NearestLanePoint> NearestLane(const LaneMap& lanes, Vec3d p, double farthest, const Counts& counts, const Fits& fits) {
  std::pair<LaneId, NearestLanePoint> best{kNoLane, {.distance = farthest}};
  for (LaneId id = 0; id < lanes.size(); ++id) {
    if (!counts(lanes.lane(id))) continue;
    const NearestLanePoint at = lanes.Nearest(id, p);
    if (at.distance < best.second.distance && fits(id, at)) best = {id, at};
  }
  return best;
}

/// Metres that `p` is to the left of a lane's middle at `s`.
inline double LeftOfLane(const LaneMap& lanes, LaneId id, double s, Vec3d p) {
  const LanePoint at = lanes.At(id, s);
  const Vec3d away = p - at.p;
  return at.direction.x * away.y - at.direction.y * away.x;
}

}  // namespace internal
}  // namespace airsim360
