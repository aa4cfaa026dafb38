// Example 5: plan the smoothest trajectory through waypoints within limits, and fly it.
//   build/bin/05_minimum_snap
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <vector>

#include "airsim360/flight/drones/catalog.h"
#include "airsim360/opening/world_loader.h"
#include "airsim360/planning/splines/time_allocation.h"
#include "airsim360/sim/sim_loop.h"
#include "airsim360/sim/trajectory_reference.h"

int main() {
  using namespace airsim360;

  // Around the room, at most 3 m/s and 4 m/s^2 anywhere on the way.
  const std::vector<Vec3d> waypoints = {{-3, -3, 2}, {3, -3, 3}, {3, 3, 2}, {-3, 3, 3}, {-3, -3, 2}};
  TrajectoryLimits limits;
  limits.speed = 3;
  limits.acceleration = 4;
  const auto trajectory =
      std::make_shared<const PolynomialTrajectory>(AllocateTimes(waypoints, limits).trajectory);
  std::printf("%zu waypoints in %.2f s\n", waypoints.size(), trajectory->duration());

  // A drone hovers at the first waypoint; its autopilot follows the plan with every derivative of it.
  auto model = std::make_shared<SimModel>();
  model->tracer = std::make_shared<const RayTracer>(LoadWorld({.world = "box_room"}));
  DroneSetup drone{.name = "drone", .model = CatalogModel("hummingbird")};
  drone.X_WB = BodyPose(waypoints[0], 0, 0, 0);
  drone.airborne = true;
  model->drones.push_back(std::make_shared<const SimDrone>(drone, model->dt_ns));
  SimLoop loop(model);
  const auto reference = std::make_shared<const PlannedReference>(trajectory, 0.0);
  loop.Post({0, FlightCommand{TrajectoryCommand{reference}}});

  // How far is it from where it should be?
  double squares = 0, largest = 0, fastest = 0;
  const auto steps = static_cast<int>(1000 * trajectory->duration());
  for (int i = 0; i < steps; ++i) {
    loop.Advance(1);
    const auto state = loop.Snapshot();
    const Kinematics& motion = state->vehicles[0].motion;
    const double error = Norm(motion.X_WB.p - trajectory->At(1e-9 * static_cast<double>(state->t_ns)).p);
    squares += error * error;
    largest = std::max(largest, error);
    fastest = std::max(fastest, Norm(motion.v_WB));
  }
  std::printf("tracking error %.3f m rms, %.3f m at most; fastest %.2f m/s\n", std::sqrt(squares / steps),
              largest, fastest);
  return largest < 0.3 && loop.Snapshot()->vehicles[0].collision.count == 0 ? 0 : 1;
}
