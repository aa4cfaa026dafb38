#include "airsim360/dataset/plan/built_in_recipes.h"

#include <utility>

#include "airsim360/dataset/waypoint_set.h"

namespace airsim360::internal {
namespace {

RecipeRow Row(const std::string& world, uint64_t frames) {
  RecipeRow row;
  row.name = row.world = world;
  row.frames = frames;
  return row;
}

Recipe Base(const std::string& name, const std::string& about, const std::string& size = "2048x1024") {
  Recipe recipe;
  recipe.name = name;
  recipe.about = about;
  recipe.picture.size = size;
  recipe.picture.settings.auto_exposure = true;
  recipe.skies = BuiltInSkies();
  return recipe;
}

// Table of the paper: 61,000 frames.
Recipe Scene() {
  Recipe recipe = Base("omni360-scene", "The paper's Omni360-Scene: depth, semantics and entities of four scenes");
  recipe.rows = {Row("city_park", 25'600), Row("downtown_west", 6'800), Row("sf_city", 22'000), Row("new_york_city", 6'600)};
  return recipe;
}

// The numbers of frames of the published files, of three scenes.
Recipe SceneReleased() {
  Recipe recipe = Base("omni360-scene-released", "As many frames as the published files of Omni360-Scene hold");
  recipe.rows = {Row("city_park", 80'000), Row("sf_city", 24'812), Row("new_york_city", 20'716)};
  return recipe;
}

Recipe Human() {
  Recipe recipe = Base("omni360-human", "The paper's Omni360-Human: 61 areas full of people in six scenes");
  const HumanRecipe human = PaperHumanRecipe();
  for (const HumanSubset& subset : SubsetsOf(human)) {
    RecipeRow row = Row(subset.world, static_cast<uint64_t>(subset.frames));
    row.name = subset.name;
    row.sampler = "people";
    row.skies = "fair";
    row.people = subset.people;
    row.width = subset.width;
    row.depth = subset.depth;
    row.pitch_deg = subset.pitch_deg;
    row.interval = human.interval;
    row.view_frames = human.frames_a_view;
    row.lowest = human.lowest;
    row.highest = human.highest;
    recipe.rows.push_back(row);
  }
  return recipe;
}

Recipe WaypointFrames() {
  constexpr uint64_t kFramesOfFlight = 20;
  Recipe recipe = Base("omni360-waypoint-frames", "Frames with their velocities along the flights of Omni360-WayPoint", "1024x512");
  for (const WaypointWorld& world : WaypointWorlds()) {
    RecipeRow row = Row(world.name, static_cast<uint64_t>(world.routes) * kFramesOfFlight);
    row.sampler = "flights";
    row.flight_frames = kFramesOfFlight;
    row.least_length = world.min_length;
    row.most_length = world.max_length;
    recipe.rows.push_back(row);
  }
  return recipe;
}

Recipe Million() {
  Recipe recipe = Base("omni360-1m", "A million frames over all worlds and skies, near the ground and high, along flights too");
  for (const char* world : {"city_park", "downtown_west", "new_york_city", "sf_city"}) {
    RecipeRow views = Row(world, 190'000), flights = Row(world, 60'000);
    flights.name += "_flights";
    flights.sampler = "flights";
    if (world != std::string("city_park")) flights.least_length = 20, flights.most_length = 50;
    recipe.rows.insert(recipe.rows.end(), {views, flights});
  }
  return recipe;
}

// 200 frames; few skies, as each takes longer than its frames.
Recipe Mini() {
  Recipe recipe = Base("omni360-mini", "200 frames over all worlds: the reference release", "1024x512");
  recipe.rows = {Row("city_park", 70), Row("downtown_west", 60), Row("new_york_city", 70)};
  for (SkyMixture& mixture : recipe.skies) mixture.frames = 24;
  return recipe;
}

// One choice: its numbers drawn over a preset.
SkyChoice Choice(double weight, const char* weather, std::vector<SettingRange> settings) {
  SkyChoice choice;
  choice.weight = weight;
  choice.weather = weather;
  choice.settings = std::move(settings);
  return choice;
}

struct BuiltIn {
  const char* name;
  Recipe (*make)();
};
constexpr BuiltIn kRecipes[] = {{"omni360-scene", Scene}, {"omni360-scene-released", SceneReleased},
                                {"omni360-human", Human}, {"omni360-waypoint-frames", WaypointFrames},
                                {"omni360-1m", Million},  {"omni360-mini", Mini}};

}  // namespace

std::vector<std::string> BuiltInRecipeNames() {
  std::vector<std::string> names;
  for (const BuiltIn& recipe : kRecipes) names.emplace_back(recipe.name);
  return names;
}

Recipe BuiltInRecipe(const std::string& name) {
  for (const BuiltIn& recipe : kRecipes) {
    if (name == recipe.name) return recipe.make();
  }
  return {};
}

std::vector<SkyMixture> BuiltInSkies() {
  const SettingRange azimuth{"sun_azimuth_deg", 0, 359}, south{"sun_azimuth_deg", 80, 280}, air{"turbidity", 2, 5};
  SkyChoice climate;
  climate.climate = true;
  climate.weight = 12;
  const SkyChoice dusk = Choice(0.7, "dusk", {{"sun_elevation_deg", -6, 2}, azimuth});
  const SkyChoice night = Choice(0.5, "night", {{"moon_azimuth_deg", 0, 359}, {"moon_elevation_deg", 15, 70}, {"moon_phase", 0.2, 1}});
  const SkyChoice fair = Choice(4, "day", {{"sun_elevation_deg", 18, 68}, south, {"cloud_cover", 0, 0.5}, {"cirrus_cover", 0, 0.7}, air});
  const SkyChoice broken = Choice(2, "day", {{"sun_elevation_deg", 20, 60}, south, {"cloud_cover", 0.5, 0.9}, air});
  const SkyChoice overcast = Choice(2, "overcast", {{"sun_elevation_deg", 15, 60}, azimuth});
  return {{"varied", 64, {climate, dusk, night}}, {"fair", 200, {fair, broken, overcast}}};
}

}  // namespace airsim360::internal
