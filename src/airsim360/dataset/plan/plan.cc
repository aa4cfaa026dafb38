#include "airsim360/dataset/plan/plan.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "airsim360/base/choice.h"
#include "airsim360/base/error.h"
#include "airsim360/base/file.h"
#include "airsim360/base/hash.h"
#include "airsim360/base/random.h"
#include "airsim360/dataset/plan/sky_draw.h"
#include "airsim360/dataset/record/config_json.h"

namespace airsim360 {
namespace {

using Json = nlohmann::ordered_json;

Json ContentJson(const DatasetPlan& plan) {
  Recipe recipe = plan.recipe;
  Json written = Json::object();
  AddConfig([&](ConfigVisitor& v) { VisitRecipe(v, recipe); }, written);
  Json worlds = Json::object(), facts = Json::object(), aims = Json::object();
  for (const auto& [key, world] : plan.worlds) {
    worlds[key] = world.exists() ? Json(world.hash) : Json(nullptr);
    if (!world.exists()) continue;
    facts[key] = {{"entities", world.entities},
                  {"triangles", world.triangles},
                  {"categories", world.categories},
                  {"attributions", world.attributions}};
  }
  for (const auto& [row, list] : plan.aims) {
    for (const Aim& aim : list) aims[row][aim.category] = aim.share;
  }
  return {{"format", kPlanFormat}, {"seed", plan.seed}, {"frames", plan.frames()}, {"worlds", worlds},
          {"facts", facts},        {"aims", aims},      {"recipe", written}};
}

std::string HashOf(const Json& content) { return Sha256Hex(AsBytes(content.dump(-1, ' ', false, Json::error_handler_t::replace))); }

// The parts beside the recipe. Their types are right, as the hash is; anything else throws.
void ReadFacts(const Json& json, DatasetPlan& plan) {
  plan.seed = json.at("seed").get<uint64_t>();
  for (const auto& [key, hash] : json.at("worlds").items()) {
    WorldFacts& world = plan.worlds[key];
    if (hash.is_null()) continue;
    world.hash = hash.get<std::string>();
    const Json& facts = json.at("facts").at(key);
    world.entities = facts.at("entities").get<int64_t>();
    world.triangles = facts.at("triangles").get<int64_t>();
    world.categories = facts.at("categories").get<std::vector<std::string>>();
    world.attributions = facts.at("attributions").get<std::vector<std::string>>();
  }
  for (const auto& [row, list] : json.at("aims").items()) {
    for (const auto& [category, share] : list.items()) plan.aims[row].push_back({category, share.get<double>()});
  }
}

// Frames that share a sky: whole flights, whole views.
int64_t FramesOfBlock(const DatasetPlan& plan, const RecipeRow& row) {
  const auto mixture = std::ranges::find(plan.recipe.skies, row.skies, &SkyMixture::name);
  const auto frames = static_cast<int64_t>(mixture->frames);
  const auto sampler = ParseChoice<Sampler>("sampler", row.sampler, kSamplerNames);
  const auto unit = static_cast<int64_t>(sampler == Sampler::kFlights  ? row.flight_frames
                                         : sampler == Sampler::kPeople ? row.view_frames
                                                                       : 1);
  return std::max<int64_t>(1, frames / unit) * unit;
}

}  // namespace

std::string WorldKey(const RecipeRow& row) {
  return row.world_seed == 0 ? row.world : row.world + "?seed=" + std::to_string(row.world_seed);
}

const WorldFacts& DatasetPlan::facts(const RecipeRow& row) const {
  const auto found = worlds.find(WorldKey(row));
  if (found == worlds.end()) throw InputError("plan: nothing is known of world '" + WorldKey(row) + "'");
  return found->second;
}

std::string PlanJson(const DatasetPlan& plan) {
  Json json = {{"hash", plan.hash}};
  json.update(ContentJson(plan));
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

void SealPlan(DatasetPlan& plan) { plan.hash = HashOf(ContentJson(plan)); }

bool IsPlanFile(const std::filesystem::path& file) {
  if (file.extension() != ".json" || !std::filesystem::is_regular_file(file)) return false;
  const Json json = Json::parse(ReadTextFile(file), nullptr, false);
  return json.is_object() && json.contains("format") && json.contains("recipe");
}

DatasetPlan ReadPlan(const std::filesystem::path& file) { return ParsePlan(ReadTextFile(file, uint64_t{64} << 20), file.string()); }

DatasetPlan ParsePlan(std::string_view text, const std::string& name) {
  const Json json = Json::parse(text, nullptr, false);
  if (!json.is_object() || !json.contains("format") || !json["format"].is_string() || !json.contains("recipe"))
    throw InputError(name + ": not a plan; make one with airsim360 dataset plan RECIPE --out plan.json");
  if (json["format"] != kPlanFormat)
    throw InputError(name + ": format '" + json["format"].get<std::string>() + "' is not " + kPlanFormat +
                     ", which this program reads; plan again");
  DatasetPlan plan;
  try {
    ReadYaml(json["recipe"].dump(), name, [&](ConfigVisitor& v) { VisitRecipe(v, plan.recipe); });
    CheckRecipe(plan.recipe, name);
    ReadFacts(json, plan);
  } catch (const Json::exception& error) {
    throw InputError(name + ": not a whole plan: " + error.what());
  }
  SealPlan(plan);
  const std::string told = json.value("hash", Json("")).dump();
  if (told != '"' + plan.hash + '"' || PlanJson(plan) != json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n")
    throw InputError(name + ": it was edited: its hash is " + told + ", that of its content \"" + plan.hash +
                     "\"; change the recipe and plan again");
  for (const RecipeRow& row : plan.recipe.rows) plan.facts(row);
  return plan;
}

int64_t FirstFrame(const DatasetPlan& plan, size_t row) {
  int64_t first = 0;
  for (size_t r = 0; r < row; ++r) first += static_cast<int64_t>(plan.recipe.rows[r].frames);
  return first;
}

FramePlace PlaceOf(const DatasetPlan& plan, int64_t frame) {
  int64_t left = frame;
  for (size_t row = 0; row < plan.recipe.rows.size() && left >= 0; ++row) {
    const auto frames = static_cast<int64_t>(plan.recipe.rows[row].frames);
    if (left < frames) return {row, left};
    left -= frames;
  }
  throw InputError("frame " + std::to_string(frame) + " is not in 0 … " + std::to_string(plan.frames() - 1) + " of the plan");
}

FrameBlock BlockOf(const DatasetPlan& plan, int64_t frame) {
  const FramePlace place = PlaceOf(plan, frame);
  const RecipeRow& row = plan.recipe.rows[place.row];
  const int64_t size = FramesOfBlock(plan, row), number = place.in_row / size;
  const int64_t in_row = number * size;
  return {.row = place.row,
          .number = number,
          .first = frame - place.in_row + in_row,
          .count = std::min(size, static_cast<int64_t>(row.frames) - in_row),
          .seed = RngStream(plan.seed, "plan block " + row.name, static_cast<uint64_t>(number)).Bits()};
}

PlannedSky SkyOf(const DatasetPlan& plan, const FrameBlock& block, const Environment& world) {
  const RecipeRow& row = plan.recipe.rows[block.row];
  const auto mixture = std::ranges::find(plan.recipe.skies, row.skies, &SkyMixture::name);
  return internal::DrawSky(*mixture, RngStream(plan.seed, "plan sky " + row.name, static_cast<uint64_t>(block.number)), world);
}

std::vector<std::pair<int64_t, int64_t>> RunsThatExist(const DatasetPlan& plan) {
  std::vector<std::pair<int64_t, int64_t>> runs;
  int64_t first = 0;
  for (const RecipeRow& row : plan.recipe.rows) {
    const int64_t last = first + static_cast<int64_t>(row.frames);
    if (plan.facts(row).exists()) {
      if (!runs.empty() && runs.back().second == first) {
        runs.back().second = last;
      } else {
        runs.emplace_back(first, last);
      }
    }
    first = last;
  }
  return runs;
}

std::vector<int64_t> FramesOfShard(const DatasetPlan& plan, int64_t index, int64_t count) {
  const auto runs = RunsThatExist(plan);
  int64_t all = 0;
  for (const auto& [first, last] : runs) all += last - first;
  const auto border = [&](int64_t k) { return static_cast<int64_t>(static_cast<__int128>(all) * k / count); };
  int64_t begin = border(index), end = border(index + 1);
  std::vector<int64_t> frames;
  frames.reserve(static_cast<size_t>(end - begin));
  for (const auto& [first, last] : runs) {
    const int64_t length = last - first;
    for (int64_t k = std::max<int64_t>(begin, 0); k < std::min(end, length); ++k) frames.push_back(first + k);
    begin -= length;
    end -= length;
  }
  return frames;
}

EntityBase EntityBaseOf(const DatasetPlan& plan, size_t row) {
  // The worlds one after the other, in the order of their rows, then the people of each row.
  EntityBase base;
  int64_t worlds = 0, people = 0;
  std::vector<std::string> seen;
  for (size_t r = 0; r < plan.recipe.rows.size(); ++r) {
    const std::string key = WorldKey(plan.recipe.rows[r]);
    if (r < row) people += kEntitiesOfPerson * static_cast<int64_t>(plan.recipe.rows[r].people);
    if (key == WorldKey(plan.recipe.rows[row]) && std::ranges::count(seen, key) == 0) base.world = worlds;
    if (std::ranges::count(seen, key) > 0) continue;
    seen.push_back(key);
    worlds += plan.facts(plan.recipe.rows[r]).entities;
  }
  base.people = worlds + people;
  return base;
}

int64_t EntityCount(const DatasetPlan& plan) {
  int64_t count = 0;
  for (const auto& [key, world] : plan.worlds) count += world.entities;
  for (const RecipeRow& row : plan.recipe.rows) count += kEntitiesOfPerson * static_cast<int64_t>(row.people);
  return count;
}

}  // namespace airsim360
