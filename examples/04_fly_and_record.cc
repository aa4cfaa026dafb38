// Example 4: fly a drone with velocity commands, look at what it meets, and record the flight bit for bit.
//   build/bin/04_fly_and_record
#include <cstdio>
#include <memory>

#include "airsim360/flight/drones/catalog.h"
#include "airsim360/opening/world_loader.h"
#include "airsim360/sim/sim_loop.h"

int main() {
  using namespace airsim360;

  // A model never changes: the world to bump into, and a drone that starts hovering 2 m above the floor.
  auto model = std::make_shared<SimModel>();
  model->tracer = std::make_shared<const RayTracer>(LoadWorld({.world = "box_room"}));
  DroneSetup drone{.name = "drone", .model = CatalogModel("hummingbird")};
  drone.X_WB = BodyPose({-3, -3, 2}, 0, 0, 0);
  drone.airborne = true;
  model->drones.push_back(std::make_shared<const SimDrone>(drone, model->dt_ns));

  // The loop owns the state; commands go in, snapshots come out. Each leg is 2 s at 2 m/s.
  SimLoop loop(model);
  const auto start = loop.Snapshot();
  loop.StartRecording("a square in box_room");
  for (const Vec3d v : {Vec3d{2, 0, 0}, Vec3d{0, 2, 0}, Vec3d{-2, 0, 0}, Vec3d{0, -2, 0}}) {
    loop.Post({0, FlightCommand{VelocityCommand{.v = v, .yaw = {YawTarget::Mode::kForward}}}});
    for (int i = 0; i < 4; ++i) {
      loop.Advance(500);  // steps of 1 ms
      const auto state = loop.Snapshot();
      const Vehicle& flying = state->vehicles[0];
      const Vec3d p = flying.motion.X_WB.p;
      std::printf("t %.1f s: (%5.2f, %5.2f, %5.2f), %.2f m/s, %.2f m to the nearest surface\n",
                  1e-9 * static_cast<double>(state->t_ns), p.x, p.y, p.z, Norm(flying.motion.v_WB),
                  static_cast<double>(flying.clearance));
    }
  }
  const auto end = loop.Snapshot();
  for (const SimEvent& event : loop.TakeEvents())
    std::printf("event: %s\n", kSimEventNames[static_cast<size_t>(event.kind)]);

  // The recording repeats the flight to the same bytes.
  const Recording recording = *loop.StopRecording();
  SimState again = *start;
  const ReplayResult replay = Replay(*model, recording, again);
  std::printf("replay of %lld steps: %s\n", static_cast<long long>(replay.steps),
              replay.same && HashState(again) == HashState(*end) ? "the same bytes" : "it differs");
  const bool home = Norm(end->vehicles[0].motion.X_WB.p - drone.X_WB.p) < 1;
  return replay.same && home ? 0 : 1;
}
