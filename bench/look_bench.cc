// What `--look photo` adds to a capture from the spawn: both looks in turn, pair after pair, with the processor time of all threads.
// Usage: look_bench [--world W] [--weather NAME] [--width W] [--pairs N]
// Prints for each tier the least and the median of the pairs, in ms, and what the look adds.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <memory>
#include <string>
#include <vector>

#include "airsim360/opening/world_environment.h"
#include "airsim360/opening/world_loader.h"
#include "airsim360/render/relightable.h"
#include "airsim360/scene/viewpoint.h"
#include "airsim360/sensors/rig.h"
#include "arguments.h"
#include "clock.h"
#include "median.h"

namespace {

using namespace airsim360;

double Least(const std::vector<double>& v) { return *std::min_element(v.begin(), v.end()); }

}  // namespace

int main(int argc, char** argv) {
  const int width = std::max(64, std::atoi(Argument(argc, argv, "--width", "2048"))) / 2 * 2;
  const int pairs = std::max(1, std::atoi(Argument(argc, argv, "--pairs", "8")));
  const auto scene = LoadWorld({.world = Argument(argc, argv, "--world", "downtown_west")});
  const auto renderer = MakeCpuRenderer(std::make_shared<const RayTracer>(scene), {.tier = Tier::kHigh});
  EnvironmentFlags flags;
  flags.weather = Argument(argc, argv, "--weather", "");
  if (!flags.weather.empty()) dynamic_cast<Relightable&>(*renderer).SetEnvironment(ApplyFlags(flags, scene->environment));
  const RigidTransform X_WB{{}, VecCast<double>(FirstViewpoint(*scene))};
  Capture captures[2];  // each look finds its own planes as it left them
  for (Tier tier : {Tier::kFast, Tier::kHigh}) {
    std::vector<double> times[2], ratios;
    for (int pair = -1; pair < pairs; ++pair) {  // the first pair warms up
      double ms[2];
      for (Look look : {Look::kClean, Look::kPhoto}) {
        PanoramicRig rig;
        rig.camera = Equirectangular{width, width / 2};
        rig.tier = tier, rig.look = look;
        const double before = SecondsOf(CLOCK_PROCESS_CPUTIME_ID);
        CaptureRig(rig, {X_WB, {}, {}}, 0, *renderer, captures[look == Look::kPhoto]);
        ms[look == Look::kPhoto] = 1e3 * (SecondsOf(CLOCK_PROCESS_CPUTIME_ID) - before);
        if (pair >= 0) times[look == Look::kPhoto].push_back(ms[look == Look::kPhoto]);
      }
      if (pair >= 0) ratios.push_back(ms[1] / ms[0]);
    }
    std::printf(
        "%s %dx%d, %d pairs: clean %.0f (median %.0f), photo %.0f (median %.0f), photo adds %.1f %% by the least, %.1f %% by the median pair\n",
        tier == Tier::kFast ? "fast" : "high", width, width / 2, pairs, Least(times[0]), Median(times[0]), Least(times[1]),
        Median(times[1]), 100 * (Least(times[1]) / Least(times[0]) - 1), 100 * (Median(ratios) - 1));
    std::fflush(stdout);
  }
}
