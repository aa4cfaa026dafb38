#include "airsim360/dataset/waypoint_set.h"

#include <algorithm>
#include <chrono>
#include <cstdio>

#include "airsim360/base/error.h"
#include "airsim360/base/file.h"
#include "airsim360/base/log.h"
#include "airsim360/base/parallel.h"
#include "airsim360/base/steady_clock.h"
#include "airsim360/dataset/waypoint_part.h"
#include "airsim360/planning/export/trajectory_plot.h"
#include "airsim360/planning/number_text.h"

namespace airsim360 {
namespace {

namespace fs = std::filesystem;

constexpr int64_t kRoutesOfPart = 500;
constexpr size_t kShownRoutes = 250;

std::string PartFile(int64_t part, const char* extension) {
  char name[32];
  std::snprintf(name, sizeof(name), "part-%04lld%s", static_cast<long long>(part), extension);
  return name;
}

// InputError for a name that is not in the table.
void CheckNames(const WaypointSetOptions& options) {
  std::vector<std::string> names;
  for (const WaypointWorld& world : WaypointWorlds()) names.push_back(world.name);
  for (const std::string& name : options.worlds) {
    if (std::find(names.begin(), names.end(), name) == names.end())
      throw InputError("--worlds: " + UnknownChoiceMessage("world of the waypoint set", name, names));
  }
}

// Worlds to do, with their counts; names those that do not exist.
std::vector<WaypointWorld> WorldsToDo(const WaypointSetOptions& options, std::vector<std::string>& skipped) {
  std::vector<WaypointWorld> worlds;
  for (WaypointWorld world : WaypointWorlds()) {
    if (!options.worlds.empty() && std::ranges::count(options.worlds, world.name) == 0) continue;
    if (options.most_routes > 0) world.routes = std::min(world.routes, options.most_routes);
    if (options.exists(world.name)) {
      worlds.push_back(world);
      continue;
    }
    skipped.push_back(world.name);
    LogWarning("world '" + world.name + "' does not exist yet: its " + std::to_string(world.routes) + " routes are left out");
  }
  return worlds;
}

// The file that tells with what a folder was begun.
void CheckFolder(const WaypointSetOptions& options) {
  std::string text = "seed: " + std::to_string(options.seed) + "\nradius: ";
  AppendNumber(text, options.radius);
  text += "\nmost_routes: " + std::to_string(options.most_routes) + "\n";
  const fs::path file = options.out / "set.yaml";
  CreateWritableFolder(options.out);
  if (fs::exists(file)) {
    if (ReadTextFile(file) != text)
      throw InputError("--out: '" + options.out.string() + "' holds a set made with another seed, radius or count; see " + file.string());
    return;
  }
  if (!fs::is_empty(options.out)) throw InputError("--out: '" + options.out.string() + "' is not empty and not a waypoint set");
  WriteFileAtomically(file, text);
}

bool PartIsThere(const fs::path& folder, int64_t part) {
  return std::all_of(KinematicSets().begin(), KinematicSets().end(), [&](const KinematicSet& set) {
    return fs::exists(folder / set.name / PartFile(part, ".npz")) && fs::exists(folder / set.name / PartFile(part, ".csv"));
  });
}

void WritePicture(const fs::path& folder, const WaypointWorld& world, const WaypointSpace& space, std::span<const WaypointRoute> routes) {
  std::vector<std::vector<Vec3d>> ways;
  for (size_t i = 0; i < std::min(routes.size(), kShownRoutes); ++i) {
    const PolynomialTrajectory& path = routes[i].flights[0].flight.trajectory;
    std::vector<Vec3d>& way = ways.emplace_back();
    for (const double t : SampleTimes(path.duration(), 0.25)) way.push_back(path.At(t).p);
  }
  const PlotOptions options{.title = world.name + ": the first " + std::to_string(ways.size()) + " routes", .map = &space.map()};
  WriteFileAtomically(folder / "routes.svg", PlotRoutes(ways, options));
  const AllocatedTrajectory& first = routes[0].flights[0].flight;
  WriteFileAtomically(folder / "first_route.svg",
                      PlotFlight(first.trajectory, {.title = world.name + ", route 0, " + KinematicSets()[0].name,
                                                    .max_speed = KinematicSets()[0].max_speed,
                                                    .max_acceleration = KinematicSets()[0].max_acceleration,
                                                    .map = &space.map()}));
}

void WritePart(const fs::path& folder, const WaypointWorld& world, int64_t part, const WaypointSpace& space,
               const WaypointSetOptions& options, ProgressBar& progress, int64_t& written) {
  const int64_t first = part * kRoutesOfPart, count = std::min(kRoutesOfPart, world.routes - first);
  std::vector<WaypointRoute> routes(static_cast<size_t>(count));
  ParallelFor(
      count, [&](int64_t i) { routes[static_cast<size_t>(i)] = MakeWaypointRoute(space, world, options.seed, first + i, options.radius); });
  if (part == 0) WritePicture(folder, world, space, routes);
  for (size_t set = 0; set < KinematicSets().size(); ++set) {
    const fs::path place = folder / KinematicSets()[set].name;
    CreateWritableFolder(place);
    const internal::PartName name{world, set, part, first};
    WriteFileAtomically(place / PartFile(part, ".npz"), internal::EncodePart(routes, name));
    WriteFileAtomically(place / PartFile(part, ".csv"), internal::PartRows(routes, name));
  }
  written += count * static_cast<int64_t>(KinematicSets().size());
  progress.Update(written);
}

// Index, statistics and card, once every part of every world is there.
bool WriteSummary(const WaypointSetOptions& options, const std::vector<WaypointWorld>& worlds) {
  std::string index = internal::kIndexHeader;
  for (const WaypointWorld& world : worlds) {
    for (const KinematicSet& set : KinematicSets()) {
      for (int64_t part = 0; part * kRoutesOfPart < world.routes; ++part) {
        if (!PartIsThere(options.out / world.name, part)) return false;
        index += ReadTextFile(options.out / world.name / set.name / PartFile(part, ".csv"));
      }
    }
  }
  const std::string statistics = internal::Statistics(index);
  WriteFileAtomically(options.out / "index.csv", index);
  WriteFileAtomically(options.out / "statistics.json", statistics);
  WriteFileAtomically(options.out / "README.md", internal::WaypointReadme(options, statistics));
  return true;
}

}  // namespace

WaypointSetResult WriteWaypointSet(const WaypointSetOptions& options) {
  WaypointSetResult result;
  CheckNames(options);
  CheckFolder(options);
  const std::vector<WaypointWorld> worlds = WorldsToDo(options, result.skipped);
  // What this shard still has to do, by world.
  const auto sets = static_cast<int64_t>(KinematicSets().size());
  std::vector<std::vector<int64_t>> missing(worlds.size());
  int64_t to_do = 0, number = 0;
  for (size_t w = 0; w < worlds.size(); ++w) {
    for (int64_t part = 0; part * kRoutesOfPart < worlds[w].routes; ++part, ++number) {
      if (number % options.shards != options.shard) continue;
      const int64_t count = sets * std::min(kRoutesOfPart, worlds[w].routes - part * kRoutesOfPart);
      result.flights += count;
      if (PartIsThere(options.out / worlds[w].name, part)) continue;
      missing[w].push_back(part);
      to_do += count;
    }
  }
  ProgressBar progress("flights", to_do);
  for (size_t w = 0; w < worlds.size(); ++w) {
    if (missing[w].empty()) continue;
    const double start = SteadySeconds();
    const WaypointSpace space(*options.open(worlds[w].name), options.radius);
    CreateWritableFolder(options.out / worlds[w].name);
    const double prepared = SteadySeconds();
    for (const int64_t part : missing[w])
      WritePart(options.out / worlds[w].name, worlds[w], part, space, options, progress, result.written);
    result.preparing_s += prepared - start;
    result.planning_s += SteadySeconds() - prepared;
  }
  result.complete = WriteSummary(options, worlds);
  return result;
}

}  // namespace airsim360
