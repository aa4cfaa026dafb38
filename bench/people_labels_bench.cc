// Labels of 45 people in a panorama of 4096 x 2048: keypoints with visibility (the bar: 3 ms), all boxes too, and
// bodies skinned into the scene. Medians over repetitions; the share of visible keypoints that are on their own
// person's pixels within one pixel is printed beside them.
// Usage: people_labels_bench [PEOPLE] [LEVEL]
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "airsim360/base/random.h"
#include "airsim360/render/renderer.h"
#include "airsim360/sim/people/labels.h"
#include "airsim360/worlds/worlds.h"

namespace {

using namespace airsim360;

template <class Work>
double MedianMs(int repetitions, const Work& work) {
  std::vector<double> times;
  for (int i = 0; i < repetitions; ++i) {
    const auto start = std::chrono::steady_clock::now();
    work();
    times.push_back(std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
  }
  std::nth_element(times.begin(), times.begin() + repetitions / 2, times.end());
  return times[static_cast<size_t>(repetitions / 2)];
}

}  // namespace

int main(int argc, char** argv) {
  const int count = argc > 1 ? std::atoi(argv[1]) : 45, level = argc > 2 ? std::atoi(argv[2]) : 0;
  constexpr int kWidth = 4096, kHeight = 2048;
  // People on a square of 30 m around the spawn of downtown_west, at the height of its ground.
  SimPeople people;
  PeoplePoses poses;
  auto world = BuildWorld("downtown_west", {});
  const RayTracer ground(world);
  const Vec3d spawn = VecCast<double>(world->spawn.value());
  RngStream rng(1, "people_labels_bench");
  while (people.cast.size() < static_cast<size_t>(count)) {
    Vec3d p = spawn + Vec3d{rng.Uniform(-15, 15), rng.Uniform(-15, 15), 1};
    const auto below = ground.Intersect(VecCast<float>(p), {0, 0, -1});
    if (!below) continue;
    p.z -= below->distance;
    const size_t i = people.cast.size();
    people.cast.push_back({"person/" + std::to_string(i), MakeProceduralBody(DrawBodySpec(5, i)), level});
    PersonState state;
    state.p_WP = p;
    state.yaw = rng.Uniform(0, 6.28);
    poses.states.push_back(state);
    poses.poses.push_back(RestPose(*people.cast[i].body, {RotationZ(state.yaw), p}));
  }
  const auto scene = AddPeople(world, people.cast, people.refs);
  const auto base = std::make_shared<const RayTracer>(scene);
  DynamicTracer dynamic(base);
  auto state = std::make_shared<SceneState>();
  const double show_ms = MedianMs(5, [&] {
    state = std::make_shared<SceneState>();
    ShowPeople(people, poses, *state);
  });
  std::shared_ptr<const RayTracer> tracer;
  const double update_ms = MedianMs(3, [&] { tracer = dynamic.At(state); });

  const Camera camera = Equirectangular{kWidth, kHeight};
  const RigidTransform X_WC = BodyPose(spawn + Vec3d{0, 0, 2}, 0.3, 0, 0) * CameraInBody();
  const PeoplePicture picture{people, poses, *tracer, camera, X_WC};
  std::vector<PersonLabel> labels;
  const double keypoints_ms = MedianMs(31, [&] { labels = LabelPeople(picture, {.boxes = false}); });
  const double all_ms = MedianMs(5, [&] { labels = LabelPeople(picture); });
  std::printf("%d people, level %d: skinned %.2f ms, traced anew %.2f ms, keypoints with visibility %.2f ms, with boxes %.1f ms\n",
              count, level, show_ms, update_ms, keypoints_ms, all_ms);

  // Where visible keypoints land.
  const auto renderer = MakeCpuRenderer(base, {.tier = Tier::kLabels});
  RenderRequest request{.camera = camera, .X_WC = X_WC, .tier = Tier::kLabels};
  request.products = {.rgb = false, .range = false, .semantic = false};
  request.state = state;
  Frame frame;
  renderer->Render(request, frame);
  int visible = 0, on = 0;
  for (const PersonLabel& label : labels) {
    for (const KeypointLabel& k : label.keypoints) {
      if (k.state != KeypointState::kVisible) continue;
      ++visible;
      const int before = on;
      for (int i = 0; i < 9; ++i) {
        const int x = (static_cast<int>(k.pixel.x) + i % 3 - 1 + kWidth) % kWidth,
                  y = std::clamp(static_cast<int>(k.pixel.y) + i / 3 - 1, 0, kHeight - 1);
        if (frame.entity(x, y) != label.entity) continue;
        ++on;
        break;
      }
      if (on == before) {
        const auto socket = static_cast<size_t>(&k - label.keypoints.data());
        std::printf("  %s of person %u, %.1f m away: the picture shows %s\n", std::string(kSocketNames[socket]).c_str(), label.person,
                    k.range, scene->entity(frame.entity(static_cast<int>(k.pixel.x), static_cast<int>(k.pixel.y))).name.c_str());
      }
    }
  }
  std::printf("visible keypoints on their own person within 1 px: %d of %d (%.3f %%)\n", on, visible, 100.0 * on / visible);
  return 0;
}
