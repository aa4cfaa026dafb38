#include "airsim360/assets/labels/words.h"

#include <algorithm>

namespace airsim360::internal {
namespace {

bool IsLower(char c) { return c >= 'a' && c <= 'z'; }
bool IsUpper(char c) { return c >= 'A' && c <= 'Z'; }
bool IsLetter(char c) { return IsLower(c) || IsUpper(c) || static_cast<unsigned char>(c) >= 0x80; }

// English plurals, roughly: leaves, benches, buses, cities, cars; not glass, bus, grass.
std::string Singular(std::string word) {
  const auto ends = [&](std::string_view end) { return word.size() > end.size() + 1 && word.ends_with(end); };
  if (word == "leaves") return "leaf";
  if (word == "buses") return "bus";
  if (word == "bus" || word == "canvas" || word == "gas" || word == "moss" || ends("ss") || ends("us")) return word;
  if (ends("ies")) return word.substr(0, word.size() - 3) + "y";
  if (ends("ches") || ends("shes") || ends("xes") || ends("sses") || ends("uses")) {
    return word == "houses" ? "house" : word.substr(0, word.size() - 2);
  }
  if (ends("s") && word.size() > 3) word.pop_back();
  return word;
}

}  // namespace

std::vector<std::string> SplitWords(std::string_view name) {
  std::vector<std::string> words;
  std::string word;
  const auto finish = [&] {
    if (!word.empty()) words.push_back(Singular(word));
    word.clear();
  };
  for (size_t i = 0; i < name.size(); ++i) {
    const char c = name[i];
    // A new word begins at aB, and at the B of ABc.
    const bool after_lower = i > 0 && IsLower(name[i - 1]);
    const bool before_lower = i + 1 < name.size() && IsLower(name[i + 1]) && i > 0 && IsUpper(name[i - 1]);
    if (!IsLetter(c) || (IsUpper(c) && (after_lower || before_lower))) finish();
    if (IsLetter(c)) word += IsUpper(c) ? static_cast<char>(c - 'A' + 'a') : c;
  }
  finish();
  return words;
}

bool HasWord(const std::vector<std::string>& words, std::initializer_list<std::string_view> wanted) {
  return std::any_of(words.begin(), words.end(),
                     [&](const std::string& word) { return std::find(wanted.begin(), wanted.end(), word) != wanted.end(); });
}

}  // namespace airsim360::internal
