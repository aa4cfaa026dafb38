// Drones in closed loop: tracking errors of the comparison flights, the catalogue against the sizing laws,
// every prompt of the sweep, and control steps per second.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>

#include "airsim360/base/error.h"
#include "airsim360/flight/control/flight_check.h"
#include "airsim360/flight/drones/catalog.h"
#include "airsim360/flight/prompt/design.h"
#include "airsim360/flight/prompt/gate.h"
#include "airsim360/flight/prompt/sample_prompts.h"
#include "clock.h"

using namespace airsim360;

namespace {

double CpuNow() { return SecondsOf(CLOCK_THREAD_CPUTIME_ID); }

void Compare(const char* name, double amplitude, double speed, ControllerKind kind) {
  const DroneModel model = CatalogModel(name);
  AutopilotOptions options;
  options.controller = kind;
  FlightLoop loop(model, options);
  const auto curve = std::make_shared<Lemniscate>(Vec3d{}, amplitude, speed, 2, 4);
  const TrackingError e = Track(loop, curve, curve->ramp(), curve->duration() - curve->ramp());
  std::printf("%-20s %-14s A %4.1f m  %4.1f m/s  rms %7.2f cm  max %7.2f cm%s\n", name, ControllerKindName(kind).c_str(), amplitude, speed,
              e.rms * 100, e.max * 100, e.upright ? "" : "  TURNED OVER");
}

void Catalogue() {
  std::printf("\ncatalogue against the laws (words only): ratio of k_f, J_x, J_y, J_z; lemniscate untuned; gate\n");
  for (const CatalogDrone& drone : DroneCatalog()) {
    const DroneModel model = CatalogModel(std::string(drone.name));
    std::printf("%-20s", std::string(drone.name).c_str());
    if (!drone.prompt.empty()) {
      const DroneModel words = DroneFromPrompt(drone.prompt).model;
      const auto J = [](const DroneModel& m, int i) { return m.inertia_B.m[i][i]; };
      std::printf(" k_f %.2f  J %.2f %.2f %.2f", words.rotors[0].thrust_factor / model.rotors[0].thrust_factor, J(words, 0) / J(model, 0),
                  J(words, 1) / J(model, 1), J(words, 2) / J(model, 2));
    }
    const FlightCheck check = CheckFlight(model);
    std::printf("  A %.1f m %.1f m/s rms %.1f cm %s;", check.lemniscate.amplitude, check.lemniscate.speed, check.tracking.rms * 100,
                check.passed ? "ok" : "FAILS");
    for (const std::string& problem : GateProblems(model)) std::printf(" %s;", problem.c_str());
    std::printf("\n");
  }
}

void Rate() {
  std::printf("\nclosed-loop control steps per second and core (one control step + its dynamics, 1 ms each)\n");
  for (const ControllerKind kind : {ControllerKind::kIndi, ControllerKind::kSe3, ControllerKind::kPx4, ControllerKind::kSimpleFlight}) {
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

/// The five-inch set on a lemniscate of 12.9 m/s and 2.1 g in light turbulence (15 knots at 6 m), 10 m up.
void Turbulence() {
  std::printf("\n12.9 m/s, 2.1 g, light Dryden turbulence (Tal and Karaman, real flight: rms 6.6 cm)\n");
  for (uint64_t seed = 0; seed < 5; ++seed) {
    FlightLoop loop(CatalogModel("agilicious"), {}, {0, 0, 10});
    loop.wind.emplace().wind_6m = 15 * 1852.0 / 3600;
    loop.wind_state = StartWind(seed, 0);
    const auto curve = std::make_shared<Lemniscate>(Vec3d{0, 0, 10}, 8.58, 12.9, 3, 5);
    const TrackingError e = Track(loop, curve, curve->ramp(), curve->duration() - curve->ramp());
    std::printf("seed %d: rms %.2f cm, max %.2f cm\n", static_cast<int>(seed), e.rms * 100, e.max * 100);
  }
}

void Prompts() {
  int refused = 0, failed = 0;
  double worst = 0;
  for (const char* prompt : kSamplePrompts) {
    try {
      const FlightCheck check = CheckFlight(DroneFromPrompt(prompt).model);
      worst = std::max(worst, check.tracking.rms / check.lemniscate.amplitude);
      failed += !check.passed;
      if (!check.passed) {
        std::printf("FAILS: %s (A %.2f m, %.1f m/s, rms %.3f m, hover %.3f m)\n", prompt, check.lemniscate.amplitude,
                    check.lemniscate.speed, check.tracking.rms, check.hover_error);
      }
    } catch (const InputError& error) {
      ++refused;
      std::printf("REFUSED: %s: %s\n", prompt, error.what());
    }
  }
  std::printf("\n%zu prompts: %d refused, %d do not fly the lemniscate; worst rms %.2f %% of its amplitude\n", std::size(kSamplePrompts),
              refused, failed, worst * 100);
}

}  // namespace

int main() {
  std::printf("comparison flights (RotorPy SE3: Hummingbird 5 m/s 19.2 cm, Crazyflie 2 m/s 4.5 cm)\n");
  for (const ControllerKind kind : {ControllerKind::kIndi, ControllerKind::kSe3, ControllerKind::kPx4}) {
    for (const double speed : {2.0, 5.0, 8.0}) Compare("hummingbird", 4, speed, kind);
    for (const double speed : {1.0, 2.0, 3.0}) Compare("crazyflie_rotorpy", 1, speed, kind);
  }
  Compare("airsim_quad", 4, 2, ControllerKind::kSimpleFlight);
  Catalogue();
  Rate();
  Turbulence();
  Prompts();
  return 0;
}
