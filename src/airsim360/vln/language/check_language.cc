#include "airsim360/vln/language/check_language.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>

#include "airsim360/base/error.h"
#include "airsim360/base/log.h"
#include "airsim360/math/angles.h"
#include "airsim360/vln/language/second_look.h"
#include "airsim360/vln/predicates/brute_force.h"

namespace airsim360 {
namespace {

using internal::Glimpse;
using internal::Glimpses;
using internal::LanguageItem;
using internal::SecondLook;
using internal::VlnJson;

constexpr int64_t kThere = 25;          // rays that show a thing
constexpr int64_t kPlain = 85;          // rays of a thing that an item may speak of, at least
constexpr double kOpen = 0.35;          // share of such a thing that has to be seen, at least
constexpr double kLargestThing = 30.5;  // metres: larger ones are several things
constexpr double kSame = 1.02;          // ranges nearer to each other than that are equal

std::string Quoted(const std::string& text) { return "'" + text + "'"; }

// What an item says that does not hold; thrown and caught here alone.
struct Wrong {
  std::string what;
};

class Auditor {
 public:
  explicit Auditor(std::shared_ptr<Stage> stage) : stage_(std::move(stage)), look_(stage_->tracer()) {}

  // "" where all holds.
  std::string Audit(const LanguageItem& item) {
    try {
      item_ = &item;
      CheckForm();
      if (item.kind == "caption") return Judge(Captions());
      if (item.kind == "refer") return Point();
      return Judge(Answers());
    } catch (const Wrong& wrong) {
      return wrong.what;
    } catch (const nlohmann::json::exception& e) {
      return std::string("its query cannot be read: ") + e.what();
    }
  }

 private:
  // ------------------------------------------------------------------------------------------------ form

  void CheckForm() const {
    const LanguageItem& item = *item_;
    std::set<std::string> choices;
    for (const VlnJson& choice : item.choices)
      if (!choices.insert(choice.dump()).second) throw Wrong{"the choice " + choice.dump() + " is there twice"};
    if (item.choices[item.answer_index] != item.answer)
      throw Wrong{"answer_index names " + item.choices[item.answer_index].dump() + ", not the answer"};
    for (const auto& [word, noun] : item.nouns.items()) {
      const std::string text = item.kind == "caption" ? item.answer.get<std::string>() : item.text + item.choices.dump();
      if (text.find(word) == std::string::npos && text.find(noun.at("plural").get<std::string>()) == std::string::npos)
        throw Wrong{"the noun " + Quoted(word) + " is not in its text"};
    }
  }

  // ------------------------------------------------------------------------------------------------ what is in sight

  const Glimpses& Picture(size_t k) { return look_.LookAt(item_->pictures.at(k)); }

  // Things in sight that a word names; those that only look like one in `alike`.
  std::vector<EntityId> InSight(const std::string& word, size_t picture, std::vector<EntityId>* alike = nullptr) {
    const VlnJson& row = item_->nouns.at(word);
    Noun noun{.word = word,
              .categories = row.at("categories").get<std::vector<std::string>>(),
              .names = row.at("names").get<std::vector<std::string>>(),
              .without = row.at("without").get<std::vector<std::string>>()};
    Noun looks{.categories = row.at("alike").get<std::vector<std::string>>()};
    if (noun.names.empty()) looks.categories.insert(looks.categories.end(), noun.categories.begin(), noun.categories.end());
    std::vector<EntityId> found;
    for (const auto& [entity, glimpse] : Picture(picture)) {
      if (glimpse.rays < kThere) continue;
      const Entity& of = look_.scene().entity(entity);
      const bool named = BruteForceNames(look_.scene(), of, noun) && look_.Extent(entity) <= kLargestThing;
      if (named)
        found.push_back(entity);
      else if (alike != nullptr && !looks.categories.empty() && BruteForceNames(look_.scene(), of, looks))
        alike->push_back(entity);
    }
    return found;
  }

  // As InSight, where nothing may look alike.
  std::vector<EntityId> SurelyInSight(const std::string& word, size_t picture) {
    std::vector<EntityId> alike;
    auto found = InSight(word, picture, &alike);
    if (!alike.empty()) throw Wrong{"not unique: " + NameOf(alike[0]) + " looks like a " + word + " too"};
    for (const EntityId entity : found) MustBePlain(entity, picture);
    return found;
  }

  std::string NameOf(EntityId entity) const {
    return Quoted(look_.scene().entity(entity).name) + " (entity " + std::to_string(entity) + ")";
  }

  // Whoever looks at the picture has to recognise what an item speaks of. "" where that is so.
  std::string Unclear(EntityId entity, size_t picture) {
    const Glimpse& g = Picture(picture).at(entity);
    if (g.rays < kPlain) return "unclear: " + NameOf(entity) + " has " + std::to_string(g.rays) + " rays, too few to recognise it";
    const double shown = look_.Shown(item_->pictures[picture], entity);
    return shown < kOpen ? "unclear: only " + std::to_string(std::lround(100 * shown)) + " % of " + NameOf(entity) + " is seen" : "";
  }
  void MustBePlain(EntityId entity, size_t picture) {
    if (std::string what = Unclear(entity, picture); !what.empty()) throw Wrong{std::move(what)};
  }

  // Degrees clockwise from the heading, and above the horizon.
  double Azimuth(const Glimpse& g, size_t picture) const {
    const double yaw = item_->pictures[picture].yaw_deg;
    return std::remainder(yaw - std::atan2(g.sum.y, g.sum.x) * 180 / kPi, 360);
  }
  static const char* Sector(double azimuth) {
    static const char* const kNames[] = {"front", "right", "behind", "left"};
    return kNames[static_cast<int>(std::floor((azimuth + 360 + 45) / 90)) % 4];
  }

  // All that are as near as the nearest, but for a hair.
  void KeepNearest(std::vector<EntityId>& things, size_t picture) {
    double least = 1e9;
    for (const EntityId e : things) least = std::min(least, Range(e, picture));
    std::erase_if(things, [&](EntityId e) { return Range(e, picture) > least * kSame; });
  }

  // The one thing that a name means.
  EntityId Named(const VlnJson& name, size_t picture = 0) {
    const auto word = name.at("word").get<std::string>(), where = name.at("where").get<std::string>();
    std::vector<EntityId> alike, found = InSight(word, picture, &alike);
    found.insert(found.end(), alike.begin(), alike.end());
    if (where == "nearest")
      KeepNearest(found, picture);
    else if (where != "only")
      std::erase_if(found, [&](EntityId e) { return Sector(Azimuth(Picture(picture).at(e), picture)) != where; });
    if (found.empty()) throw Wrong{"absent: no " + word + " (" + where + ") is in sight"};
    if (found.size() > 1)
      throw Wrong{"not unique: " + NameOf(found[0]) + " and " + NameOf(found[1]) + " compete for the " + word + " (" + where + ")"};
    if (std::ranges::find(item_->entities, found[0]) == item_->entities.end())
      throw Wrong{"the " + word + " is " + NameOf(found[0]) + ", of which it does not speak"};
    MustBePlain(found[0], picture);
    return found[0];
  }

  std::string TextOf(const VlnJson& name) const {
    const auto word = name.at("word").get<std::string>(), where = name.at("where").get<std::string>();
    if (where == "nearest") return "the nearest " + word;
    if (where == "any") return (std::string("aeio").find(word[0]) != std::string::npos ? "an " : "a ") + word;
    const std::string said = where == "front"    ? " in front of you"
                             : where == "behind" ? " behind you"
                             : where == "only"   ? ""
                                                 : " on your " + where;
    return "the " + word + said;
  }

  double Range(EntityId entity, size_t picture = 0) { return look_.Distance(item_->pictures.at(picture).position, entity); }

  // ------------------------------------------------------------------------------------------------ questions

  std::string Judge(const std::vector<VlnJson>& holds) const {
    if (holds.size() == 1 && holds[0] == item_->answer) return "";
    if (holds.empty()) return "no answer holds, though it says " + item_->answer.dump();
    if (holds.size() == 1) return "the answer is " + holds[0].dump() + ", not " + item_->answer.dump();
    return "not unique: " + holds[0].dump() + " and " + holds[1].dump() + " hold both";
  }

  // The one with the least value; both where they are too alike.
  std::vector<VlnJson> Least(const VlnJson& a, double x, const VlnJson& b, double y) const {
    if (std::max(x, y) < std::min(x, y) * kSame) return {TextOf(a), TextOf(b)};
    return {TextOf(x < y ? a : b)};
  }

  std::vector<VlnJson> Answers() {
    const VlnJson& q = item_->query;
    const auto is = q.at("is").get<std::string>();
    if (is == "exists") {
      const auto word = q.at("word").get<std::string>();
      if (const auto found = InSight(word, 0); !found.empty()) {
        if (std::ranges::none_of(found, [&](EntityId e) { return Unclear(e, 0).empty(); })) MustBePlain(found[0], 0);
        return {"yes"};
      }
      SurelyInSight(word, 0);
      return {"no"};
    }
    if (is == "count") return {SurelyInSight(q.at("word").get<std::string>(), 0).size()};
    const VlnJson& of = q.at("of");
    if (is == "came_into_view") return CameIntoView(of);
    if (item_->pictures.size() == 2) return OfFlight(is, of);
    std::vector<EntityId> things;
    for (const VlnJson& name : of) things.push_back(Named(name));
    if (is == "direction") return {Sector(Azimuth(Picture(0).at(things.at(0)), 0))};
    if (is == "nearer") return Least(of.at(0), Range(things.at(0)), of.at(1), Range(things.at(1)));
    if (is == "near_to") return Least(of.at(1), look_.Apart(things.at(0), things.at(1)), of.at(2), look_.Apart(things.at(0), things.at(2)));
    if (is == "facing") {
      const double turn = std::remainder(Azimuth(Picture(0).at(things.at(1)), 0) - Azimuth(Picture(0).at(things.at(0)), 0), 360);
      return {turn > 0 ? "right" : "left"};
    }
    if (is == "side") {
      const Glimpse &a = Picture(0).at(things.at(0)), &b = Picture(0).at(things.at(1));
      if (a.right < b.left) return {"left"};
      if (b.right < a.left) return {"right"};
      return {"left", "right"};
    }
    if (is == "behind") return Behind(of, things);
    if (is == "what_is_behind") return WhatIsBehind(of, things);
    if (is == "seen_from") return SeenFrom(things);
    if (is == "distance") {
      const double range = std::log(Range(things.at(0)) / 12) / std::log(3);
      return {range < -0.5 ? "4 m" : range < 0.5 ? "12 m" : "36 m"};
    }
    throw Wrong{"its query asks for " + Quoted(is) + ", which is not known"};
  }

  // Share of the rays of the narrower thing within the azimuths of the other.
  double Shared(EntityId a, EntityId b) {
    const Glimpse *p = &Picture(0).at(a), *q = &Picture(0).at(b);
    const auto spread = [&](const Glimpse& g, double around) {
      double low = 1e9, high = -1e9;
      for (const double azimuth : g.azimuths) {
        const double off = std::remainder(azimuth - around, 360);
        low = std::min(low, off);
        high = std::max(high, off);
      }
      return std::pair(low, high);
    };
    const double around = Azimuth(*p, 0);
    auto [pl, ph] = spread(*p, around);
    auto [ql, qh] = spread(*q, around);
    if (ph - pl > qh - ql) {
      std::swap(p, q);
      std::swap(pl, ql);
      std::swap(ph, qh);
    }
    const auto inside = std::ranges::count_if(p->azimuths, [&](double azimuth) {
      const double off = std::remainder(azimuth - around, 360);
      return off >= ql && off <= qh;
    });
    return static_cast<double>(inside) / static_cast<double>(p->rays);
  }

  std::vector<VlnJson> Behind(const VlnJson& of, const std::vector<EntityId>& things) {
    if (Shared(things.at(0), things.at(1)) < 0.5) throw Wrong{NameOf(things[0]) + " and " + NameOf(things[1]) + " do not stand in line"};
    return Least(of.at(0), -Range(things[0]), of.at(1), -Range(things[1]));
  }

  std::vector<VlnJson> WhatIsBehind(const VlnJson& of, const std::vector<EntityId>& things) {
    std::vector<VlnJson> holds;
    for (const size_t i : {1, 2})
      if (Shared(things.at(0), things.at(i)) > 0.3 && Range(things[i]) > Range(things[0]) * kSame) holds.push_back(TextOf(of[i]));
    return holds;
  }

  std::vector<VlnJson> SeenFrom(const std::vector<EntityId>& things) {
    const auto middle = [&](EntityId entity) {
      Vec3d sum;
      for (const Vec3d& p : look_.Points(entity)) sum += p;
      return sum / static_cast<double>(look_.Points(entity).size());
    };
    const Vec3d from = middle(things.at(0)), ahead = middle(things.at(1)) - from;
    bool left = false, right = false;
    for (const Vec3d& p : look_.Points(things.at(2))) ((ahead.x * (p.y - from.y) - ahead.y * (p.x - from.x)) > 0 ? left : right) = true;
    std::vector<VlnJson> holds;
    if (left) holds.push_back("left");
    if (right) holds.push_back("right");
    return holds;
  }

  std::vector<VlnJson> CameIntoView(const VlnJson& of) {
    std::vector<VlnJson> holds;
    for (const VlnJson& name : of) {
      const auto word = name.at("word").get<std::string>();
      if (InSight(word, 0).empty() && !InSight(word, 1).empty())
        holds.push_back(TextOf(name));
      else if (InSight(word, 0).empty())
        throw Wrong{"no " + word + " is in either picture"};
    }
    return holds;
  }

  std::vector<VlnJson> OfFlight(const std::string& is, const VlnJson& of) {
    std::vector<VlnJson> holds;
    for (const VlnJson& name : of) {
      const EntityId thing = Named(name, 0);
      if (Named(name, 1) != thing) throw Wrong{"the two pictures show different ones of " + TextOf(name)};
      const double before = Azimuth(Picture(0).at(thing), 0), after = Azimuth(Picture(1).at(thing), 1);
      const bool passed = std::abs(before) < 90 && std::abs(after) > 90;
      if (is == "passed" && passed) holds.push_back(TextOf(name));
      if (is == "passed_side" && passed) holds.push_back(after < 0 ? "left" : "right");
      if (is == "approach") holds.push_back(Range(thing, 1) < Range(thing, 0) ? "nearer" : "farther");
    }
    return holds;
  }

  // ------------------------------------------------------------------------------------------------ expressions

  std::string Point() {
    const VlnJson& q = item_->query;
    const auto word = q.at("word").get<std::string>(), where = q.at("where").get<std::string>();
    std::vector<EntityId> alike, found = InSight(word, 0, &alike);
    const size_t named = found.size();
    found.insert(found.end(), alike.begin(), alike.end());
    if (where == "nearest" || where == "beside" || where == "row") {
      std::vector<std::pair<double, EntityId>> order;
      const EntityId anchor = where == "beside" ? Named(q.at("anchor")) : kNoEntity;
      for (const EntityId e : found) {
        const double column = Picture(0).at(e).column / static_cast<double>(Picture(0).at(e).rays);
        order.emplace_back(where == "nearest"       ? Range(e)
                           : where == "beside"      ? look_.Apart(anchor, e)
                           : q.at("side") == "left" ? column
                                                    : -column,
                           e);
      }
      std::ranges::sort(order);
      const size_t k = where == "row" ? q.at("k").get<size_t>() - 1 : 0;
      if (k >= order.size()) return "absent: there are only " + std::to_string(order.size());
      if (k + 1 < order.size() && order[k + 1].first - order[k].first < 0.01)
        return "not unique: " + NameOf(order[k].second) + " and " + NameOf(order[k + 1].second) + " compete";
      found = {order[k].second};
    } else if (where != "only") {
      std::erase_if(found, [&](EntityId e) { return Sector(Azimuth(Picture(0).at(e), 0)) != where; });
    }
    if (found.empty() || named == 0) return "absent: no " + word + " is in sight";
    if (found.size() > 1) return "not unique: " + NameOf(found[0]) + " and " + NameOf(found[1]) + " compete for " + Quoted(item_->text);
    if (item_->entities.empty() || found[0] != item_->entities[0]) return "it means " + NameOf(found[0]) + ", not what it says";
    MustBePlain(found[0], 0);
    return CheckBox(Picture(0).at(found[0]));
  }

  // The box of the answer is that of the thing, within what pixels and rays between them differ by.
  std::string CheckBox(const Glimpse& g) const {
    const VlnJson& box = item_->answer;
    const double x = box.at(0).get<double>(), y = box.at(1).get<double>(), w = box.at(2).get<double>(), h = box.at(3).get<double>();
    const double slack = 3 + 0.08 * std::max(w, h);
    const double off = std::max({std::abs(x - g.left), std::abs(y - g.top), std::abs(x + w - 1 - g.right), std::abs(y + h - 1 - g.bottom)});
    return off <= slack ? "" : "its box is " + std::to_string(static_cast<int>(off)) + " pixels off";
  }

  // ------------------------------------------------------------------------------------------------ captions

  // All captions that hold, read as they stand.
  std::vector<VlnJson> Captions() {
    std::vector<VlnJson> holds;
    for (const VlnJson& choice : item_->choices)
      if (Holds(choice.get<std::string>())) holds.push_back(choice);
    return holds;
  }

  // "On your left there are two trees and a bus. …"
  bool Holds(const std::string& caption) {
    size_t from = 0;
    while (from < caption.size()) {
      const size_t end = caption.find('.', from);
      if (end == std::string::npos) throw Wrong{"a sentence of " + Quoted(caption) + " has no end"};
      std::string sentence = caption.substr(from, end - from);
      from = end + 2;
      const size_t verb = sentence.find(" there ");
      const size_t start = verb == std::string::npos ? verb : sentence.find(' ', verb + 7);
      if (start == std::string::npos) throw Wrong{Quoted(sentence) + " says of no place that something is there"};
      const std::string place = PlaceOf(sentence.substr(0, verb));
      std::string rest = sentence.substr(start + 1);
      for (size_t at; (at = rest.find(" and ")) != std::string::npos;) rest.replace(at, 5, ", ");
      std::istringstream parts(rest);
      for (std::string part; std::getline(parts, part, ',');) {
        part.erase(0, part.find_first_not_of(' '));
        if (!HoldsAt(part, place)) return false;
      }
    }
    return true;
  }

  static std::string PlaceOf(const std::string& said) {
    for (const auto& [words, place] :
         {std::pair("In front of you", "front"), std::pair("Behind you", "behind"), std::pair("On your left", "left"),
          std::pair("On your right", "right"), std::pair("On the left", "left"), std::pair("On the right", "right"),
          std::pair("In the middle", "middle")})
      if (said == words) return place;
    throw Wrong{Quoted(said) + " is no place"};
  }

  bool HoldsAt(const std::string& said, const std::string& place) {
    const size_t space = said.find(' ');
    const std::string number = said.substr(0, space), word = said.substr(space + 1);
    static const std::vector<std::string> kNumbers = {"no", "one", "two", "three", "four", "five"};
    const bool article = number == "a" || number == "an";
    const int64_t count = article ? 1 : std::ranges::find(kNumbers, number) - kNumbers.begin();
    for (const auto& [one, noun] : item_->nouns.items()) {
      if ((count == 1 ? one : noun.at("plural").get<std::string>()) != word) continue;
      const auto found = SurelyInSight(one, 0);
      return std::ranges::count_if(found, [&](EntityId e) { return Where(Picture(0).at(e)) == place; }) == count;
    }
    throw Wrong{Quoted(word) + " is none of its nouns"};
  }

  std::string Where(const Glimpse& g) const {
    if (item_->pictures[0].panorama) return Sector(Azimuth(g, 0));
    const double share = g.column / static_cast<double>(g.rays) / item_->pictures[0].width;
    return share < 1.0 / 3 ? "left" : share < 2.0 / 3 ? "middle" : "right";
  }

  std::shared_ptr<Stage> stage_;
  SecondLook look_;
  const LanguageItem* item_ = nullptr;
};

}  // namespace

LanguageCheck CheckLanguage(const std::filesystem::path& items,
                            const std::function<std::shared_ptr<Stage>(const std::string& world, uint64_t seed)>& open) {
  LanguageCheck check;
  // All is read once before a world is opened.
  std::set<std::pair<std::string, uint64_t>> worlds;
  int64_t total = 0;
  internal::ReadLanguageItems(items, [&](const LanguageItem& item) {
    worlds.insert({item.world, item.world_seed});
    ++total;
  });
  ProgressBar bar("language check", total);
  for (const auto& [world, seed] : worlds) {
    Auditor auditor(open(world, seed));
    internal::ReadLanguageItems(items, [&, world = world, seed = seed](const LanguageItem& item) {
      if (item.world != world || item.world_seed != seed) return;
      if (std::string what = auditor.Audit(item); !what.empty()) check.complaints.push_back({item.id, std::move(what)});
      bar.Update(++check.items);
    });
  }
  return check;
}

}  // namespace airsim360
