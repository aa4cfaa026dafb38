#include "airsim360/eval/files/vln_file.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <unordered_map>

#include "airsim360/base/error.h"
#include "airsim360/base/text.h"
#include "airsim360/eval/files/json_cursor.h"

namespace airsim360 {
namespace {

using internal::JsonCursor;
using internal::JsonFile;

struct Entry {
  std::string id;
  JsonCursor value;
};

std::vector<Entry> Entries(const JsonCursor& top) {
  std::vector<Entry> entries;
  if (top.is_object() && !top.Has("episodes") && !top.Has("id") && !top.Has("episode_id")) {
    for (const std::string& id : top.Names()) entries.push_back({id, top[id.c_str()]});
    return entries;
  }
  const auto id_of = [](const JsonCursor& value) {
    return value[value.Has("episode_id") && !value.Has("id") ? "episode_id" : "id"].IdText();
  };
  if (top.is_object() && !top.Has("episodes")) return {{id_of(top), top}};
  const JsonCursor list = top.is_object() ? top["episodes"] : top;
  for (size_t i = 0; i < list.size(); ++i) entries.push_back({id_of(list[i]), list[i]});
  return entries;
}

const char* FirstField(const JsonCursor& value, std::initializer_list<const char*> names) {
  for (const char* name : names) {
    if (value.Has(name)) return name;
  }
  return nullptr;
}

// What one entry says of its episode's truth and of its flight.
struct Said {
  VlnEpisode episode;
  size_t dimensions = 0;  // of its points; 0: none so far
};

Vec3d Point(const JsonCursor& value, Said& said) {
  const std::vector<double> numbers = value.Numbers();
  if (numbers.size() < 2) value.Fail("a point is [x, y, z] or [x, y]");
  const size_t dimensions = std::min<size_t>(numbers.size(), 3);
  if (said.dimensions == 0) said.dimensions = dimensions;
  if (said.dimensions != dimensions) value.Fail("[x, y] and [x, y, z] in one episode: without a height distances are not comparable");
  return {numbers[0], numbers[1], dimensions > 2 ? numbers[2] : 0};
}

std::vector<Vec3d> Points(const JsonCursor& value, Said& said) {
  if (value.size() == 0) value.Fail("a path without points");
  std::vector<Vec3d> points;
  for (size_t i = 0; i < value.size(); ++i) points.push_back(Point(value[i], said));
  return points;
}

double Radius(const JsonCursor& value) {
  const double radius = value.Number();
  if (!(radius > 0)) value.Fail("a radius is above 0 m");
  return radius;
}

constexpr std::initializer_list<const char*> kReference = {"ref", "reference_path", "reference"}, kFlown = {"pred", "path", "flown"},
                                             kShortest = {"shortest", "geodesic_length", "geodesic_distance"};

void ReadTruth(const JsonCursor& value, Said& said) {
  VlnEpisode& episode = said.episode;
  if (const char* field = FirstField(value, kReference)) episode.reference = Points(value[field], said);
  if (value.Has("goal")) {
    const JsonCursor goal = value["goal"];
    episode.goal = Point(!goal.is_object() ? goal : goal[goal.Has("point") ? "point" : "position"], said);
    if (goal.is_object() && goal.Has("radius")) episode.radius = Radius(goal["radius"]);
    if (goal.Has("places") && goal["places"].size() > 0) episode.places = Points(goal["places"], said);
  }
  // As `vln run` writes it.
  if (value.Has("places") && value["places"].size() > 0) episode.places = Points(value["places"], said);
  if (value.Has("radius")) episode.radius = Radius(value["radius"]);
  if (const char* field = FirstField(value, kShortest)) {
    episode.shortest = value[field].Number();
    if (*episode.shortest < 0) value[field].Fail("a way is not shorter than 0 m");
  }
}

void ReadFlight(const JsonCursor& value, Said& said) {
  if (const char* field = FirstField(value, kFlown)) said.episode.flown = Points(value[field], said);
  if (const char* field = FirstField(value, {"stop", "stopped"})) said.episode.stopped = value[field].Flag();
  if (const char* field = FirstField(value, {"collision", "collided"})) said.episode.collided = value[field].Flag();
}

// Files round to millimetres, some twice.
constexpr double kRounding = 2e-3;

bool Same(const std::vector<Vec3d>& a, const std::vector<Vec3d>& b) {
  return std::ranges::equal(a, b, [](Vec3d p, Vec3d q) { return Norm(p - q) <= kRounding; });
}

// Results may repeat what the episode says, not change it.
void CheckClaims(const JsonCursor& value, const Said& truth, std::optional<double> radius) {
  const VlnEpisode& e = truth.episode;
  Said claim{{}, truth.dimensions};
  ReadTruth(value, claim);
  const std::string of_episode = " is not that of the episode: only the flown path, 'stop' and 'collision' are taken from results";
  if (!claim.episode.reference.empty() && !Same(claim.episode.reference, e.reference))
    value[FirstField(value, kReference)].Fail("this reference" + of_episode);
  if (claim.episode.goal) {
    const auto is_it = [&](Vec3d p) { return Norm(p - *claim.episode.goal) <= kRounding; };
    if (!is_it(e.goal.value_or(e.reference.back())) && std::ranges::none_of(e.places, is_it))
      value["goal"].Fail("this goal" + of_episode + " (its goal, or one of its other places)");
  }
  if (claim.episode.shortest && e.shortest && std::abs(*claim.episode.shortest - *e.shortest) > kRounding)
    value[FirstField(value, kShortest)].Fail("this shortest way" + of_episode);
  const double counts = e.radius.value_or(kUsualVlnRadius);
  if (!radius && claim.episode.radius && std::abs(*claim.episode.radius - counts) > 1e-9)
    value[value.Has("radius") ? "radius" : "goal"].Fail("the radius " + ShortestText(*claim.episode.radius) + " m is not the " +
                                                        ShortestText(counts) + " m " + (e.radius ? "of the episode" : "that count") +
                                                        ": --radius says which counts");
}

// How far a path leads away from its start.
double Extent(const std::vector<Vec3d>& path) {
  double extent = 0;
  for (const Vec3d& p : path) extent = std::max(extent, Norm(p - path.front()));
  return extent;
}

std::vector<NamedVlnEpisode> JoinEpisodes(const JsonFile& episodes, const JsonFile& results, bool one_file, std::optional<double> radius) {
  const std::vector<Entry> truths = Entries(episodes.top()), flights = one_file ? truths : Entries(results.top());
  if (truths.empty()) episodes.top().Fail("no episodes");
  const auto flies = [](const Entry& entry) { return FirstField(entry.value, kFlown) != nullptr; };
  if (!one_file && std::ranges::all_of(truths, flies) && std::ranges::none_of(flights, flies))
    results.top().Fail("no flown path ('pred'), while every episode has one: are the two files swapped? The episodes come first");
  std::vector<Said> said;
  std::unordered_map<std::string, size_t> index;
  for (const Entry& entry : truths) {
    if (!index.emplace(entry.id, said.size()).second) entry.value.Fail("the id '" + entry.id + "' occurs twice");
    ReadTruth(entry.value, said.emplace_back());
    if (said.back().episode.reference.empty()) entry.value.Fail("the episode '" + entry.id + "' has no reference path ('ref')");
  }
  std::set<size_t> flown;
  for (const Entry& entry : flights) {
    const auto found = index.find(entry.id);
    if (found == index.end()) entry.value.Fail("the episode '" + entry.id + "' is not among the episodes");
    if (!flown.insert(found->second).second) entry.value.Fail("the id '" + entry.id + "' occurs twice");
    Said& one = said[found->second];
    if (!one_file) CheckClaims(entry.value, one, radius);
    ReadFlight(entry.value, one);
  }
  std::vector<NamedVlnEpisode> list;
  size_t missing = 0, first = 0;
  for (size_t i = 0; i < said.size(); ++i) {
    VlnEpisode& e = said[i].episode;
    e.radius = radius.value_or(e.radius.value_or(kUsualVlnRadius));
    if (e.flown.empty() && missing++ == 0) first = i;
    list.push_back({truths[i].id, std::move(e)});
  }
  if (missing > 0)
    results.top().Fail("no flown path ('pred') for " + std::to_string(missing) + " of " + std::to_string(list.size()) + " episodes, '" +
                       list[first].id + "' first");
  return list;
}

}  // namespace

std::vector<NamedVlnEpisode> ReadVlnFiles(const std::filesystem::path& episodes, const std::filesystem::path& results,
                                          std::optional<double> radius) {
  std::error_code none;
  const bool one = episodes == results || std::filesystem::equivalent(episodes, results, none);
  const JsonFile file = JsonFile::Read(episodes);
  return one ? JoinEpisodes(file, file, true, radius) : JoinEpisodes(file, JsonFile::Read(results), false, radius);
}

std::vector<NamedVlnEpisode> ParseVlnFiles(std::string_view episodes, const std::string& name, std::string_view results,
                                           const std::string& results_name, bool lines) {
  return JoinEpisodes(JsonFile::Parse(episodes, name, lines), JsonFile::Parse(results, results_name, lines), name == results_name, {});
}

// A flight in another unit leads as many times farther, from as many times the start.
LikelyMistake VlnUnitMistake(const std::vector<NamedVlnEpisode>& episodes) {
  for (const double factor : {100.0, 1000.0}) {
    size_t near = 0, close = 0;
    for (const auto& [id, e] : episodes) {
      const double extent = Extent(e.reference), ratio = Extent(e.flown) / extent / factor,
                   start = Norm(e.flown.front() / factor - e.reference.front());
      near += ratio > 0.3 && ratio < 3 && start <= e.radius.value_or(kUsualVlnRadius);
      // As far as it should be, and arrived.
      close += ratio > 0.8 && ratio < 1.25 && start < 0.1 * extent && Norm(e.flown.back() / factor - e.reference.back()) < 0.25 * extent;
    }
    if (2 * near <= episodes.size()) continue;
    return {std::string("flown paths lead about ") +
                (factor == 100 ? "100 times as far as their references: are they in centi"
                               : "1000 times as far as their references: are they in milli") +
                "metres?",
            static_cast<double>(close) >= internal::kNearlyAll * static_cast<double>(episodes.size())};
  }
  return {};
}

}  // namespace airsim360
