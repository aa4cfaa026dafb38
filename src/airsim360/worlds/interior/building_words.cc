#include "airsim360/worlds/interior/building_words.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "airsim360/base/error.h"
#include "airsim360/base/nearest_name.h"

namespace airsim360 {
namespace {

constexpr size_t kLongest = 1000;

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
                                               {"warehouse", BuildingUse::kWarehouse},
                                               {"storage hall", BuildingUse::kWarehouse},
                                               {"mall", BuildingUse::kMall},
                                               {"shopping mall", BuildingUse::kMall},
                                               {"shopping centre", BuildingUse::kMall},
                                               {"shopping center", BuildingUse::kMall},
                                               {"car park", BuildingUse::kCarPark},
                                               {"parking garage", BuildingUse::kCarPark},
                                               {"multi storey car park", BuildingUse::kCarPark},
                                               {"library", BuildingUse::kLibrary}});
constexpr auto kFillers =
    std::to_array<std::string_view>({"a",      "an",  "the",  "with",   "and",  "of",     "in",     "on",       "its",  "it",     "that",
                                     "which",  "has", "have", "having", "is",   "are",    "very",   "building", "make", "create", "build",
                                     "please", "me",  "high", "wide",   "deep", "modern", "public", "all",      "some"});
// Words of a place out of doors: such descriptions are of towns.
constexpr auto kTowns = std::to_array<std::string_view>({"town", "city", "village", "street", "streets", "suburb", "downtown", "hamlet",
                                                         "settlement", "harbour", "island", "forest", "cabins", "houses", "towers"});
constexpr auto kNumbers = std::to_array<std::pair<std::string_view, double>>({{"one", 1},
                                                                              {"single", 1},
                                                                              {"two", 2},
                                                                              {"three", 3},
                                                                              {"four", 4},
                                                                              {"five", 5},
                                                                              {"six", 6},
                                                                              {"seven", 7},
                                                                              {"eight", 8},
                                                                              {"ten", 10},
                                                                              {"twenty", 20},
                                                                              {"fifty", 50},
                                                                              {"hundred", 100}});
constexpr auto kStoreys = std::to_array<std::string_view>(
    {"storey", "storeys", "story", "stories", "storied", "floor", "floors", "level", "levels", "deck", "decks"});
constexpr auto kPeople = std::to_array<std::string_view>({"people", "persons", "visitors", "workers", "shoppers", "readers"});

struct Setting {
  std::string_view words, as;
  void (*set)(BuildingSpec&);
};
constexpr auto kSettings = std::to_array<Setting>({
    {"atrium", "atrium: true", [](BuildingSpec& s) { s.atrium = true; }},
    {"cluttered", "clutter: 1.5", [](BuildingSpec& s) { s.clutter = 1.5; }},
    {"messy", "clutter: 1.5", [](BuildingSpec& s) { s.clutter = 1.5; }},
    {"busy", "clutter: 1.3", [](BuildingSpec& s) { s.clutter = 1.3; }},
    {"tidy", "clutter: 0.4", [](BuildingSpec& s) { s.clutter = 0.4; }},
    {"empty", "clutter: 0", [](BuildingSpec& s) { s.clutter = 0; }},
    {"open doors", "open_doors: 1", [](BuildingSpec& s) { s.open_doors = 1; }},
    {"closed doors", "open_doors: 0", [](BuildingSpec& s) { s.open_doors = 0; }},
});

std::vector<std::string> Split(std::string_view text) {
  std::vector<std::string> words;
  std::string word;
  const auto end = [&] {
    if (!word.empty()) words.push_back(std::move(word));
    word.clear();
  };
  for (const char c : text) {
    const auto u = static_cast<unsigned char>(c);
    if (std::isalnum(u) || c == '.')
      word += static_cast<char>(std::tolower(u));
    else
      end();
  }
  end();
  for (std::string& w : words)
    while (w.size() > 1 && w.back() == '.') w.pop_back();
  return words;
}

template <class List>
bool IsIn(const List& list, std::string_view word) {
  return std::find(list.begin(), list.end(), word) != list.end();
}

std::optional<double> NumberOf(const std::string& word) {
  for (const auto& [name, value] : kNumbers)
    if (name == word) return value;
  double value = 0;
  const auto [stop, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || !std::isfinite(value) || value < 0 || value > 1e6) return std::nullopt;
  if (stop == word.data() + word.size()) return value;
  return std::string_view(stop) == "m" ? std::optional(value) : std::nullopt;
}

class Reader {
 public:
  explicit Reader(std::vector<std::string> words) : words_(std::move(words)) {}

  bool IsOfBuilding() const {
    bool building = false;
    for (size_t i = 0; i < words_.size(); ++i) {
      if (IsIn(kTowns, words_[i])) return false;
      for (const UseWord& use : kUses) building = building || Matches(use.words, i) > 0;
    }
    return building;
  }

  BuildingRequest Read() {
    while (at_ < words_.size())
      if (!Use() && !Measures() && !Storeys() && !Applied() && !Filler()) Refuse();
    // Malls and libraries of several storeys have their hall in any case.
    if (request_.spec.atrium && request_.spec.storeys == 0 && request_.spec.Settled().storeys < 2) request_.spec.storeys = 2;
    request_.spec.Check("");
    return std::move(request_);
  }

 private:
  // Words of a phrase that stand at i; 0 = not all of them do.
  size_t Matches(std::string_view phrase, size_t i) const {
    const std::vector<std::string> wanted = Split(phrase);
    if (i + wanted.size() > words_.size() || !std::equal(wanted.begin(), wanted.end(), words_.begin() + static_cast<std::ptrdiff_t>(i)))
      return 0;
    return wanted.size();
  }
  void Took(size_t count, std::string as) {
    std::string text;
    for (size_t i = 0; i < count; ++i) text += (i ? " " : "") + words_[at_ + i];
    request_.words.emplace_back(std::move(text), std::move(as));
    at_ += count;
  }

  bool Use() {
    const UseWord* longest = nullptr;
    for (const UseWord& use : kUses)
      if (const size_t n = Matches(use.words, at_); n > 0 && (!longest || n > Split(longest->words).size())) longest = &use;
    if (!longest) return false;
    if (used_ && request_.spec.use != longest->use)
      throw InputError(std::string("one building has one use: both '") + std::string(*used_) + "' and '" + std::string(longest->words) +
                       "' are named");
    used_ = longest->words;
    request_.spec.use = longest->use;
    Took(Split(longest->words).size(), std::string("use: ") + kBuildingUses[static_cast<size_t>(longest->use)]);
    return true;
  }

  // "40 x 30 m".
  bool Measures() {
    if (at_ + 2 >= words_.size() || (words_[at_ + 1] != "x" && words_[at_ + 1] != "by")) return false;
    const auto width = NumberOf(words_[at_]), depth = NumberOf(words_[at_ + 2]);
    if (!width || !depth) return false;
    request_.spec.width = *width;
    request_.spec.depth = *depth;
    const bool unit = at_ + 3 < words_.size() && (words_[at_ + 3] == "m" || words_[at_ + 3] == "metres" || words_[at_ + 3] == "meters");
    Took(unit ? 4 : 3, "width: " + words_[at_] + ", depth: " + words_[at_ + 2]);
    return true;
  }

  bool Storeys() {
    const auto number = NumberOf(words_[at_]);
    if (!number || at_ + 1 >= words_.size()) return false;
    const bool storeys = IsIn(kStoreys, words_[at_ + 1]), people = IsIn(kPeople, words_[at_ + 1]);
    if (!storeys && !people) return false;
    if (*number != std::floor(*number) || (people && *number > 400))
      throw InputError("'" + words_[at_] + " " + words_[at_ + 1] + "': not a whole number from 1 to 400");
    if (storeys)
      request_.spec.storeys = static_cast<uint64_t>(*number);
    else
      request_.people = static_cast<uint64_t>(*number);
    Took(2, (storeys ? "storeys: " : "people: ") + std::to_string(static_cast<uint64_t>(*number)));
    return true;
  }

  bool Applied() {
    for (const Setting& setting : kSettings) {
      const size_t n = Matches(setting.words, at_);
      if (n == 0) continue;
      setting.set(request_.spec);
      Took(n, std::string(setting.as));
      return true;
    }
    return false;
  }

  bool Filler() {
    if (!IsIn(kFillers, words_[at_])) return false;
    Took(1, "filler");
    return true;
  }

  [[noreturn]] void Refuse() const {
    std::vector<std::string> known;
    for (const UseWord& use : kUses) known.emplace_back(use.words);
    for (const Setting& setting : kSettings) known.emplace_back(setting.words);
    for (const auto& list : kStoreys) known.emplace_back(list);
    for (const auto& list : kPeople) known.emplace_back(list);
    throw InputError("'" + words_[at_] + "' says nothing about a building" + DidYouMean(words_[at_], known));
  }

  std::vector<std::string> words_;
  size_t at_ = 0;
  std::optional<std::string_view> used_;
  BuildingRequest request_;
};

}  // namespace

std::optional<BuildingRequest> BuildingFromWords(std::string_view description) {
  if (description.size() > kLongest) return std::nullopt;
  Reader reader(Split(description));
  if (!reader.IsOfBuilding()) return std::nullopt;
  return reader.Read();
}

}  // namespace airsim360
