// Whole frames of downtown_west along its survey route: milliseconds per 2048x1024 frame, rendering alone, by
// tier and number of threads, and the ratios between them. Usage: frame_bench [--frames N] [--width W]
// [--json]
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

#include "airsim360/base/parallel.h"
#include "airsim360/sensors/rig.h"
#include "airsim360/sim/fly_route.h"
#include "airsim360/sim/survey.h"
#include "airsim360/sim/world_loader.h"

namespace {

using namespace airsim360;

struct Row {
  const char* what;
  Tier tier;
  int aa_samples;
  int threads;
  double median_ms = 0, mean_ms = 0, mean_rays = 0;
};

int Argument(int argc, char** argv, const char* name, int value) {
  for (int i = 1; i + 1 < argc; ++i) {
    if (std::strcmp(argv[i], name) == 0) value = std::atoi(argv[i + 1]);
  }
  return value;
}

}  // namespace

int main(int argc, char** argv) {
  const int frames = std::max(1, Argument(argc, argv, "--frames", 8));
  const int width = std::max(64, Argument(argc, argv, "--width", 2048)) / 2 * 2;
  const bool json =
      std::any_of(argv, argv + argc, [](const char* a) { return std::strcmp(a, "--json") == 0; });

  // The same poses as `airsim360 collect --world downtown_west --frames N`.
  const auto scene = LoadWorld({.world = "downtown_west"});
  const auto tracer = std::make_shared<const RayTracer>(scene);
  const auto route = std::make_shared<const Route>(PlanSurvey(*tracer, {}));
  const Flight flight = FlyRoute({.tracer = tracer, .dt_ns = kRouteStepNs}, route, EvenTimes(*route, frames));
  const auto renderer = MakeCpuRenderer(tracer, {.tier = Tier::kHigh});

  // All rows take turns at every pose, so that a busy moment of the machine hits all of them.
  std::vector<Row> rows;
  for (int threads : {1, 0}) {
    rows.push_back({"labels", Tier::kLabels, 1, threads});
    rows.push_back({"fast, 1 sample", Tier::kFast, 1, threads});
    rows.push_back({"fast, 4 samples", Tier::kFast, 4, threads});
    rows.push_back({"high, 4 samples", Tier::kHigh, 4, threads});
  }
  std::vector<std::vector<double>> times(rows.size());
  std::vector<double> rays(rows.size());
  Frame frame;
  const PanoramicRig rig;
  for (const Shot& shot : flight.shots) {
    for (size_t i = 0; i < rows.size(); ++i) {
      const ThreadLimit limit(rows[i].threads);
      const RenderStats stats = renderer->Render({.camera = Equirectangular{width, width / 2},
                                                  .X_WC = CameraPose(rig, shot.body.X_WB),
                                                  .tier = rows[i].tier,
                                                  .aa_samples = rows[i].aa_samples},
                                                 frame);
      times[i].push_back(stats.render_ms);
      rays[i] += static_cast<double>(stats.rays);
    }
  }

  const SceneCounts counts = scene->Count();
  if (!json) {
    std::printf("downtown_west, %dx%d, %d poses, %.1f M triangles (%.1f M unique), %d threads at most\n",
                width, width / 2, frames, static_cast<double>(counts.instanced_triangles) / 1e6,
                static_cast<double>(counts.unique_triangles) / 1e6, ThreadCount());
    std::printf("%-18s %8s %10s %10s %10s %10s\n", "tier", "threads", "median ms", "mean ms", "frames/s",
                "Mrays");
  }
  for (size_t i = 0; i < rows.size(); ++i) {
    double sum = 0;
    for (double t : times[i]) sum += t;
    std::sort(times[i].begin(), times[i].end());
    const double median = times[i][times[i].size() / 2], mean = sum / frames;
    const int threads = rows[i].threads > 0 ? rows[i].threads : ThreadCount();
    if (json) {
      std::printf(
          "%s{\"tier\": \"%s\", \"threads\": %d, \"median_ms\": %.3f, \"mean_ms\": %.3f, \"mrays\": %.3f}%s",
          i == 0 ? "[" : ",\n ", rows[i].what, threads, median, mean, rays[i] / frames / 1e6,
          i + 1 == rows.size() ? "]\n" : "");
    } else {
      std::printf("%-18s %8d %10.1f %10.1f %10.2f %10.2f\n", rows[i].what, threads, median, mean, 1000 / mean,
                  rays[i] / frames / 1e6);
    }
  }
}
