#include "airsim360/worlds/town_maker/town_words.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <map>
#include <numeric>
#include <optional>
#include <span>
#include <utility>

#include "airsim360/base/config.h"
#include "airsim360/base/error.h"
#include "airsim360/scene/environment.h"
#include "airsim360/worlds/town_maker/town_adjectives.h"
#include "airsim360/worlds/town_maker/town_lexicon.h"
#include "airsim360/worlds/town_maker/town_phrases.h"
#include "airsim360/worlds/words/number_words.h"
#include "airsim360/worlds/words/word_tokens.h"

namespace airsim360 {
namespace {

using namespace internal;
using namespace town_tables;

constexpr size_t kLongest = 1000, kMostWords = 5;       // characters; words of a phrase
constexpr double kPersonEach = 1700;                    // m^2 of a town for one who walks outside, usually
constexpr double kMostPeople = 400, kPopulation = 200;  // who walk; more than so many people live there rather
constexpr double kLaneStreet = 8.2;                     // metres; old towns have lanes without cars between streets so narrow

template <class List>
bool IsOneOf(const List& list, std::string_view word) {
  return std::find(list.begin(), list.end(), word) != list.end();
}

bool IsAny(const std::string& word, std::initializer_list<std::string_view> list) {
  return std::find(list.begin(), list.end(), word) != list.end();
}

std::string Number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", value);
  return text;
}

class Reader {
 public:
  explicit Reader(std::string_view description) : tokens_(WordTokens(description)) {}

  TownRequest Read() {
    if (tokens_.empty()) throw InputError("the description is empty: say what town, as in \"a small coastal town with a church\"");
    for (size_t i = 0; i < tokens_.size();) i = Step(i);
    if (std::ranges::all_of(request_.words, [](const UnderstoodWords& row) { return row.as == "filler"; }))
      throw InputError("'" + Joined(0, tokens_.size(), false) +
                       "' says nothing about a town: say what town, as in \"a small coastal town with a church\"");
    return Finish();
  }

 private:
  struct Saying {
    WordLevel level;
    std::string words, means;
    std::function<void(TownDraft&)> apply;
    std::function<bool(const TownDraft&)> holds;  // empty: applying it changes nothing
    int order = 0;                                // within a level
  };
  struct Claim {
    std::string means, words;
  };

  std::string Joined(size_t i, size_t n, bool plain = false) const { return JoinedTokens(tokens_, i, n, plain); }
  // Do the `n` words from i read as `phrase`?
  bool Reads(size_t i, size_t n, std::string_view phrase) const {
    return i + n <= tokens_.size() && (Joined(i, n, true) == phrase || Joined(i, n, false) == phrase);
  }

  void Note(size_t i, size_t n, std::string as) { request_.words.push_back({Joined(i, n, false), std::move(as)}); }

  [[noreturn]] static void Exclude(const std::string& a, const std::string& means_a, const std::string& b, const std::string& means_b) {
    throw InputError("'" + a + "' (" + means_a + ") and '" + b + "' (" + means_b + ") exclude each other");
  }

  // Two words about one subject must mean the same.
  void Agree(const std::string& subject, const std::string& means, const std::string& words) {
    const auto [it, fresh] = claims_.try_emplace(subject, Claim{means, words});
    if (!fresh && it->second.means != means) Exclude(it->second.words, it->second.means, words, means);
  }

  template <class Table, class Key>
  auto Longest(const Table& table, size_t i, size_t& n, const Key& key) const -> decltype(&*table.begin()) {
    for (n = std::min(kMostWords, tokens_.size() - i); n > 0; --n)
      for (const auto& row : table)
        if (Reads(i, n, key(row))) return &row;
    return nullptr;
  }

  size_t Step(size_t i) {
    Refuse(i);
    if (const size_t n = Some(i)) return i + n;
    if (const size_t n = Denied(i)) return i + n;
    if (const size_t n = Measured(i)) return i + n;
    if (const size_t n = Mostly(i)) return i + n;
    // The longest of all that is known.
    size_t words = 0, things = 0, stuffs = 0;
    const TownWord* word = Longest(TownWords(), i, words, [](const TownWord& row) { return row.phrase; });
    const TownThing* thing = Longest(TownThings(), i, things, [](const TownThing& row) { return row.noun; });
    const TownStuff* stuff = Longest(TownStuffs(), i, stuffs, [](const TownStuff& row) { return row.noun; });
    // Pedestrians are people, a pedestrian street is not.
    if (word && stuff && words == stuffs && (tokens_[i].text != tokens_[i].plain || NounAfter(tokens_, i + words).kind == 0))
      word = nullptr;
    if (word && words >= things && words >= stuffs) return Word(i, words, *word);
    if (thing && things >= stuffs) return Thing(i, things, *thing, true);
    if (stuff) return Stuff(i, 0, stuffs, *stuff, 1);
    // One of what there is once is no number; one tree is.
    if (tokens_[i].number == 1.0 && i + 1 < tokens_.size() && Single(i + 1)) {
      Note(i, 1, "filler");
      return i + 1;
    }
    if (IsOneOf(kFillers, tokens_[i].plain) || IsOneOf(kFillers, tokens_[i].text)) {
      Note(i, 1, "filler");
      return i + 1;
    }
    Unknown(i);
  }

  void Refuse(size_t i) const {
    size_t n = 0;
    const Refused* refused = Longest(kRefused, i, n, [](const Refused& row) { return row.words; });
    size_t stop = 0;
    // A bus stop is no bus.
    if (!refused || (Longest(TownThings(), i, stop, [](const TownThing& row) { return row.noun; }) && stop > n)) return;
    throw InputError("'" + Joined(i, n) + "': " + std::string(refused->instead));
  }

  // "mostly brick houses", "mostly of stone": of what a whole town is alike in.
  size_t Mostly(size_t i) {
    if (!IsOneOf(kMostly, tokens_[i].text)) return 0;
    size_t at = i + 1, n = 0;
    while (IsAny(WordAt(at), {"of", "the", "in", "with"})) ++at;
    // "most houses have flat roofs"
    while (IsAny(WordAt(at), {"house", "home", "building", "street", "road", "have", "are", "roof"}) && at + 1 < tokens_.size()) ++at;
    const TownWord* word = at < tokens_.size() ? Longest(TownWords(), at, n, [](const TownWord& row) { return row.phrase; }) : nullptr;
    const bool storeys = NumberAt(at) && IsStoreyWord(WordAt(at + 1));
    if (!storeys && (!word || !IsAny(std::string(word->subject),
                                     {"style", "colours", "roofs", "heights", "paving", "street", "plan", "setback", "apart"})))
      throw InputError("'" + Joined(i, at + 1 - i) + "': '" + tokens_[i].text +
                       "' is said of houses, roofs, storeys and streets, and means all of them; say it without");
    Note(i, 1, "taken as all of them");
    return 1;
  }

  [[noreturn]] void Unknown(size_t i) const {
    if (tokens_[i].number)
      throw InputError(
          "'" + Joined(i, std::min<size_t>(3, tokens_.size() - i)) +
          "': a number of what? Understood are hectares, metres by metres, storeys, houses, people, squares, parks, and per cent of slope");
    size_t n = 0;
    if (i + 1 < tokens_.size() && Longest(kAmounts, i, n, [](const Amount& row) { return row.words; }))
      throw InputError("'" + Joined(i, n + 1) +
                       "': amounts are said of trees, cars, traffic, people, parks and squares; of houses and storeys a number is");
    std::vector<std::string> known;
    for (const TownWord& row : TownWords()) known.emplace_back(row.phrase);
    for (const TownThing& row : TownThings()) known.emplace_back(row.noun);
    for (const TownStuff& row : TownStuffs()) known.emplace_back(row.noun);
    const std::string nearest = NearestChoice(tokens_[i].plain, known);
    throw InputError("the word '" + tokens_[i].text + "' says nothing about towns" +
                     (nearest.empty() ? "" : "; did you mean '" + nearest + "'?") + " (docs/guide/towns.md lists the words)");
  }

  size_t Word(size_t i, size_t n, const TownWord& word) {
    const TownNoun noun = NounAfter(tokens_, i + n);
    if (std::string of; !Suits(word.subject, noun, of))
      throw InputError("'" + Joined(i, noun.end - i, false) + "': '" + Joined(i, n, false) + "' (" + std::string(word.means) +
                       ") is said of " + of + ", not of '" + Joined(noun.end - 1, 1, false) + "'");
    // Kinds may be named again, and parts of one beside them.
    Agree(std::string(word.subject), std::string(word.means), Joined(i, n, false));
    // Degrees bend what the others say.
    const int order = word.subject == "apart" ? -1 : word.subject == "steep" || word.subject == "island" ? 1 : 0;
    said_.push_back({word.level, Joined(i, n, false), std::string(word.means), word.apply, {}, order});
    if (word.holds) said_.back().holds = word.holds;
    if (IsAny(std::string(word.subject), {"bridge", "harbour", "terrace"}))
      request_.promises.push_back({Joined(i, n, false), std::string(word.subject), 1});
    Note(i, n, std::string(word.means));
    return i + n;
  }

  size_t Thing(size_t i, size_t n, const TownThing& thing, bool there) {
    Affirm(thing, i, n, n, there);
    return i + n;
  }

  // The thing's own `n` words end the phrase of `all` words from i on.
  void Affirm(const TownThing& thing, size_t i, size_t all, size_t n, bool there) {
    const std::string means = std::string(thing.setting) + (there ? ": true" : ": false"), words = Joined(i, all, false);
    // "a church, no chapel": what a town has once under several names is there if one of them is wanted.
    const bool also = IsAny(std::string(thing.noun), {"chapel", "cathedral", "bar", "pub"}),
               other = claims_.contains(std::string(thing.setting));
    if (also && !there) {
      Agree(std::string(thing.noun), means, words);
      denied_.emplace_back(&thing, request_.words.size());
    } else {
      if (also) Agree(std::string(thing.noun), means, words);
      Agree(std::string(thing.setting), means, words);
      bool TownSpec::*field = thing.field;
      things_.push_back({WordLevel::kSaid, words, means, [field, there](TownDraft& d) { d.spec.*field = there; }, {}});
      if (there && !other) request_.promises.push_back({words, std::string(thing.setting), 1});
    }
    Note(i + all - n, n, means);
  }

  // `before` words of amount, then the noun.
  size_t Stuff(size_t i, size_t before, size_t n, const TownStuff& stuff, double amount) {
    const bool plural = tokens_[i + before + n - 1].text != tokens_[i + before + n - 1].plain;
    // "parks" alone are two.
    std::string means = std::string(stuff.setting) + " x " + Number(amount);
    // "water, a lake" is one thing.
    Agree(stuff.setting == "water" && amount > 0 ? "some water" : std::string(stuff.setting), means, Joined(i, before + n, false));
    Stuffed(stuff, amount, Joined(i, before + n, false), means);
    if (before == 0 && plural && IsAny(std::string(stuff.setting), {"parks", "squares"}))
      (stuff.setting == "parks" ? parks_ : squares_) = 2;
    Note(i, before + n, means);
    return i + before + n;
  }

  void Stuffed(const TownStuff& stuff, double amount, const std::string& words, const std::string& means) {
    stuffs_.push_back({WordLevel::kSaid, words, means, [set = stuff.set, amount](TownDraft& d) { set(d, amount); }, {}});
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
        Affirm(*thing, i, from + things - i, things, false);
        return things;
      }
      size_t absents = 0;
      const Absent* absent = Longest(kAbsent, from, absents, [](const Absent& row) { return row.noun; });
      if (!stuff && absent) {
        const std::string words = Joined(i, from + absents - i), means(absent->means);
        Agree(std::string(absent->subject), means, words);
        said_.push_back({WordLevel::kSaid, words, means, absent->apply, {}});
        Note(from, absents, means);
        return absents;
      }
      if (!stuff) return 0;
      Agree(std::string(stuff->setting), std::string(stuff->setting) + " x 0", Joined(i, from + stuffs - i, false));
      Stuffed(*stuff, 0, Joined(i, from + stuffs - i, false), std::string(stuff->setting) + " x 0");
      Note(from, stuffs, std::string(stuff->setting) + ": none");
      return stuffs;
    };
    // no buildings over 3 storeys
    if (IsAny(WordAt(at), {"building", "house", "home"}) && NumberAt(at + 1) && tokens_[at + 1].limit == NumberLimit::kOver &&
        IsStoreyWord(WordAt(at + 2))) {
      const double most = *tokens_[at + 1].number;
      return Storeys(i, at + 3 - i, std::max(1.0, std::round(0.3 * most)), most);
    }
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
    for (const Absent& row : kAbsent) list += std::string(row.noun) + ", ";
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
      throw InputError("'" + Joined(i, n) + "': " + Number(value) + " is not from " + Number(low) + " to " + Number(high) + " " + unit);
  }

  // Numbers with what they count, and words before them: words read, 0 = not this.
  size_t Measured(size_t i) {
    if (tokens_[i].number) return Counted(i);
    // streets 8 m wide, a slope of 10 %
    if (IsAny(WordAt(i), {"street", "road", "lane"}) && NumberAt(i + 1) && MetresAt(i + 2) > 0 && WordAt(i + 3) == "wide")
      return Street(i, 4, *tokens_[i + 1].number * MetresAt(i + 2));
    if (IsAny(WordAt(i), {"slope", "gradient", "grade"}) && WordAt(i + 1) == "of" && NumberAt(i + 2) && WordAt(i + 3) == "percent")
      return Slope(i, 4, *tokens_[i + 2].number);
    return 0;
  }

  size_t Counted(size_t i) {
    // Of a range of lengths, areas or people the middle.
    const double least = *tokens_[i].number, value = tokens_[i].upper ? (least + *tokens_[i].upper) / 2 : least;
    const size_t k = i + 1;
    if (tokens_[i].upper && *tokens_[i].upper < least && !IsStoreyWord(WordAt(k)))
      throw InputError("'" + Joined(i, 2) + "': " + Number(least) + " is more than " + Number(*tokens_[i].upper));
    if (const size_t read = Extent(i, value)) return read;
    if (IsStoreyWord(WordAt(k))) {
      const WordToken& token = tokens_[i];
      const size_t n = IsAny(WordAt(k + 1), {"high", "tall"}) ? 3 : 2;
      if (token.upper) return Storeys(i, n, least, *token.upper);
      const bool more = token.limit == NumberLimit::kAtLeast || token.limit == NumberLimit::kOver;
      if (more) {
        const double low = value + (token.limit == NumberLimit::kOver ? 1 : 0);
        Bound(i, n, value, 0, TownSpec::kMostFloors - 1, "storeys");
        return Storeys(i, n, low, std::min(TownSpec::kMostFloors, std::round(1.4 * low) + 1));
      }
      if (token.limit == NumberLimit::kNone) return Storeys(i, n, value, value);
      const double most = value - (token.limit == NumberLimit::kUnder ? 1 : 0);
      return Storeys(i, n, std::max(1.0, std::round(0.3 * most)), most);
    }
    if (const size_t read = Things(i, value)) return read;
    if (WordAt(k) == "percent" && IsAny(WordAt(k + 1), {"slope", "gradient", "grade"})) return Slope(i, 3, value);
    if (MetresAt(k) > 0 && WordAt(k + 1) == "wide" && IsAny(WordAt(k + 2), {"street", "road", "lane"}))
      return Street(i, 4, value * MetresAt(k));
    if (MetresAt(k) > 0 && IsAny(WordAt(k + 1), {"street", "road", "lane"})) return Street(i, 3, value * MetresAt(k));
    return 0;
  }

  std::string WordAt(size_t k) const { return k < tokens_.size() ? tokens_[k].plain : std::string(); }
  bool NumberAt(size_t k) const { return k < tokens_.size() && tokens_[k].number.has_value(); }
  double MetresAt(size_t k) const { return MetresOf(WordAt(k)); }
  // What is there at most once.
  bool Single(size_t at) const {
    size_t n = 0;
    const TownThing* thing = Longest(TownThings(), at, n, [](const TownThing& row) { return row.noun; });
    if (thing)
      return IsAny(std::string(thing->setting), {"church", "castle", "clock_tower", "windmill", "market", "playground", "fountain"}) &&
             thing->noun != "stall";
    const TownWord* word = Longest(TownWords(), at, n, [](const TownWord& row) { return row.phrase; });
    return word && IsAny(std::string(word->subject), {"kind", "terrace", "relief", "water"});
  }

  // Lengths and areas are as said: only these two limits keep to that.
  void Exact(size_t i, size_t n) const {
    if (tokens_[i].limit == NumberLimit::kOver || tokens_[i].limit == NumberLimit::kUnder)
      throw InputError("'" + Joined(i, n) + "': a town is made as large, wide or steep as the number says: give the number alone");
  }

  // "300 m by 400 m", "40 ha", "2 square kilometres".
  size_t Extent(size_t i, double value) {
    const size_t k = i + 1;
    const double unit = MetresAt(k);
    const size_t cross = unit > 0 ? k + 1 : k;
    if (IsAny(WordAt(cross), {"by", "x", "times"}) && NumberAt(cross + 1)) {
      const double after = MetresAt(cross + 2), of_both = after > 0 ? after : 1, first = unit > 0 ? unit : of_both;
      const size_t n = cross + 2 + (after > 0 ? 1 : 0) - i;
      const double second = after > 0 ? after : first;
      const double sides[] = {value * first, *tokens_[cross + 1].number * second};
      for (double side : sides) Bound(i, n, side, TownSpec::kLeastSide, TownSpec::kMostSide, "m");
      Exact(i, n);
      return Size(i, n, sides[0], sides[1]);
    }
    const auto [square, words] = SquareMetresAt(tokens_, k);
    if (words == 0) return 0;
    const double hectares = value * square / 1e4;
    const size_t n = 1 + words;
    if (!std::isfinite(hectares)) throw InputError("'" + Joined(i, n) + "' is not from 1.5 to 144 hectares");
    Bound(i, n, hectares, 1.5, 144, "hectares");
    Exact(i, n);
    const double wide = std::min(std::sqrt(hectares * 1e4 * 1.12), TownSpec::kMostSide);
    return Size(i, n, wide, hectares * 1e4 / wide);
  }

  // Houses, people, parks and squares.
  size_t Things(size_t i, double said) {
    const size_t k = i + 1;
    const NumberLimit limit = tokens_[i].limit;
    const double value = said + (limit == NumberLimit::kOver ? 1 : limit == NumberLimit::kUnder ? -1 : 0);
    const std::optional<double> upper = tokens_[i].upper;
    // "12 wooden houses": the adjectives are read on their own.
    size_t noun = k;
    for (size_t n = 0; noun < tokens_.size() && !tokens_[noun].breaks && noun < k + 3; noun += n) {
      const TownWord* word = Longest(TownWords(), noun, n, [](const TownWord& row) { return row.phrase; });
      if (!word || !IsAny(std::string(word->subject), {"style", "colours", "heights", "setback", "apart", "size", "age", "place"})) break;
    }
    if (IsAny(WordAt(noun), {"house", "home", "building", "cabin", "hut", "cottage"})) {
      const bool alone = noun > k || IsAny(WordAt(k), {"cabin", "hut"});
      const size_t n = noun + 1 - i;
      const double most = upper ? *upper : value, least = upper ? *tokens_[i].number : value;
      Whole(i, most, 1, 4000, "houses", n);
      Whole(i, least, 1, 4000, "houses", n);
      Agree("houses in numbers", "houses: " + Number(most), Joined(i, n));
      houses_ = most;
      // At most so many is what the setting means.
      if (limit != NumberLimit::kMost && limit != NumberLimit::kUnder)
        request_.promises.push_back({Joined(i, n), "houses", static_cast<uint64_t>(least)});
      Note(i, alone ? 1 : 2, "houses: " + Number(most));
      return alone ? 1 : 2;
    }
    if (IsAny(WordAt(k), {"people", "inhabitant", "resident", "pedestrian", "person", "citizen"})) {
      Whole(i, value, 1, 100000, "people");
      Agree("people", "people: " + Number(value), Joined(i, 2));
      people_ = value <= kPopulation ? value : std::min(value / 20, kMostPeople);
      if (value > kPopulation) population_ = value;
      Note(i, 2, value <= kPopulation ? "people: " + Number(value) : "people: " + Number(std::round(people_)) + " of them outside");
      return 2;
    }
    if (IsAny(WordAt(k), {"park", "square", "plaza"}) && !IsAny(WordAt(k + 1), {"kilometre", "kilometer", "km", "metre", "meter", "m"})) {
      const bool park = WordAt(k) == "park";
      // Of two to three parks two.
      const double value = upper ? *tokens_[i].number : said + (limit == NumberLimit::kOver ? 1 : limit == NumberLimit::kUnder ? -1 : 0);
      Whole(i, value, 1, park ? 6 : 4, park ? "parks" : "squares");
      Agree(park ? "parks" : "squares", Number(value), Joined(i, 2));
      (park ? parks_ : squares_) = value;
      request_.promises.push_back({Joined(i, 2), park ? "parks" : "squares", static_cast<uint64_t>(value)});
      Note(i, 2, (park ? "parks: " : "squares: ") + Number(value));
      return 2;
    }
    return 0;
  }

  void Whole(size_t i, double value, double low, double high, const char* what, size_t n = 2) const {
    Bound(i, n, value, low, high, what);
    if (value != std::round(value)) throw InputError("'" + Joined(i, n) + "': " + Number(value) + " is no whole number");
  }

  size_t Size(size_t i, size_t n, double width, double depth) {
    const std::string means = "width: " + Number(std::round(width)) + ", depth: " + Number(std::round(depth));
    Agree("size in numbers", means, Joined(i, n));
    width_ = std::round(width);
    depth_ = std::round(depth);
    Note(i, n, means);
    return n;
  }

  size_t Storeys(size_t i, size_t n, double least, double most) {
    for (double floors : {least, most}) {
      Bound(i, n, floors, 1, TownSpec::kMostFloors, "storeys");
      if (floors != std::round(floors)) throw InputError("'" + Joined(i, n) + "': " + Number(floors) + " is no whole number");
    }
    if (least > most) throw InputError("'" + Joined(i, n) + "': " + Number(least) + " is more than " + Number(most));
    const std::string means = "floors: " + Number(least) + " to " + Number(most);
    Agree("floors in numbers", means, Joined(i, n));
    least_ = least;
    most_ = most;
    Note(i, n, means);
    return n;
  }

  size_t Slope(size_t i, size_t n, double value) {
    Bound(i, n, value, 0, 24, "per cent");
    Exact(i, n);
    const std::string means = value > 0 ? "climb: " + Number(value) + " % of the depth" : "relief: flat";
    Agree("slope in numbers", means, Joined(i, n));
    slope_ = value / 100;
    Note(i, n, means);
    return n;
  }

  size_t Street(size_t i, size_t n, double value) {
    Bound(i, n, value, 4, 40, "m");
    Exact(i, n);
    const std::string means = "street: " + Number(value);
    Agree("street in numbers", means, Joined(i, n));
    street_ = value;
    Note(i, n, means);
    return n;
  }

  TownRequest Finish() {
    TownDraft draft;
    TownSpec& spec = draft.spec;
    spec.country = TownCountry::kFields;
    std::stable_sort(said_.begin(), said_.end(),
                     [](const Saying& a, const Saying& b) { return a.level != b.level ? a.level < b.level : a.order < b.order; });
    said_.insert(said_.end(), stuffs_.begin(), stuffs_.end());
    said_.insert(said_.end(), things_.begin(), things_.end());
    for (const auto& [thing, note] : denied_) {
      if (claims_.contains(std::string(thing->setting)))
        request_.words[note].as = "none beside the " + claims_.at(std::string(thing->setting)).words;
      else
        spec.*(thing->field) = false,
        said_.push_back({WordLevel::kSaid, "", "", [field = thing->field](TownDraft& d) { d.spec.*field = false; }, {}});
    }
    for (const Saying& saying : said_) saying.apply(draft);
    CheckSayings(draft);
    CheckNumbers(draft);
    if (most_ > 0) spec.least_floors = least_, spec.most_floors = most_;
    if (parks_ >= 0) spec.parks = static_cast<uint64_t>(parks_);
    if (squares_ >= 0) spec.squares = static_cast<uint64_t>(squares_);
    if (houses_ > 0) spec.houses = static_cast<uint64_t>(houses_);
    Sides(draft);
    Bring(spec);
    if (slope_ >= 0) spec.relief = slope_ > 0 ? TownRelief::kSlope : TownRelief::kFlat, spec.climb = slope_ * spec.depth;
    const double steepest = std::min(0.24 * std::min(spec.width, spec.depth), TownSpec::kMostClimb);
    if (slope_ >= 0 && spec.climb > steepest)
      throw InputError("'" + claims_.at("slope in numbers").words + "' climbs " + Number(std::round(spec.climb)) + " m in a town of " +
                       Number(spec.width) + " x " + Number(spec.depth) + " m: at most " + Number(std::floor(steepest)) + " m are possible");
    spec.climb = std::round(std::min(spec.climb, steepest));
    if (spec.country == TownCountry::kFields && spec.most_floors > 8) spec.country = TownCountry::kCity;
    spec.Check("");
    request_.spec = spec;
    Weather(draft);
    request_.sized = width_ > 0;
    request_.people = static_cast<uint64_t>(
        std::round(people_ > 0              ? people_
                   : draft.people_share > 0 ? std::clamp(draft.people_share * spec.width * spec.depth / kPersonEach, 4.0, kMostPeople)
                                            : 0));
    return std::move(request_);
  }

  // A preset, over which clouds, fog, rain and snow of others are laid.
  void Weather(const TownDraft& draft) {
    const bool early = draft.time == "dawn" || draft.time == "sunrise";
    request_.weather = draft.time == "dawn" ? "dusk" : draft.time == "sunrise" ? "sunset" : draft.time;
    if (request_.weather.empty() && !draft.airs.empty()) request_.weather = *draft.airs.rbegin();
    if (early) request_.environment.emplace_back("sun_azimuth_deg", 75);
    if (draft.airs.size() + (draft.time.empty() ? 0 : 1) < 2) return;
    for (const EnvironmentField& field : EnvironmentFields()) {
      static constexpr std::string_view kOfAirs[] = {"cloud_cover", "cirrus_cover", "visibility_m", "wetness",
                                                     "snow_depth",  "rain_mm_h",    "snowfall_mm_h"};
      if (!IsOneOf(std::span(kOfAirs), field.name)) continue;
      double most = 0, least = 1e9;
      for (const std::string& air : draft.airs) {
        const double value = ParseEnvironmentPreset(air, {}).*field.value;
        most = std::max(most, value);
        if (value > 0) least = std::min(least, value);
      }
      // The thickest fog is that of the shortest sight.
      const bool sight = std::string_view(field.name) == "visibility_m" && most > 0;
      request_.environment.emplace_back(field.name, sight ? least : most);
    }
  }

  // What needs something else brings it along, unless that was denied.
  void Bring(TownSpec& spec) const {
    if (spec.arches && !claims_.contains("street") && !claims_.contains("boulevard")) spec.street = std::min(spec.street, kLaneStreet);
    if (spec.most_floors > 8)
      spec.street = std::max(spec.street, 15.0), spec.block = std::max(spec.block, 76.0), spec.setback = std::min(spec.setback, 6.0);
    // Rows of trees stand on pavements of 2.6 m and more.
    if (claims_.contains("tree lined") && !spec.palms && street_ <= 0) spec.street = std::max(spec.street, 15.0);
    if (street_ > 0) spec.street = street_;
    if (spec.harbour && spec.water == TownWater::kNone && !claims_.contains("water") && !claims_.contains("sea"))
      spec.water = TownWater::kSea;
    if ((spec.market || spec.fountain || spec.clock_tower) && spec.squares == 0 && !claims_.contains("squares")) spec.squares = 1;
    if (spec.terrace && most_ <= 0 && !(claims_.contains("heights") && spec.most_floors >= 6))
      spec.most_floors = std::max(spec.most_floors, 10.0);
    if (spec.playground) spec.parks = std::max<uint64_t>(spec.parks, claims_.contains("parks") ? spec.parks : 1);
  }

  static std::string Described(const TownDraft& draft) {
    TownSpec spec = draft.spec;
    return DescribeConfig([&](ConfigVisitor& v) { spec.Visit(v); }) + draft.time + Number(draft.people_share) +
           std::accumulate(draft.airs.begin(), draft.airs.end(), std::string());
  }

  // Nothing that was said may be undone by what else was said.
  void CheckSayings(const TownDraft& draft) const {
    const auto undone = [](const Saying& saying, const TownDraft& by) {
      if (saying.level != WordLevel::kSaid) return false;
      if (saying.holds) return !saying.holds(by);
      TownDraft again = by;
      saying.apply(again);
      return Described(again) != Described(by);
    };
    for (const Saying& a : said_) {
      if (!undone(a, draft)) continue;
      for (const Saying& b : said_) {
        TownDraft both = draft;
        a.apply(both);
        b.apply(both);
        if (b.level == WordLevel::kSaid && undone(a, both)) Exclude(a.words, a.means, b.words, b.means);
      }
    }
  }

  void CheckNumbers(const TownDraft& draft) const {
    const auto exclude = [&](const char* a, const char* b) {
      Exclude(claims_.at(a).words, claims_.at(a).means, claims_.at(b).words, claims_.at(b).means);
    };
    if (claims_.contains("heights") && most_ > 0) {
      const bool low = claims_.at("heights").words.starts_with("low");
      if ((low && least_ > 5) || (!low && most_ < 4)) exclude("heights", "floors in numbers");
    }
    if (claims_.contains("terrace") && most_ > 0 && most_ < 6) exclude("terrace", "floors in numbers");
    if (claims_.contains("terrace") && claims_.contains("heights") && most_ <= 0 && draft.spec.most_floors < 6)
      exclude("terrace", "heights");
    if (claims_.contains("relief") && slope_ >= 0 && draft.spec.relief != (slope_ > 0 ? TownRelief::kSlope : TownRelief::kFlat))
      exclude("relief", "slope in numbers");
    if (claims_.contains("steep") && slope_ >= 0 && (slope_ > 0.1) != (claims_.at("steep").words == "steep"))
      exclude("steep", "slope in numbers");
    if (claims_.contains("street") && street_ > 0 && (claims_.at("street").words == "narrow" ? street_ > 10 : street_ < 10))
      exclude("street", "street in numbers");
    if (claims_.contains("boulevard") && street_ > 0 && street_ < 18) exclude("boulevard", "street in numbers");
    if (claims_.contains("no tall") && most_ > 4) exclude("no tall", "floors in numbers");
    if (claims_.contains("no tall") && claims_.contains("terrace")) exclude("no tall", "terrace");
    if (claims_.contains("no tall") && claims_.contains("heights") && !claims_.at("heights").words.starts_with("low"))
      exclude("no tall", "heights");
    if (claims_.contains("tree lined") && claims_.contains("street") && claims_.at("street").words == "narrow")
      exclude("tree lined", "street");
    if (claims_.contains("tree lined") && street_ > 0 && street_ < 14.5) exclude("tree lined", "street in numbers");
    if (claims_.contains("tree lined") && draft.spec.paving == TownPaving::kDirt)
      throw InputError("'" + claims_.at("tree lined").words + "': tracks of earth have no pavements for trees; say 'paved'");
    if (const TownWater water = draft.spec.water;
        claims_.contains("middle") && water != TownWater::kRiver && water != TownWater::kCanal && water != TownWater::kLake)
      throw InputError("'" + claims_.at("middle").words +
                       "': of what? Understood are a river or a canal through the middle, and a lake in the middle");
    if (claims_.contains("crowd") && people_ > 0 && draft.people_share < 0) exclude("crowd", "people");
    if (claims_.contains("playground") && draft.spec.playground && claims_.contains("parks") && parks_ < 0 && draft.spec.parks == 0)
      exclude("playground", "parks");
  }

  void Sides(TownDraft& draft) {
    TownSpec& spec = draft.spec;
    if (width_ > 0) {
      for (UnderstoodWords& row : request_.words)
        if (row.as.starts_with("sides x")) row.as = "as large as " + claims_.at("size in numbers").words;
      spec.width = width_;
      spec.depth = depth_;
      return;
    }
    if (population_ > 0) spec.width = std::sqrt(population_ * 60 * 1.12), spec.depth = population_ * 60 / spec.width;
    const auto fit = [&](double side) { return std::round(std::clamp(side * draft.scale, TownSpec::kLeastSide, TownSpec::kMostSide)); };
    spec.width = fit(spec.width);
    spec.depth = fit(spec.depth);
  }

  std::vector<WordToken> tokens_;
  TownRequest request_;
  std::map<std::string, Claim> claims_;
  std::vector<Saying> said_, stuffs_, things_;
  std::vector<std::pair<const TownThing*, size_t>> denied_;  // and its place in the report
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
