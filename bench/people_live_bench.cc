// A whole crowd alive, one core: behaviour, avoidance, gait with feet on the ground and the pose of everybody, 20 times a
// second. The bar: 1,000 people in real time, that is 50 ms a tick.
//   people_live_bench [PEOPLE] [SECONDS] [THREADS] [WORLD]     default 1000 20 1 and a town of blocks, 200 x 200 m

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <vector>

#include "airsim360/base/error.h"
#include "airsim360/base/parallel.h"
#include "airsim360/opening/world_loader.h"
#include "airsim360/sim/people/populate.h"
#include "blocks.h"
#include "clock.h"

namespace {

using namespace airsim360;

double Now() { return 1e3 * SecondsOf(CLOCK_MONOTONIC); }

void Print(const char* what, std::vector<double> ms, size_t people) {
  std::ranges::sort(ms);
  double sum = 0;
  for (const double t : ms) sum += t;
  const double mean = sum / static_cast<double>(ms.size());
  std::printf("%-34s mean %7.2f ms  median %7.2f  p99 %7.2f  worst %7.2f  %6.2f us a person\n", what, mean, ms[ms.size() / 2],
              ms[ms.size() * 99 / 100], ms.back(), 1e3 * mean / static_cast<double>(people));
}

}  // namespace

int main(int argc, char** argv) try {
  const size_t count = argc > 1 ? static_cast<size_t>(std::atoi(argv[1])) : 1000;
  const double seconds = argc > 2 ? std::atof(argv[2]) : 20;
  const int threads = argc > 3 ? std::atoi(argv[3]) : 1;
  const auto scene = argc > 4 ? LoadWorld({.world = argv[4]}) : Blocks(200);
  const ThreadLimit limit(threads);
  const PopulatedScene populated = Populate(scene, {.count = count, .warm_up = 10, .level = 3, .seed = 1});
  const SimPeople& people = *populated.people;
  PeopleState state = *people.start;
  std::vector<double> tick, pose, both;
  std::vector<size_t> acts(static_cast<size_t>(Behaviour::kCount));
  StateHasher hasher;
  for (int k = 0; k < static_cast<int>(seconds * 20); ++k) {
    const double start = Now();
    TickPeople(people, {}, state);
    const double middle = Now();
    const PeoplePoses poses = PosesAt(people, state, state.crowd.t_ns);
    const double end = Now();
    tick.push_back(middle - start), pose.push_back(end - middle), both.push_back(end - start);
    hasher.Add(poses.poses[static_cast<size_t>(k) % count].X_WJ[9].p);
    for (const PersonState& person : poses.states) ++acts[static_cast<size_t>(person.upper)];
  }
  std::printf("%zu people, %.0f s at 20 Hz, %d threads, bodies %s\n", count, seconds, threads, people.cast[0].body->character.c_str());
  Print("behaviour, avoidance, gait, feet", tick, count);
  Print("poses", pose, count);
  Print("all of it (bar: 50 ms a tick)", both, count);
  double sum = 0;
  for (const double t : both) sum += t;
  const auto ticks = static_cast<double>(both.size());
  std::printf("%.2f times real time; hash %016llx\ndoing:", 50 * ticks / sum,
              static_cast<unsigned long long>(hasher.hash() ^ HashPeople(state)));
  for (size_t b = 0; b < acts.size(); ++b) {
    if (acts[b] > 0) std::printf(" %s %.1f", BehaviourName(static_cast<Behaviour>(b)), static_cast<double>(acts[b]) / ticks);
  }
  std::printf("\n");
} catch (const InputError& error) {
  std::fprintf(stderr, "people_live_bench: %s\n", error.what());
  return 2;
}
