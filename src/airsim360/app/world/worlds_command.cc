// airsim360 worlds: the built-in worlds, without building them.
#include <cstdio>
#include <memory>
#include <string>

#include "airsim360/app/flags/arguments.h"
#include "airsim360/app/flags/commands.h"
#include "airsim360/base/log.h"
#include "airsim360/stage/stage.h"
#include "airsim360/worlds/survey/world_floor.h"
#include "airsim360/worlds/survey/world_survey.h"
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
      std::printf("%-19s %-8s %9.0f m2  %3zu categories  %s\n", world.name.c_str(), world.setting.c_str(), world.area_m2,
                  world.categories.size(), world.description.c_str());
    }
  }
  if (json) PrintJson(list);
}

// What a world holds, counted on the built scene.
nlohmann::ordered_json CountsOf(const std::string& name, uint64_t seed) {
  const auto scene = Stage({.world = {.world = name, .seed = seed}}).shared_scene();
  const WorldSurvey s = SurveyWorld(*scene);
  nlohmann::ordered_json floor = nlohmann::ordered_json::array();
  for (const FloorRow& row : StructuralFloor(name, s))
    floor.push_back({{"item", row.item}, {"at_least", row.at_least}, {"measured", row.measured}, {"reached", row.reached()}});
  return {{"name", name},
          {"ground_area_m2", s.ground_area_m2},
          {"buildings_inside", s.buildings_inside},
          {"buildings_backdrop_600_m", s.buildings_backdrop},
          {"lamp_posts", s.lamp_posts},
          {"cars", s.cars},
          {"manholes", s.manholes},
          {"trees", s.trees},
          {"tree_species", s.tree_species},
          {"tree_meshes", s.tree_meshes},
          {"road_m", s.road_m},
          {"pavement_m", s.pavement_m},
          {"entities", s.counts.entities},
          {"instances", s.counts.instances},
          {"unique_triangles", s.counts.unique_triangles},
          {"instanced_triangles", s.counts.instanced_triangles},
          {"floor", floor},
          {"entities_by_category", s.categories}};
}

void PrintCounts(const std::string& name, const GlobalOptions& globals) {
  const nlohmann::ordered_json counts = CountsOf(name, globals.seed);
  if (globals.json) return PrintJson(counts);
  for (const auto& [key, value] : counts.items()) {
    if (!value.is_structured()) std::printf("%-26s %s\n", key.c_str(), value.dump().c_str());
  }
  for (const auto& row : counts["floor"])
    std::printf("  %-3s %-34s %s of %s\n", row["reached"].get<bool>() ? "ok" : "LOW", row["item"].get<std::string>().c_str(),
                row["measured"].dump().c_str(), row["at_least"].dump().c_str());
  for (const auto& [path, count] : counts["entities_by_category"].items()) std::printf("  %-48s %s\n", path.c_str(), count.dump().c_str());
}

}  // namespace

void AddWorldsCommand(CLI::App& app, GlobalOptions& globals) {
  CLI::App* command = app.add_subcommand("worlds", "list the built-in worlds: name, setting, area, categories");
  auto count = std::make_shared<std::string>();
  command->add_option("--count", *count, "builds this world and counts what it holds");
  command->callback([&globals, count] { count->empty() ? PrintWorlds(globals.json) : PrintCounts(*count, globals); });
}

}  // namespace airsim360
