#include "airsim360/traffic/turns.h"

#include <cmath>

#include "airsim360/base/random.h"

namespace airsim360::internal {
namespace {

double Weight(const TrafficModel& model, LaneId lane, bool bus) {
  if (model.lanes.lane(lane).bus && !bus) return 1e-6;
  const double turn = std::abs(model.lanes.turn(lane));
  return turn < 0.6 ? 3 : turn < 2.4 ? 1 : 1e-3;
}

}  // namespace

LaneId ChooseNext(const TrafficModel& model, uint32_t vehicle, LaneId lane, DrivingVehicle& own) {
  const std::vector<LaneId>& next = model.lanes.lane(lane).next;
  RngStream rng(model.seed, "turn", uint64_t{vehicle} << 32 | own.choices++);
  const bool bus = model.vehicles[vehicle].shape.bus;
  double sum = 0;
  for (const LaneId id : next) sum += Weight(model, id, bus);
  double at = rng.Uniform() * sum;
  for (const LaneId id : next) {
    at -= Weight(model, id, bus);
    if (at < 0) return id;
  }
  return next.back();
}

void ChooseAhead(const TrafficModel& model, uint32_t vehicle, DrivingVehicle& own) {
  LaneId lane = own.lane;
  for (LaneId& ahead : own.ahead) lane = ahead = ChooseNext(model, vehicle, lane, own);
}

}  // namespace airsim360::internal
