#include "airsim360/worlds/interior/building_words.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <map>
#include <span>

#include "airsim360/base/error.h"
#include "airsim360/base/nearest_name.h"
#include "airsim360/worlds/town_maker/town_lexicon.h"

namespace airsim360 {
namespace {

using Names = std::span<const std::string_view>;

constexpr size_t kLongestDescription = 1000;
constexpr double kMostInside = 400;  // people

struct UseWord {
  std::string_view words;
  BuildingUse use;
};
constexpr auto kUses = std::to_array<UseWord>({{"apartment", BuildingUse::kApartment},
                                               {"flat", BuildingUse::kApartment},
                                               {"maisonette", BuildingUse::kApartment},
                                               {"office", BuildingUse::kOffice},
                                               {"offices", BuildingUse::kOffice},
                                               {"office building", BuildingUse::kOffice},
                                               {"office tower", BuildingUse::kOffice},
                                               {"warehouse", BuildingUse::kWarehouse},
                                               {"storage hall", BuildingUse::kWarehouse},
                                               {"mall", BuildingUse::kMall},
                                               {"shopping mall", BuildingUse::kMall},
                                               {"shopping centre", BuildingUse::kMall},
                                               {"shopping center", BuildingUse::kMall},
                                               {"car park", BuildingUse::kCarPark},
                                               {"parking garage", BuildingUse::kCarPark},
                                               {"multi storey car park", BuildingUse::kCarPark},
                                               {"library", BuildingUse::kLibrary},
                                               {"public library", BuildingUse::kLibrary}});
// One word a line would hide them.
// clang-format off
constexpr auto kFillerWords = std::to_array<std::string_view>({"a", "an", "the", "with", "and", "but", "of", "in", "its", "it", "that", "which", "has", "have", "having",
                                "is", "are", "building", "for", "make", "create", "build", "please", "me", "i", "want", "need"});
// Words of a place out of doors: such descriptions are of towns.
constexpr auto kPlaceWords = std::to_array<std::string_view>(
    {"town", "city", "village", "street", "streets", "suburb", "downtown", "hamlet", "settlement", "harbour", "island", "forest", "cabins",
     "houses", "towers"});
// Beside these "flat" is how land lies.
constexpr auto kLandWords = std::to_array<std::string_view>(
    {"slope", "hill", "hills", "hilltop", "castle", "roofs", "terrain", "land", "landscape", "ha", "hectares", "campus", "park", "trees",
     "sea", "coast"});
// Of which no inside is made.
constexpr auto kOtherBuildings = std::to_array<std::string_view>({"hospital", "school", "hotel", "museum", "theatre", "theater", "cinema", "airport", "stadium",
                                   "supermarket", "restaurant", "gym", "prison", "hangar", "bank", "laboratory", "clinic", "kindergarten",
                                   "factory", "workshop", "studio", "shop", "gallery", "gymnasium", "hostel", "arena"});
constexpr auto kNumberWords = std::to_array<std::pair<std::string_view, double>>(
    {{"zero", 0}, {"one", 1}, {"single", 1}, {"two", 2}, {"three", 3}, {"four", 4}, {"five", 5}, {"six", 6}, {"seven", 7}, {"eight", 8},
     {"nine", 9}, {"ten", 10}, {"eleven", 11}, {"twelve", 12}, {"fifteen", 15}, {"twenty", 20}, {"thirty", 30}, {"forty", 40},
     {"fifty", 50}, {"sixty", 60}, {"seventy", 70}, {"eighty", 80}, {"ninety", 90}, {"dozen", 12}, {"hundred", 100}});
constexpr auto kStoreyWords = std::to_array<std::string_view>({"storey", "storeys", "story", "stories", "storied", "floor", "floors", "level", "levels", "deck", "decks"});
constexpr auto kPeopleWords = std::to_array<std::string_view>({"people", "persons", "visitors", "workers", "shoppers", "readers"});
constexpr auto kAbout = std::to_array<std::string_view>({"about", "around", "approximately", "roughly"});
constexpr auto kBounds = std::to_array<std::string_view>({"over", "under", "above", "below", "at", "least", "most", "up", "to", "more", "less", "fewer", "than",
                           "between", "minus", "nearly", "almost", "several", "many", "few"});
constexpr auto kDenials = std::to_array<std::string_view>({"no", "without", "not", "free"});
constexpr auto kLightWords = std::to_array<std::string_view>({"night", "day", "evening", "morning", "dusk", "sunset", "fog", "foggy", "rain", "rainy", "snow", "snowy",
                               "sunny", "dark"});
// clang-format on

// What a word sets; two that set one key must agree.
struct Setting {
  std::string_view words, as;
  void (*set)(BuildingSpec&);
  std::array<std::string_view, 2> keys;  ///< "clutter=0"
};
constexpr auto kSettings = std::to_array<Setting>({
    {"atrium", "atrium: true", [](BuildingSpec& s) { s.atrium = true; }, {"atrium=true"}},
    {"cluttered", "clutter: 1.5", [](BuildingSpec& s) { s.clutter = 1.5; }, {"clutter=1.5", "furnished=true"}},
    {"messy", "clutter: 1.5", [](BuildingSpec& s) { s.clutter = 1.5; }, {"clutter=1.5", "furnished=true"}},
    {"busy", "clutter: 1.3", [](BuildingSpec& s) { s.clutter = 1.3; }, {"clutter=1.3", "furnished=true"}},
    {"tidy", "clutter: 0", [](BuildingSpec& s) { s.clutter = 0; }, {"clutter=0", "furnished=true"}},
    {"furnished", "furnished: true", [](BuildingSpec& s) { s.furnished = true; }, {"furnished=true"}},
    {"unfurnished", "furnished: false", [](BuildingSpec& s) { s.furnished = false; }, {"furnished=false"}},
    {"empty", "furnished: false", [](BuildingSpec& s) { s.furnished = false; }, {"furnished=false"}},
    {"half open doors", "open_doors: 0.5", [](BuildingSpec& s) { s.open_doors = 0.5; }, {"doors=0.5"}},
    {"doors half open", "open_doors: 0.5", [](BuildingSpec& s) { s.open_doors = 0.5; }, {"doors=0.5"}},
    {"open doors", "open_doors: 1", [](BuildingSpec& s) { s.open_doors = 1; }, {"doors=1"}},
    {"doors open", "open_doors: 1", [](BuildingSpec& s) { s.open_doors = 1; }, {"doors=1"}},
    {"all doors open", "open_doors: 1", [](BuildingSpec& s) { s.open_doors = 1; }, {"doors=1"}},
    {"no closed doors", "open_doors: 1", [](BuildingSpec& s) { s.open_doors = 1; }, {"doors=1"}},
    {"closed doors", "open_doors: 0", [](BuildingSpec& s) { s.open_doors = 0; }, {"doors=0"}},
    {"doors closed", "open_doors: 0", [](BuildingSpec& s) { s.open_doors = 0; }, {"doors=0"}},
    {"all doors closed", "open_doors: 0", [](BuildingSpec& s) { s.open_doors = 0; }, {"doors=0"}},
    {"no open doors", "open_doors: 0", [](BuildingSpec& s) { s.open_doors = 0; }, {"doors=0"}},
    {"no atrium", "atrium: false", [](BuildingSpec& s) { s.atrium = false; }, {"atrium=false"}},
    {"no clutter", "clutter: 0", [](BuildingSpec& s) { s.clutter = 0; }, {"clutter=0"}},
    {"no furniture", "furnished: false", [](BuildingSpec& s) { s.furnished = false; }, {"furnished=false"}},
});
// Small ones have the least sides of the use, large ones 1.4 times the usual.
constexpr auto kSmall = std::to_array<std::string_view>({"small", "little", "tiny"});
constexpr auto kLarge = std::to_array<std::string_view>({"large", "big", "huge", "spacious"});

// What buildings of a use have in any case, and so can be said.
struct Part {
  std::string_view words;
  unsigned uses;                        ///< their bits
  bool storeys = false, loose = false;  ///< needs two storeys; gone where unfurnished
};
// Bits of uses.
constexpr unsigned kHome = 1, kOffices = 2, kHalls = 4, kMalls = 8, kDecksOfCars = 16, kLibraries = 32;
constexpr auto kParts = std::to_array<Part>({{"furniture", kHome | kOffices | kHalls | kMalls | kLibraries, false, true},
                                             {"lamp", kHome | kOffices | kHalls | kMalls | kDecksOfCars | kLibraries},
                                             {"living room", kHome},
                                             {"dining room", kHome},
                                             {"kitchen", kHome},
                                             {"bedroom", kHome},
                                             {"bathroom", kHome},
                                             {"meeting room", kOffices},
                                             {"pantry", kOffices},
                                             {"desk", kOffices, false, true},
                                             {"pallet rack", kHalls, false, true},
                                             {"rack", kHalls, false, true},
                                             {"goods", kHalls, false, true},
                                             {"forklift", kHalls, false, true},
                                             {"shop", kMalls},
                                             {"supermarket", kMalls},
                                             {"food court", kMalls},
                                             {"escalator", kMalls, true},
                                             {"car", kDecksOfCars, false, true},
                                             {"parked car", kDecksOfCars, false, true},
                                             {"ramp", kDecksOfCars, true},
                                             {"lift", kOffices | kMalls | kLibraries},
                                             {"stairs", kOffices | kMalls | kLibraries, true},
                                             {"reading room", kLibraries},
                                             {"book stack", kLibraries}});

bool IsAmong(Names list, std::string_view word) { return std::find(list.begin(), list.end(), word) != list.end(); }
bool IsAmong(std::initializer_list<std::string_view> list, std::string_view word) {
  return std::find(list.begin(), list.end(), word) != list.end();
}
bool IsDigit(char c) { return c >= '0' && c <= '9'; }

struct BuildingToken {
  std::string text;
  bool starts = false;  ///< behind a comma or another mark, or the first
};

// "40x20m" in four, "600m2" in two.
void AddTokens(const std::string& word, bool starts, std::vector<BuildingToken>& tokens) {
  double value = 0;
  const char* const end = word.data() + word.size();
  const bool whole = std::from_chars(word.data(), end, value).ptr == end;
  size_t at = 0;
  while (!whole && at < word.size() && (IsDigit(word[at]) || (at == 0 && word[0] == '-'))) {
    const size_t digits = std::min(word.find_first_not_of("0123456789.,-", at), word.size());
    size_t letters = std::min(word.find_first_of("0123456789", digits), word.size());
    if (letters + 1 == word.size() && word[letters] == '2') letters = word.size();
    tokens.push_back({word.substr(at, digits - at), starts});
    if (letters > digits) tokens.push_back({word.substr(digits, letters - digits)});
    starts = false;
    at = letters;
  }
  if (at < word.size()) tokens.push_back({word.substr(at), starts});
}

// Lower case words, numbers with their signs ("-2", "3-5", "10,000"), and signs that are neither blanks nor marks ("%").
std::vector<BuildingToken> TokensOfBuilding(std::string text) {
  static constexpr std::pair<std::string_view, std::string_view> kSigns[] = {{"²", "2"}, {"×", " x "}, {"–", "-"},    {"—", "-"},
                                                                             {"−", "-"}, {"’", " "},   {"&", " and "}};
  for (const auto& [sign, as] : kSigns)
    for (size_t at = 0; (at = text.find(sign, at)) != std::string::npos; at += as.size()) text.replace(at, sign.size(), as);
  std::vector<BuildingToken> tokens;
  std::string word;
  bool starts = true;
  const auto end = [&] {
    if (word.empty()) return;
    AddTokens(word, starts, tokens);
    starts = false;
    word.clear();
  };
  for (size_t i = 0; i < text.size(); ++i) {
    const auto c = static_cast<unsigned char>(text[i]);
    const bool digit_next = i + 1 < text.size() && IsDigit(text[i + 1]), digit_before = i > 0 && IsDigit(text[i - 1]);
    const bool letter_before = i > 0 && std::isalpha(static_cast<unsigned char>(text[i - 1]));
    if (std::isalnum(c) || c >= 0x80 || (digit_next && ((c == '-' && !letter_before) || c == '.' || (c == ',' && digit_before)))) {
      word += static_cast<char>(std::tolower(c));
      continue;
    }
    end();
    if (c == ',' || c == ';' || c == '.' || c == ':' || c == '!' || c == '?' || c == '\n') starts = true;
    if (std::isspace(c) || std::string_view(",;.:!?-()'\"").find(static_cast<char>(c)) != std::string_view::npos) continue;
    tokens.push_back({std::string(1, static_cast<char>(c)), starts});
    starts = false;
  }
  end();
  return tokens;
}

std::optional<double> NumberIn(std::string text) {
  for (const auto& [name, value] : kNumberWords)
    if (name == text) return value;
  // Commas part thousands.
  for (size_t at = text.find(','); at != std::string::npos; at = text.find(',', at)) {
    if (text.size() < at + 4 || (text.size() > at + 4 && text[at + 4] != ',' && text[at + 4] != '.')) return std::nullopt;
    text.erase(at, 1);
  }
  double value = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || !std::isfinite(value) || stop != text.data() + text.size()) return std::nullopt;
  return value;
}

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
  explicit BuildingReader(std::vector<BuildingToken> words) : words_(std::move(words)) {}

  /// False: of a town. InputError for a building of which no inside is made, and for a use that is misspelt.
  bool IsOfBuilding() const {
    for (const BuildingToken& word : words_)
      if (IsAmong(kPlaceWords, word.text)) return false;
    for (size_t i = 0; i < words_.size(); ++i)
      if (const UseWord* use = UseAt(i); use && (use->words != "flat" || IsHome(i))) return true;
    for (const BuildingToken& word : words_)
      if (!IsKnown(word.text) && IsOfTowns(word.text)) return false;
    for (const BuildingToken& word : words_) {
      if (IsKnown(word.text) || IsOfTowns(word.text)) continue;
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
  bool IsEnd(size_t i) const { return i >= words_.size() || words_[i].starts; }

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
  bool IsKnown(const std::string& word) const {
    const auto in = [&](std::string_view phrase) { return (" " + std::string(phrase) + " ").find(" " + word + " ") != std::string::npos; };
    return IsAmong(kFillerWords, word) || IsAmong(kStoreyWords, word) || IsAmong(kPeopleWords, word) || IsAmong(kSmall, word) ||
           IsAmong(kLarge, word) || IsAmong(kBounds, word) || IsAmong(kAbout, word) || IsAmong(kDenials, word) || NumberIn(word) ||
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
    if (!IsEnd(i + 1) && !IsKnown(Word(i + 1))) return false;
    if (std::any_of(words_.begin(), words_.end(), [](const auto& w) { return IsAmong(kLandWords, w.text); })) return false;
    size_t from = i;
    while (!words_[from].starts) --from;
    if (from < i && (Word(from) == "a" || Word(from) == "one")) return Word(i - 1) != "is" && Word(i - 1) != "and";
    return std::all_of(words_.begin(), words_.begin() + static_cast<std::ptrdiff_t>(i), [&](const auto& w) { return IsKnown(w.text); });
  }

  std::string Text(size_t from, size_t count) const {
    std::string text;
    for (size_t i = 0; i < count; ++i) text += (i ? " " : "") + Word(from + i);
    return text;
  }
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

  // "two hundred", "twenty five", "40"; how many words it has, 0 = no number.
  std::pair<double, size_t> NumberAt(size_t i) const {
    const auto first = i < words_.size() ? NumberIn(Word(i)) : std::nullopt;
    if (!first) return {0, 0};
    double value = *first;
    size_t n = 1;
    if (const auto next = NumberIn(Word(i + n)); next && value >= 20 && value < 100 && *next >= 1 && *next < 10 && !IsDigit(Word(i)[0]))
      value += *next, ++n;
    while (!IsEnd(i + n) && (Word(i + n) == "hundred" || Word(i + n) == "dozen")) value *= *NumberIn(Word(i + n)), ++n;
    return {value, n};
  }
  // Metres that a unit of length at i has, or square metres of a unit of area; and its words.
  std::pair<double, size_t> UnitAt(size_t i, bool area) const {
    const auto length = [&](const std::string& unit) {
      return IsAmong({"m", "metre", "metres", "meter", "meters"}, unit) ? 1.0 : IsAmong({"ft", "foot", "feet"}, unit) ? 0.3048 : 0.0;
    };
    if (!area) return {length(Word(i)), length(Word(i)) > 0 ? 1 : 0};
    if (Word(i) == "m2" || Word(i) == "sqm") return {1, 1};
    if (Word(i) == "ft2" || Word(i) == "sqft") return {0.3048 * 0.3048, 1};
    if (Word(i) != "square" && Word(i) != "sq") return {0, 0};
    const double side = length(Word(i + 1));
    return {side * side, side > 0 ? 2 : 0};
  }

  void Side(const char* field, double& side, double value, const std::string& said) {
    if (!(value > 0 && value < 1e6))
      throw InputError("'" + said + "': " + field + ": " + Short(value) + " is not from " + Short(BuildingSpec::kLeastSide) + " to " +
                       Short(BuildingSpec::kMostSide));
    Claim(field, Short(value), said);
    Claim("size", "sides", said);
    side = std::round(value * 100) / 100;
  }

  bool Quantity() {
    const size_t about = IsAmong(kAbout, Word(at_)) ? 1 : 0;
    size_t i = at_ + about;
    // "people: 10".
    if (about == 0 && !NumberAt(at_).second && NumberAt(at_ + 1).second && words_[at_ + 1].starts && !words_[at_].text.empty() &&
        IsAmong(kPeopleWords, Word(at_)) && IsEnd(at_ + 1 + NumberAt(at_ + 1).second)) {
      const auto [value, n] = NumberAt(at_ + 1);
      return People(value, 1 + n);
    }
    const auto [value, n] = NumberAt(i);
    if (n == 0) return false;
    i += n;
    const size_t high = Word(i + 1) == "high" || Word(i + 1) == "tall";
    if (IsAmong(kStoreyWords, Word(i))) return Storeys(value, i + 1 + high - at_);
    if (IsAmong(kPeopleWords, Word(i))) return People(value, i + 1 - at_);
    if (const auto [unit, words] = UnitAt(i, true); words > 0) return Area(value * unit, i + words - at_);
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
    auto [unit, words] = UnitAt(i, false);
    const size_t behind = i + words;
    if (Word(behind) == "x" || Word(behind) == "by") {
      const auto [second, n] = NumberAt(behind + 1);
      const auto [unit2, words2] = UnitAt(behind + 1 + n, false);
      if (n == 0) return false;
      const double last = words2 > 0 ? unit2 : words > 0 ? unit : 1, first = words > 0 ? unit : last;
      const size_t count = behind + 1 + n + words2 - at_;
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
    const auto goes_on = [&](const std::string& word) {
      return NumberIn(word) || IsDigit(word[0]) || IsAmong(kBounds, word) || IsAmong(kDenials, word) || IsAmong(kAbout, word) ||
             IsAmong(kSmall, word) || IsAmong(kLarge, word) || word == "of" || word == "the" || word == "a" || word == "an" || word == "-";
    };
    while (n < 7 && !IsEnd(at_ + n) && goes_on(Word(at_ + n - 1))) ++n;
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

  std::vector<BuildingToken> words_;
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
  BuildingReader reader(TokensOfBuilding(std::string(description)));
  if (!reader.IsOfBuilding()) return std::nullopt;
  return reader.Read();
}

}  // namespace airsim360
