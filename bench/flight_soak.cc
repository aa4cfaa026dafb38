// Long runs: an hour of simulated random commands (no NaN, no escape from the world, memory flat), and the
// same hash of the state after many steps with 1 and all threads, from a snapshot, and replayed from a file.
//   flight_soak [--world W] [--seconds S] [--drones N]      default box_room, 3600 s, 2 drones
//   flight_soak --determinism [--steps N] [--drones N]      default 1,000,000 steps, 9 drones
// Exit status 1 if anything is wrong.
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <string>

#include "airsim360/base/parallel.h"
#include "airsim360/flight/drones/catalog.h"
#include "airsim360/opening/world_loader.h"
#include "airsim360/scene/viewpoint.h"
#include "airsim360/sim/recording.h"

namespace {

using namespace airsim360;

std::string Argument(int argc, char** argv, const char* name, const char* value) {
  for (int i = 1; i + 1 < argc; ++i) {
    if (std::strcmp(argv[i], name) == 0) value = argv[i + 1];
  }
  return value;
}

bool Given(int argc, char** argv, const char* name) {
  for (int i = 1; i < argc; ++i) {
    if (std::strcmp(argv[i], name) == 0) return true;
  }
  return false;
}

double ResidentMib() {
  // Pages: all, then those in memory.
  long all = 0, resident = 0;
  std::FILE* file = std::fopen("/proc/self/statm", "r");
  if (file == nullptr || std::fscanf(file, "%ld %ld", &all, &resident) != 2) resident = 0;
  if (file != nullptr) std::fclose(file);
  return static_cast<double>(resident) * static_cast<double>(sysconf(_SC_PAGESIZE)) / (1 << 20);
}

Vec3d RandomVector(RngStream& random, double size) {
  const double x = random.Uniform(-size, size), y = random.Uniform(-size, size);
  return {x, y, random.Uniform(-size, size)};
}

// Any command, also absurd ones.
Command RandomCommand(RngStream& random, Vec3d home) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  switch (random.Index(12)) {
    case 0:
      return VelocityCommand{.v = RandomVector(random, 8)};
    case 1:
      return PositionCommand{.p_W = home + RandomVector(random, 20), .speed = random.Uniform(0, 10)};
    case 2:
      return RateCommand{.w_B = RandomVector(random, 6), .vertical = {.value = random.Uniform()}};
    case 3:
      return AttitudeCommand{.roll = random.Uniform(-1, 1), .pitch = random.Uniform(-1, 1), .vertical = {.value = random.Uniform()}};
    case 4: {
      RotorSignalCommand signals;
      for (double& s : signals.signals) s = random.Uniform();
      return signals;
    }
    case 5:
      return TakeoffCommand{.height = random.Uniform(1, 5)};
    case 6:
      return LandCommand{};
    case 7:
      return ReturnCommand{};
    case 8:
      return VelocityCommand{.v = {nan, 0, 0}};
    case 9:
      return PositionCommand{.p_W = {1e300, -1e300, 0}};
    case 10:
      return DisarmCommand{};
    default:
      return TakeoffCommand{};
  }
}

// Something new for every drone now and then: commands, broken rotors, wind, resets.
std::vector<SimCommand> RandomCommands(RngStream& random, const SimModel& model) {
  std::vector<SimCommand> commands;
  for (size_t i = 0; i < model.drones.size(); ++i) {
    const Vec3d home = model.drones[i]->setup().X_WB.p;
    if (random.Chance(0.3)) commands.push_back({i, FlightCommand{RandomCommand(random, home), 2'000'000'000}});
    if (random.Chance(0.01)) {
      RotorHealthCommand health;
      health.health[random.Index(4)] = random.Uniform();
      commands.push_back({i, health});
    }
    if (random.Chance(0.05)) {
      SimCommand& reset = commands.emplace_back();
      reset.vehicle = i;
      reset.action.emplace<ResetCommand>().airborne = random.Chance(0.5);
    }
  }
  if (random.Chance(0.02)) {
    Vec3d wind = RandomVector(random, 8);
    wind.z = 0;
    SimCommand command;
    command.action.emplace<WindCommand>(wind);
    commands.push_back(std::move(command));
  }
  return commands;
}

SimModel MakeModel(const std::string& world, int count) {
  const auto scene = LoadWorld({.world = world});
  SimModel model{.tracer = std::make_shared<const RayTracer>(scene)};
  model.wind.turbulence_6m = 3;
  const Vec3d spawn = VecCast<double>(FirstViewpoint(*scene));
  for (int i = 0; i < count; ++i) {
    DroneSetup setup{.name = "drone " + std::to_string(i), .model = CatalogModel("hummingbird")};
    setup.model.battery = {.cells = 3, .capacity_ah = 2.2, .resistance = 0.02};
    setup.X_WB.p = spawn + Vec3d{-1.5 + 1.5 * (i % 3), -1.5 + 1.5 * (i / 3), 1};
    setup.airborne = true;
    setup.crash_disarms = i % 2 == 0;  // the others go on after every crash
    model.drones.push_back(std::make_shared<const SimDrone>(setup, model.dt_ns));
  }
  return model;
}

bool IsFinite(Vec3d v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

// What is wrong with a vehicle; nullptr if nothing is.
const char* Problem(const SimModel& model, const Vehicle& vehicle) {
  const DroneState& drone = vehicle.drone;
  if (!IsFinite(drone.p_WB) || !IsFinite(drone.v_WB) || !IsFinite(drone.w_WB_B) || !std::isfinite(drone.q_WB.w)) return "not a number";
  const Scene& scene = model.tracer->scene();
  const float margin = scene.sky_entity == kNoEntity ? 0.01f : 1001;
  Box3f room = scene.bounds;
  room.min -= Vec3f{margin, margin, margin};
  room.max += Vec3f{margin, margin, margin};
  if (!room.Contains(VecCast<float>(drone.p_WB))) return "outside of the world";
  for (const SensorStates* sensors = &vehicle.sensors; const ImuState& imu : sensors->imus) {
    if (!IsFinite(imu.last.specific_force) || !IsFinite(imu.last.angular_velocity)) return "IMU is not a number";
  }
  return nullptr;
}

int Soak(const std::string& world, double seconds, int drones) {
  const SimModel model = MakeModel(world, drones);
  SimState state = StartState(model);
  RngStream random(7, "flight_soak");
  std::vector<SimEvent> events;
  int64_t kinds[std::size(kSimEventNames)] = {};
  const auto steps = static_cast<int64_t>(seconds * 1000);
  double early = 0;
  for (int64_t i = 0; i < steps; ++i) {
    Step(model, i % 500 == 0 ? RandomCommands(random, model) : std::vector<SimCommand>(), state, &events);
    for (const SimEvent& event : events) ++kinds[static_cast<size_t>(event.kind)];
    events.clear();
    for (const Vehicle& vehicle : state.vehicles) {
      if (const char* problem = Problem(model, vehicle)) {
        std::printf("FAILED: %s at step %lld: %g %g %g\n", problem, static_cast<long long>(i), vehicle.drone.p_WB.x, vehicle.drone.p_WB.y,
                    vehicle.drone.p_WB.z);
        return 1;
      }
    }
    if (i == steps / 10) early = ResidentMib();
  }
  const double late = ResidentMib();
  std::printf(
      "%s, %d drones, %.0f s: no NaN, nobody left the world; memory %.1f MiB after a tenth, %.1f MiB at the "
      "end\n",
      world.c_str(), drones, seconds, early, late);
  for (size_t k = 0; k < std::size(kSimEventNames); ++k) std::printf("  %-16s %lld\n", kSimEventNames[k], static_cast<long long>(kinds[k]));
  return late < early + 4 ? 0 : 1;
}

struct Run {
  uint64_t hash = 0;
  Recording recording;
  SimState middle;
};

Run Fly(const SimModel& model, int64_t steps) {
  SimState state = StartState(model);
  Recorder recorder(model, state, "flight_soak", 100'000);
  RngStream random(3, "flight_soak");
  Run run;
  for (int64_t i = 0; i < steps; ++i) {
    const auto commands = i % 500 == 0 ? RandomCommands(random, model) : std::vector<SimCommand>();
    recorder.Before(state, commands);
    Step(model, commands, state);
    recorder.After(state);
    if (i == steps / 2) run.middle = state;
  }
  run.hash = HashState(state);
  run.recording = recorder.Finish(state);
  return run;
}

int Determinism(int64_t steps, int drones) {
  const SimModel model = MakeModel("box_room", drones);
  const Run many = Fly(model, steps);
  std::printf("%lld steps of %d drones: hash %016llx with %d threads\n", static_cast<long long>(steps), drones,
              static_cast<unsigned long long>(many.hash), ThreadCount());
  uint64_t one_hash;
  {
    const ThreadLimit one(1);
    one_hash = Fly(model, steps).hash;
  }
  std::printf("hash %016llx with one thread\n", static_cast<unsigned long long>(one_hash));

  // From the snapshot of the middle, with the commands that were still to come.
  SimState state = many.middle;
  for (const RecordedStep& step : many.recording.commands) {
    while (step.step >= many.middle.step && state.step < step.step) Step(model, {}, state);
    if (step.step >= many.middle.step) Step(model, step.commands, state);
  }
  while (state.step < steps) Step(model, {}, state);
  const uint64_t restored = HashState(state);
  std::printf("hash %016llx from the snapshot of the middle\n", static_cast<unsigned long long>(restored));

  state = StartState(model);
  const Recording read = DecodeRecording(EncodeRecording(many.recording), "run");
  const ReplayResult replay = Replay(model, read, state);
  std::printf("hash %016llx replayed from the file\n", static_cast<unsigned long long>(replay.hash));
  const bool same = one_hash == many.hash && restored == many.hash && replay.same && replay.hash == many.hash;
  std::printf("%s\n", same ? "all the same" : "FAILED: they differ");
  return same ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  if (Given(argc, argv, "--determinism")) {
    return Determinism(std::atoll(Argument(argc, argv, "--steps", "1000000").c_str()),
                       std::atoi(Argument(argc, argv, "--drones", "9").c_str()));
  }
  return Soak(Argument(argc, argv, "--world", "box_room"), std::atof(Argument(argc, argv, "--seconds", "3600").c_str()),
              std::atoi(Argument(argc, argv, "--drones", "2").c_str()));
}
