#include "airsim360/dataset/plan/recipe.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>
#include <set>

#include "airsim360/base/choice.h"
#include "airsim360/base/error.h"
#include "airsim360/dataset/plan/built_in_recipes.h"
#include "airsim360/dataset/plan/plan_spec.h"
#include "airsim360/dataset/record/config_json.h"
#include "airsim360/dataset/record/record.h"
#include "airsim360/scene/environment.h"
#include "airsim360/scene/environment_sampler.h"

namespace airsim360 {
namespace {

constexpr char kWaypointSet[] = "omni360-waypoint";

void VisitSettings(ConfigVisitor& v, SettingRange& range) {
  v.Field("setting", "a number of the environment, such as turbidity, or exposure", range.setting);
  v.Field("low", "drawn evenly from here", range.low, -1e9, 1e9);
  v.Field("high", "to here", range.high, -1e9, 1e9);
}

void VisitChoice(ConfigVisitor& v, SkyChoice& choice) {
  v.Field("weight", "how often, beside the other choices", choice.weight, 0, 1e6);
  v.Field("weather", "a preset: day, golden, overcast, …; empty: the world's own", choice.weather);
  v.Field("climate", "instead: date, hour, clouds and weather by lot, as a climate has them", choice.climate);
  v.Field("latitude_deg", "of that climate, degrees north", choice.latitude_deg, -Climate::kMaxLatitude, Climate::kMaxLatitude);
  v.Field("least_sun_elevation_deg", "of that climate's samples", choice.least_sun_elevation_deg, -90, Climate::kMaxLeastSun);
  v.List("settings", "numbers drawn over it", choice.settings, VisitSettings);
}

void VisitMixture(ConfigVisitor& v, SkyMixture& mixture) {
  v.Field("name", "what rows call it", mixture.name);
  v.Field("frames", "consecutive frames that share one sky", mixture.frames);
  v.List("choices", "kinds of sky", mixture.choices, VisitChoice);
}

void VisitRow(ConfigVisitor& v, RecipeRow& row) {
  v.Field("name", "unique; the world's name if left out", row.name);
  v.Field("world", "name or file", row.world);
  v.Field("world_seed", "of a procedural world", row.world_seed);
  v.Field("frames", "how many", row.frames);
  v.Field("sampler", "viewpoints, flights or people", row.sampler);
  v.Field("skies", "name of a mixture", row.skies);
  v.Field("area", "[x0, y0, x1, y1] in metres; empty: where the world's things are", row.area);
  v.Field("lowest", "metres above the ground", row.lowest, 0.1, 10000);
  v.Field("highest", "metres above the ground", row.highest, 0.1, 10000);
  v.Field("clearance", "metres to every surface", row.clearance, 0.1, 100);
  v.Field("tilt_deg", "pitch and roll of the body are drawn from ± this", row.tilt_deg, 0, 45);
  v.Field("flight_frames", "flights: frames of each", row.flight_frames);
  v.Field("least_length", "flights: metres", row.least_length, 1, 10000);
  v.Field("most_length", "flights: metres", row.most_length, 1, 10000);
  v.Field("people", "in the world; sampler people: in the area", row.people);
  v.Field("width", "sampler people: of the area, metres", row.width, 4, 500);
  v.Field("depth", "sampler people: of the area, metres", row.depth, 4, 500);
  v.Field("pitch_deg", "sampler people: of the camera below the horizon", row.pitch_deg, -90, 90);
  v.Field("interval", "sampler people: seconds between frames", row.interval, 0.05, 60);
  v.Field("view_frames", "sampler people: frames before the camera goes elsewhere", row.view_frames);
}

void CheckMixture(const SkyMixture& mixture, const std::string& where) {
  const std::string at = where + ": skies '" + mixture.name + "': ";
  if (mixture.name.empty()) throw InputError(where + ": skies: a mixture needs a name");
  if (mixture.frames < 1 || mixture.frames > 1'000'000)
    throw InputError(at + "frames: " + std::to_string(mixture.frames) + " is not in 1 … 1000000");
  double weights = 0;
  for (const SkyChoice& choice : mixture.choices) {
    weights += choice.weight;
    if (choice.climate && !choice.weather.empty()) throw InputError(at + "weather: a climate draws its own; leave one of them out");
    if (!choice.weather.empty()) ParseChoice("weather", choice.weather, EnvironmentPresetNames(), at + "weather");
    for (const SettingRange& range : choice.settings) {
      std::vector<std::string> names;
      for (const EnvironmentField& field : EnvironmentFields()) names.emplace_back(field.name);
      names.emplace_back(kExposureSetting);
      const size_t index = ParseChoice("setting", range.setting, names, at + "settings");
      if (!(range.low <= range.high)) throw InputError(at + range.setting + ": low is above high");
      if (index == EnvironmentFields().size()) {
        if (range.low < -kMaxStops || range.high > kMaxStops)
          throw InputError(at + "exposure: it is in " + std::to_string(-static_cast<int>(kMaxStops)) + " … " +
                           std::to_string(static_cast<int>(kMaxStops)) + " stops");
        continue;
      }
      const EnvironmentField& field = EnvironmentFields()[index];
      Environment ends;
      for (const double end : {range.low, range.high}) {
        ends.*field.value = end;
        ValidateEnvironment(ends, at + "settings");
      }
    }
  }
  if (!(weights > 0)) throw InputError(at + "choices: their weights add up to nothing");
}

void CheckRow(const RecipeRow& row, const Recipe& recipe, const std::string& where) {
  const std::string at = where + ": row '" + row.name + "': ";
  if (row.world.empty()) throw InputError(at + "world is missing");
  if (row.frames < 1 || row.frames > static_cast<uint64_t>(kMostPlanFrames))
    throw InputError(at + "frames: " + std::to_string(row.frames) + " is not in 1 … " + std::to_string(kMostPlanFrames));
  const auto sampler = ParseChoice<Sampler>("sampler", row.sampler, kSamplerNames, at + "sampler");
  std::vector<std::string> names;
  for (const SkyMixture& mixture : recipe.skies) names.push_back(mixture.name);
  ParseChoice("mixture", row.skies, names, at + "skies");
  if (!row.area.empty()) AreaOf(row, at);
  if (!(row.lowest <= row.highest)) throw InputError(at + "lowest is above highest");
  if (!(row.least_length < row.most_length)) throw InputError(at + "least_length is not below most_length");
  if (row.flight_frames < 1 || row.flight_frames > 10000) throw InputError(at + "flight_frames: not in 1 … 10000");
  if (row.view_frames < 1 || row.view_frames > 10000) throw InputError(at + "view_frames: not in 1 … 10000");
  if (row.people > 20000) throw InputError(at + "people: " + std::to_string(row.people) + " is not in 0 … 20000");
  if (sampler == Sampler::kPeople && row.people == 0) throw InputError(at + "people: the sampler people needs some");
  if (sampler != Sampler::kPeople && row.people > 0)
    throw InputError(at + "people: only the sampler people has people; use sampler: people");
}

}  // namespace

int64_t Recipe::frames() const {
  return std::accumulate(rows.begin(), rows.end(), int64_t{0},
                         [](int64_t sum, const RecipeRow& row) { return sum + static_cast<int64_t>(row.frames); });
}

Box2d AreaOf(const RecipeRow& row, const std::string& where) {
  double values[4] = {};
  for (size_t i = 0; i < 4 && i < row.area.size(); ++i) {
    const std::string& text = row.area[i];
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), values[i]);
    if (error != std::errc() || end != text.data() + text.size() || !(std::abs(values[i]) < 1e6))
      throw InputError(where + "area: '" + text.substr(0, 40) + "' is not a number of metres");
  }
  if (row.area.size() != 4 || !(values[0] < values[2]) || !(values[1] < values[3]))
    throw InputError(where + "area: it is [x0, y0, x1, y1] with x0 < x1 and y0 < y1");
  return {{values[0], values[1]}, {values[2], values[3]}};
}

void VisitPicture(ConfigVisitor& v, RecipePicture& picture) {
  v.Field("size", "WxH, twice as wide as high", picture.size);
  v.Field("products", "beside rgb, range, semantic, entity", picture.products);
  picture.settings.Visit(v);
}

std::string PictureJson(RecipePicture picture) {
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  AddConfig([&](ConfigVisitor& v) { VisitPicture(v, picture); }, json);
  return json.dump();
}

void VisitRecipe(ConfigVisitor& v, Recipe& recipe) {
  v.Field("name", "of the dataset", recipe.name);
  v.Field("about", "one line", recipe.about);
  v.Group("picture", "what a frame is", [&](ConfigVisitor& group) { VisitPicture(group, recipe.picture); });
  v.List("skies", "mixtures of skies", recipe.skies, VisitMixture);
  v.List("rows", "frames of worlds", recipe.rows, VisitRow);
}

void CheckRecipe(const Recipe& recipe, const std::string& where) {
  constexpr size_t kMostRows = 10000;
  if (recipe.name.empty()) throw InputError(where + ": key 'name' is missing");
  if (recipe.rows.empty()) throw InputError(where + ": key 'rows' is missing");
  if (recipe.rows.size() > kMostRows) throw InputError(where + ": more than 10000 rows");
  for (const SkyMixture& mixture : recipe.skies) CheckMixture(mixture, where);
  std::set<std::string> names;
  for (const RecipeRow& row : recipe.rows) {
    CheckRow(row, recipe, where);
    if (!names.insert(row.name).second) throw InputError(where + ": two rows are called '" + row.name + "'");
  }
  try {
    (void)SpecOfPicture(recipe.picture, {.size = recipe.picture.size, .cameras = {}});
  } catch (const InputError& error) {
    throw InputError(where + ": picture: " + error.what());
  }
  CheckExposures(recipe, recipe.picture.settings, where);
  if (recipe.frames() > kMostPlanFrames)
    throw InputError(where + ": " + std::to_string(recipe.frames()) + " frames are more than " + std::to_string(kMostPlanFrames));
}

void CheckExposures(const Recipe& recipe, const PictureSettings& picture, const std::string& where) {
  if (!HasOwnExposure(picture)) return;
  for (const SkyMixture& mixture : recipe.skies) {
    for (const SkyChoice& choice : mixture.choices) {
      if (std::ranges::count(choice.settings, kExposureSetting, &SettingRange::setting) > 0)
        throw InputError(where + ": skies '" + mixture.name +
                         "': exposure is drawn, but every picture finds its own with exposure: auto; give a number of stops");
    }
  }
}

Recipe FindRecipe(const std::string& name_or_file) {
  if (name_or_file == kWaypointSet)
    throw InputError(std::string(kWaypointSet) +
                     " holds flights, not frames: airsim360 plan --dataset waypoint --out DIR makes it, with "
                     "--shard I/N a part of it; frames along its flights: airsim360 dataset plan omni360-waypoint-frames");
  const std::vector<std::string> names = RecipeNames();
  if (std::ranges::count(names, name_or_file) > 0) {
    Recipe recipe = internal::BuiltInRecipe(name_or_file);
    CheckRecipe(recipe, name_or_file);
    return recipe;
  }
  const std::filesystem::path file = name_or_file;
  if (!file.has_extension() && !file.has_parent_path()) throw InputError(UnknownChoiceMessage("recipe", name_or_file, names));
  Recipe recipe;
  ReadYamlFile(file, [&](ConfigVisitor& v) { VisitRecipe(v, recipe); });
  if (recipe.skies.empty()) recipe.skies = internal::BuiltInSkies();
  for (RecipeRow& row : recipe.rows) {
    if (row.name.empty()) row.name = std::filesystem::path(row.world).stem().string();
    // Worlds that are files lie beside the recipe.
    const std::filesystem::path world = row.world;
    if (world.is_relative() && (world.has_extension() || world.has_parent_path()))
      row.world = (std::filesystem::absolute(file).parent_path() / world).lexically_normal().string();
  }
  CheckRecipe(recipe, file.string());
  return recipe;
}

std::vector<std::string> RecipeNames() { return internal::BuiltInRecipeNames(); }

Recipe WithWorlds(Recipe recipe, const std::vector<std::string>& worlds) {
  std::vector<std::string> names;
  for (const RecipeRow& row : recipe.rows) {
    if (std::ranges::count(names, row.world) == 0) names.push_back(row.world);
  }
  for (const std::string& world : worlds) ParseChoice("world of the recipe", world, names, "--world");
  std::erase_if(recipe.rows, [&](const RecipeRow& row) { return std::ranges::count(worlds, row.world) == 0; });
  return recipe;
}

Recipe Scaled(Recipe recipe, int64_t frames) {
  const auto rows = static_cast<int64_t>(recipe.rows.size());
  if (frames < rows || frames > kMostPlanFrames) {
    throw InputError("--frames: " + std::to_string(frames) + " is not in " + std::to_string(rows) + " (one a row) … " +
                     std::to_string(kMostPlanFrames));
  }
  // Every row keeps one frame; the rest is shared out in proportion.
  const int64_t all = recipe.frames();
  std::vector<std::pair<int64_t, size_t>> remainders;  // negative: the largest first
  int64_t given = 0;
  for (size_t i = 0; i < recipe.rows.size(); ++i) {
    const auto share = static_cast<__int128>(recipe.rows[i].frames) * (frames - rows);
    recipe.rows[i].frames = static_cast<uint64_t>(1 + share / all);
    given += static_cast<int64_t>(recipe.rows[i].frames);
    remainders.emplace_back(-static_cast<int64_t>(share % all), i);
  }
  std::ranges::sort(remainders);
  for (int64_t k = 0; given < frames; ++k, ++given) ++recipe.rows[remainders[static_cast<size_t>(k)].second].frames;
  return recipe;
}

}  // namespace airsim360
