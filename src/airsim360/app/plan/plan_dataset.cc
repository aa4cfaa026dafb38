#include "airsim360/app/plan/plan_dataset.h"

#include <cstdio>

#include "airsim360/app/flags/arguments.h"
#include "airsim360/base/error.h"
#include "airsim360/base/log.h"
#include "airsim360/dataset/waypoint_set.h"
#include "airsim360/stage/stage.h"
#include "airsim360/worlds/worlds.h"

namespace airsim360 {

void RunWaypointSet(const WaypointSetArguments& arguments, const GlobalOptions& globals) {
  if (arguments.dataset != "waypoint")
    throw InputError("--dataset: " + UnknownChoiceMessage("dataset", arguments.dataset, std::vector<std::string>{"waypoint"}));
  if (arguments.routes < 0) throw InputError("--routes: " + std::to_string(arguments.routes) + " is below zero");
  const Shard shard = ParseShard(arguments.shard);
  WaypointSetOptions options{.out = arguments.out,
                             .seed = globals.seed,
                             .shard = shard.index,
                             .shards = shard.count,
                             .most_routes = arguments.routes,
                             .radius = arguments.clearance};
  std::vector<std::string> names;
  for (const WaypointWorld& world : WaypointWorlds()) names.push_back(world.name);
  if (!arguments.worlds.empty()) options.worlds = ParseList("--worlds", arguments.worlds, names);
  options.exists = [](const std::string& name) {
    for (const WorldInfo& world : ListWorlds()) {
      if (world.name == name) return true;
    }
    return false;
  };
  // Worlds are always those of seed 0: the seed varies the routes.
  options.open = [](const std::string& name) { return std::make_shared<Stage>(StageOptions{.world = {.world = name}}); };
  const WaypointSetResult result = WriteWaypointSet(options);
  if (globals.json) {
    PrintJson({{"out", arguments.out},
               {"flights", result.flights},
               {"flights_written", result.written},
               {"worlds_missing", result.skipped},
               {"complete", result.complete},
               {"preparing_s", result.preparing_s},
               {"planning_s", result.planning_s}});
    return;
  }
  std::printf("%s: %lld flights of this shard, %lld written now in %.1f s after %.1f s of preparing%s\n", arguments.out.c_str(),
              static_cast<long long>(result.flights), static_cast<long long>(result.written), result.planning_s, result.preparing_s,
              result.complete ? "; the set is complete" : "");
}

}  // namespace airsim360
