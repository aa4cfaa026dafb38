#include "airsim360/base/nearest_name.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <vector>

#include "airsim360/base/error.h"

namespace airsim360 {
namespace {

using internal::EditDistance;
using internal::SameMeaning;

constexpr size_t kLongest = 256;  // characters of a word that count
constexpr size_t kShortestPart = 3;
// Words that say nothing about which name is meant.
constexpr auto kFillers = std::to_array<std::string_view>(
    {"file", "folder", "dir", "directory", "path", "name", "number", "num", "of", "the", "no", "max", "min", "deg"});

bool IsAlnum(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; }
bool IsUpper(char c) { return std::isupper(static_cast<unsigned char>(c)) != 0; }
char Lower(char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); }

// "entities" → "entity", "boxes" → "box", "normals" → "normal"; "s" that belongs to the word stays.
std::string Singular(std::string word) {
  const auto ends = [&](std::string_view end) { return word.size() > end.size() + 1 && word.ends_with(end); };
  if (ends("ies")) return word.replace(word.size() - 3, 3, "y");
  if (ends("xes") || ends("ches") || ends("shes") || ends("sses")) return word.erase(word.size() - 2);
  if (word.size() > 3 && ends("s") && !ends("ss") && !ends("us") && !ends("is")) word.pop_back();
  return word;
}

// "waving" and "wave" as one.
std::string_view Stem(std::string_view word) {
  if (word.size() > 5 && word.ends_with("ing")) return word.substr(0, word.size() - 3);
  return word.size() > 3 && word.ends_with("e") ? word.substr(0, word.size() - 1) : word;
}

// A name as it is compared.
struct Name {
  std::string plain;               // lower case, letters and digits alone, singular
  std::vector<std::string> parts;  // words of it, apart by other characters or a capital: "FovDegrees", "box_room"

  explicit Name(std::string_view text) {
    std::string part;
    const auto finish = [&] {
      if (!part.empty()) parts.push_back(Singular(std::move(part)));
      part.clear();
    };
    for (size_t i = 0; i < text.size(); ++i) {
      if (!IsAlnum(text[i])) {
        finish();
        continue;
      }
      if (i > 0 && IsUpper(text[i]) && IsAlnum(text[i - 1]) && !IsUpper(text[i - 1])) finish();
      part += Lower(text[i]);
      plain += Lower(text[i]);
    }
    finish();
    plain = Singular(std::move(plain));
  }

  std::string Initials() const {
    std::string initials;
    for (const std::string& part : parts) initials += part[0];
    return initials;
  }
};

bool BeginsWith(std::string_view whole, std::string_view start) { return start.size() >= kShortestPart && whole.starts_with(start); }

// A letter in three may be wrong; in words of up to three letters one that is not the first, or two change places.
bool FewEdits(const Name& a, const Name& b) {
  const size_t longest = std::max(a.plain.size(), b.plain.size()), shortest = std::min(a.plain.size(), b.plain.size());
  if (shortest < 2 || longest - shortest > std::max<size_t>(longest / 3, 1)) return false;
  if (longest <= kShortestPart && a.plain[0] != b.plain[0] && !std::ranges::is_permutation(a.plain, b.plain)) return false;
  return EditDistance(a.plain, b.plain) <= std::clamp<size_t>(longest / 3, 1, 4);
}

// A word of `word` that is, or means, the whole of `choice`, or a word of it.
bool SharesPart(const Name& word, const Name& choice, bool whole) {
  for (const std::string& part : word.parts) {
    if (std::ranges::count(kFillers, part) > 0) continue;
    if (part == choice.plain || SameMeaning(part, choice.plain)) return true;
    if (!whole && part.size() >= kShortestPart && std::ranges::count(choice.parts, part) > 0) return true;
  }
  return false;
}

// Ways in which a choice can be meant, the surest first; the first that any choice satisfies decides.
constexpr auto kWays = std::to_array<bool (*)(const Name&, const Name&)>({
    [](const Name& word, const Name& choice) { return word.plain == choice.plain; },
    [](const Name& word, const Name& choice) { return SameMeaning(word.plain, choice.plain); },
    [](const Name& word, const Name& choice) {
      return std::min(word.plain.size(), choice.plain.size()) > kShortestPart && EditDistance(word.plain, choice.plain) == 1;
    },
    [](const Name& word, const Name& choice) { return BeginsWith(choice.plain, word.plain) || BeginsWith(word.plain, choice.plain); },
    [](const Name& word, const Name& choice) { return Stem(word.plain) == Stem(choice.plain); },
    [](const Name& word, const Name& choice) { return word.plain.size() > 1 && word.plain == choice.Initials(); },
    [](const Name& word, const Name& choice) { return SharesPart(word, choice, true); },
    [](const Name& word, const Name& choice) { return SharesPart(word, choice, false); },
    FewEdits,
});

}  // namespace

namespace internal {

size_t EditDistance(std::string_view a, std::string_view b) {
  // Rows i - 2, i - 1 and i of the table of distances of the prefixes (optimal string alignment).
  std::array<std::vector<size_t>, 3> rows;
  for (auto& row : rows) row.assign(b.size() + 1, 0);
  for (size_t j = 0; j <= b.size(); ++j) rows[0][j] = j;
  for (size_t i = 1; i <= a.size(); ++i) {
    std::vector<size_t>& row = rows[i % 3];
    const std::vector<size_t>&above = rows[(i + 2) % 3], &above_that = rows[(i + 1) % 3];
    row[0] = i;
    for (size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min({above[j] + 1, row[j - 1] + 1, above[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) row[j] = std::min(row[j], above_that[j - 2] + 1);
    }
  }
  return rows[a.size() % 3][b.size()];
}

}  // namespace internal

std::string NearestChoice(std::string_view word, std::span<const std::string> choices) {
  const Name meant(word.substr(0, kLongest));
  if (meant.plain.empty()) return {};
  std::vector<Name> names(choices.begin(), choices.end());
  for (const auto& way : kWays) {
    // Of several, the one with the fewest edits.
    const std::string* best = nullptr;
    size_t fewest = 0;
    for (size_t i = 0; i < names.size(); ++i) {
      if (names[i].plain.empty() || names[i].plain.size() > kLongest || !way(meant, names[i])) continue;
      const size_t edits = EditDistance(meant.plain, names[i].plain);
      if (best != nullptr && edits >= fewest) continue;
      best = &choices[i];
      fewest = edits;
    }
    if (best != nullptr) return *best;
  }
  return {};
}

std::string DidYouMean(std::string_view word, std::span<const std::string> choices) {
  const std::string nearest = NearestChoice(word, choices);
  return nearest.empty() ? std::string() : "; did you mean '" + nearest + "'?";
}

}  // namespace airsim360
