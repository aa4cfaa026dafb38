// airsim360 worlds: the built-in worlds, without building them.
#include <cstdio>

#include "airsim360/app/arguments.h"
#include "airsim360/app/commands.h"
#include "airsim360/worlds/worlds.h"

namespace airsim360 {
namespace {

void PrintWorlds(bool json) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const WorldInfo& world : ListWorlds()) {
    if (json) {
      list.push_back({{"name", world.name},
                      {"setting", world.setting},
                      {"area_m2", world.area_m2},
                      {"categories", world.categories},
                      {"description", world.description}});
    } else {
      std::printf("%-16s %-8s %9.0f m2  %3zu categories  %s\n", world.name.c_str(), world.setting.c_str(),
                  world.area_m2, world.categories.size(), world.description.c_str());
    }
  }
  if (json) PrintJson(list);
}

}  // namespace

void AddWorldsCommand(CLI::App& app, GlobalOptions& globals) {
  CLI::App* command =
      app.add_subcommand("worlds", "list the built-in worlds: name, setting, area, categories");
  command->callback([&globals] { PrintWorlds(globals.json); });
}

}  // namespace airsim360
