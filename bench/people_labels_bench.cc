// Labels of people in a panorama: keypoints with visibility (the bar: 45 people at 4096 x 2048 in 3 ms), all boxes
// too, and bodies skinned into the scene. Medians over repetitions. Then where the keypoints land that the labels call
// visible, by joint and by distance, against the picture.
//   people_labels_bench [--people 45] [--level 0] [--width 4096] [--spread 15] [--views 1] [--breakdown]
//                       [--threads N]
// Bodies are those of MakeBody: AIRSIM360_PEOPLE= forces procedural ones.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>

#include "airsim360/base/parallel.h"
#include "airsim360/base/random.h"
#include "airsim360/people/body/test_bodies.h"
#include "airsim360/render/renderer.h"
#include "airsim360/sim/people/labels.h"
#include "airsim360/worlds/worlds.h"

namespace {

using namespace airsim360;

struct Options {
  int people = 45, level = 0, width = 4096, views = 1, threads = 0;
  double spread = 15;
  bool breakdown = false;
};

Options Parse(int argc, char** argv) {
  Options o;
  for (int i = 1; i < argc; ++i) {
    const std::string a = argv[i];
    const auto value = [&] { return i + 1 < argc ? std::atof(argv[++i]) : 0.0; };
    if (a == "--people")
      o.people = static_cast<int>(value());
    else if (a == "--level")
      o.level = static_cast<int>(value());
    else if (a == "--width")
      o.width = static_cast<int>(value());
    else if (a == "--views")
      o.views = static_cast<int>(value());
    else if (a == "--threads")
      o.threads = static_cast<int>(value());
    else if (a == "--spread")
      o.spread = value();
    else if (a == "--breakdown")
      o.breakdown = true;
    else
      std::fprintf(stderr, "people_labels_bench: no flag '%s'\n", a.c_str()), std::exit(2);
  }
  return o;
}

/// Milliseconds that repetitions of a piece of work took: the fastest is that of an undisturbed machine.
struct Times {
  double median = 0, fastest = 0;
};

template <class Work>
Times TimeMs(int repetitions, const Work& work) {
  std::vector<double> times;
  for (int i = 0; i < repetitions; ++i) {
    const auto start = std::chrono::steady_clock::now();
    work();
    times.push_back(std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
  }
  std::ranges::sort(times);
  return {times[static_cast<size_t>(repetitions / 2)], times[0]};
}

// Somebody in the middle of what they do.
SkeletonPose ActingPose(const Body& body, PersonState& state, uint64_t seed) {
  constexpr Behaviour kActs[] = {Behaviour::kWalk, Behaviour::kPhoneCall, Behaviour::kTalk, Behaviour::kTexting,
                                 Behaviour::kIdle, Behaviour::kWave,      Behaviour::kSit,  Behaviour::kJog};
  const Behaviour act = kActs[seed % std::size(kActs)];
  const bool moves = act == Behaviour::kWalk || act == Behaviour::kJog;
  state.upper = act;
  state.lower = moves || act == Behaviour::kSit ? act : Behaviour::kIdle;
  state.speaking = true;
  const Vec3d v = Vec3d{std::cos(state.yaw), std::sin(state.yaw), 0} * (act == Behaviour::kJog ? 2.4 : moves ? 1.3 : 0.0);
  state.v_WP = v;
  const Vec3d end = state.p_WP;
  constexpr int kSteps = 60;
  state.p_WP = end - v * (0.05 * kSteps);
  MotionState motion = StartMotion(body, state, seed, 0);
  for (int k = 1; k <= kSteps; ++k) {
    state.p_WP = end - v * (0.05 * (kSteps - k));
    StepMotion(body, state, k * 50'000'000ll + static_cast<int64_t>(seed % 17), nullptr, motion);
  }
  return PoseOf(body, motion, state);
}

/// How many keypoints of some kind are called visible, and how many of them the picture shows on their person.
struct Tally {
  int visible = 0, missed = 0, unresolved = 0;
  std::map<std::string, int> shows;
};

void Print(const char* what, const std::map<std::string, Tally>& tallies) {
  for (const auto& [name, t] : tallies) {
    if (t.missed + t.unresolved == 0) continue;
    std::printf("  %s %-18s visible %6d, beside the person %4d, unresolved %5d;", what, name.c_str(), t.visible, t.missed, t.unresolved);
    for (const auto& [thing, n] : t.shows) std::printf(" %s %d", thing.c_str(), n);
    std::printf("\n");
  }
}

bool ShowsNear(const Frame& frame, Vec2d pixel, EntityId entity) {
  const int w = frame.entity.width(), h = frame.entity.height();
  for (int i = 0; i < 9; ++i) {
    const int x = (static_cast<int>(pixel.x) + i % 3 - 1 + w) % w, y = std::clamp(static_cast<int>(pixel.y) + i / 3 - 1, 0, h - 1);
    if (frame.entity(x, y) == entity) return true;
  }
  return false;
}

}  // namespace

int main(int argc, char** argv) {
  const Options o = Parse(argc, argv);
  const ThreadLimit limit(o.threads);
  // People on a square around the spawn of downtown_west, at the height of its ground.
  SimPeople people;
  PeoplePoses poses;
  auto world = BuildWorld("downtown_west", {});
  const RayTracer ground(world);
  const Vec3d spawn = VecCast<double>(world->spawn.value());
  RngStream rng(1, "people_labels_bench");
  while (people.cast.size() < static_cast<size_t>(o.people)) {
    Vec3d p = spawn + Vec3d{rng.Uniform(-o.spread, o.spread), rng.Uniform(-o.spread, o.spread), 1};
    const auto below = ground.Intersect(VecCast<float>(p), {0, 0, -1});
    if (!below) continue;
    p.z -= below->distance;
    const size_t i = people.cast.size();
    people.cast.push_back({"person/" + std::to_string(i), MakeBody(internal::DrawBodySpec(5, i)), o.level});
    PersonState state;
    state.p_WP = p;
    state.yaw = rng.Uniform(0, 6.28);
    poses.poses.push_back(ActingPose(*people.cast[i].body, state, i));
    poses.states.push_back(state);
  }
  const auto scene = AddPeople(world, people.cast, people.refs);
  const auto base = std::make_shared<const RayTracer>(scene);
  DynamicTracer dynamic(base);
  auto state = std::make_shared<SceneState>();
  const double show_ms = TimeMs(5, [&] {
                           state = std::make_shared<SceneState>();
                           ShowPeople(people, poses, *state);
                         }).median;
  std::shared_ptr<const RayTracer> tracer;
  const double update_ms = TimeMs(3, [&] { tracer = dynamic.At(state); }).median;
  std::printf("%d people (%s), level %d: skinned %.2f ms, traced anew %.2f ms\n", o.people, people.cast[0].body->character.c_str(), o.level,
              show_ms, update_ms);

  const Camera camera = Equirectangular{o.width, o.width / 2};
  const auto renderer = MakeCpuRenderer(base, {.tier = Tier::kLabels});
  std::map<std::string, Tally> by_joint, by_range;
  Tally all;
  for (int view = 0; view < o.views; ++view) {
    const double reach = view == 0 ? 0 : o.spread;
    const Vec3d eye = spawn + Vec3d{rng.Uniform(-reach, reach), rng.Uniform(-reach, reach), 2.0 + 0.7 * (view % 5)};
    const RigidTransform X_WC = BodyPose(eye, 0.3 + view, 0, 0) * CameraInBody();
    const PeoplePicture picture{people, poses, *tracer, camera, X_WC};
    std::vector<PersonLabel> labels;
    if (view == 0) {
      const Times keypoints = TimeMs(201, [&] { labels = LabelPeople(picture, {.boxes = false}); });
      const Times all_boxes = TimeMs(5, [&] { labels = LabelPeople(picture); });
      std::printf("keypoints with visibility %.2f ms (fastest %.2f), with boxes %.1f ms (fastest %.1f), %d threads at most\n",
                  keypoints.median, keypoints.fastest, all_boxes.median, all_boxes.fastest, o.threads);
    }
    labels = LabelPeople(picture, {.boxes = false});
    RenderRequest request = MakeRequest(camera, X_WC, Tier::kLabels);
    request.products = {.rgb = false, .range = false, .semantic = false};
    request.state = state;
    Frame frame;
    renderer->Render(request, frame);
    for (const PersonLabel& label : labels) {
      for (size_t socket = 0; socket < label.keypoints.size(); ++socket) {
        const KeypointLabel& k = label.keypoints[socket];
        const bool visible = k.state == KeypointState::kVisible, unresolved = k.state == KeypointState::kUnresolved;
        if (!visible && !unresolved) continue;
        const bool missed = visible && !ShowsNear(frame, k.pixel, label.entity);
        const EntityId seen = frame.entity(static_cast<int>(k.pixel.x), static_cast<int>(k.pixel.y));
        char bin[32];
        std::snprintf(bin, sizeof bin, "%3d m", static_cast<int>(k.range / 5) * 5);
        for (Tally* t : {&all, &by_joint[std::string(kSocketNames[socket])], &by_range[bin]}) {
          t->visible += visible, t->missed += missed, t->unresolved += unresolved;
          if (missed || unresolved) ++t->shows[scene->tree[scene->entity(seen).category].path];
        }
      }
    }
  }
  if (o.breakdown) Print("joint", by_joint), Print("range", by_range);
  const int on = all.visible - all.missed, seen = all.visible + all.unresolved;
  std::printf("visible keypoints on their own person within 1 px: %d of %d (%.3f %%); ", on, all.visible, 100.0 * on / all.visible);
  std::printf("with those too thin for the picture %d of %d (%.3f %%)\n", on, seen, 100.0 * on / seen);
  return 0;
}
