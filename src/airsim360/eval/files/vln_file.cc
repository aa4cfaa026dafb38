#include "airsim360/eval/files/vln_file.h"

#include <optional>
#include <unordered_map>

#include "airsim360/base/error.h"
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
  if (top.is_object() && !top.Has("episodes")) return {{top[top.Has("id") ? "id" : "episode_id"].IdText(), top}};
  const JsonCursor list = top.is_object() ? top["episodes"] : top;
  for (size_t i = 0; i < list.size(); ++i) entries.push_back({list[i][list[i].Has("id") ? "id" : "episode_id"].IdText(), list[i]});
  return entries;
}

const char* FirstField(const JsonCursor& value, std::initializer_list<const char*> names) {
  for (const char* name : names) {
    if (value.Has(name)) return name;
  }
  return nullptr;
}

Vec3d Point(const JsonCursor& value) {
  const std::vector<double> numbers = value.Numbers();
  if (numbers.size() < 2) value.Fail("a point is [x, y, z] or [x, y]");
  return {numbers[0], numbers[1], numbers.size() > 2 ? numbers[2] : 0};
}

std::vector<Vec3d> Points(const JsonCursor& value) {
  if (value.size() == 0) value.Fail("a path without points");
  std::vector<Vec3d> points;
  for (size_t i = 0; i < value.size(); ++i) points.push_back(Point(value[i]));
  return points;
}

double Radius(const JsonCursor& value) {
  const double radius = value.Number();
  if (!(radius > 0)) value.Fail("a radius is above 0 m");
  return radius;
}

// Whatever one entry says of its episode; the later file wins.
void Absorb(const JsonCursor& value, VlnEpisode& episode) {
  if (const char* field = FirstField(value, {"ref", "reference_path", "reference"})) episode.reference = Points(value[field]);
  if (const char* field = FirstField(value, {"pred", "path", "flown"})) episode.flown = Points(value[field]);
  if (value.Has("goal")) {
    const JsonCursor goal = value["goal"];
    episode.goal = Point(!goal.is_object() ? goal : goal[goal.Has("point") ? "point" : "position"]);
    if (goal.is_object() && goal.Has("radius")) episode.radius = Radius(goal["radius"]);
  }
  if (value.Has("radius")) episode.radius = Radius(value["radius"]);
  if (const char* field = FirstField(value, {"shortest", "geodesic_length", "geodesic_distance"})) {
    episode.shortest = value[field].Number();
    if (*episode.shortest < 0) value[field].Fail("a way is not shorter than 0 m");
  }
  if (const char* field = FirstField(value, {"stop", "stopped"})) episode.stopped = value[field].Flag();
  if (const char* field = FirstField(value, {"collision", "collided"})) episode.collided = value[field].Flag();
}

std::vector<NamedVlnEpisode> JoinEpisodes(const JsonFile& episodes, const JsonFile& results) {
  std::vector<NamedVlnEpisode> list;
  std::unordered_map<std::string, size_t> index;
  for (const Entry& entry : Entries(episodes.top())) {
    if (!index.emplace(entry.id, list.size()).second) entry.value.Fail("the id '" + entry.id + "' occurs twice");
    list.push_back({entry.id, {}});
    Absorb(entry.value, list.back().episode);
  }
  for (const Entry& entry : Entries(results.top())) {
    const auto found = index.find(entry.id);
    if (found == index.end()) entry.value.Fail("the episode '" + entry.id + "' is not among the episodes");
    Absorb(entry.value, list[found->second].episode);
  }
  size_t missing = 0, first = 0;
  for (size_t i = list.size(); i-- > 0;) {
    if (list[i].episode.flown.empty()) ++missing, first = i;
  }
  if (list.empty()) episodes.top().Fail("no episodes");
  if (missing > 0)
    results.top().Fail("no flown path ('pred') for " + std::to_string(missing) + " of " + std::to_string(list.size()) + " episodes, '" +
                       list[first].id + "' first");
  for (const NamedVlnEpisode& one : list) {
    if (one.episode.reference.empty()) episodes.top().Fail("the episode '" + one.id + "' has no reference path ('ref')");
  }
  return list;
}

}  // namespace

std::vector<NamedVlnEpisode> ReadVlnFiles(const std::filesystem::path& episodes, const std::filesystem::path& results) {
  return JoinEpisodes(JsonFile::Read(episodes), JsonFile::Read(results));
}

std::vector<NamedVlnEpisode> ParseVlnFiles(std::string_view episodes, const std::string& name, std::string_view results,
                                           const std::string& results_name, bool lines) {
  return JoinEpisodes(JsonFile::Parse(episodes, name, lines), JsonFile::Parse(results, results_name, lines));
}

}  // namespace airsim360
