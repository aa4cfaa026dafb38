#include "airsim360/traffic/turns.h"

#include <algorithm>
#include <cmath>

#include "airsim360/base/random.h"

namespace airsim360::internal {
namespace {

double Weight(const TrafficModel& model, LaneId lane, const VehicleShape& shape) {
  constexpr double kRidesApart = 20;  // times as likely are cycle lanes
  if (model.lanes.lane(lane).bus && !shape.bus) return 1e-6;
  if (model.lanes.lane(lane).cycle && !shape.bicycle) return 0;
  const double here = model.lanes.lane(lane).cycle ? kRidesApart : 1, turn = std::abs(model.lanes.turn(lane));
  return here * (turn < 0.6 ? 3 : turn < 2.4 ? 1 : 1e-3);
}

}  // namespace

LaneId ChooseNext(const TrafficModel& model, uint32_t vehicle, LaneId lane, DrivingVehicle& own) {
  const std::vector<LaneId>& next = model.lanes.lane(lane).next;
  RngStream rng(model.seed, "turn", uint64_t{vehicle} << 32 | own.choices++);
  const VehicleShape& shape = model.vehicles[vehicle].shape;
  double sum = 0;
  for (const LaneId id : next) sum += Weight(model, id, shape);
  double at = rng.Uniform() * sum;
  for (const LaneId id : next) {
    at -= Weight(model, id, shape);
    if (at < 0) return id;
  }
  return *std::ranges::max_element(next, {}, [&](LaneId id) { return Weight(model, id, shape); });
}

void ChooseAhead(const TrafficModel& model, uint32_t vehicle, DrivingVehicle& own) {
  LaneId lane = own.lane;
  for (LaneId& ahead : own.ahead) lane = ahead = ChooseNext(model, vehicle, lane, own);
}

}  // namespace airsim360::internal
