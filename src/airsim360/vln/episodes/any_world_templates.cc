#include "airsim360/vln/episodes/any_world_templates.h"

#include <algorithm>
#include <map>
#include <set>

#include "airsim360/base/error.h"

namespace airsim360 {
namespace {

constexpr float kSmallest = 0.4f, kLargest = 40;  // metres: what an instruction may name
constexpr size_t kMostNouns = 24;

// "furniture/seating/bench/wood" is a wood bench to people.
std::string WordOf(const std::string& path) {
  static const std::map<std::string, std::string> kWords = {
      {"wood", "wooden bench"}, {"generic", "broadleaf tree"}, {"narrowleaf", "narrow-leaved tree"}, {"pine", "pine tree"},
      {"usa", "American flag"}, {"maple", "maple tree"},       {"amur_cork", "cork tree"},           {"modular", "pavement"},
      {"barrier", "barrier"},   {"car_pillar", "bollard"},     {"road_column", "bollard"},           {"type_a", "lamp post"},
      {"type_b", "lamp post"},  {"pot", "plant pot"},          {"green_pot", "green plant pot"}};
  std::string word = path.substr(path.rfind('/') + 1);
  if (const auto found = kWords.find(word); found != kWords.end()) return found->second;
  std::ranges::replace(word, '_', ' ');
  return word;
}

bool IsNameable(const std::string& path) {
  for (const char* no :
       {"ground", "sky", "nature", "human", "uav", "animal", "construction/building", "construction/wall", "construction/ceiling",
        "vegetation/grass_tuft", "vegetation/plant", "vegetation/climber", "furniture/misc", "object", "traffic/temporary/tube"})
    if (path.starts_with(no)) return false;
  return true;
}

Predicate Bearing(const char* sector, bool at_turn = false) {
  return {.kind = PredicateKind::kBearing, .sector = sector, .at_turn = at_turn};
}
Predicate Nearest() { return {.kind = PredicateKind::kNearest}; }

// Words of a sector, as the paper's instructions say it.
const char* Said(const std::string& sector) {
  static const std::map<std::string, const char*> kSaid = {{"ahead", "straight ahead"},
                                                           {"right", "on your right"},
                                                           {"behind", "behind you"},
                                                           {"left", "on your left"},
                                                           {"ahead_left", "ahead to your left"},
                                                           {"ahead_right", "ahead to your right"},
                                                           {"rear_right", "on your right rear"},
                                                           {"rear_left", "on your left rear"}};
  return kSaid.at(sector);
}

// Five lengths of the same task, from three words to two sentences.
std::vector<InstructionTemplate> OfNoun(const Noun& noun) {
  const std::string& word = noun.word;
  std::vector<InstructionTemplate> made;
  const auto add = [&](const std::string& kind, std::string text, Query query, const char* heading) -> InstructionTemplate& {
    std::string id = "any/" + word + "/" + kind;
    std::ranges::replace(id, ' ', '_');
    made.push_back({.id = std::move(id), .text = std::move(text), .query = std::move(query), .heading = heading});
    return made.back();
  };
  add("1", "Nearest " + word + ".", {noun, {Nearest()}}, "any");
  add("2", "Fly to the nearest " + word + " and stop.", {noun, {Nearest()}}, "any");
  int turn = 0;
  for (const Sector& sector : kSectors) {
    add("3/" + std::string(sector.name), "Fly to the nearest " + word + " " + Said(sector.name) + " and stop when you are close to it.",
        {noun, {Bearing(sector.name), Nearest()}}, sector.name);
    // The longest words for every second direction: as many as all other lengths together would be too alike.
    if (++turn % 2 == 0)
      add("5/" + std::string(sector.name),
          "Look around you first. There may be more than one " + word + ", but only those " + Said(sector.name) +
              " count. Choose the one of them that is nearest to where you are now, fly to it without touching anything, and stop beside it.",
          {noun, {Bearing(sector.name), Nearest()}}, sector.name);
  }
  add("4", "Turn until you find the " + word + " that is nearest to you, fly to it, keep a few metres away, and stop there.",
      {noun, {Nearest()}}, "any");
  InstructionTemplate& second =
      add("3/second", "Fly straight ahead and stop when you reach the second " + word + ".",
          {noun, {{.kind = PredicateKind::kAlong, .width = 10}, {.kind = PredicateKind::kOrdinal, .k = 2}}}, "ahead");
  second.farthest = 90;
  return made;
}

// Two things one after the other, the second seen in the direction of the flight to the first.
InstructionTemplate OneThenTheOther(const Noun& first, const Noun& second, const char* sector) {
  std::string id = "any/" + first.word + "/then/" + second.word + "/" + sector;
  std::ranges::replace(id, ' ', '_');
  return {.id = std::move(id),
          .text = "Fly straight to the nearest " + first.word + ". Still facing the way you flew, go on to the nearest " + second.word +
                  " " + Said(sector) + " and stop beside it.",
          .query = {first, {Nearest()}},
          .then = {{.query = {second, {Bearing(sector), Nearest()}}}}};
}

// Rooms are small.
void FitRoom(InstructionTemplate& made) {
  made.nearest = 2;
  made.farthest = 15;
  made.lowest = 1;
  made.highest = 2;
  made.distance = 1;
  for (NextPart& part : made.then) part.distance = 1;
}

}  // namespace

std::vector<InstructionTemplate> AnyWorldTemplates(const Scene& scene, bool rooms) {
  std::map<std::string, std::set<std::string>> by_word;  // categories
  std::map<std::string, int> count;
  for (const Entity& entity : scene.entities) {
    const std::string& path = scene.tree[entity.category].path;
    const Vec3f size = entity.bounds.size();
    const float largest = std::max({size.x, size.y, size.z});
    if (entity.bounds.empty() || !IsNameable(path) || largest < kSmallest || largest > kLargest) continue;
    by_word[WordOf(path)].insert(path);
    ++count[WordOf(path)];
  }
  if (by_word.empty())
    throw InputError("world '" + scene.name + "' names nothing that an instruction could send a drone to: label it (docs/guide/labels.md)");
  // Rare things first: they are landmarks.
  std::vector<std::string> words;
  for (const auto& [word, categories] : by_word) words.push_back(word);
  std::ranges::stable_sort(words, {}, [&](const std::string& word) { return count[word]; });
  words.resize(std::min(words.size(), kMostNouns));
  std::vector<Noun> nouns;
  for (const std::string& word : words) nouns.push_back({.word = word, .categories = {by_word[word].begin(), by_word[word].end()}});
  std::vector<InstructionTemplate> templates;
  for (const Noun& noun : nouns)
    for (InstructionTemplate& made : OfNoun(noun)) templates.push_back(std::move(made));
  // Each thing leads on to three others.
  for (size_t i = 0; i < nouns.size(); ++i)
    for (size_t k = 1; k <= std::min<size_t>(3, nouns.size() - 1); ++k)
      templates.push_back(OneThenTheOther(nouns[i], nouns[(i + k) % nouns.size()], kSectors[(i + 2 * k) % 4].name));
  if (rooms) std::ranges::for_each(templates, FitRoom);
  return templates;
}

}  // namespace airsim360
