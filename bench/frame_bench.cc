// Whole frames of a world along its survey route: milliseconds per 2048x1024 frame, rendering alone, by tier
// and number of threads, and the ratios between them. Usage: frame_bench [--world W] [--frames N] [--width W]
// [--row K] [--spawn] [--json]
//   --row K   only the K-th row of the table (from 1), for a profiler
// Processor time (of all threads) is what to look at on a machine that does other work, too.
//   --spawn   the spawn again and again instead of a route
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <memory>
#include <string>
#include <vector>

#include "airsim360/base/parallel.h"
#include "airsim360/opening/world_loader.h"
#include "airsim360/routes/survey.h"
#include "airsim360/scene/viewpoint.h"
#include "airsim360/sensors/rig.h"
#include "airsim360/sim/fly_route.h"
#include "clock.h"
#include "median.h"

namespace {

using namespace airsim360;

struct Row {
  const char* what;
  Tier tier;
  int edge_samples;
  int threads;
};

// Of all threads of this process so far, ms.
double ProcessorMilliseconds() { return 1e3 * SecondsOf(CLOCK_PROCESS_CPUTIME_ID); }

const char* Text(int argc, char** argv, const char* name, const char* value) {
  for (int i = 1; i + 1 < argc; ++i) {
    if (std::strcmp(argv[i], name) == 0) value = argv[i + 1];
  }
  return value;
}

int Argument(int argc, char** argv, const char* name, int value) {
  const char* text = Text(argc, argv, name, nullptr);
  return text == nullptr ? value : std::atoi(text);
}

bool Flag(int argc, char** argv, const char* name) {
  return std::any_of(argv, argv + argc, [&](const char* a) { return std::strcmp(a, name) == 0; });
}

// The poses of `airsim360 collect --world W --frames N`, or the spawn N times.
std::vector<RigidTransform> Poses(const std::shared_ptr<const RayTracer>& tracer, int frames, bool spawn) {
  std::vector<RigidTransform> poses;
  if (spawn) {
    const Scene& scene = tracer->scene();
    poses.assign(static_cast<size_t>(frames), {{}, VecCast<double>(FirstViewpoint(scene))});
    return poses;
  }
  const auto route = std::make_shared<const Route>(PlanSurvey(*tracer, {}));
  const Flight flight = FlyRoute({.tracer = tracer, .dt_ns = kRouteStepNs}, route, EvenTimes(*route, frames));
  for (const Shot& shot : flight.shots) poses.push_back(shot.body.X_WB);
  return poses;
}

}  // namespace

int main(int argc, char** argv) {
  const int frames = std::max(1, Argument(argc, argv, "--frames", 8));
  const int width = std::max(64, Argument(argc, argv, "--width", 2048)) / 2 * 2;
  const bool json = Flag(argc, argv, "--json");
  const std::string world = Text(argc, argv, "--world", "downtown_west");

  const auto scene = LoadWorld({.world = world});
  const auto tracer = std::make_shared<const RayTracer>(scene);
  const std::vector<RigidTransform> poses = Poses(tracer, frames, Flag(argc, argv, "--spawn"));
  const auto renderer = MakeCpuRenderer(tracer, {.tier = Tier::kHigh});

  // All rows take turns at every pose, so that a busy moment of the machine hits all of them.
  std::vector<Row> rows;
  for (int threads : {1, 0}) {
    rows.push_back({"labels", Tier::kLabels, 1, threads});
    rows.push_back({"fast, 1 sample", Tier::kFast, 1, threads});
    rows.push_back({"fast, 2 samples", Tier::kFast, 2, threads});
    rows.push_back({"fast, 4 samples", Tier::kFast, 4, threads});
    rows.push_back({"high, 8 samples", Tier::kHigh, 8, threads});
  }
  const int only = Argument(argc, argv, "--row", 0);
  if (only > 0 && only <= static_cast<int>(rows.size())) rows = {rows[static_cast<size_t>(only - 1)]};
  std::vector<std::vector<double>> times(rows.size()), work(rows.size());
  std::vector<double> rays(rows.size());
  Frame frame;
  const PanoramicRig rig;
  for (const RigidTransform& X_WB : poses) {
    for (size_t i = 0; i < rows.size(); ++i) {
      const ThreadLimit limit(rows[i].threads);
      const double before = ProcessorMilliseconds();
      RenderRequest request = MakeRequest(Equirectangular{width, width / 2}, CameraPose(rig, X_WB), rows[i].tier);
      request.edge_samples = rows[i].edge_samples;
      const RenderStats stats = renderer->Render(request, frame);
      times[i].push_back(stats.render_ms);
      work[i].push_back(ProcessorMilliseconds() - before);
      rays[i] += static_cast<double>(stats.rays);
    }
  }

  const SceneCounts counts = scene->Count();
  if (!json) {
    std::printf("%s, %dx%d, %d poses, %.1f M triangles (%.1f M unique), %d threads at most\n", world.c_str(), width, width / 2, frames,
                static_cast<double>(counts.instanced_triangles) / 1e6, static_cast<double>(counts.unique_triangles) / 1e6, ThreadCount());
    std::printf("%-18s %8s %10s %10s %13s %10s %10s\n", "tier", "threads", "median ms", "mean ms", "processor ms", "frames/s", "Mrays");
  }
  for (size_t i = 0; i < rows.size(); ++i) {
    double sum = 0;
    for (double t : times[i]) sum += t;
    const double median = Median(times[i]), processor = Median(work[i]), mean = sum / frames;
    const int threads = rows[i].threads > 0 ? rows[i].threads : ThreadCount();
    if (json) {
      std::printf(
          "%s{\"tier\": \"%s\", \"threads\": %d, \"median_ms\": %.3f, \"mean_ms\": %.3f, "
          "\"processor_ms\": %.3f, \"mrays\": %.3f}%s",
          i == 0 ? "[" : ",\n ", rows[i].what, threads, median, mean, processor, rays[i] / frames / 1e6, i + 1 == rows.size() ? "]\n" : "");
    } else {
      std::printf("%-18s %8d %10.1f %10.1f %13.1f %10.2f %10.2f\n", rows[i].what, threads, median, mean, processor, 1000 / mean,
                  rays[i] / frames / 1e6);
    }
  }
  return 0;
}
