// Speed of the flight dynamics: one drone, lanes by instruction set, drones a call, threads, and what every
// term costs. `--soak HOURS` instead flies random commands in a closed room and reports whether it stayed
// sound.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <string>
#include <vector>

#include "airsim360/base/parallel.h"
#include "airsim360/base/random.h"
#include "airsim360/flight/collision/contact.h"
#include "airsim360/flight/dynamics/batch.h"
#include "airsim360/flight/dynamics/drone_step.h"
#include "airsim360/flight/dynamics/dynamics.h"
#include "airsim360/flight/test_drones.h"
#include "clock.h"

namespace airsim360 {
namespace {

double ThreadSeconds() { return SecondsOf(CLOCK_THREAD_CPUTIME_ID); }

struct Row {
  std::string name;
  std::function<double()> seconds_a_step;  ///< of one drone
  std::vector<double> rounds;
};

/// Medians of alternating rounds.
void Report(std::vector<Row>& rows) {
  for (int round = 0; round < 9; ++round) {
    for (Row& r : rows) r.rounds.push_back(r.seconds_a_step());
  }
  for (Row& r : rows) {
    std::sort(r.rounds.begin(), r.rounds.end());
    const double median = r.rounds[r.rounds.size() / 2];
    std::printf("%-52s %8.2f ns a step  %8.1f M steps/s  x %.2f\n", r.name.c_str(), median * 1e9, 1e-6 / median,
                median / rows.front().rounds[rows.front().rounds.size() / 2]);
  }
}

double SingleDouble(const DroneModel& model) {
  constexpr int kSteps = 100000;
  const DroneDynamics drone(model);
  DroneState s;
  s.rotor_speeds.fill(HoverSpeed(model));
  const RotorSpeeds commands = s.rotor_speeds;
  const double start = ThreadSeconds();
  for (int i = 0; i < kSteps; ++i) drone.Step({}, commands, kAllRotorsWork, s);
  return (ThreadSeconds() - start) / kSteps;
}

/// 16 lanes hold the same work as the batch; the blocks' memory is what `drones` need.
double Lanes(const DroneModel& model, void (*kernel)(const internal::BatchWork&), int drones, int steps, bool near_ground = false,
             bool own_air = false) {
  const auto constants = internal::MakeDroneConstants<float>(model, 1e-3);
  const int blocks = drones / internal::kBlockDrones;
  std::vector<internal::DroneBlock> memory(blocks);
  std::vector<internal::SurroundingsBlock> air(own_air ? blocks : 1);
  for (auto& a : air) {
    std::fill_n(a.density, internal::kBlockDrones, 1.0f);
    std::fill_n(a.ground_distance, internal::kBlockDrones, near_ground ? 0.3f : 1e9f);
  }
  for (auto& b : memory) {
    std::fill_n(b.q[0], internal::kBlockDrones, 1.0f);
    std::fill_n(b.charge, internal::kBlockDrones, 1.0f);
    for (int r = 0; r < kMaxRotors; ++r) {
      for (int lane = 0; lane < internal::kBlockDrones; ++lane) {
        b.speed[r][lane] = b.command[r][lane] = static_cast<float>(HoverSpeed(model) * (1 + 1e-3 * lane));
      }
    }
  }
  const int calls = std::max(1, 1600000 / (drones * steps));
  const double start = ThreadSeconds();
  for (int i = 0; i < calls; ++i) {
    kernel({&constants, memory.data(), air.data(), !own_air, near_ground, steps, blocks});
  }
  return (ThreadSeconds() - start) / (1.0 * calls * drones * steps);
}

double Threads(const DroneModel& model, int threads) {
  const ThreadLimit limit(threads);
  DroneBatch batch(model, 65536);
  const auto start = std::chrono::steady_clock::now();
  batch.Step(10);
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start;
  return wall.count() / (10.0 * batch.size());
}

void BenchSpeed() {
  const DroneModel base = AgiliciousDrone();
  const auto best = AIRSIM360_SELECT_KERNEL(StepBlocks);
  std::vector<Row> rows;
  const auto add = [&](std::string name, std::function<double()> run) { rows.push_back({std::move(name), run, {}}); };
  add("one drone, DroneDynamics::Step (double)", [&] { return SingleDouble(base); });
  add("one drone, every term (double)", [] { return SingleDouble(DroneWithEveryTerm()); });
  add("sse4.2, 16 drones, 100 steps a call", [&] { return Lanes(base, internal::isa_sse42::StepBlocks, 16, 100); });
  if (internal::CurrentKernelIsa() >= internal::KernelIsa::kAvx2) {
    add("avx2, 16 drones, 100 steps a call", [&] { return Lanes(base, internal::isa_avx2::StepBlocks, 16, 100); });
  }
  if (internal::CurrentKernelIsa() >= internal::KernelIsa::kAvx512) {
    add("avx512, 16 drones, 100 steps a call", [&] { return Lanes(base, internal::isa_avx512::StepBlocks, 16, 100); });
  }
  add("16384 drones, 1 step a call", [&] { return Lanes(base, best, 16384, 1); });
  add("16384 drones, 10 steps a call", [&] { return Lanes(base, best, 16384, 10); });
  add("65536 drones, 1 thread (wall clock)", [&] { return Threads(base, 1); });
  add("65536 drones, all threads (wall clock)", [&] { return Threads(base, 0); });
  Report(rows);
}

void BenchTerms() {
  const auto kernel = AIRSIM360_SELECT_KERNEL(StepBlocks);
  const auto with = [](const std::function<void(RotorModel&)>& change) {
    DroneModel m = AgiliciousDrone();
    for (RotorModel& r : m.rotors) change(r);
    return m;
  };
  DroneModel inertia = AgiliciousDrone(), battery = inertia, hexa = inertia, octo = inertia, tilted = inertia;
  inertia.inertia_B.m[0][1] = inertia.inertia_B.m[1][0] = 1e-5;
  battery.battery = {.cells = 4, .capacity_ah = 1.5, .resistance = 0.03, .efficiency = 0.75, .idle_power = 5};
  for (int i = 0; i < 4; ++i) {
    if (i < 2) hexa.rotors.push_back(hexa.rotors[i]);
    octo.rotors.push_back(octo.rotors[i]);
    tilted.rotors[i].axis_B = {0, i % 2 ? 0.6 : -0.6, 0.8};
  }
  std::vector<Row> rows;
  const auto add = [&](std::string name, DroneModel m, bool ground = false, bool air = false) {
    rows.push_back({std::move(name), [=] { return Lanes(m, kernel, 1600, 10, ground, air); }, {}});
  };
  add("terms of the prototype (lag, k_f, k_m, k_d, drag)", AgiliciousDrone());
  add("+ wind, density, forces of each drone", AgiliciousDrone(), false, true);
  add("+ rotors above the centre of mass", with([](RotorModel& r) { r.p_B.z = 0.01; }));
  add("+ inflow k_z", with([](RotorModel& r) { r.inflow = 3e-5; }));
  add("+ translational lift k_h", with([](RotorModel& r) { r.translational_lift = 2e-3; }));
  add("+ flapping k_flap", with([](RotorModel& r) { r.flapping = 2e-6; }));
  add("+ rotor inertia (gyroscopic, acceleration)", with([](RotorModel& r) { r.inertia = 9e-6; }));
  add("+ products of inertia", inertia);
  add("+ battery", battery);
  add("+ ground effect", AgiliciousDrone(), true);
  add("6 rotors", hexa);
  add("8 rotors", octo);
  add("tilted rotors", tilted);
  DroneModel all = DroneWithEveryTerm();
  all.battery = battery.battery;
  add("every term, ground, battery, own air", all, true, true);
  for (RotorModel& r : all.rotors) r.axis_B = {0, 0.6, 0.8};
  add("the same with tilted rotors", all, true, true);
  Report(rows);
}

/// The inside of a box.
class ClosedRoom : public ContactQuery {
 public:
  static constexpr double kHalf = 5;
  std::optional<SurfacePoint> FirstHit(Vec3d from, Vec3d to) const override {
    double best = 2;
    SurfacePoint hit;
    for (int axis = 0; axis < 3; ++axis) {
      for (double wall : {-kHalf, kHalf}) {
        const double a = from[axis] - wall, b = to[axis] - wall;
        if (a * b > 0 || a == b || a / (a - b) >= best) continue;
        best = a / (a - b);
        hit = {from + (to - from) * best, {}, 1};
        hit.normal_W[axis] = a > 0 ? 1 : -1;
      }
    }
    return best <= 1 ? std::optional(hit) : std::nullopt;
  }
  std::optional<SurfacePoint> Nearest(Vec3d p, double range) const override {
    double best = range;
    SurfacePoint nearest;
    for (int axis = 0; axis < 3; ++axis) {
      const double wall = p[axis] > 0 ? kHalf : -kHalf;
      if (std::abs(wall - p[axis]) >= best) continue;
      best = std::abs(wall - p[axis]);
      nearest = {p, {}, 1};
      nearest.p_W[axis] = wall;
    }
    return best < range ? std::optional(nearest) : std::nullopt;
  }
};

int Soak(double hours) {
  const DroneModel model = DroneWithEveryTerm();
  const DroneDynamics drone(model);
  const ClosedRoom room;
  RngStream random(1, "soak");
  DroneState s;
  ContactState contact;
  RotorSpeeds commands{};
  int64_t touching = 0;
  const int64_t steps = std::llround(hours * 3.6e6);
  for (int64_t i = 0; i < steps; ++i) {
    // Thrown anew every 20 s, or it would lie on its back most of the time.
    if (i % 20000 == 0) {
      s = DroneState{};
      contact = {};
      s.v_WB = {random.Uniform(-20, 20), random.Uniform(-20, 20), random.Uniform(-20, 20)};
      s.rotor_speeds.fill(HoverSpeed(model));
    }
    if (i % 200 == 0) {
      const double base = HoverSpeed(model) * random.Uniform(0.6, 1.4);
      for (double& c : commands) c = base * random.Uniform(0.9, 1.1);
    }
    const DroneState before = s;
    drone.Step({}, commands, kAllRotorsWork, s);
    touching += ResolveContacts(model, {}, room, before, 1e-3, 0, s, contact).touching;
    const double far = std::max({std::abs(s.p_WB.x), std::abs(s.p_WB.y), std::abs(s.p_WB.z)});
    if (!(far < ClosedRoom::kHalf) || !std::isfinite(Norm(s.v_WB) + Norm(s.w_WB_B))) {
      std::printf("step %lld: out of the room or not finite\n", static_cast<long long>(i));
      return 1;
    }
  }
  std::printf("%.2f h of random commands at 1 ms: in the room, finite, touching in %.1f %% of the steps\n", hours,
              100.0 * static_cast<double>(touching) / static_cast<double>(steps));
  return 0;
}

}  // namespace
}  // namespace airsim360

int main(int argc, char** argv) {
  if (argc == 3 && std::strcmp(argv[1], "--soak") == 0) return airsim360::Soak(std::atof(argv[2]));
  airsim360::BenchSpeed();
  std::printf("\nterms, 1600 drones, 10 steps a call, one core\n");
  airsim360::BenchTerms();
}
