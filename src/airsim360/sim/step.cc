#include "airsim360/sim/step.h"

#include <bit>
#include <string>

#include "airsim360/base/error.h"
#include "airsim360/base/random.h"

namespace airsim360 {
namespace {

void ApplyCommands(std::span<const RouteCommand> commands, SimState& state) {
  for (const RouteCommand& command : commands) {
    if (command.vehicle >= state.vehicles.size()) {
      throw InputError("command for vehicle " + std::to_string(command.vehicle) + " of " +
                       std::to_string(state.vehicles.size()));
    }
    state.vehicles[command.vehicle].following = FollowRoute{command.route, state.t_ns};
  }
}

// Vehicles that follow a route are where it is at the state's time.
void PlanMotion(SimState& state) {
  for (Vehicle& vehicle : state.vehicles) {
    if (!vehicle.following) continue;
    const FollowRoute& following = *vehicle.following;
    const RoutePoint point = following.route->At(static_cast<double>(state.t_ns - following.start_ns) * 1e-9);
    vehicle.motion = {BodyPose(point.p, point.yaw, 0, 0), point.v, {0, 0, point.yaw_rate}};
    vehicle.a_WB = point.a;
  }
}

void QueryContacts(const SimModel& model, SimState& state) {
  for (Vehicle& vehicle : state.vehicles) {
    vehicle.clearance = model.tracer->Clearance(VecCast<float>(vehicle.motion.X_WB.p), model.contact_range);
  }
}

// Order-dependent mixing of 64-bit words.
class StateHasher {
 public:
  void Add(uint64_t bits) { hash_ = MixBits(hash_ ^ bits) + 0x9e3779b97f4a7c15ull; }
  void Add(double value) { Add(std::bit_cast<uint64_t>(value)); }
  void Add(Vec3d v) {
    for (int i = 0; i < 3; ++i) Add(v[i]);
  }
  uint64_t hash() const { return hash_; }

 private:
  uint64_t hash_ = 0;
};

}  // namespace

Vehicle VehicleAt(const SimModel& model, const RigidTransform& X_WB) {
  Vehicle vehicle{.motion = {X_WB, {}, {}}, .a_WB = {}, .clearance = 0, .following = {}};
  vehicle.clearance = model.tracer->Clearance(VecCast<float>(X_WB.p), model.contact_range);
  return vehicle;
}

void Step(const SimModel& model, std::span<const RouteCommand> commands, SimState& state) {
  ApplyCommands(commands, state);
  ++state.step;
  state.t_ns += model.dt_ns;
  PlanMotion(state);
  QueryContacts(model, state);
}

uint64_t HashState(const SimState& state) {
  StateHasher hasher;
  hasher.Add(static_cast<uint64_t>(state.step));
  hasher.Add(static_cast<uint64_t>(state.t_ns));
  for (const Vehicle& vehicle : state.vehicles) {
    for (int i = 0; i < 3; ++i) hasher.Add(vehicle.motion.X_WB.R.row(i));
    hasher.Add(vehicle.motion.X_WB.p);
    hasher.Add(vehicle.motion.v_WB);
    hasher.Add(vehicle.motion.w_WB_B);
    hasher.Add(vehicle.a_WB);
    hasher.Add(static_cast<double>(vehicle.clearance));
    hasher.Add(vehicle.following ? static_cast<uint64_t>(vehicle.following->start_ns) : ~uint64_t{0});
  }
  return hasher.hash();
}

}  // namespace airsim360
