#include "airsim360/worlds/town_maker/town_words.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <map>
#include <optional>
#include <utility>

#include "airsim360/base/error.h"
#include "airsim360/worlds/town_maker/town_lexicon.h"

namespace airsim360 {
namespace {

using namespace internal;

constexpr size_t kLongest = 1000, kMostWords = 4;       // characters; words of a phrase
constexpr double kPersonEach = 1700;                    // m^2 of a town for one who walks outside, usually
constexpr double kMostPeople = 400, kPopulation = 200;  // who walk; more than so many people live there rather

// One word a line would hide them.
// clang-format off
constexpr auto kFillers = std::to_array<std::string_view>(
    {"a", "an", "the", "with", "and", "of", "in", "on", "at", "by", "to", "for", "near", "beside", "around", "along", "through",
     "between", "over", "above", "under", "below", "behind", "into", "from", "its", "it", "is", "are", "be", "that", "which", "where",
     "there", "has", "have", "having", "like", "s", "as", "very", "quite", "rather", "also", "all", "any", "some", "one", "other",
     "each", "every", "house", "home", "building", "block", "apartment", "street", "alley", "lane", "road", "path", "roof", "wall",
     "pavement", "sidewalk", "district", "quarter", "neighbourhood", "neighborhood", "area", "place", "settlement", "centre", "center",
     "community", "facade", "front", "plan", "style", "type", "kind", "view", "land", "ground", "side", "surrounded", "lined", "built",
     "full", "set", "located", "situated", "about", "roughly", "central", "main", "make", "create", "generate", "build", "please",
     "me", "want", "i", "world", "scene", "storey", "terrain", "architecture"});
constexpr auto kNumbers = std::to_array<std::pair<std::string_view, double>>(
    {{"two", 2}, {"three", 3}, {"four", 4}, {"five", 5}, {"six", 6}, {"seven", 7}, {"eight", 8}, {"nine", 9}, {"ten", 10},
     {"twelve", 12}, {"fifteen", 15}, {"twenty", 20}, {"thirty", 30}, {"forty", 40}, {"fifty", 50}, {"hundred", 100}});
constexpr auto kNone = std::to_array<std::string_view>({"no", "without", "free of", "hardly any", "not any", "devoid of"});
struct Amount {
  std::string_view words;
  double share;
};
constexpr auto kAmounts = std::to_array<Amount>(
    {{"few", 0.4}, {"a few", 0.4}, {"very few", 0.25}, {"little", 0.4}, {"light", 0.4}, {"sparse", 0.4}, {"moderate", 1}, {"some", 1},
     {"many", 1.5}, {"lots of", 1.5}, {"a lot of", 1.5}, {"plenty of", 1.5}, {"heavy", 1.5}, {"dense", 1.5}, {"big", 1.3},
     {"large", 1.3}});
// clang-format on

bool IsAny(const std::string& word, std::initializer_list<std::string_view> list) {
  return std::find(list.begin(), list.end(), word) != list.end();
}

std::string Number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", value);
  return text;
}

// "houses" and "house", "cities" and "city", "churches" and "church".
std::string Singular(std::string word) {
  const auto ends = [&](std::string_view end) { return word.size() > end.size() + 1 && word.ends_with(end); };
  if (ends("ies") && word.size() > 4) return word.replace(word.size() - 3, 3, "y");
  if (ends("ches") || ends("shes") || ends("sses") || ends("xes")) return word.erase(word.size() - 2);
  if (word.size() > 3 && ends("s") && !ends("ss") && !ends("us") && !ends("is")) word.pop_back();
  return word;
}

struct Token {
  std::string text, plain;  // as written; lower case, without accents, singular
  std::optional<double> number;
};

// Lower case letters, digits and points; letters with accents as they are without.
std::string Plain(std::string_view text) {
  static constexpr std::pair<std::string_view, char> kAccents[] = {{"é", 'e'}, {"è", 'e'}, {"ç", 'c'}, {"ã", 'a'}, {"á", 'a'}, {"ü", 'u'},
                                                                   {"ö", 'o'}, {"ä", 'a'}, {"ñ", 'n'}, {"²", '2'}, {"×", 'x'}};
  std::string plain;
  for (size_t i = 0; i < text.size();) {
    const auto accent =
        std::find_if(std::begin(kAccents), std::end(kAccents), [&](const auto& row) { return text.substr(i).starts_with(row.first); });
    if (accent != std::end(kAccents)) {
      plain += accent->second;
      i += accent->first.size();
      continue;
    }
    const auto c = static_cast<unsigned char>(text[i++]);
    plain += c == '%'                                   ? std::string(" percent ")
             : std::isalnum(c) || c == '.' || c >= 0x80 ? std::string(1, static_cast<char>(std::tolower(c)))
                                                        : std::string(" ");
  }
  return plain;
}

std::vector<Token> TokensOf(std::string_view description) {
  std::vector<Token> tokens;
  const std::string plain = Plain(description) + " ";
  std::string word;
  const auto finish = [&] {
    while (!word.empty() && word.back() == '.') word.pop_back();
    while (!word.empty() && word.front() == '.') word.erase(0, 1);
    if (word.empty()) return;
    // "40ha" is two words.
    const size_t digits = std::min(word.find_first_not_of("0123456789."), word.size());
    if (digits > 0 && digits < word.size() && word.find_first_of("0123456789", digits) > word.size() - 2) {
      const std::string unit = word.substr(digits);
      word.resize(digits);
      tokens.push_back({word, word, {}});
      tokens.push_back({unit, Singular(unit), {}});
    } else {
      tokens.push_back({word, Singular(word), {}});
    }
    word.clear();
  };
  for (char c : plain) {
    if (c == ' ')
      finish();
    else
      word += c;
  }
  for (Token& token : tokens) {
    double value = 0;
    const auto [end, error] = std::from_chars(token.text.data(), token.text.data() + token.text.size(), value);
    if (error == std::errc() && end == token.text.data() + token.text.size() && std::isfinite(value)) token.number = value;
    for (const auto& [name, number] : kNumbers)
      if (token.plain == name) token.number = number;
  }
  return tokens;
}

class Reader {
 public:
  explicit Reader(std::string_view description) : tokens_(TokensOf(description)) {}

  TownRequest Read() {
    if (tokens_.empty()) throw InputError("the description is empty: say what town, as in \"a small coastal town with a church\"");
    for (size_t i = 0; i < tokens_.size();) i = Step(i);
    return Finish();
  }

 private:
  struct Said {
    WordLevel level;
    void (*apply)(TownDraft&);
  };
  struct Claim {
    std::string means, words;
  };

  std::string Joined(size_t i, size_t n, bool plain) const {
    std::string text;
    for (size_t k = i; k < i + n && k < tokens_.size(); ++k) text += (k > i ? " " : "") + (plain ? tokens_[k].plain : tokens_[k].text);
    return text;
  }
  // Do the `n` words from i read as `phrase`?
  bool Reads(size_t i, size_t n, std::string_view phrase) const {
    return i + n <= tokens_.size() && (Joined(i, n, true) == phrase || Joined(i, n, false) == phrase);
  }

  void Note(size_t i, size_t n, std::string as) { request_.words.push_back({Joined(i, n, false), std::move(as)}); }

  // Two words about one subject must mean the same.
  void Agree(const std::string& subject, const std::string& means, const std::string& words) {
    const auto [it, fresh] = claims_.try_emplace(subject, Claim{means, words});
    if (!fresh && it->second.means != means)
      throw InputError("'" + it->second.words + "' (" + it->second.means + ") and '" + words + "' (" + means + ") exclude each other");
  }

  template <class Table, class Key>
  auto Longest(const Table& table, size_t i, size_t& n, const Key& key) const -> decltype(&*table.begin()) {
    for (n = std::min(kMostWords, tokens_.size() - i); n > 0; --n)
      for (const auto& row : table)
        if (Reads(i, n, key(row))) return &row;
    return nullptr;
  }

  size_t Step(size_t i) {
    if (const size_t n = Denied(i)) return i + n;
    if (const size_t n = Some(i)) return i + n;
    if (tokens_[i].number)
      if (const size_t n = Counted(i)) return i + n;
    // The longest of all that is known.
    size_t words = 0, things = 0, stuffs = 0;
    const TownWord* word = Longest(TownWords(), i, words, [](const TownWord& row) { return row.phrase; });
    const TownThing* thing = Longest(TownThings(), i, things, [](const TownThing& row) { return row.noun; });
    const TownStuff* stuff = Longest(TownStuffs(), i, stuffs, [](const TownStuff& row) { return row.noun; });
    if (word && words >= things && words >= stuffs) return Word(i, words, *word);
    if (thing && things >= stuffs) return Thing(i, things, *thing, true);
    if (stuff) return Stuff(i, 0, stuffs, *stuff, 1);
    if (std::find(kFillers.begin(), kFillers.end(), tokens_[i].plain) != kFillers.end() ||
        std::find(kFillers.begin(), kFillers.end(), tokens_[i].text) != kFillers.end()) {
      Note(i, 1, "filler");
      return i + 1;
    }
    Unknown(i);
  }

  [[noreturn]] void Unknown(size_t i) const {
    if (tokens_[i].number)
      throw InputError(
          "'" + Joined(i, std::min<size_t>(3, tokens_.size() - i), false) +
          "': a number of what? Understood are hectares, metres by metres, storeys, houses, people, squares, parks, and per cent of slope");
    std::vector<std::string> known;
    for (const TownWord& row : TownWords()) known.emplace_back(row.phrase);
    for (const TownThing& row : TownThings()) known.emplace_back(row.noun);
    for (const TownStuff& row : TownStuffs()) known.emplace_back(row.noun);
    for (std::string_view filler : kFillers) known.emplace_back(filler);
    const std::string nearest = NearestChoice(tokens_[i].plain, known);
    throw InputError("the word '" + tokens_[i].text + "' says nothing about towns" +
                     (nearest.empty() ? "" : "; did you mean '" + nearest + "'?") + " (docs/guide/towns.md lists the words)");
  }

  size_t Word(size_t i, size_t n, const TownWord& word) {
    // Kinds may be named again, and parts of one beside them.
    Agree(std::string(word.subject), std::string(word.means), Joined(i, n, false));
    said_.push_back({word.level, word.apply});
    Note(i, n, std::string(word.means));
    return i + n;
  }

  size_t Thing(size_t i, size_t n, const TownThing& thing, bool there) {
    const std::string means = std::string(thing.setting) + (there ? ": true" : ": false");
    Agree(std::string(thing.setting), means, Joined(i, n, false));
    things_.emplace_back(thing.field, there);
    Note(i, n, means);
    return i + n;
  }

  // `before` words of amount, then the noun.
  size_t Stuff(size_t i, size_t before, size_t n, const TownStuff& stuff, double amount) {
    const bool plural = tokens_[i + before + n - 1].text != tokens_[i + before + n - 1].plain;
    // "parks" alone are two.
    std::string means = std::string(stuff.setting) + " x " + Number(amount);
    Agree(std::string(stuff.setting), means, Joined(i, before + n, false));
    stuffs_.emplace_back(stuff.set, amount);
    if (before == 0 && plural && IsAny(std::string(stuff.setting), {"parks", "squares"}))
      (stuff.setting == "parks" ? parks_ : squares_) = 2;
    Note(i, before + n, means);
    return i + before + n;
  }

  // "no trees", "without a church": words read, 0 = not this.
  size_t Denied(size_t i) {
    size_t n = 0;
    const auto* none = Longest(kNone, i, n, [](std::string_view row) { return row; });
    if (!none) return 0;
    size_t at = i + n;
    while (at < tokens_.size() && IsAny(tokens_[at].text, {"a", "an", "any", "the"})) ++at;
    const auto deny = [&](size_t from) -> size_t {
      size_t things = 0, stuffs = 0;
      if (from >= tokens_.size()) return 0;
      const TownThing* thing = Longest(TownThings(), from, things, [](const TownThing& row) { return row.noun; });
      const TownStuff* stuff = Longest(TownStuffs(), from, stuffs, [](const TownStuff& row) { return row.noun; });
      if (thing && things >= stuffs) {
        Agree(std::string(thing->setting), std::string(thing->setting) + ": false", Joined(i, from + things - i, false));
        things_.emplace_back(thing->field, false);
        Note(from, things, std::string(thing->setting) + ": false");
        return things;
      }
      if (!stuff) return 0;
      Agree(std::string(stuff->setting), std::string(stuff->setting) + " x 0", Joined(i, from + stuffs - i, false));
      stuffs_.emplace_back(stuff->set, 0.0);
      Note(from, stuffs, std::string(stuff->setting) + ": none");
      return stuffs;
    };
    Note(i, at - i, "none of what follows");
    size_t read = deny(at);
    if (read == 0) throw InputError("'" + Joined(i, at - i + 1, false) + "': what can be denied are " + Deniable());
    at += read;
    // "no trees and no cars" begins anew; "no trees or cars" goes on.
    while (at + 1 < tokens_.size() && IsAny(tokens_[at].text, {"or", "nor"})) {
      Note(at, 1, "filler");
      read = deny(at + 1);
      if (read == 0) throw InputError("'" + Joined(at, 2, false) + "': what can be denied are " + Deniable());
      at += 1 + read;
    }
    return at - i;
  }

  static std::string Deniable() {
    std::string list;
    for (const TownStuff& row : TownStuffs()) list += std::string(row.noun) + ", ";
    for (const TownThing& row : TownThings()) list += std::string(row.noun) + ", ";
    list.resize(list.size() - 2);
    return list;
  }

  // "many trees", "light traffic": words read, 0 = not this.
  size_t Some(size_t i) {
    size_t n = 0, nouns = 0;
    const Amount* amount = Longest(kAmounts, i, n, [](const Amount& row) { return row.words; });
    if (!amount || i + n >= tokens_.size()) return 0;
    const TownStuff* stuff = Longest(TownStuffs(), i + n, nouns, [](const TownStuff& row) { return row.noun; });
    // "large trees", but a large square is a square.
    const bool size = amount->words == "large" || amount->words == "big";
    if (!stuff || (size && stuff->setting != "trees")) return 0;
    return Stuff(i, n, nouns, *stuff, amount->share) - i;
  }

  void Bound(size_t i, size_t n, double value, double low, double high, const char* unit) const {
    if (!(value >= low && value <= high))
      throw InputError("'" + Joined(i, n, false) + "': " + Number(value) + " is not from " + Number(low) + " to " + Number(high) + " " +
                       unit);
  }

  // Numbers with what they count: words read, 0 = not this.
  size_t Counted(size_t i) {
    const double value = *tokens_[i].number;
    const auto word = [&](size_t at) { return WordAt(at); };
    const size_t k = i + 1;
    if (const size_t read = Extent(i, value)) return read;
    // 2 to 5 storeys
    if (word(k) == "to" && k + 1 < tokens_.size() && tokens_[k + 1].number && IsStorey(word(k + 2)))
      return Storeys(i, 4, value, *tokens_[k + 1].number);
    if (k < tokens_.size() && tokens_[k].number && IsStorey(word(k + 1))) return Storeys(i, 3, value, *tokens_[k].number);
    if (IsStorey(word(k)))
      return Storeys(i, IsAny(word(k + 1), {"high", "tall"}) ? 3 : 2, value <= 3 ? value : std::round((value > 12 ? 0.3 : 0.7) * value),
                     value);
    if (const size_t read = Things(i, value)) return read;
    if (IsAny(word(k), {"percent"}) && IsAny(word(k + 1), {"slope", "gradient", "grade"})) {
      Bound(i, 3, value, 0, 26, "per cent");
      slope_ = value / 100;
      Note(i, 3, "climb: " + Number(value) + " % of the depth");
      return 3;
    }
    if (IsMetre(k) && IsAny(word(k + 1), {"wide"}) && IsAny(word(k + 2), {"street", "road", "lane"})) {
      Bound(i, 4, value, 4, 40, "m");
      street_ = value;
      Note(i, 4, "street: " + Number(value));
      return 4;
    }
    return 0;
  }

  std::string WordAt(size_t k) const { return k < tokens_.size() ? tokens_[k].plain : std::string(); }
  bool IsMetre(size_t k) const { return IsAny(WordAt(k), {"m", "metre", "meter"}); }

  // "300 m by 400 m", "40 ha", "2 square kilometres".
  size_t Extent(size_t i, double value) {
    const auto word = [&](size_t at) { return WordAt(at); };
    const size_t k = i + 1;
    const size_t cross = IsMetre(k) ? k + 1 : k;
    if (IsAny(word(cross), {"by", "x", "times"}) && cross + 1 < tokens_.size() && tokens_[cross + 1].number) {
      const size_t n = cross + 2 + (IsMetre(cross + 2) ? 1 : 0) - i;
      const double other = *tokens_[cross + 1].number;
      for (double side : {value, other}) Bound(i, n, side, TownSpec::kLeastSide, TownSpec::kMostSide, "m");
      return Size(i, n, value, other);
    }
    const double square = IsAny(word(k), {"ha", "hectare"}) ? 1e4
                          : word(k) == "acre"               ? 4046.9
                          : IsAny(word(k), {"km2", "sqkm"}) ? 1e6
                          : IsAny(word(k), {"m2", "sqm"})   ? 1
                                                            : 0;
    const bool two = IsAny(word(k), {"square", "sq"}) && IsAny(word(k + 1), {"kilometre", "kilometer", "km", "metre", "meter", "m"});
    if (square > 0 || two) {
      const double unit = square > 0 ? square : IsAny(word(k + 1), {"kilometre", "kilometer", "km"}) ? 1e6 : 1;
      const size_t n = square > 0 ? 2 : 3;
      Bound(i, n, value * unit / 1e4, 1.5, 144, "hectares");
      const double wide = std::sqrt(value * unit * 1.12);
      return Size(i, n, std::min(wide, TownSpec::kMostSide), value * unit / std::min(wide, TownSpec::kMostSide));
    }
    return 0;
  }

  // Houses, people, parks and squares.
  size_t Things(size_t i, double value) {
    const auto word = [&](size_t at) { return WordAt(at); };
    const size_t k = i + 1;
    if (IsAny(word(k), {"house", "home", "building", "cabin", "hut", "cottage"})) {
      Whole(i, value, 1, 4000, "houses");
      Agree("houses", "houses: " + Number(value), Joined(i, 2, false));
      houses_ = value;
      if (word(k) == "cabin" || word(k) == "hut") Step(k);
      Note(i, word(k) == "cabin" || word(k) == "hut" ? 1 : 2, "houses: " + Number(value));
      return 2;
    }
    if (IsAny(word(k), {"people", "inhabitant", "resident", "pedestrian", "person", "citizen"})) {
      Whole(i, value, 1, 100000, "people");
      Agree("people", "people: " + Number(value), Joined(i, 2, false));
      people_ = value <= kPopulation ? value : std::min(value / 20, kMostPeople);
      if (value > kPopulation) population_ = value;
      Note(i, 2, value <= kPopulation ? "people: " + Number(value) : "people: " + Number(std::round(people_)) + " of them outside");
      return 2;
    }
    if (IsAny(word(k), {"park", "square", "plaza"})) {
      const bool park = word(k) == "park";
      Whole(i, value, 1, park ? 6 : 4, park ? "parks" : "squares");
      Agree(park ? "parks" : "squares", Number(value), Joined(i, 2, false));
      (park ? parks_ : squares_) = value;
      Note(i, 2, (park ? "parks: " : "squares: ") + Number(value));
      return 2;
    }
    return 0;
  }

  static bool IsStorey(const std::string& word) { return IsAny(word, {"storey", "story", "floor", "level", "storeyed", "storied"}); }

  void Whole(size_t i, double value, double low, double high, const char* what) const {
    Bound(i, 2, value, low, high, what);
    if (value != std::round(value)) throw InputError("'" + Joined(i, 2, false) + "': " + Number(value) + " is no whole number");
  }

  size_t Size(size_t i, size_t n, double width, double depth) {
    const std::string means = "width: " + Number(std::round(width)) + ", depth: " + Number(std::round(depth));
    Agree("size in numbers", means, Joined(i, n, false));
    width_ = std::round(width);
    depth_ = std::round(depth);
    Note(i, n, means);
    return n;
  }

  size_t Storeys(size_t i, size_t n, double least, double most) {
    for (double floors : {least, most}) Bound(i, n, floors, 1, TownSpec::kMostFloors, "storeys");
    if (least > most) throw InputError("'" + Joined(i, n, false) + "': " + Number(least) + " is more than " + Number(most));
    const std::string means = "floors: " + Number(least) + " to " + Number(most);
    Agree("floors in numbers", means, Joined(i, n, false));
    least_ = least;
    most_ = most;
    Note(i, n, means);
    return n;
  }

  TownRequest Finish() {
    TownDraft draft;
    TownSpec& spec = draft.spec;
    spec.country = TownCountry::kFields;
    for (WordLevel level : {WordLevel::kKind, WordLevel::kPlace, WordLevel::kSaid})
      for (const Said& said : said_)
        if (said.level == level) said.apply(draft);
    for (const auto& [set, amount] : stuffs_) set(draft, amount);
    for (const auto& [field, there] : things_) spec.*field = there;
    CheckHeights();
    if (most_ > 0) spec.least_floors = least_, spec.most_floors = most_;
    if (parks_ >= 0) spec.parks = static_cast<uint64_t>(parks_);
    if (squares_ >= 0) spec.squares = static_cast<uint64_t>(squares_);
    if (houses_ > 0) spec.houses = static_cast<uint64_t>(houses_);
    if (street_ > 0) spec.street = street_;
    Sides(draft);
    // What needs something else brings it along, unless that was denied.
    if (spec.most_floors > 8)
      spec.street = std::max(spec.street, 15.0), spec.block = std::max(spec.block, 76.0), spec.setback = std::min(spec.setback, 6.0);
    if (spec.harbour && spec.water == TownWater::kNone && !claims_.contains("water")) spec.water = TownWater::kSea;
    if ((spec.market || spec.fountain || spec.clock_tower) && spec.squares == 0 && !claims_.contains("squares")) spec.squares = 1;
    if (spec.terrace) spec.most_floors = std::max(spec.most_floors, 10.0);
    if (spec.playground) spec.parks = std::max<uint64_t>(spec.parks, claims_.contains("parks") ? spec.parks : 1);
    if (slope_ >= 0) spec.relief = slope_ > 0 ? TownRelief::kSlope : TownRelief::kFlat, spec.climb = slope_ * spec.depth;
    spec.climb = std::min({spec.climb, 0.24 * std::min(spec.width, spec.depth), TownSpec::kMostClimb});
    spec.climb = std::round(spec.climb);
    if (spec.country == TownCountry::kFields && spec.most_floors > 8) spec.country = TownCountry::kCity;
    spec.Check("");
    request_.spec = spec;
    request_.weather = draft.weather;
    request_.people = static_cast<uint64_t>(
        std::round(people_ > 0              ? people_
                   : draft.people_share > 0 ? std::clamp(draft.people_share * spec.width * spec.depth / kPersonEach, 4.0, kMostPeople)
                                            : 0));
    return std::move(request_);
  }

  void CheckHeights() const {
    const auto said = claims_.find("heights");
    if (said == claims_.end() || most_ <= 0) return;
    const bool low = said->second.words.starts_with("low");
    if ((low && least_ > 5) || (!low && most_ < 4))
      throw InputError("'" + said->second.words + "' and '" + claims_.at("floors in numbers").words + "' exclude each other");
  }

  void Sides(TownDraft& draft) const {
    TownSpec& spec = draft.spec;
    if (width_ > 0) {
      spec.width = width_;
      spec.depth = depth_;
      return;
    }
    if (population_ > 0) spec.width = std::sqrt(population_ * 60 * 1.12), spec.depth = population_ * 60 / spec.width;
    const auto fit = [&](double side) { return std::round(std::clamp(side * draft.scale, TownSpec::kLeastSide, TownSpec::kMostSide)); };
    spec.width = fit(spec.width);
    spec.depth = fit(spec.depth);
  }

  std::vector<Token> tokens_;
  TownRequest request_;
  std::map<std::string, Claim> claims_;
  std::vector<Said> said_;
  std::vector<std::pair<void (*)(TownDraft&, double), double>> stuffs_;
  std::vector<std::pair<bool TownSpec::*, bool>> things_;
  double width_ = 0, depth_ = 0, least_ = 0, most_ = 0, houses_ = 0, people_ = 0, population_ = 0, parks_ = -1, squares_ = -1, street_ = 0,
         slope_ = -1;
};

}  // namespace

TownRequest TownFromWords(std::string_view description) {
  if (description.size() > kLongest)
    throw InputError("the description has " + std::to_string(description.size()) + " characters; at most " + std::to_string(kLongest) +
                     " are read");
  return Reader(description).Read();
}

}  // namespace airsim360
