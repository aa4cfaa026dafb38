#include "airsim360/vln/episodes/any_world_templates.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <span>

#include "airsim360/base/error.h"
#include "airsim360/vln/episodes/language_episode.h"

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
      {"type_b", "lamp post"},  {"pot", "plant pot"},          {"green_pot", "green plant pot"},     {"machine", "vending machine"}};
  std::string word = path.substr(path.rfind('/') + 1);
  if (const auto found = kWords.find(word); found != kWords.end()) return found->second;
  std::ranges::replace(word, '_', ' ');
  return word;
}

bool IsNameable(const std::string& path) {
  // To people the walls of houses are walls too.
  if (path == "barrier/wall") return false;
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

// What an instruction speaks of. `floors`: some of these things stand over each other, so that only those on this floor are meant.
struct SpokenOf {
  Noun noun;
  bool floors = false;

  std::string text() const { return noun.word + (floors ? " on this floor" : ""); }
  Query Asked(std::vector<Predicate> predicates) const {
    if (floors) predicates.insert(predicates.begin(), Bearing("on_floor"));
    return {noun, std::move(predicates)};
  }
};

// Five lengths of the same task, from three words to two sentences. `keeping`: how far from it one stops.
std::vector<InstructionTemplate> OfNoun(const SpokenOf& named, const std::string& keeping) {
  const std::string word = named.text();
  std::vector<InstructionTemplate> made;
  const auto add = [&](const std::string& kind, std::string text, std::vector<Predicate> predicates,
                       const char* heading) -> InstructionTemplate& {
    std::string id = "any/" + named.noun.word + "/" + kind;
    std::ranges::replace(id, ' ', '_');
    made.push_back({.id = std::move(id), .text = std::move(text), .query = named.Asked(std::move(predicates)), .heading = heading});
    return made.back();
  };
  add("1", "Nearest " + word + ".", {Nearest()}, "any");
  add("2", "Fly to the nearest " + word + " and stop.", {Nearest()}, "any");
  int turn = 0;
  for (const Sector& sector : std::span(kSectors).first(kPlainSectors)) {
    add("3/" + std::string(sector.name), "Fly to the nearest " + word + " " + Said(sector.name) + " and stop when you are close to it.",
        {Bearing(sector.name), Nearest()}, sector.name);
    // The longest words for every second direction: as many as all other lengths together would be too alike.
    if (++turn % 2 == 0)
      add("5/" + std::string(sector.name),
          "Look around you first. There may be more than one " + word + ", but only those " + Said(sector.name) +
              " count. Choose the one of them that is nearest to where you are now, fly to it without touching anything, and stop beside it.",
          {Bearing(sector.name), Nearest()}, sector.name);
  }
  add("4", "Turn until you find the " + word + " that is nearest to you, fly to it, keep " + keeping + " away, and stop there.",
      {Nearest()}, "any");
  // Counted is what stands in the way, so to speak; what is farther aside than that one person counts and another does not.
  InstructionTemplate& second =
      add("3/second", "Fly straight ahead and stop when you reach the second " + word + ".",
          {{.kind = PredicateKind::kAlong, .width = 1.5, .clear = 6}, {.kind = PredicateKind::kOrdinal, .k = 2}}, "ahead");
  second.farthest = 90;
  second.in_sight = kInSight;
  return made;
}

// Two things one after the other, the second seen in the direction of the flight to the first.
InstructionTemplate OneThenTheOther(const SpokenOf& first, const SpokenOf& second, const char* sector) {
  std::string id = "any/" + first.noun.word + "/then/" + second.noun.word + "/" + sector;
  std::ranges::replace(id, ' ', '_');
  return {.id = std::move(id),
          .text = "Fly straight to the nearest " + first.text() + ". Still facing the way you flew, go on to the nearest " + second.text() +
                  " " + Said(sector) + " and stop beside it.",
          .query = first.Asked({Nearest()}),
          .then = {{.query = second.Asked({Bearing(sector), Nearest()})}}};
}

// The plan of what has a ceiling. Flights in rooms lead to nothing else: the trees before a house are outside.
std::vector<Box3f> CeilingsOf(const Scene& scene) {
  std::vector<Box3f> ceilings;
  for (const Entity& entity : scene.entities)
    if (scene.tree[entity.category].path.starts_with("construction/ceiling")) ceilings.push_back(entity.bounds);
  return ceilings;
}

bool IsBelowOne(const std::vector<Box3f>& ceilings, const Box3f& box) {
  const Vec3f c = (box.min + box.max) * 0.5f;
  return std::ranges::any_of(ceilings, [&](const Box3f& ceiling) {
    return ceiling.min.x <= c.x && c.x <= ceiling.max.x && ceiling.min.y <= c.y && c.y <= ceiling.max.y && c.z < ceiling.max.z;
  });
}

// Two of them have a storey between their feet and the same place seen from above.
bool StandOverEachOther(const std::vector<Box3f>& boxes) {
  constexpr float kStorey = 2;  // metres
  for (size_t i = 0; i < boxes.size(); ++i)
    for (size_t k = 0; k < i; ++k) {
      const Box3f &a = boxes[i], &b = boxes[k];
      const bool overlap = a.min.x < b.max.x && b.min.x < a.max.x && a.min.y < b.max.y && b.min.y < a.max.y;
      if (overlap && std::abs(a.min.z - b.min.z) > kStorey) return true;
    }
  return false;
}

// Rooms are small.
void FitRoom(InstructionTemplate& made) {
  made.nearest = 2;
  made.farthest = 15;
  made.lowest = 1;
  made.highest = 2;
  made.distance = 1;
  for (Predicate& predicate : made.query.predicates) {
    if (predicate.kind != PredicateKind::kAlong) continue;
    predicate.width = 1;
    predicate.clear = 2.5;
  }
  for (NextPart& part : made.then) part.distance = 1;
}

}  // namespace

std::vector<InstructionTemplate> AnyWorldTemplates(const Scene& scene, bool rooms) {
  std::map<std::string, std::set<std::string>> by_word;  // categories
  std::map<std::string, std::vector<Box3f>> boxes;
  const std::vector<Box3f> ceilings = rooms ? CeilingsOf(scene) : std::vector<Box3f>{};
  for (const Entity& entity : scene.entities) {
    const std::string& path = scene.tree[entity.category].path;
    const Vec3f size = entity.bounds.size();
    const float largest = std::max({size.x, size.y, size.z});
    if (entity.bounds.empty() || !IsNameable(path) || largest < kSmallest || largest > kLargest) continue;
    if (!ceilings.empty() && !IsBelowOne(ceilings, entity.bounds)) continue;
    by_word[WordOf(path)].insert(path);
    boxes[WordOf(path)].push_back(entity.bounds);
  }
  if (by_word.empty())
    throw InputError("world '" + scene.name + "' names nothing that an instruction could send a drone to: label it (docs/guide/labels.md)");
  // Rare things first: they are landmarks.
  std::vector<std::string> words;
  for (const auto& [word, categories] : by_word) words.push_back(word);
  std::ranges::stable_sort(words, {}, [&](const std::string& word) { return boxes[word].size(); });
  words.resize(std::min(words.size(), kMostNouns));
  std::vector<SpokenOf> nouns;
  for (const std::string& word : words)
    nouns.push_back({{.word = word, .categories = {by_word[word].begin(), by_word[word].end()}}, rooms && StandOverEachOther(boxes[word])});
  std::vector<InstructionTemplate> templates;
  for (const SpokenOf& named : nouns)
    for (InstructionTemplate& made : OfNoun(named, rooms ? "a metre" : "a few metres")) templates.push_back(std::move(made));
  // Each thing leads on to three others.
  for (size_t i = 0; i < nouns.size(); ++i)
    for (size_t k = 1; k <= std::min<size_t>(3, nouns.size() - 1); ++k)
      templates.push_back(OneThenTheOther(nouns[i], nouns[(i + k) % nouns.size()], kSectors[(i + 2 * k) % 4].name));
  if (rooms) std::ranges::for_each(templates, FitRoom);
  return templates;
}

}  // namespace airsim360
