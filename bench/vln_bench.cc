// Sixty-four flights of vision-and-language navigation at once against a renderer that does nothing else: the same panoramas,
// drawn one after the other. Either makes two renderers. What the programs take that answer is apart: they stand for models on other machines.
//   vln_bench EPISODES.jsonl [FLIGHTS [WORKERS [DECISIONS [WIDTH]]]]     default 64 64 12 512
#include <sys/resource.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <vector>

#include "airsim360/base/error.h"
#include "airsim360/base/parallel.h"
#include "airsim360/math/transform.h"
#include "airsim360/vln/flights/run_episodes.h"
#include "clock.h"

namespace {

using namespace airsim360;

struct Spent {
  double wall = 0, processor = 0, children = 0;  // seconds
};

Spent Now() {
  Spent now{.wall = SecondsOf(CLOCK_MONOTONIC)};
  const auto used_by = [](auto who) {
    rusage used;
    getrusage(who, &used);
    return static_cast<double>(used.ru_utime.tv_sec + used.ru_stime.tv_sec) +
           1e-6 * static_cast<double>(used.ru_utime.tv_usec + used.ru_stime.tv_usec);
  };
  now.processor = used_by(RUSAGE_SELF);
  now.children = used_by(RUSAGE_CHILDREN);
  return now;
}

template <class Work>
Spent Measure(const Work& work) {
  const Spent begun = Now();
  work();
  const Spent ended = Now();
  return {ended.wall - begun.wall, ended.processor - begun.processor, ended.children - begun.children};
}

double Print(const char* what, size_t frames, const Spent& spent) {
  const auto n = static_cast<double>(frames);
  std::printf("%-28s %5zu frames, %6.2f frames/s, %6.2f ms of processor a frame (and %.2f of programs), %.2f processors busy\n", what,
              frames, n / spent.wall, 1e3 * spent.processor / n, 1e3 * spent.children / n, (spent.processor + spent.children) / spent.wall);
  std::fflush(stdout);
  return spent.processor / n;
}

// Flies ahead, turns at every third decision, then stops.
VlnRunOptions Run(const std::shared_ptr<Stage>& stage, int workers, int decisions, int width) {
  VlnRunOptions options;
  options.agent = "exec";
  options.exec.command = {"sed", "-u",
                          "-e",  std::to_string(decisions) + "c{\"action\":\"stop\"}",
                          "-e",  "3~3c{\"action\":\"turn_left\"}",
                          "-e",  "c{\"action\":\"forward\"}"};
  options.decisions = Decisions::kDiscrete;
  options.protocol = "citynav";
  options.workers = workers;
  options.width = width;
  options.open = [stage](const std::string&, uint64_t, int64_t) { return stage; };
  return options;
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc < 2) throw InputError("needs EPISODES.jsonl");
  const auto number = [&](int k, int otherwise) { return argc > k ? std::atoi(argv[k]) : otherwise; };
  const int width = number(5, 512);
  std::vector<LanguageEpisode> episodes = ReadEpisodes(argv[1]);
  std::erase_if(episodes, [first = episodes.front()](const LanguageEpisode& e) {
    return e.world != first.world || e.world_seed != first.world_seed;
  });
  episodes.resize(std::min(episodes.size(), static_cast<size_t>(std::max(1, number(2, 64)))));
  const auto stage = std::make_shared<Stage>(StageOptions{.world = {.world = episodes.front().world, .seed = episodes.front().world_seed}});
  const VlnRunOptions options = Run(stage, number(3, 64), number(4, 12), width);
  stage->solid();
  std::vector<VlnResult> results;
  const auto fly = [&] { results = RunEpisodes(episodes, options); };
  RunEpisodes({episodes.front()}, options);  // fills caches
  const Spent flown = Measure(fly);
  std::vector<RigidTransform> poses;
  for (const VlnResult& result : results)
    for (const auto& at : result.log) poses.push_back(BodyPose(at.p, at.yaw_deg * std::numbers::pi / 180, 0, 0) * CameraInBody());
  const auto draw = [&] {
    const std::unique_ptr<Renderer> renderers[] = {stage->NewRenderer(options.picture.tier), stage->NewRenderer(options.picture.tier)};
    Frame frame;
    for (size_t k = 0; const RigidTransform& X_WC : poses) {
      RenderRequest request{options.picture, Equirectangular{width, width / 2}, X_WC};
      request.products = {.rgb = true, .range = false, .semantic = false, .entity = false};
      renderers[k++ % std::size(renderers)]->Render(request, frame);
    }
  };
  std::printf("%s, %zu flights, %d at once, panoramas of %d x %d, %d threads\n", episodes.front().world.c_str(), episodes.size(),
              options.workers, width, width / 2, ThreadCount());
  const double a = Print("renderer alone", poses.size(), Measure(draw)), b = Print("flights", poses.size(), flown);
  const double c = Print("renderer alone, again", poses.size(), Measure(draw)), d = Print("flights, again", poses.size(), Measure(fly));
  std::printf("renderer / flights: %.3f of the processor (bar 0.9)\n", (a + c) / (b + d));
} catch (const InputError& error) {
  std::fprintf(stderr, "vln_bench: %s\n", error.what());
  return 2;
}
