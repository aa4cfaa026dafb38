#include "airsim360/app/world/world_make.h"

#include <cstdio>
#include <filesystem>
#include <optional>
#include <sstream>

#include "airsim360/app/flags/arguments.h"
#include "airsim360/base/config.h"
#include "airsim360/base/error.h"
#include "airsim360/base/file.h"
#include "airsim360/base/text.h"
#include "airsim360/worlds/interior/building_words.h"
#include "airsim360/worlds/town_maker/town_words.h"

namespace airsim360 {
namespace {

namespace fs = std::filesystem;

// One line, whatever the words were.
std::string Comment(std::string text) {
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 0x20) c = ' ';
  return "# " + text + "\n";
}

std::string BuildingText(const std::string& words, const BuildingRequest& request, const std::string& people, uint64_t seed) {
  std::string text = Comment(words) + "world: building\nseed: " + std::to_string(seed) + "\n";
  if (!people.empty()) text += Comment("people: open it with --people " + people);
  text += "building:\n";
  BuildingSpec spec = request.spec;
  std::istringstream lines(DescribeConfig([&](ConfigVisitor& v) { spec.Visit(v); }));
  for (std::string line; std::getline(lines, line);) text += "  " + line + "\n";
  return text;
}

std::string WorldText(const std::string& words, const TownRequest& request, const std::string& people, uint64_t seed) {
  std::string text = Comment(words) + "world: town\nseed: " + std::to_string(seed) + "\n";
  if (!people.empty()) text += Comment("people: open it with --people " + people);
  if (!request.weather.empty()) text += "environment:\n  weather: " + request.weather + "\n";
  for (const auto& [key, value] : request.environment) text += "  " + key + ": " + ShortestText(value) + "\n";
  text += "town:\n";
  TownSpec spec = request.spec;
  std::istringstream lines(DescribeConfig([&](ConfigVisitor& v) { spec.Visit(v); }));
  for (std::string line; std::getline(lines, line);) text += "  " + line + "\n";
  return text;
}

}  // namespace

void RunWorldMake(const MakeArguments& arguments, const GlobalOptions& globals) {
  const fs::path out = arguments.out;
  if (out.extension() != ".yaml" && out.extension() != ".yml")
    throw InputError("--out: '" + arguments.out + "': a world file is a .yaml; did you mean '" +
                     fs::path(out).replace_extension(".yaml").string() + "'?");
  // Of a building from inside, else of a town.
  const std::optional<BuildingRequest> building = BuildingFromWords(arguments.words);
  TownRequest request;
  if (!building) request = TownFromWords(arguments.words);
  if (building) {
    request.people = building->people;
    for (const auto& [word, as] : building->words) request.words.push_back({word, as});
  }
  if (!building) SettleTown(request, globals.seed);
  // Of the people who are wanted now, or none: an older file of them would be taken for these.
  const fs::path people_file = fs::path(out).replace_extension(".people.yaml");
  for (const fs::path& file : {out, people_file})
    if (fs::is_directory(file)) throw InputError("--out: '" + file.string() + "' is a folder");
  if (out.has_parent_path()) CreateWritableFolder(out.parent_path());
  const fs::path people = request.people > 0 ? people_file : fs::path();
  const std::string text = building ? BuildingText(arguments.words, *building, people.filename().string(), globals.seed)
                                    : WorldText(arguments.words, request, people.filename().string(), globals.seed);
  WriteFileAtomically(out, std::string_view(text));
  if (people.empty())
    fs::remove(people_file);
  else
    WriteFileAtomically(people, std::string_view(std::string("areas:\n  - name: ") + (building ? "building" : "town") +
                                                 "\n    count: " + std::to_string(request.people) + "\n"));
  if (globals.json) {
    nlohmann::ordered_json json{{"out", out.string()}, {"seed", globals.seed}, {"people", request.people}};
    if (!people.empty()) json["people_file"] = people.string();
    for (const UnderstoodWords& row : request.words) json["words"].push_back({{"words", row.words}, {"as", row.as}});
    return PrintJson(json);
  }
  for (const UnderstoodWords& row : request.words) std::printf("  %-24s %s\n", row.words.c_str(), row.as.c_str());
  std::printf("use it as --world %s%s\n", out.c_str(), people.empty() ? "" : (" --people " + people.string()).c_str());
}

}  // namespace airsim360
