#include "airsim360/traffic/place_vehicle.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "airsim360/base/error.h"
#include "airsim360/traffic/turns.h"

namespace airsim360 {
namespace {

constexpr double kRoom = 0.5;  // metres before and behind

// Others are taken as long as they are in the direction of this one: those beside it are on lanes of their own.
void CheckFree(const TrafficModel& model, const TrafficState& state, uint32_t vehicle) {
  const RigidTransform X_WB = PoseOf(model, state, vehicle, state.t_ns);
  const VehicleShape& own = model.vehicles[vehicle].shape;
  for (size_t i = 0; i < state.vehicles.size(); ++i) {
    const VehicleShape& other = model.vehicles[i].shape;
    const Vec3d away = PoseOf(model, state, i, state.t_ns).p - X_WB.p;
    if (i != vehicle && std::abs(Dot(away, X_WB.R.column(0))) < (own.length + other.length) / 2 + kRoom &&
        std::abs(Dot(away, X_WB.R.column(1))) < (own.width + other.width) / 2)
      throw InputError("point: another vehicle is in the way");
  }
}

}  // namespace

TrafficState WithVehicleAt(const TrafficModel& model, const TrafficState& state, uint32_t vehicle, Vec3d p) {
  const VehicleShape& shape = model.vehicles[vehicle].shape;
  const auto allowed = [&](const Lane& road) { return road.junction < 0 && (!road.bus || shape.bus) && (!road.cycle || shape.bicycle); };
  const auto has_room = [&](LaneId id, const NearestLanePoint&) { return model.lanes.length(id) >= shape.length; };
  const double beyond = std::nextafter(kFarthestLane, INFINITY);
  const auto [lane, best] = internal::NearestLane(model.lanes, p, beyond, allowed, has_room);
  if (lane == kNoLane) throw InputError("point: no lane is within " + std::to_string(static_cast<int>(kFarthestLane)) + " m of it");
  TrafficState changed = state;
  const double front = std::clamp(best.s + shape.length / 2, shape.length, model.lanes.length(lane));
  changed.vehicles[vehicle] = {.lane = lane, .s = front, .choices = state.vehicles[vehicle].choices};
  internal::ChooseAhead(model, vehicle, changed.vehicles[vehicle]);
  CheckFree(model, changed, vehicle);
  return changed;
}

}  // namespace airsim360
