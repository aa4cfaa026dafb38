// airsim360 bench: how fast this machine draws and steps a world.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <memory>

#include "airsim360/app/flags/arguments.h"
#include "airsim360/app/flags/commands.h"
#include "airsim360/app/flags/environment_flags.h"
#include "airsim360/app/flags/people_arguments.h"
#include "airsim360/app/flags/session.h"
#include "airsim360/app/flags/traffic_arguments.h"
#include "airsim360/app/flags/world_flags.h"
#include "airsim360/base/error.h"
#include "airsim360/base/parallel.h"
#include "airsim360/dataset/record/version.h"
#include "airsim360/flight/drones/catalog.h"
#include "airsim360/scene/viewpoint.h"
#include "airsim360/sim/sim_loop.h"

namespace airsim360 {
namespace {

constexpr int kMostFrames = 10000;
constexpr double kMostSeconds = 86400;  // simulated
constexpr double kHeightOfDrone = 2;    // metres above the spawn

struct BenchArguments {
  std::string world = "downtown_west", size = "2048x1024", tiers = "labels,fast,high";
  int frames = 5;
  double seconds = 5;
  EnvironmentFlags environment;
  PeopleArguments people;
  TrafficArguments traffic;
};

struct TierSpeed {
  std::string tier;
  double median_ms = 0, least_ms = 0, mrays_per_second = 0;
};

struct StepSpeed {
  double steps_per_second = 0, real_time_factor = 0;
};

std::vector<Tier> TiersOf(const BenchArguments& arguments) {
  const std::vector<std::string> names(std::begin(kTierNames), std::end(kTierNames));
  std::vector<Tier> tiers;
  for (const std::string& name : ParseList("--tiers", arguments.tiers, names)) tiers.push_back(ParseTier(name));
  return tiers;
}

Vec3d SpawnOf(const Scene& scene) { return VecCast<double>(FirstViewpoint(scene)); }

// Panoramas from the spawn, each turned on a little; the first, which fills caches, does not count.
TierSpeed TimeFrames(Stage& stage, Tier tier, ImageSize size, int frames) {
  Renderer& renderer = stage.renderer(tier);
  const Vec3d spawn = SpawnOf(stage.scene());
  std::vector<double> times;
  double rays = 0, total = 0;
  Frame frame;
  for (int i = 0; i <= frames; ++i) {
    const double yaw = 0.1 * i;
    RenderRequest request =
        MakeRequest(Equirectangular{size.width, size.height}, CameraPose(PanoramicRig{}, BodyPose(spawn, yaw, 0, 0)), tier);
    request.state = stage.StartState();
    const RenderStats stats = renderer.Render(request, frame);
    if (i == 0) continue;
    times.push_back(stats.render_ms);
    rays += static_cast<double>(stats.rays);
    total += stats.render_ms;
  }
  std::sort(times.begin(), times.end());
  return {kTierNames[static_cast<int>(tier)], times[times.size() / 2], times.front(), total > 0 ? rays / (1e3 * total) : 0};
}

// One drone with its standard sensors hovers above the spawn; people and traffic live as they were asked for.
StepSpeed TimeSteps(Stage& stage, double seconds) {
  DroneSetup setup{.name = "drone", .model = CatalogModel("hummingbird")};
  setup.X_WB.p = SpawnOf(stage.scene()) + Vec3d{0, 0, kHeightOfDrone};
  setup.airborne = true;
  SimModel model = stage.Model();
  model.drones.push_back(std::make_shared<const SimDrone>(setup, model.dt_ns));
  const auto steps = std::max<int64_t>(1, static_cast<int64_t>(seconds * 1e9) / model.dt_ns);
  SimLoop loop(std::make_shared<const SimModel>(std::move(model)));
  const auto begin = std::chrono::steady_clock::now();
  loop.Advance(steps);
  const double wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return {static_cast<double>(steps) / wall, 1e-9 * static_cast<double>(steps * loop.model().dt_ns) / wall};
}

void PrintTable(const BenchArguments& arguments, const Stage& stage, const std::vector<TierSpeed>& tiers, const StepSpeed& steps) {
  const SceneCounts counts = stage.scene().Count();
  std::printf("%s: %.1f M triangles, %zu entities, ready after %.1f s; %d threads, device %s\n", arguments.world.c_str(),
              1e-6 * static_cast<double>(counts.instanced_triangles), static_cast<size_t>(counts.entities), stage.load_seconds(),
              ThreadCount(), stage.device().device.c_str());
  for (const TierSpeed& tier : tiers)
    std::printf("%-10s %s  %8.1f ms a frame (least %.1f)  %7.2f frames/s  %6.2f Mrays/s\n", tier.tier.c_str(), arguments.size.c_str(),
                tier.median_ms, tier.least_ms, 1e3 / tier.median_ms, tier.mrays_per_second);
  std::printf("simulation %9.0f steps/s, %.0f times real time: one drone, %zu people, %d vehicles\n", steps.steps_per_second,
              steps.real_time_factor, stage.people() ? stage.people()->cast.size() : 0, arguments.traffic.count);
  std::printf("memory     %9.0f MiB at most\n", PeakRssMib());
}

nlohmann::ordered_json ReportOf(const BenchArguments& arguments, const Stage& stage, const std::vector<TierSpeed>& tiers,
                                const StepSpeed& steps) {
  const SceneCounts counts = stage.scene().Count();
  nlohmann::ordered_json frames = nlohmann::ordered_json::array();
  for (const TierSpeed& tier : tiers)
    frames.push_back({{"tier", tier.tier},
                      {"render_ms", tier.median_ms},
                      {"render_ms_least", tier.least_ms},
                      {"frames_per_second", 1e3 / tier.median_ms},
                      {"mrays_per_second", tier.mrays_per_second}});
  return {{"version", kVersion},
          {"world", arguments.world},
          {"size", arguments.size},
          {"threads", ThreadCount()},
          {"device", stage.device().device},
          {"triangles", counts.instanced_triangles},
          {"entities", counts.entities},
          {"load_ms", 1e3 * stage.load_seconds()},
          {"tiers", frames},
          {"simulation",
           {{"drones", 1},
            {"people", stage.people() ? stage.people()->cast.size() : 0},
            {"vehicles", arguments.traffic.count},
            {"steps_per_second", steps.steps_per_second},
            {"real_time_factor", steps.real_time_factor}}},
          {"peak_rss_mib", PeakRssMib()}};
}

void RunBench(const BenchArguments& arguments, const GlobalOptions& globals) {
  const ImageSize size = ParseSize(arguments.size);
  const std::vector<Tier> tiers = TiersOf(arguments);
  if (arguments.frames < 1 || arguments.frames > kMostFrames)
    throw InputError("--frames: " + std::to_string(arguments.frames) + " is not in 1 ... " + std::to_string(kMostFrames));
  if (CheckPositive("--seconds", arguments.seconds) > kMostSeconds)
    throw InputError("--seconds: " + std::to_string(arguments.seconds) + " is more than a day");
  Stage stage(StageOptionsOf(arguments.world, globals, arguments.environment, arguments.people.Request(globals.seed),
                             arguments.traffic.Request(globals.seed)));
  std::vector<TierSpeed> speeds;
  for (const Tier tier : tiers) speeds.push_back(TimeFrames(stage, tier, size, arguments.frames));
  const StepSpeed steps = TimeSteps(stage, arguments.seconds);
  if (globals.json)
    PrintJson(ReportOf(arguments, stage, speeds, steps));
  else
    PrintTable(arguments, stage, speeds, steps);
}

}  // namespace

void AddBenchCommand(CLI::App& app, GlobalOptions& globals) {
  CLI::App* command = app.add_subcommand("bench", "how fast this machine draws and steps a world");
  auto arguments = std::make_shared<BenchArguments>();
  command->add_option("--world", arguments->world, "name or file of a world (default downtown_west)");
  command->add_option("--size", arguments->size, "WxH of the panoramas (default 2048x1024)");
  command->add_option("--tiers", arguments->tiers, "of labels, fast, high, reference (default labels,fast,high)");
  command->add_option("--frames", arguments->frames, "panoramas a tier, after one that does not count (default 5)");
  command->add_option("--seconds", arguments->seconds, "simulated time of the steps that are timed (default 5)");
  AddEnvironmentFlags(*command, arguments->environment);
  arguments->people.AddTo(*command);
  arguments->traffic.AddTo(*command);
  AddWorldFlags(*command, globals);
  command->callback([arguments, &globals] { RunBench(*arguments, globals); });
}

}  // namespace airsim360
