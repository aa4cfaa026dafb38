// Drones in closed loop: tracking errors of the comparison flights, the catalogue against the sizing laws, every
// prompt of the sweep, and control steps per second. Usage: drone_bench [FILE OF PROMPTS]
#include <time.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>

#include "airsim360/flight/catalog.h"
#include "airsim360/flight/flight_check.h"
#include "airsim360/flight/prompt/design.h"
#include "airsim360/flight/prompt/gate.h"

using namespace airsim360;

namespace {

double CpuNow() {
  timespec t;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

void Compare(const char* name, double amplitude, double speed, ControllerKind kind) {
  const DroneModel model = CatalogModel(name);
  AutopilotOptions options;
  options.controller = kind;
  FlightLoop loop(model, options);
  const auto curve = std::make_shared<Lemniscate>(Vec3d{}, amplitude, speed, 2, 4);
  const TrackingError e = Track(loop, curve, curve->ramp(), curve->duration() - curve->ramp());
  std::printf("%-20s %-14s A %4.1f m  %4.1f m/s  rms %7.2f cm  max %7.2f cm%s\n", name,
              ControllerKindName(kind).c_str(), amplitude, speed, e.rms * 100, e.max * 100,
              e.upright ? "" : "  TURNED OVER");
}

void Catalogue() {
  std::printf("\ncatalogue against the laws (words only): ratio of k_f, J_x, J_y, J_z; lemniscate untuned; gate\n");
  for (const CatalogDrone& drone : DroneCatalog()) {
    const DroneModel model = CatalogModel(std::string(drone.name));
    std::printf("%-20s", std::string(drone.name).c_str());
    if (!drone.prompt.empty()) {
      const DroneModel words = DroneFromPrompt(drone.prompt).model;
      const auto J = [](const DroneModel& m, int i) { return m.inertia_B.m[i][i]; };
      std::printf(" k_f %.2f  J %.2f %.2f %.2f", words.rotors[0].thrust_factor / model.rotors[0].thrust_factor,
                  J(words, 0) / J(model, 0), J(words, 1) / J(model, 1), J(words, 2) / J(model, 2));
    }
    const FlightCheck check = CheckFlight(model);
    std::printf("  A %.1f m %.1f m/s rms %.1f cm %s;", check.lemniscate.amplitude, check.lemniscate.speed,
                check.tracking.rms * 100, check.passed ? "ok" : "FAILS");
    for (const std::string& problem : GateProblems(model)) std::printf(" %s;", problem.c_str());
    std::printf("\n");
  }
}

void Rate() {
  std::printf("\nclosed-loop control steps per second and core (one control step + its dynamics, 1 ms each)\n");
  for (const ControllerKind kind : {ControllerKind::kIndi, ControllerKind::kSe3, ControllerKind::kPx4,
                                    ControllerKind::kSimpleFlight}) {
    AutopilotOptions options;
    options.controller = kind;
    options.control_dt = 1e-3;
    FlightLoop loop(CatalogModel("airsim_quad"), options);
    VelocityCommand forward;
    forward.v = {1, 0, 0};
    loop.Give(forward);
    double best = 1e9;
    for (int round = 0; round < 9; ++round) {
      const double start = CpuNow();
      for (int i = 0; i < 20000; ++i) loop.Step();
      best = std::min(best, (CpuNow() - start) / 20000);
    }
    std::printf("%-14s %.0f k steps/s\n", ControllerKindName(kind).c_str(), 1e-3 / best);
  }
}

}  // namespace

int main(int argc, char** argv) {
  std::printf("comparison flights (RotorPy SE3: Hummingbird 5 m/s 19.2 cm, Crazyflie 2 m/s 4.5 cm)\n");
  for (const ControllerKind kind : {ControllerKind::kIndi, ControllerKind::kSe3, ControllerKind::kPx4}) {
    for (const double speed : {2.0, 5.0, 8.0}) Compare("hummingbird", 4, speed, kind);
    for (const double speed : {1.0, 2.0, 3.0}) Compare("crazyflie_rotorpy", 1, speed, kind);
  }
  Compare("airsim_quad", 4, 2, ControllerKind::kSimpleFlight);
  Catalogue();
  Rate();
  if (argc > 1) {
    std::FILE* file = std::fopen(argv[1], "r");
    char line[1100];
    int flown = 0, failed = 0;
    while (file && std::fgets(line, sizeof(line), file)) {
      line[std::strcspn(line, "\n")] = 0;
      const DroneDesign design = DroneFromPrompt(line);
      const FlightCheck check = CheckFlight(design.model);
      ++flown;
      failed += !check.passed;
      if (!check.passed) std::printf("FAILS: %s (rms %.3f m, hover %.3f m)\n", line, check.tracking.rms, check.hover_error);
    }
    std::printf("\n%d prompts, %d do not fly the lemniscate\n", flown, failed);
    if (file) std::fclose(file);
  }
}
