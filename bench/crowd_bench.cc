// What a crowd costs, one core, and what it does.
//   crowd_bench                         time of a step: all of it, and avoidance alone, over the number of people
//   crowd_bench ring                    speed over density against Weidmann, 60 s a density
//   crowd_bench doors [PEOPLE]          RiMEA tests 9 and 12 in full: times, flow through doors and corridors by width
//   crowd_bench soak N MINUTES [WORLD [FILE.yaml]]  N people, in a town of blocks or a world: stuck, overlaps, memory, hash
//   crowd_bench same N MINUTES          hash of all poses, with one thread and with all
//   crowd_bench trace WORLD N SECONDS OUT.svg [FILE.yaml]   seen from above: ways, talks, seats
#include <malloc.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <map>

#include "airsim360/base/error.h"
#include "airsim360/base/parallel.h"
#include "airsim360/base/state_hash.h"
#include "airsim360/opening/world_loader.h"
#include "airsim360/people/crowd/agent.h"
#include "airsim360/people/crowd/crowd.h"
#include "airsim360/people/crowd/test_doors.h"
#include "airsim360/people/crowd/test_ring.h"
#include "airsim360/sim/people/populate.h"
#include "blocks.h"

namespace {

using namespace airsim360;
using Clock = std::chrono::steady_clock;

double Milliseconds(Clock::time_point since) { return std::chrono::duration<double, std::milli>(Clock::now() - since).count(); }

struct Times {
  std::vector<double> ms;
  void Print(const char* what, size_t people) {
    std::sort(ms.begin(), ms.end());
    double sum = 0;
    for (const double t : ms) sum += t;
    const double mean = sum / static_cast<double>(ms.size());
    std::printf("%6zu people  %-22s mean %7.3f ms  median %7.3f  p99 %7.3f   %.2f us a person\n", people, what, mean, ms[ms.size() / 2],
                ms[ms.size() * 99 / 100], 1000 * mean / static_cast<double>(people));
  }
};

void TimeSteps(size_t people, float edge) {
  const auto scene = Blocks(edge);
  auto start = Clock::now();
  const auto mesh = NavMesh::Build(*scene);
  const double build = Milliseconds(start);
  CrowdRequest request;
  request.count = people;
  const auto model = BuildCrowd(*scene, mesh, request);
  CrowdState state = StartCrowd(*model);
  if (people == 1000)
    std::printf("navmesh of %.0f x %.0f m: %.0f ms, %zu polygons, %zu KiB\n", edge, edge, build, mesh->polygon_count(),
                mesh->memory_bytes() / 1024);
  for (int i = 0; i < 200; ++i) StepCrowd(*model, state, kCrowdTickNs, {});
  Times all, steer;
  for (int i = 0; i < 600; ++i) {
    start = Clock::now();
    StepCrowd(*model, state, kCrowdTickNs, {});
    all.ms.push_back(Milliseconds(start));
  }
  all.Print("whole step", people);
  // The same people, avoidance alone: what DetourCrowd's update does less the paths.
  std::vector<internal::Walker> walkers = state.internals->walkers;
  internal::Steering steering;
  for (int i = 0; i < 200; ++i) {
    start = Clock::now();
    steering.Sort(walkers);
    steering.Step(*mesh, walkers, {}, 0.05);
    steer.ms.push_back(Milliseconds(start));
  }
  steer.Print("avoidance and moving", people);
}

void Ring() {
  const auto mesh = internal::BuildRing();
  for (const double density : {0.25, 0.5, 0.75, 1.0, 1.5, 2.0, 2.5, 3.0, 3.5, 4.0}) {
    const double speed = internal::RingSpeed(*mesh, density, 60), weidmann = internal::WeidmannSpeed(density);
    std::printf("%.2f per m2: %.3f m/s, Weidmann %.3f, %+.1f %%\n", density, speed, weidmann, 100 * (speed / weidmann - 1));
  }
}

void Doors(PersonIndex people) {
  const double scale = std::sqrt(people / 1000.0);
  double seconds[2];
  for (const bool two : {false, true}) {
    const auto start = Clock::now();
    const internal::DoorRun run = internal::EmptyRoom(30 * scale, 20 * scale, people, two);
    seconds[two] = run.seconds;
    std::printf("test 9, %u people, %d exits: %.1f s, %.2f people a second and door, closest %.3f m, %zu left (%.1f s of work)\n", people,
                two ? 2 : 4, run.seconds, run.flow, run.closest, run.left, Milliseconds(start) / 1000);
  }
  std::printf("test 9: %.2f times as long\n", seconds[1] / seconds[0]);
  for (const double width : {0.9, 1.0, 1.2, 1.6, 2.0, 2.4}) {
    const internal::DoorRun door = internal::EmptyRoom(15, 10, 250, true, width);
    const internal::CorridorRun corridor = internal::RunCorridors(150, width);
    std::printf(
        "width %.1f m: door %.2f people a second (%.2f a metre), %zu left; corridor %.2f (%.2f), before it %.1f, before the next %.1f, %zu left\n",
        width, door.flow, door.flow / width, door.left, corridor.flow, corridor.flow / width, corridor.first, corridor.second,
        corridor.left);
  }
}

std::shared_ptr<const Scene> SceneOf(const char* world) {
  return std::strcmp(world, "blocks") == 0 ? Blocks(200) : LoadWorld({.world = world});
}

/// Why somebody stands: those around them.
void Explain(const CrowdModel& model, const CrowdState& state, PersonIndex i) {
  const internal::Agent& agent = state.internals->agents[i];
  const internal::Walker& self = state.internals->walkers[i];
  const auto line = [&](PersonIndex k) {
    const internal::Walker& w = state.internals->walkers[k];
    const internal::Agent& a = state.internals->agents[k];
    const Vec3d d = w.at.p_W - self.at.p_W;
    std::printf("    %4u at %+.2f %+.2f, wants %+.2f %+.2f, does %+.2f %+.2f%s, %s, walk %d, gate %u of %zu, group %u%s%s\n", k, d.x, d.y,
                w.wanted.x, w.wanted.y, w.v.x, w.v.y, w.still ? ", still" : "", std::string(PersonStateName(model, state, k)).c_str(),
                static_cast<int>(a.walk), a.gate, a.gates.size(), a.group, a.at_place ? ", at place" : "", a.hold ? ", red" : "");
  };
  std::printf("  stuck: %u at %.2f %.2f, t %.1f s\n", i, self.at.p_W.x, self.at.p_W.y, static_cast<double>(state.t_ns) * 1e-9);
  if (agent.gate < agent.gates.size()) {
    const internal::Gate& gate = agent.gates[agent.gate];
    std::printf("    gate %.2f %.2f, side %.2f %.2f\n", gate.p.x, gate.p.y, gate.side.x, gate.side.y);
  }
  line(i);
  for (PersonIndex k = 0; k < state.people.size(); ++k)
    if (k != i && Norm(state.internals->walkers[k].at.p_W - self.at.p_W) < 1.2) line(k);
}

void Soak(size_t people, double minutes, const char* world, const char* file) {
  const auto scene = SceneOf(world);
  const auto began = Clock::now();
  CrowdRequest request;
  request.count = people;
  request.file = file;
  const auto model = BuildCrowd(*scene, nullptr, request);
  CrowdState state = StartCrowd(*model);
  std::vector<CrowdEvent> events;
  std::map<std::string, size_t> transitions;
  size_t stuck = 0, lost = 0;
  double closest = 1e9, farthest = 0;
  size_t together = 0, apart = 0;  // parties, every five seconds
  for (int64_t tick = 0; tick < static_cast<int64_t>(minutes * 60 * 20); ++tick) {
    StepCrowd(*model, state, kCrowdTickNs, {}, &events);
    for (const CrowdEvent& event : events) {
      if (event.kind == CrowdEvent::Kind::kStuck) {
        ++stuck;
        Explain(*model, state, event.person);
      }
      lost += event.kind == CrowdEvent::Kind::kMessageLost;
      if (event.kind == CrowdEvent::Kind::kTransition) ++transitions[event.to];
    }
    events.clear();
    if (tick % 100 == 0) {
      for (size_t i = 0; i < state.people.size(); ++i)
        for (size_t k = 0; k < i; ++k) closest = std::min(closest, Norm(state.people[i].p_WP - state.people[k].p_WP));
      for (const internal::Party& party : model->plan->parties) {
        double spread = 0;
        for (const PersonIndex i : party.members)
          spread = std::max(spread, Norm(state.people[i].p_WP - state.people[party.members[0]].p_WP));
        ++(spread < 5 ? together : apart);
        farthest = std::max(farthest, spread);
      }
    }
    if (tick % 12000 == 1200)
      std::printf("%5.0f min: heap %zu KiB, hash %016lx\n", static_cast<double>(tick) / 1200, mallinfo2().uordblks / 1024,
                  HashCrowd(state));
  }
  std::printf("%zu people, %.0f min: stuck %zu, messages lost %zu, closest %.3f m, hash %016lx; %.0f s of work\n", people, minutes, stuck,
              lost, closest, HashCrowd(state), Milliseconds(began) / 1000);
  std::printf("parties: %zu, over 5 m from the first of them %.2f %% of the time, at most %.1f m\n", model->plan->parties.size(),
              100.0 * static_cast<double>(apart) / static_cast<double>(std::max<size_t>(1, apart + together)), farthest);
  for (const auto& [name, n] : transitions) std::printf("  -> %-20s %zu\n", name.c_str(), n);
}

/// Crowd and poses as a simulation has them.
void Same(size_t people, double minutes) {
  std::string hashes[2];
  for (const int threads : {1, 0}) {
    const ThreadLimit limit(threads);
    const auto start = Clock::now();
    const PopulatedScene populated = Populate(Blocks(120), {.count = people, .level = 3, .seed = 1});
    PeopleState state = *populated.people->start;
    uint64_t hash = 0;
    for (int64_t tick = 0; tick < static_cast<int64_t>(minutes * 60 * 20); ++tick) {
      TickPeople(*populated.people, {}, state);
      StateHasher hasher;
      hasher.Add(hash);
      hasher.Add(HashPeople(state));
      const PeoplePoses poses = PosesAt(*populated.people, state, state.crowd.t_ns);
      for (const SkeletonPose& pose : poses.poses)
        for (const RigidTransform& X : pose.X_WJ) hasher.Add(X.p);
      hash = hasher.hash();
    }
    char text[32];
    std::snprintf(text, sizeof text, "%016lx", hash);
    hashes[threads == 0] = text;
    std::printf("%zu people, %.0f min, %d threads: hash of all poses %s (%.0f s of work)\n", people, minutes, ThreadCount(), text,
                Milliseconds(start) / 1000);
  }
  std::printf("%s\n", hashes[0] == hashes[1] ? "the same" : "NOT THE SAME");
}

const char* ColorOf(GroundKind kind) {
  switch (kind) {
    case GroundKind::kRoad:
      return "#c9c9cf";
    case GroundKind::kParking:
      return "#d6d2c8";
    case GroundKind::kCrossing:
      return "#ffffff";
    case GroundKind::kGrass:
      return "#cfe3c0";
    default:
      return "#f1ebdf";
  }
}

void Trace(const char* world, size_t people, double seconds, const char* out, const char* file) {
  const auto scene = std::filesystem::exists(world) || std::strcmp(world, "blocks") != 0 ? LoadWorld({.world = world}) : Blocks(120);
  auto start = Clock::now();
  const auto mesh = NavMesh::Build(*scene);
  const Box3f box = mesh->bounds();
  std::printf("navmesh: %.0f ms, %zu polygons, %zu walls, %zu crossings, %.0f x %.0f m, %zu KiB\n", Milliseconds(start),
              mesh->polygon_count(), mesh->walls().size(), mesh->crossings().size(), box.size().x, box.size().y,
              mesh->memory_bytes() / 1024);
  CrowdRequest request;
  request.count = people;
  if (file) {
    request.file = file;
    request.count.reset();
  }
  const auto model = BuildCrowd(*scene, mesh, request);
  std::map<int, int> kinds;
  for (const internal::Place& place : model->plan->places) ++kinds[static_cast<int>(place.kind)];
  for (const auto& [kind, n] : kinds) std::printf("  %d x %s\n", n, internal::kPlaceKindNames[kind]);
  std::printf("area %.0f m2\n", model->plan->ground[0].square_metres);

  // Ways in grey turning red, talks blue, seats green.
  CrowdState state = StartCrowd(*model);
  const double scale = std::min(6.0, 1400.0 / std::max(box.size().x, box.size().y));
  std::ofstream svg(out);
  const auto X = [&](double x) { return scale * (x - box.min.x) + 10; };
  const auto Y = [&](double y) { return scale * (box.max.y - y) + 10; };
  svg << "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" << X(box.max.x) + 10 << "\" height=\"" << Y(box.min.y) + 10
      << "\"><rect width=\"100%\" height=\"100%\" fill=\"#8d939b\"/>\n";
  for (uint32_t i = 0; i < mesh->polygon_count(); ++i) {
    const std::vector<Vec3d> corners = mesh->PolygonOutline(i);
    svg << "<polygon fill=\"" << ColorOf(mesh->Kind({i, {}})) << "\" points=\"";
    for (const Vec3d& p : corners) svg << X(p.x) << "," << Y(p.y) << " ";
    svg << "\"/>\n";
  }
  for (const internal::Place& place : model->plan->places)
    svg << "<rect x=\"" << X(place.p_W.x) - 1.5 << "\" y=\"" << Y(place.p_W.y) - 1.5 << "\" width=\"3\" height=\"3\" fill=\""
        << (place.kind == internal::PlaceKind::kBench ? "#177a2b" : "#a05a00") << "\"/>\n";
  std::vector<std::string> lines(people ? model->people.size() : 0);
  std::vector<CrowdEvent> events;
  start = Clock::now();
  std::map<std::string, int> seen;
  for (int64_t tick = 0; tick < static_cast<int64_t>(seconds * 20); ++tick) {
    StepCrowd(*model, state, kCrowdTickNs, {}, &events);
    if (tick % 10) continue;
    for (size_t i = 0; i < lines.size(); ++i) {
      const PersonState& p = state.people[i];
      char text[60];
      std::snprintf(text, sizeof(text), "%.1f,%.1f ", X(p.p_WP.x), Y(p.p_WP.y));
      lines[i] += text;
      ++seen[internal::kBehaviourNames[static_cast<size_t>(p.upper)]];
      if (p.group) svg << "<circle cx=\"" << X(p.p_WP.x) << "\" cy=\"" << Y(p.p_WP.y) << "\" r=\"1.6\" fill=\"#1f55d0\"/>\n";
    }
  }
  std::printf("%.0f s of %zu people: %.1f s\n", seconds, lines.size(), Milliseconds(start) / 1000);
  for (size_t i = 0; i < lines.size(); ++i)
    svg << "<polyline fill=\"none\" stroke=\"hsl(" << (i * 47) % 360 << ",70%,40%)\" stroke-width=\"0.8\" points=\"" << lines[i]
        << "\"/>\n";
  for (const PersonState& p : state.people)
    svg << "<circle cx=\"" << X(p.p_WP.x) << "\" cy=\"" << Y(p.p_WP.y) << "\" r=\"2\" fill=\"#c01818\"/><line x1=\"" << X(p.p_WP.x)
        << "\" y1=\"" << Y(p.p_WP.y) << "\" x2=\"" << X(p.p_WP.x + 0.8 * std::cos(p.yaw)) << "\" y2=\""
        << Y(p.p_WP.y + 0.8 * std::sin(p.yaw)) << "\" stroke=\"#c01818\"/>\n";
  svg << "</svg>\n";
  std::map<std::string, size_t> causes;
  for (const CrowdEvent& event : events)
    ++causes[std::string(kCrowdEventNames[static_cast<int>(event.kind)]) + " " + event.from + " -> " + event.to];
  for (const auto& [name, n] : causes) std::printf("  %5zu %s\n", n, name.c_str());
  for (const auto& [name, n] : seen)
    std::printf("  %5.1f %% %s\n", 100.0 * n / (static_cast<double>(lines.size()) * seconds * 2), name.c_str());
}

}  // namespace

int main(int argc, char** argv) {
  const std::string mode = argc > 1 ? argv[1] : "";
  try {
    if (mode == "same" && argc > 3) {
      Same(std::strtoul(argv[2], nullptr, 10), std::strtod(argv[3], nullptr));
      return 0;
    }
    const airsim360::ThreadLimit one(1);
    if (mode == "ring") {
      Ring();
    } else if (mode == "doors") {
      Doors(argc > 2 ? static_cast<airsim360::PersonIndex>(std::strtoul(argv[2], nullptr, 10)) : 1000);
    } else if (mode == "soak" && argc > 3) {
      Soak(std::strtoul(argv[2], nullptr, 10), std::strtod(argv[3], nullptr), argc > 4 ? argv[4] : "blocks", argc > 5 ? argv[5] : "");
    } else if (mode == "trace" && argc > 5) {
      Trace(argv[2], std::strtoul(argv[3], nullptr, 10), std::strtod(argv[4], nullptr), argv[5], argc > 6 ? argv[6] : nullptr);
    } else {
      TimeSteps(45, 60);
      TimeSteps(100, 100);
      TimeSteps(1000, 200);
      TimeSteps(10000, 500);
    }
  } catch (const airsim360::InputError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
  return 0;
}
