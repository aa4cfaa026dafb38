// Steps of the simulation per second with contacts against a real scene, for 1, 16 and 1000 drones, and rays
// per second of a lidar. Drones fly random velocity commands over the scene's spawn.
//   sim_bench [--world W] [--seconds S]
// CPU seconds of all threads; the figures for more threads are by the wall clock.

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

#include "airsim360/base/parallel.h"
#include "airsim360/flight/drones/catalog.h"
#include "airsim360/opening/world_loader.h"
#include "airsim360/scene/viewpoint.h"
#include "airsim360/sim/capture.h"
#include "clock.h"

namespace {

using namespace airsim360;

std::string Argument(int argc, char** argv, const char* name, const char* value) {
  for (int i = 1; i + 1 < argc; ++i) {
    if (std::strcmp(argv[i], name) == 0) value = argv[i + 1];
  }
  return value;
}

double CpuSeconds() { return SecondsOf(CLOCK_PROCESS_CPUTIME_ID); }

double WallSeconds() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

// Drones two metres apart in a square around a place, all sensors at their default rates or none.
SimModel MakeModel(const std::shared_ptr<const RayTracer>& tracer, Vec3d p, int count, bool sensors) {
  SimModel model{.tracer = tracer};
  int side = 1;
  while (side * side < count) ++side;
  for (int i = 0; i < count; ++i) {
    DroneSetup setup{.name = "drone " + std::to_string(i), .model = CatalogModel("hummingbird")};
    if (!sensors) setup.sensors = {};
    setup.X_WB.p = p + Vec3d{2.0 * (i % side) - side, 2.0 * (i / side) - side, 0};
    setup.airborne = true;
    setup.crash_disarms = false;
    model.drones.push_back(std::make_shared<const SimDrone>(setup, model.dt_ns));
  }
  return model;
}

void Report(const char* what, const SimModel& model, double budget) {
  SimState state = StartState(model);
  RngStream random(1, "sim_bench");
  const double cpu = CpuSeconds(), wall = WallSeconds();
  int64_t steps = 0, touches = 0;
  std::vector<SimEvent> events;
  while (WallSeconds() - wall < budget) {
    std::vector<SimCommand> commands;
    for (size_t i = 0; steps % 500 == 0 && i < state.vehicles.size(); ++i) {
      const Vec3d v{random.Uniform(-4, 4), random.Uniform(-4, 4), random.Uniform(-1, 1)};
      commands.push_back({i, FlightCommand{VelocityCommand{.v = v}}});
    }
    Step(model, commands, state, &events);
    ++steps;
    touches += static_cast<int64_t>(events.size());
    events.clear();
  }
  const double drone_steps = static_cast<double>(steps) * static_cast<double>(state.vehicles.size());
  std::printf("%-28s %5zu drones: %9.0f steps/s, %10.0f drone steps/s, %10.0f a CPU second, %lld events\n", what, state.vehicles.size(),
              static_cast<double>(steps) / (WallSeconds() - wall), drone_steps / (WallSeconds() - wall), drone_steps / (CpuSeconds() - cpu),
              static_cast<long long>(touches));
}

void ReportLidar(const RayTracer& tracer, Vec3d p, double budget) {
  const LidarSpec spec{.channels = 64, .columns = 2048, .low_deg = -45, .high_deg = 45};
  const Kinematics body{BodyPose(p, 0, 0, 0), {}, {}};
  LidarScan scan;
  const double cpu = CpuSeconds(), wall = WallSeconds();
  int64_t scans = 0;
  size_t points = 0;
  for (; WallSeconds() - wall < budget; ++scans) {
    ScanLidar(spec, {}, tracer, body, {}, scans * 100'000'000, scan);
    points = scan.points.size();
  }
  const double rays = static_cast<double>(scans) * static_cast<double>(spec.shots());
  std::printf("lidar 64 x 2048: %.2f M rays/s, %.2f M a CPU second, %zu points a scan\n", rays / (WallSeconds() - wall) * 1e-6,
              rays / (CpuSeconds() - cpu) * 1e-6, points);
}

}  // namespace

int main(int argc, char** argv) {
  const std::string world = Argument(argc, argv, "--world", "downtown_west");
  const double budget = std::atof(Argument(argc, argv, "--seconds", "3").c_str());
  const auto scene = LoadWorld({.world = world});
  const auto tracer = std::make_shared<const RayTracer>(scene);
  const Vec3d p = VecCast<double>(FirstViewpoint(*scene)) + Vec3d{0, 0, 1};
  std::printf("%s, %llu triangles, %d threads\n", world.c_str(), static_cast<unsigned long long>(scene->Count().instanced_triangles),
              ThreadCount());
  for (const int count : {1, 16, 1000}) {
    Report("with standard sensors", MakeModel(tracer, p, count, true), budget);
    Report("without sensors", MakeModel(tracer, p, count, false), budget);
  }
  ReportLidar(*tracer, p, budget);
  const ThreadLimit one(1);
  std::printf("one thread:\n");
  Report("with standard sensors", MakeModel(tracer, p, 1000, true), budget);
  ReportLidar(*tracer, p, budget);
  return 0;
}
