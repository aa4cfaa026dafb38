// Flying a route through the simulation and noting what happened.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "airsim360/sim/step.h"

namespace airsim360 {

/// One trigger of the rig.
struct Shot {
  int64_t t_ns = 0;
  Kinematics body;
  std::shared_ptr<const PeopleState> people = nullptr;  ///< SimState::people then
  bool last = false;                                    ///< of a take: the next shot does not follow in time, the body goes on as it moves
  std::shared_ptr<const TrafficState> traffic = nullptr;  ///< SimState::traffic then
};

/// One moment of the recorded trajectory.
struct TrajectorySample {
  int64_t t_ns = 0;
  Kinematics body;
  Vec3d a_WB;
};

struct Flight {
  std::vector<Shot> shots;
  std::vector<TrajectorySample> trajectory;
  double least_clearance = 0;              ///< metres, over all steps, at most SimModel::contact_range
  std::vector<NearMiss> near_misses = {};  ///< that were over before its end; times are those of the shots
};

/// `n` times spread evenly over the route, the first at its start and the last at its end; one: at its start.
std::vector<int64_t> EvenTimes(const Route& route, int64_t n);

/// Simulates the whole route and takes a shot at the step nearest to each of `shot_times_ns` (ascending).
/// Records the trajectory ten times a second and at its end.
Flight FlyRoute(const SimModel& model, std::shared_ptr<const Route> route, std::span<const int64_t> shot_times_ns);

/// A flight that stays in one place: one shot at time 0.
Flight Hover(const RigidTransform& X_WB);

/// CSV with header t_s, px … qz: time, position, velocity and acceleration of B in W, attitude q_WB as w, x,
/// y, z. Numbers in the shortest form that reads back exactly.
std::string TrajectoryCsv(const Flight& flight);

}  // namespace airsim360
