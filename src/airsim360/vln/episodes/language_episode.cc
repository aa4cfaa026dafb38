#include "airsim360/vln/episodes/language_episode.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>

#include "airsim360/base/error.h"
#include "airsim360/base/file.h"
#include "airsim360/math/angles.h"
#include "airsim360/planning/routes/search.h"
#include "airsim360/tasks/agent_server/episode.h"
#include "airsim360/vln/predicates/query_json.h"

namespace airsim360 {
namespace {

using internal::Rounded;
using internal::ToJson;
using internal::VlnFields;
using internal::VlnJson;

constexpr size_t kMostEpisodes = 1'000'000, kMostPoints = 4096;

VlnJson ViewJson(const Viewpoint& view) { return {{"p", ToJson(view.p_W)}, {"yaw_deg", Rounded(view.yaw / kDegree)}}; }

Viewpoint ViewOf(const VlnJson& value, const std::string& where) {
  VlnFields fields(value, where);
  const Viewpoint view{fields.Point("p"), fields.Number("yaw_deg", 0, -360, 360) * kDegree};
  fields.Finish();
  return view;
}

std::vector<EntityId> EntitiesOf(const VlnJson& list, const std::string& where) {
  if (!list.is_array() || list.size() > 100'000) throw InputError(where + ": is not a list of entity ids");
  std::vector<EntityId> entities;
  for (const VlnJson& id : list) {
    if (!id.is_number_unsigned() || id.get<uint64_t>() == 0 || id.get<uint64_t>() > UINT32_MAX)
      throw InputError(where + ": " + id.dump().substr(0, 40) + " is no entity id");
    entities.push_back(id.get<EntityId>());
  }
  return entities;
}

uint64_t SeedOf(VlnFields& fields, const char* name) {
  const VlnJson* found = fields.Find(name);
  if (found == nullptr) return 0;
  if (!found->is_number_unsigned()) throw InputError(fields.where() + "." + name + ": " + found->dump().substr(0, 40) + " is no seed");
  return found->get<uint64_t>();
}

WorldThings ThingsFrom(const VlnJson& value, const std::string& where) {
  VlnFields fields(value, where);
  const WorldThings things{static_cast<size_t>(fields.Number("count", 0, 1, UINT32_MAX)), fields.Text("sha256", "")};
  const auto is_hex = [](char c) { return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f'); };
  if (things.sha256.size() != 64 || !std::ranges::all_of(things.sha256, is_hex))
    throw InputError(where + ".sha256: is not 64 lower-case hexadecimal digits");
  fields.Finish();
  return things;
}

GoalKind RegionOf(VlnFields& fields) {
  const std::string region = fields.Text("region", "near");
  const std::vector<std::string> names(std::begin(kGoalKindNames), std::end(kGoalKindNames));
  const auto found = std::ranges::find(names, region);
  if (found == names.end()) throw InputError(fields.where() + ".region: " + UnknownChoiceMessage("region", region, names));
  return static_cast<GoalKind>(found - names.begin());
}

VlnJson PartsJson(const std::vector<EpisodePart>& parts) {
  VlnJson list = VlnJson::array();
  for (const EpisodePart& part : parts)
    list.push_back({{"seen_from", ViewJson(part.seen_from)},
                    {"goal",
                     {{"entities", part.entities},
                      {"name", part.name},
                      {"region", kGoalKindNames[static_cast<int>(part.goal_kind)]},
                      {"position", ToJson(part.goal)}}},
                    {"query", ToJson(part.query)},
                    {"proof", part.proof.empty() ? VlnJson(nullptr) : VlnJson::parse(part.proof)}});
  return list;
}

void ReadParts(LanguageEpisode& episode, const VlnJson& list, const std::string& where) {
  if (!list.is_array() || list.size() > kMostParts)
    throw InputError(where + ": is not a list of at most " + std::to_string(kMostParts) + " parts");
  for (size_t i = 0; i < list.size(); ++i) {
    VlnFields fields(list[i], where + "[" + std::to_string(i) + "]");
    EpisodePart part{.seen_from = ViewOf(fields.At("seen_from"), fields.where() + ".seen_from")};
    VlnFields goal(fields.At("goal"), fields.where() + ".goal");
    part.entities = EntitiesOf(goal.At("entities"), goal.where() + ".entities");
    part.name = goal.Text("name", "");
    part.goal_kind = RegionOf(goal);
    part.goal = goal.Point("position");
    goal.Finish();
    if (part.entities.empty()) throw InputError(goal.where() + ".entities: is empty");
    part.query = internal::QueryOf(fields.At("query"), fields.where() + ".query");
    if (const VlnJson* proof = fields.Find("proof")) part.proof = proof->dump();
    fields.Finish();
    episode.before.push_back(std::move(part));
  }
}

void ReadGoal(LanguageEpisode& episode, const VlnJson& value, const std::string& where) {
  VlnFields fields(value, where);
  episode.entities = EntitiesOf(fields.At("entities"), where + ".entities");
  episode.name = fields.Text("name", "");
  episode.goal_kind = RegionOf(fields);
  episode.goal = fields.Point("position");
  if (fields.Find("places") != nullptr) episode.places = fields.Points("places", kMostPoints);
  episode.radius = fields.Number("radius", 10, 0.1, 1000);
  fields.Finish();
}

void ReadSeen(SeenAtStart& seen, const VlnJson& value, const std::string& where) {
  VlnFields fields(value, where);
  seen.pixels = static_cast<int64_t>(fields.Number("pixels", 0, 0, 1e9));
  seen.azimuth_deg = fields.Number("azimuth_deg", 0, -360, 360);
  seen.elevation_deg = fields.Number("elevation_deg", 0, -90, 90);
  seen.range = fields.Number("range", 0, 0, 1e6);
  fields.Finish();
}

}  // namespace

bool IsBound(const LanguageEpisode& e) { return Names(e.query.noun); }

std::string EpisodeLine(const LanguageEpisode& e) {
  VlnJson ref = VlnJson::array();
  for (const Vec3d& p : e.ref) ref.push_back(ToJson(p));
  VlnJson json = {
      {"id", e.id},
      {"template", e.template_id},
      {"instruction", e.instruction},
      {"language", "en"},
      {"world", e.world},
      {"world_seed", e.world_seed},
      {"world_things", e.things.count == 0 ? VlnJson(nullptr) : VlnJson{{"count", e.things.count}, {"sha256", e.things.sha256}}},
      {"seed", e.seed},
      {"weather", e.weather},
      {"people", e.people},
      {"start", ViewJson(e.start)},
      {"before", PartsJson(e.before)},
      {"turn", e.turn ? ViewJson(*e.turn) : VlnJson(nullptr)},
      {"goal",
       {{"entities", e.entities},
        {"name", e.name},
        {"region", kGoalKindNames[static_cast<int>(e.goal_kind)]},
        {"position", ToJson(e.goal)},
        {"radius", e.radius}}},
      {"visible_at_start",
       {{"pixels", e.seen.pixels},
        {"azimuth_deg", Rounded(e.seen.azimuth_deg)},
        {"elevation_deg", Rounded(e.seen.elevation_deg)},
        {"range", Rounded(e.seen.range)}}},
      {"straight_length", Rounded(Norm(e.goal - e.start.p_W))},
      {"geodesic_length", Rounded(e.geodesic_length)},
      {"ref", ref},
      {"difficulty", e.difficulty},
      {"split", e.split},
      {"query", IsBound(e) ? ToJson(e.query) : VlnJson(nullptr)},
      {"proof", e.proof.empty() ? VlnJson(nullptr) : VlnJson::parse(e.proof)}};
  for (const Vec3d& p : e.places) json["goal"]["places"].push_back(ToJson(p));
  if (!e.source.empty()) json["source"] = VlnJson::parse(e.source);
  return json.dump(-1, ' ', false, VlnJson::error_handler_t::replace);
}

LanguageEpisode ParseEpisodeLine(const std::string& line, const std::string& where) {
  const VlnJson json = internal::ParseVlnJson(line, where);
  VlnFields fields(json, where);
  LanguageEpisode e;
  e.id = fields.Text("id", "");
  e.template_id = fields.Text("template", "");
  e.instruction = fields.Text("instruction", "");
  e.world = fields.Text("world", "");
  if (e.id.empty() || e.world.empty() || e.instruction.empty()) throw InputError(where + ": needs 'id', 'instruction' and 'world'");
  fields.Text("language", "en");
  e.world_seed = SeedOf(fields, "world_seed");
  e.seed = SeedOf(fields, "seed");
  if (const VlnJson* things = fields.Find("world_things")) e.things = ThingsFrom(*things, where + ".world_things");
  e.weather = fields.Text("weather", "");
  e.people = static_cast<int64_t>(fields.Number("people", 0, 0, 100'000));
  e.start = ViewOf(fields.At("start"), where + ".start");
  if (const VlnJson* before = fields.Find("before")) ReadParts(e, *before, where + ".before");
  if (const VlnJson* turn = fields.Find("turn")) e.turn = ViewOf(*turn, where + ".turn");
  ReadGoal(e, fields.At("goal"), where + ".goal");
  if (const VlnJson* seen = fields.Find("visible_at_start")) ReadSeen(e.seen, *seen, where + ".visible_at_start");
  e.ref = fields.Points("ref", kMostPoints);
  if (e.ref.size() < 2) throw InputError(where + ".ref: has fewer than 2 points");
  fields.Number("straight_length", 0, 0, 1e7);
  e.geodesic_length = fields.Number("geodesic_length", PolylineLength(e.ref), 0, 1e7);
  e.difficulty = fields.Text("difficulty", "");
  e.split = fields.Text("split", "");
  if (const VlnJson* query = fields.Find("query")) e.query = internal::QueryOf(*query, where + ".query");
  if (const VlnJson* source = fields.Find("source")) e.source = source->dump();
  if (IsBound(e) && e.entities.empty()) throw InputError(where + ".goal.entities: is empty, but there is a query");
  if (const VlnJson* proof = fields.Find("proof")) e.proof = proof->dump();
  fields.Finish();
  return e;
}

EpisodeSpec SpecOf(const LanguageEpisode& episode) {
  EpisodeSpec spec;
  spec.instruction = episode.instruction;
  spec.goal = episode.goal;
  spec.more_goals = episode.places;
  spec.start = episode.start.p_W;
  spec.start_yaw = episode.start.yaw;
  spec.reference_path = episode.ref;
  spec.seed = episode.seed;
  spec.success_radius = episode.radius;
  return spec;
}

std::vector<LanguageEpisode> ReadEpisodes(const std::filesystem::path& file) {
  std::istringstream lines(ReadTextFile(file, uint64_t{8} << 30));
  std::vector<LanguageEpisode> episodes;
  std::set<std::string> ids;
  std::string line;
  for (size_t number = 1; std::getline(lines, line); ++number) {
    if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
    const std::string where = file.string() + ":" + std::to_string(number);
    episodes.push_back(ParseEpisodeLine(line, where));
    if (!ids.insert(episodes.back().id).second) throw InputError(where + ".id: '" + episodes.back().id + "' is there twice");
    if (episodes.size() > kMostEpisodes) throw InputError(where + ": more than " + std::to_string(kMostEpisodes) + " episodes");
  }
  if (episodes.empty()) throw InputError(file.string() + ": holds no episode");
  return episodes;
}

}  // namespace airsim360
