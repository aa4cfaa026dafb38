#include "airsim360/worlds/interior/building_words.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <span>

#include "airsim360/base/error.h"
#include "airsim360/base/nearest_name.h"
#include "airsim360/worlds/interior/building_lexicon.h"
#include "airsim360/worlds/town_maker/town_lexicon.h"
#include "airsim360/worlds/words/number_words.h"
#include "airsim360/worlds/words/word_tokens.h"

namespace airsim360 {
namespace {

using namespace internal;
using namespace building_tables;
using Names = std::span<const std::string_view>;

constexpr size_t kLongestDescription = 1000;
constexpr double kMostInside = 400;  // people

bool IsAmong(Names list, std::string_view word) { return std::find(list.begin(), list.end(), word) != list.end(); }
std::string Short(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", value);
  return text;
}

std::string UsesInWords() {
  std::string all;
  for (const char* use : kBuildingUses) all += (all.empty() ? "" : ", ") + std::string(use);
  std::replace(all.begin(), all.end(), '_', ' ');
  return all;
}

class BuildingReader {
 public:
  explicit BuildingReader(std::vector<WordToken> words) : words_(std::move(words)) {}

  /// False: of a town. InputError for a building of which no inside is made, and for a use that is misspelt.
  bool IsOfBuilding() const {
    for (const WordToken& word : words_)
      if (IsAmong(kPlaceWords, word.text)) return false;
    for (size_t i = 0; i < words_.size(); ++i)
      if (const UseWord* use = UseAt(i); use && (use->words != "flat" || IsHome(i))) return true;
    for (const WordToken& word : words_)
      if (!IsKnown(word) && IsOfTowns(word.text)) return false;
    for (const WordToken& word : words_) {
      if (IsKnown(word) || IsOfTowns(word.text)) continue;
      if (IsAmong(kOtherBuildings, word.text)) throw InputError("'" + word.text + "': buildings from inside are: " + UsesInWords());
      for (const UseWord& use : kUses) {
        std::string many(use.words);
        many.back() == 'y' ? many.replace(many.size() - 1, 1, "ies") : many += "s";
        if (word.text == many)
          throw InputError("'" + word.text + "': a description makes one building; did you mean '" + std::string(use.words) + "'?");
        if (internal::EditDistance(word.text, use.words) <= (use.words.size() > 5 ? 2u : 1u) && word.text.size() > 4)
          throw InputError("'" + word.text + "' names no building; did you mean '" + std::string(use.words) +
                           "'? Buildings from inside are: " + UsesInWords());
      }
    }
    return false;
  }

  BuildingRequest Read() {
    while (at_ < words_.size())
      if (!Use() && !Applied() && !Quantity() && !Size() && !Parts() && !Filler()) Refuse();
    Finish();
    return std::move(request_);
  }

 private:
  const std::string& Word(size_t i) const {
    static const std::string none;
    return i < words_.size() ? words_[i].text : none;
  }
  bool IsEnd(size_t i) const { return i >= words_.size() || words_[i].breaks; }

  // How many words of a phrase stand at i, the last perhaps in the plural; 0 = not all of them do.
  size_t Matches(std::string_view phrase, size_t i, bool plural = false) const {
    for (const size_t from = i;; ++i) {
      const size_t blank = phrase.find(' ');
      const std::string wanted(phrase.substr(0, blank));
      const bool last = blank == std::string_view::npos;
      // "no atrium", "without an atrium".
      const bool denied = wanted == "no" && Word(i) == "without";
      if (Word(i) != wanted && !denied && !(last && plural && Word(i) == wanted + "s")) return 0;
      if (last) return i + 1 - from;
      if (wanted == "no" && (Word(i + 1) == "a" || Word(i + 1) == "an" || Word(i + 1) == "any")) ++i;
      phrase.remove_prefix(blank + 1);
    }
  }
  const UseWord* UseAt(size_t i) const {
    const UseWord* longest = nullptr;
    for (const UseWord& use : kUses)
      if (Matches(use.words, i) > 0 && (!longest || use.words.size() > longest->words.size())) longest = &use;
    return longest;
  }
  bool IsKnown(const WordToken& token) const {
    const std::string& word = token.text;
    const auto in = [&](std::string_view phrase) { return (" " + std::string(phrase) + " ").find(" " + word + " ") != std::string::npos; };
    return IsAmong(kFillerWords, word) || IsAmong(kStoreyWords, word) || IsAmong(kPeopleWords, word) || IsAmong(kSmall, word) ||
           IsAmong(kLarge, word) || IsAmong(kBounds, word) || token.number || IsAmong(kDenials, word) ||
           std::any_of(kSettings.begin(), kSettings.end(), [&](const Setting& s) { return in(s.words); });
  }
  static bool IsOfTowns(std::string word) {
    if (word.size() > 3 && word.back() == 's') word.pop_back();
    const auto in = [&](std::string_view phrase) { return (" " + std::string(phrase) + " ").find(" " + word + " ") != std::string::npos; };
    const auto words = internal::TownWords();
    const auto stuffs = internal::TownStuffs();
    const auto things = internal::TownThings();
    return std::any_of(words.begin(), words.end(), [&](const auto& w) { return in(w.phrase); }) ||
           std::any_of(stuffs.begin(), stuffs.end(), [&](const auto& w) { return in(w.noun); }) ||
           std::any_of(things.begin(), things.end(), [&](const auto& w) { return in(w.noun); });
  }
  // "a flat", "flat with …", "tidy flat"; not "flat roofs", "a campus, flat".
  bool IsHome(size_t i) const {
    if (!IsEnd(i + 1) && !IsKnown(words_[i + 1])) return false;
    if (std::any_of(words_.begin(), words_.end(), [](const auto& w) { return IsAmong(kLandWords, w.text); })) return false;
    size_t from = i;
    while (from > 0 && !words_[from].breaks) --from;
    if (from < i && (Word(from) == "a" || Word(from) == "one")) return Word(i - 1) != "is" && Word(i - 1) != "and";
    return std::all_of(words_.begin(), words_.begin() + static_cast<std::ptrdiff_t>(i), [&](const auto& w) { return IsKnown(w); });
  }

  std::string Text(size_t from, size_t count) const { return JoinedTokens(words_, from, count); }
  void Took(size_t count, std::string as) {
    request_.words.emplace_back(Text(at_, count), std::move(as));
    at_ += count;
  }
  // Two words that set one key must agree.
  void Claim(const std::string& key, const std::string& value, const std::string& said) {
    const auto [it, first] = claims_.try_emplace(key, value, said);
    if (!first && it->second.first != value) throw InputError("'" + it->second.second + "' and '" + said + "' exclude each other");
  }

  bool Use() {
    const UseWord* use = UseAt(at_);
    if (!use) return false;
    const size_t n = Matches(use->words, at_);
    if (use->use == BuildingUse::kApartment && (Word(at_ + n) == "building" || Word(at_ + n) == "block" || Word(at_ + n) == "house"))
      throw InputError("'" + Text(at_, n + 1) + "': one flat is made, not a house of flats; did you mean 'apartment'?");
    if (used_ && request_.spec.use != use->use)
      throw InputError(std::string("one building has one use: both '") + std::string(*used_) + "' and '" + std::string(use->words) +
                       "' are named");
    used_ = use->words;
    request_.spec.use = use->use;
    Took(n, std::string("use: ") + kBuildingUses[static_cast<size_t>(use->use)]);
    return true;
  }

  // Adjectives are of the building, not of its parts: "empty atrium" is refused.
  void NeedBuilding(size_t next) const {
    if (!IsEnd(next) && !UseAt(next) &&
        (Word(next) == "atrium" || Word(next) == "doors" || Word(next) == "furniture" || IsAmong(kStoreyWords, Word(next)) ||
         IsAmong(kPeopleWords, Word(next)) || PartAt(next)))
      throw InputError("'" + Text(at_, next + 1 - at_) + "' says nothing about a building: '" + Text(at_, next - at_) +
                       "' goes with the building, as in '" + Text(at_, next - at_) + " library'");
  }
  bool Applied() {
    const Setting* longest = nullptr;
    for (const Setting& setting : kSettings)
      if (Matches(setting.words, at_) > 0 && (!longest || setting.words.size() > longest->words.size())) longest = &setting;
    if (longest) {
      const size_t n = Matches(longest->words, at_);
      if (n == 1 && longest->words != "atrium") NeedBuilding(at_ + 1);
      for (const std::string_view key : longest->keys)
        if (!key.empty()) Claim(std::string(key.substr(0, key.find('='))), std::string(key.substr(key.find('=') + 1)), Text(at_, n));
      longest->set(request_.spec);
      Took(n, std::string(longest->as));
      return true;
    }
    const bool nobody = (Word(at_) == "no" || Word(at_) == "without") && IsAmong(kPeopleWords, Word(at_ + 1));
    const bool no_cars = (Word(at_) == "no" || Word(at_) == "without") && (Word(at_ + 1) == "cars" || Word(at_ + 1) == "vehicles");
    if (nobody || Word(at_) == "deserted") {
      Claim("people", "0", Text(at_, nobody ? 2 : 1));
      Took(nobody ? 2 : 1, "people: 0");
      return true;
    }
    if (!no_cars || !Named(BuildingUse::kCarPark)) return false;
    Claim("furnished", "false", Text(at_, 2));
    request_.spec.furnished = false;
    Took(2, "furnished: false");
    return true;
  }
  bool Named(BuildingUse use) const {
    for (size_t i = 0; i < words_.size(); ++i)
      if (const UseWord* said = UseAt(i)) return said->use == use;
    return false;
  }

  bool NumberAt(size_t i) const { return i < words_.size() && words_[i].number.has_value(); }
  // Metres of a unit of length, 0 where there is none.
  double UnitAt(size_t i) const { return i < words_.size() ? MetresOf(words_[i].plain) : 0; }

  void Side(const char* field, double& side, double value, const std::string& said) {
    if (!(value > 0 && value < 1e6))
      throw InputError("'" + said + "': " + field + ": " + Short(value) + " is not from " + Short(BuildingSpec::kLeastSide) + " to " +
                       Short(BuildingSpec::kMostSide));
    Claim(field, Short(value), said);
    Claim("size", "sides", said);
    side = std::round(value * 100) / 100;
  }

  bool Quantity() {
    // "people: 10".
    if (!NumberAt(at_) && NumberAt(at_ + 1) && words_[at_ + 1].breaks && IsAmong(kPeopleWords, Word(at_)) && IsEnd(at_ + 2))
      return People(*words_[at_ + 1].number, 2);
    if (!NumberAt(at_) || words_[at_].upper || words_[at_].limit != NumberLimit::kNone) return false;
    const double value = *words_[at_].number;
    const size_t i = at_ + 1;
    const size_t high = Word(i + 1) == "high" || Word(i + 1) == "tall";
    if (IsAmong(kStoreyWords, Word(i))) return Storeys(value, 2 + high);
    if (IsAmong(kPeopleWords, Word(i))) return People(value, 2);
    if (const auto [unit, words] = SquareMetresAt(words_, i); words > 0) return Area(value * unit, 1 + words);
    return Lengths(value, i);
  }
  bool Storeys(double value, size_t count) {
    if (value != std::floor(value) || value < 1 || value > static_cast<double>(BuildingSpec::kMostStoreys))
      throw InputError("'" + Text(at_, count) + "': storeys: " + Short(value) + " is not a whole number from 1 to " +
                       std::to_string(BuildingSpec::kMostStoreys));
    Claim("storeys", Short(value), Text(at_, count));
    request_.spec.storeys = static_cast<uint64_t>(value);
    Took(count, "storeys: " + Short(value));
    return true;
  }
  bool People(double value, size_t count) {
    if (value != std::floor(value) || value < 0 || value > kMostInside)
      throw InputError("'" + Text(at_, count) + "': people: " + Short(value) + " is not a whole number from 0 to " + Short(kMostInside));
    Claim("people", Short(value), Text(at_, count));
    request_.people = static_cast<uint64_t>(value);
    Took(count, "people: " + Short(value));
    return true;
  }
  bool Area(double value, size_t count) {
    if (!(value > 0)) throw InputError("'" + Text(at_, count) + "': " + Short(value) + " m2 is not an area");
    Claim("size", "area", Text(at_, count));
    Claim("area", Short(value), Text(at_, count));
    area_ = value;
    Took(count, "");
    sized_ = request_.words.size() - 1;
    return true;
  }
  // "40 x 30 m", "40 m by 30 m", "12 m high".
  bool Lengths(double value, size_t i) {
    const double unit = UnitAt(i);
    const size_t words = unit > 0, behind = i + words;
    if (Word(behind) == "x" || Word(behind) == "by") {
      if (!NumberAt(behind + 1) || words_[behind + 1].upper) return false;
      const double second = *words_[behind + 1].number, unit2 = UnitAt(behind + 2);
      const double last = unit2 > 0 ? unit2 : words > 0 ? unit : 1, first = words > 0 ? unit : last;
      const size_t count = behind + 2 + (unit2 > 0) - at_;
      Side("width", request_.spec.width, value * first, Text(at_, count));
      Side("depth", request_.spec.depth, second * last, Text(at_, count));
      Took(count, "width: " + Short(request_.spec.width) + ", depth: " + Short(request_.spec.depth));
      return true;
    }
    if (words == 0) return false;
    const std::string& way = Word(behind);
    const size_t count = behind + 1 - at_;
    const bool wide = way == "wide" || way == "long", deep = way == "deep";
    if (wide || deep) {
      double& side = wide ? request_.spec.width : request_.spec.depth;
      Side(wide ? "width" : "depth", side, value * unit, Text(at_, count));
      Took(count, (wide ? "width: " : "depth: ") + Short(side));
      return true;
    }
    if (way != "high" && way != "tall") return false;
    Claim("height", Short(value * unit), Text(at_, count));
    if (!(value > 0)) throw InputError("'" + Text(at_, count) + "': " + Short(value) + " is not a height");
    high_ = value * unit;
    Took(count, "");
    raised_ = request_.words.size() - 1;
    return true;
  }

  bool Size() {
    const bool small = IsAmong(kSmall, Word(at_)), large = IsAmong(kLarge, Word(at_));
    if (!small && !large) return false;
    NeedBuilding(at_ + 1);
    Claim("size", small ? "small" : "large", Word(at_));
    scale_ = small ? 0 : 1.4;
    Took(1, "");
    sized_ = request_.words.size() - 1;
    return true;
  }

  const Part* PartAt(size_t i) const {
    const Part* longest = nullptr;
    for (const Part& part : kParts)
      if (Matches(part.words, i, true) > 0 && (!longest || part.words.size() > longest->words.size())) longest = &part;
    return longest;
  }
  bool Parts() {
    const Part* part = PartAt(at_);
    if (!part) return false;
    const size_t n = Matches(part->words, at_, true);
    parts_.emplace_back(part, Text(at_, n));
    if (part->loose) Claim("furnished", "true", Text(at_, n));
    Took(n, "as every building of the use has");
    return true;
  }

  bool Filler() {
    if (!IsAmong(kFillerWords, Word(at_))) return false;
    Took(1, "filler");
    return true;
  }

  // What follows from several words.
  void Finish() {
    BuildingSpec& spec = request_.spec;
    const BuildingSpec usual = BuildingSpec{.use = spec.use}.Settled();
    if (spec.use == BuildingUse::kMall && claims_.contains("atrium") && !spec.atrium)
      throw InputError("'" + claims_.at("atrium").second + "': a mall is built around its hall");
    if (spec.atrium && spec.storeys == 0 && spec.Settled().storeys < 2) {
      spec.storeys = 2;
      for (auto& [said, as] : request_.words)
        if (as == "atrium: true") as += ", storeys: 2";
    }
    // The file says what is built: malls of several storeys have their hall in any case.
    if (spec.use == BuildingUse::kMall && spec.Settled().storeys > 1) spec.atrium = true;
    const auto storeys = static_cast<double>(spec.Settled().storeys);
    if (high_ > 0) {
      spec.storey_height = high_ / storeys;
      request_.words[raised_].second = "storey_height: " + Short(spec.storey_height);
    }
    if (area_ > 0 || scale_) SetSides(usual, storeys);
    for (const auto& [part, said] : parts_) {
      if ((part->uses >> static_cast<unsigned>(spec.use) & 1u) == 0)
        throw InputError("'" + said + "': not in buildings of use: " + kBuildingUses[static_cast<size_t>(spec.use)] +
                         "; rooms and things follow from the use");
      if (part->storeys && storeys < 2) throw InputError("'" + said + "' needs 2 storeys or more");
    }
    spec.Check("");
  }
  void SetSides(const BuildingSpec& usual, double storeys) {
    BuildingSpec& spec = request_.spec;
    const auto [least_width, least_depth] = BuildingSpec::LeastSides(spec.use);
    if (area_ > 0) {
      const double floor = area_ / storeys, most = BuildingSpec::kMostSide * BuildingSpec::kMostSide;
      if (floor < least_width * least_depth * 0.999 || floor > most)
        throw InputError("'" + request_.words[sized_].first + "': " + Short(floor) + " m2 a storey is not from " +
                         Short(std::ceil(least_width * least_depth)) + " to " + Short(most) +
                         " for use: " + kBuildingUses[static_cast<size_t>(spec.use)]);
      // As long for their depth as is usual, where the least sides allow it.
      spec.width = std::clamp(std::sqrt(floor * usual.width / usual.depth), least_width, BuildingSpec::kMostSide);
      spec.depth = std::clamp(floor / spec.width, least_depth, BuildingSpec::kMostSide);
      spec.width = std::clamp(floor / spec.depth, least_width, BuildingSpec::kMostSide);
    } else {
      spec.width = *scale_ > 0 ? std::min(usual.width * *scale_, BuildingSpec::kMostSide) : least_width;
      spec.depth = *scale_ > 0 ? std::min(usual.depth * *scale_, BuildingSpec::kMostSide) : least_depth;
    }
    for (double* side : {&spec.width, &spec.depth}) *side = std::round(*side * 100) / 100;
    request_.words[sized_].second = "width: " + Short(spec.width) + ", depth: " + Short(spec.depth);
  }

  // The phrase at at_, to its noun: "at least 3 storeys".
  std::string Phrase() const {
    size_t n = 1;
    const auto goes_on = [&](const WordToken& token) {
      const std::string& word = token.text;
      return token.number || IsAmong(kBounds, word) || IsAmong(kDenials, word) || IsAmong(AboutWords(), word) || IsAmong(kSmall, word) ||
             IsAmong(kLarge, word) || word == "of" || word == "the" || word == "a" || word == "an" || word == "-";
    };
    while (n < 7 && !IsEnd(at_ + n) && goes_on(words_[at_ + n - 1])) ++n;
    return Text(at_, n);
  }
  [[noreturn]] void Refuse() const {
    const std::string phrase = Phrase(), last = phrase.substr(phrase.rfind(' ') + 1),
                      said = "'" + phrase + "' says nothing about a building";
    std::vector<std::string> known;
    for (const UseWord& use : kUses) known.emplace_back(use.words);
    for (const Setting& setting : kSettings) known.emplace_back(setting.words);
    for (const Part& part : kParts) known.emplace_back(part.words);
    for (const Names list : {Names(kStoreyWords), Names(kPeopleWords), Names(kSmall), Names(kLarge)})
      known.insert(known.end(), list.begin(), list.end());
    if (IsAmong(kPeopleWords, last)) throw InputError(said + ": say how many, as in '20 " + last + "'");
    if (IsAmong(kStoreyWords, last)) throw InputError(said + ": say one number, as in '3 storeys'");
    if (IsAmong(kLightWords, last)) throw InputError(said + "; light and weather are set where the world is opened: --weather night");
    if (PartAt(at_ + static_cast<size_t>(std::count(phrase.begin(), phrase.end(), ' '))))
      throw InputError(said +
                       "; rooms and things follow from the use and the measures, only 'no furniture' and 'empty' take all of it away");
    // Words of meanings far apart are no help.
    const std::string choice = NearestChoice(last, known),
                      nearest = internal::EditDistance(last, choice) < 3 ? DidYouMean(last, known) : "";
    throw InputError(said + (nearest.empty() || std::find(known.begin(), known.end(), last) != known.end()
                                 ? "; what can be: its use, storeys, measures, people, doors, an atrium, 'empty', 'tidy', 'cluttered'"
                                 : nearest));
  }

  std::vector<WordToken> words_;
  size_t at_ = 0;
  std::optional<std::string_view> used_;
  std::map<std::string, std::pair<std::string, std::string>> claims_;  // key → value, words
  std::vector<std::pair<const Part*, std::string>> parts_;
  double area_ = 0, high_ = 0;
  std::optional<double> scale_;
  size_t sized_ = 0, raised_ = 0;  // rows of the words that the settings of Finish belong to
  BuildingRequest request_;
};

}  // namespace

std::optional<BuildingRequest> BuildingFromWords(std::string_view description) {
  if (description.size() > kLongestDescription) return std::nullopt;
  BuildingReader reader(WordTokens(description));
  if (!reader.IsOfBuilding()) return std::nullopt;
  return reader.Read();
}

}  // namespace airsim360
