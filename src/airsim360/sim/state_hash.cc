// Every number of a simulation's state, in order.
#include "airsim360/base/state_hash.h"

#include "airsim360/sim/people/people.h"
#include "airsim360/sim/step.h"
#include "airsim360/traffic/traffic.h"

namespace airsim360 {
namespace {

template <class Values>
void AddAll(const Values& values, StateHasher& hasher) {
  for (const double value : values) hasher.Add(value);
}

void Add(const Kinematics& motion, StateHasher& hasher) {
  for (int i = 0; i < 3; ++i) hasher.Add(motion.X_WB.R.row(i));
  hasher.Add(motion.X_WB.p);
  hasher.Add(motion.v_WB);
  hasher.Add(motion.w_WB_B);
}

void Add(const DroneState& drone, StateHasher& hasher) {
  hasher.Add(drone.p_WB);
  hasher.Add(drone.q_WB);
  hasher.Add(drone.v_WB);
  hasher.Add(drone.w_WB_B);
  AddAll(drone.rotor_speeds, hasher);
  hasher.Add(drone.charge);
}

// All members are eight bytes wide (autopilot_state.h), so that its memory holds nothing else.
void Add(const AutopilotState& autopilot, StateHasher& hasher) {
  static_assert(sizeof(AutopilotState) % 8 == 0);
  const auto words = std::bit_cast<std::array<uint64_t, sizeof(AutopilotState) / 8>>(autopilot);
  for (const uint64_t word : words) hasher.Add(word);
}

void Add(const CollisionInfo& collision, StateHasher& hasher) {
  hasher.Add(collision.count);
  hasher.Add(collision.t_ns);
  for (const Vec3d& v : {collision.p_W, collision.normal_W, collision.p_WB}) hasher.Add(v);
  hasher.Add(collision.impact_speed);
  hasher.Add(collision.penetration);
  hasher.Add(collision.entity);
}

void Add(const WindState& wind, StateHasher& hasher) {
  hasher.Add(std::bit_cast<uint64_t>(wind.random));
  const DrydenState& air = wind.turbulence;
  hasher.Add(air.started);
  for (const double x : {air.u, air.roll, air.v[0], air.v[1], air.w[0], air.w[1], air.v_slow, air.w_slow}) hasher.Add(x);
}

void Add(const Vehicle& vehicle, StateHasher& hasher) {
  Add(vehicle.motion, hasher);
  hasher.Add(vehicle.a_WB);
  hasher.Add(vehicle.alpha_WB_B);
  hasher.Add(static_cast<double>(vehicle.clearance));
  hasher.Add(vehicle.following ? static_cast<uint64_t>(vehicle.following->start_ns) : ~uint64_t{0});
  Add(vehicle.drone, hasher);
  AddAll(vehicle.rotor_commands, hasher);
  AddAll(vehicle.health, hasher);
  Add(vehicle.autopilot, hasher);
  hasher.Add(vehicle.command.id);
  hasher.Add(vehicle.command.timeout_ns);
  hasher.Add(uint64_t{vehicle.command.command.index()});
  hasher.Add(vehicle.contact.free_distance);
  hasher.Add(vehicle.contact.crashed);
  hasher.Add(vehicle.touching);
  hasher.Add(vehicle.touched_ns);
  hasher.Add(vehicle.still_ns);
  Add(vehicle.collision, hasher);
  Add(vehicle.gusts, hasher);
  hasher.Add(vehicle.shelter);
  hasher.Add(vehicle.wind_W);
  HashSensors(vehicle.sensors, hasher);
  for (const TraceSample& sample : vehicle.trace) {
    hasher.Add(sample.t_ns);
    hasher.Add(sample.p_WB);
    hasher.Add(sample.q_WB);
  }
}

}  // namespace

uint64_t HashState(const SimState& state) {
  StateHasher hasher;
  hasher.Add(state.step);
  hasher.Add(state.t_ns);
  hasher.Add(state.wind_W);
  for (const Vehicle& vehicle : state.vehicles) Add(vehicle, hasher);
  if (state.people) hasher.Add(HashPeople(*state.people));
  if (state.traffic) hasher.Add(HashTraffic(*state.traffic));
  return hasher.hash();
}

}  // namespace airsim360
