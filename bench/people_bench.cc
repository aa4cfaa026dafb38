// Bodies in motion: time of a step, of a pose, of skinning, of the dynamic geometry of 30 people; processor time of
// one thread. Run on a quiet machine.
//   build/bin/people_bench [PEOPLE] [SECONDS]

#include <cstdio>
#include <cstdlib>

#include "airsim360/people/body/skinning.h"
#include "airsim360/people/body/test_bodies.h"
#include "airsim360/people/motion/pose.h"
#include "airsim360/trace/ray_tracer.h"
#include "clock.h"

using namespace airsim360;

namespace {

double CpuNow(clockid_t clock = CLOCK_THREAD_CPUTIME_ID) { return SecondsOf(clock); }

struct Person {
  PersonState state;
  MotionState motion;
};

}  // namespace

int main(int argc, char** argv) {
  const size_t count = argc > 1 ? static_cast<size_t>(std::atoi(argv[1])) : 200;
  const double seconds = argc > 2 ? std::atof(argv[2]) : 10;
  constexpr int64_t kDt = 50'000'000;  // 20 Hz
  constexpr Behaviour kUppers[] = {Behaviour::kWalk,    Behaviour::kPhoneCall, Behaviour::kTalk,
                                   Behaviour::kTexting, Behaviour::kIdle,      Behaviour::kCarry};

  // Twelve bodies, as many people as asked for; every 3 s each does something else.
  double start = CpuNow();
  std::vector<std::shared_ptr<const Body>> bodies;
  for (uint64_t i = 0; i < 12; ++i) bodies.push_back(MakeBody(internal::DrawBodySpec(3, i)));
  std::printf("bodies: %.1f ms each (%s)\n", (CpuNow() - start) / 12 * 1e3, bodies[0]->character.c_str());
  std::vector<Person> people(count);
  for (size_t i = 0; i < count; ++i) people[i].motion = StartMotion(*bodies[i % 12], people[i].state, i, 0);
  double step_time = 0, pose_time = 0;
  int64_t calls = 0;
  StateHasher hasher;
  for (int64_t t = kDt; t <= static_cast<int64_t>(seconds * 1e9); t += kDt) {
    start = CpuNow();
    for (size_t i = 0; i < count; ++i) {
      Person& p = people[i];
      const size_t act = (static_cast<size_t>(t / 3'000'000'000) + i) % std::size(kUppers);
      const bool walks = (static_cast<size_t>(t / 3'000'000'000) + i) % 3 != 0;
      p.state.lower = walks ? Behaviour::kWalk : Behaviour::kIdle;
      if (p.state.upper != kUppers[act]) p.state.upper_since_ns = t;
      p.state.upper = kUppers[act];
      p.state.speaking = true;
      p.state.yaw += 0.01;
      p.state.v_WP = Vec3d{std::cos(p.state.yaw), std::sin(p.state.yaw), 0} * (walks ? 1.3 : 0);
      p.state.p_WP += p.state.v_WP * 0.05;
      StepMotion(*bodies[i % 12], p.state, t, nullptr, p.motion);
    }
    step_time += CpuNow() - start;
    start = CpuNow();
    for (size_t i = 0; i < count; ++i) hasher.Add(PoseOf(*bodies[i % 12], people[i].motion, people[i].state).X_WJ[9].p);
    pose_time += CpuNow() - start;
    calls += static_cast<int64_t>(count);
  }
  const auto n = static_cast<double>(calls);
  std::printf("step %.2f us, pose %.2f us, both %.2f us a person (bar 15, stretch 6); hash %016llx\n", step_time / n * 1e6,
              pose_time / n * 1e6, (step_time + pose_time) / n * 1e6, static_cast<unsigned long long>(hasher.hash()));

  // Skinning by level.
  for (int level = 0; level < 4; ++level) {
    std::vector<Vec3f> positions;
    const int rounds = 20 << level;
    size_t vertices = 0;
    start = CpuNow();
    for (int k = 0; k < rounds; ++k) {
      const size_t i = static_cast<size_t>(k) % 12;
      SkinBody(*bodies[i], level, PoseOf(*bodies[i], people[i % count].motion, people[i % count].state), {}, positions);
      vertices += positions.size();
    }
    const double time = CpuNow() - start;
    std::printf("skin level %d: %.0f vertices, %.1f us a person, %.1f ns a vertex\n", level, static_cast<double>(vertices) / rounds,
                time / rounds * 1e6, time / static_cast<double>(vertices) * 1e9);
  }

  // The dynamic geometry of 30 people: skin, then refit in the tracer; whole process.
  for (int level = 0; level < 3; ++level) {
    SceneBuilder builder("plain");
    builder.AddMaterial({});
    Mesh plane;
    plane.positions = {{-50, -50, 0}, {50, -50, 0}, {0, 50, 0}};
    plane.triangles = {{0, 1, 2}};
    builder.AddInstance({builder.AddMesh(plane), {}, builder.AddEntity("ground", builder.tree().At("ground/pavement"))});
    std::vector<PersonInScene> crowd;
    for (size_t i = 0; i < 30; ++i) crowd.push_back({"person/" + std::to_string(i), bodies[i % 12], level});
    std::vector<PersonRef> refs;
    const auto scene = AddPeople(builder.Build(), crowd, refs);
    DynamicTracer tracer(std::make_shared<RayTracer>(scene));
    double skin = 0, refit = 0;
    constexpr int kRounds = 40;
    for (int k = 0; k < kRounds; ++k) {
      std::vector<SkeletonPose> poses;
      std::vector<const SkeletonPose*> shown;
      for (size_t i = 0; i < 30; ++i) {
        Person& p = people[i % count];
        p.state.v_WP = {1.3, 0, 0};
        p.state.yaw = 0;
        p.state.p_WP.x += 0.065;
        StepMotion(*bodies[i % 12], p.state, p.motion.t_ns + kDt, nullptr, p.motion);
        poses.push_back(PoseOf(*bodies[i % 12], p.motion, p.state));
      }
      for (const SkeletonPose& pose : poses) shown.push_back(&pose);
      const double a = CpuNow(CLOCK_PROCESS_CPUTIME_ID);
      auto state = std::make_shared<SceneState>();
      AppendPeople(crowd, refs, shown, {}, *state);
      const double b = CpuNow(CLOCK_PROCESS_CPUTIME_ID);
      tracer.At(state);
      const double c = CpuNow(CLOCK_PROCESS_CPUTIME_ID);
      if (k < 5) continue;  // first builds
      skin += b - a;
      refit += c - b;
    }
    std::printf("30 people, level %d: skinning %.2f ms, tracer %.2f ms a frame\n", level, skin / (kRounds - 5) * 1e3,
                refit / (kRounds - 5) * 1e3);
  }
  return 0;
}
