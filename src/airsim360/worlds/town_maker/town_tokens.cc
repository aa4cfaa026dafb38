#include "airsim360/worlds/town_maker/town_tokens.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <utility>

namespace airsim360::internal {
namespace {

constexpr char kBreak = '\x01';

constexpr auto kUnits = std::to_array<std::pair<std::string_view, double>>(
    {{"one", 1}, {"single", 1}, {"two", 2}, {"three", 3}, {"four", 4}, {"five", 5}, {"six", 6}, {"seven", 7}, {"eight", 8}, {"nine", 9}});
constexpr auto kTeens = std::to_array<std::pair<std::string_view, double>>({{"zero", 0},
                                                                            {"ten", 10},
                                                                            {"eleven", 11},
                                                                            {"twelve", 12},
                                                                            {"thirteen", 13},
                                                                            {"fourteen", 14},
                                                                            {"fifteen", 15},
                                                                            {"sixteen", 16},
                                                                            {"seventeen", 17},
                                                                            {"eighteen", 18},
                                                                            {"nineteen", 19}});
constexpr auto kTens = std::to_array<std::pair<std::string_view, double>>(
    {{"twenty", 20}, {"thirty", 30}, {"forty", 40}, {"fifty", 50}, {"sixty", 60}, {"seventy", 70}, {"eighty", 80}, {"ninety", 90}});
constexpr auto kLots = std::to_array<std::pair<std::string_view, double>>({{"dozen", 12}, {"hundred", 100}, {"thousand", 1000}});

constexpr auto kStoreyNouns = std::to_array<std::string_view>({"storey", "story", "floor", "level", "storeyed", "storied"});

template <class Table>
std::optional<double> In(const Table& table, std::string_view word) {
  for (const auto& [name, value] : table)
    if (name == word) return value;
  return std::nullopt;
}

// "houses" and "house", "cities" and "city", "churches" and "church".
std::string TownSingular(std::string word) {
  const auto ends = [&](std::string_view end) { return word.size() > end.size() + 1 && word.ends_with(end); };
  if (ends("ies") && word.size() > 4) return word.replace(word.size() - 3, 3, "y");
  if (ends("ches") || ends("shes") || ends("sses") || ends("xes")) return word.erase(word.size() - 2);
  if (word.size() > 3 && ends("s") && !ends("ss") && !ends("us") && !ends("is")) word.pop_back();
  return word;
}

bool DigitAt(std::string_view text, size_t i) { return i < text.size() && std::isdigit(static_cast<unsigned char>(text[i])); }

// Of a comma at i: "10,000" has none, "1,5" is a decimal point, any other parts words.
std::string Comma(std::string_view text, size_t i) {
  size_t after = 0;
  while (DigitAt(text, i + 1 + after)) ++after;
  if (i == 0 || !DigitAt(text, i - 1) || after == 0) return std::string(1, kBreak);
  return after == 3 ? "" : ".";
}

// Lower case letters, digits and points; letters with accents as they are without. A minus stays where a number begins
// with it, so that the bounds of the number can refuse it.
std::string PlainText(std::string_view text) {
  static constexpr std::pair<std::string_view, std::string_view> kSigns[] = {
      {"é", "e"}, {"è", "e"}, {"ç", "c"}, {"ã", "a"}, {"á", "a"},      {"ü", "u"},      {"ö", "o"},
      {"ä", "a"}, {"ñ", "n"}, {"²", "2"}, {"×", "x"}, {"\u2212", "-"}, {"\u2013", "-"}, {"\u2014", " "}};
  std::string even;
  for (size_t i = 0; i < text.size();) {
    const auto sign =
        std::find_if(std::begin(kSigns), std::end(kSigns), [&](const auto& row) { return text.substr(i).starts_with(row.first); });
    if (sign != std::end(kSigns)) {
      even += sign->second;
      i += sign->first.size();
    } else {
      even += text[i++];
    }
  }
  std::string plain;
  for (size_t i = 0; i < even.size(); ++i) {
    const auto c = static_cast<unsigned char>(even[i]);
    const bool number = DigitAt(even, i + 1) || (i + 1 < even.size() && even[i + 1] == '.' && DigitAt(even, i + 2));
    const bool joined = i > 0 && (std::isalnum(static_cast<unsigned char>(even[i - 1])) || even[i - 1] == '-');
    if (c == '%')
      plain += " percent ";
    else if (c == ',')
      plain += Comma(even, i);
    else if (c == ';' || c == ':' || c == '(' || c == ')' || c == '!' || c == '?')
      plain += kBreak;
    else if (c == '-' && number && !joined)
      plain += " -";
    else if (std::isalnum(c) || c == '.' || c >= 0x80)
      plain += static_cast<char>(std::tolower(c));
    else
      plain += ' ';
  }
  return plain;
}

void Number(TownToken& token) {
  double value = 0;
  const char* last = token.text.data() + token.text.size();
  const auto [end, error] = std::from_chars(token.text.data(), last, value);
  if (end == last && error == std::errc() && std::isfinite(value)) token.number = value;
  for (const auto& found : {In(kUnits, token.plain), In(kTeens, token.plain), In(kTens, token.plain), In(kLots, token.plain)})
    if (found) token.number = found;
}

// "twenty five", "two hundred", "two hundred and fifty" as one.
std::vector<TownToken> Joined(std::vector<TownToken> tokens) {
  std::vector<TownToken> joined;
  const auto append = [&](const TownToken& next, double value) {
    joined.back().text += " " + next.text;
    joined.back().plain = joined.back().text;
    joined.back().number = value;
  };
  bool lots = false;  // the last of `joined` ends in "hundred" or the like
  for (size_t i = 0; i < tokens.size(); ++i) {
    const TownToken& token = tokens[i];
    // "twenty two-storey houses" are not of 22 storeys.
    const bool storeys =
        i + 1 < tokens.size() && std::find(kStoreyNouns.begin(), kStoreyNouns.end(), tokens[i + 1].plain) != kStoreyNouns.end();
    const bool after = !joined.empty() && joined.back().number && !token.breaks && !storeys && token.plain != "single";
    if (const auto lot = In(kLots, token.plain); lot && after && !lots && *joined.back().number > 0) {
      append(token, *joined.back().number * *lot);
      lots = true;
      continue;
    }
    const auto small = [&](const TownToken& t) -> std::optional<double> {
      for (const auto& found : {In(kUnits, t.plain), In(kTeens, t.plain), In(kTens, t.plain)})
        if (found && *found > 0) return found;
      return std::nullopt;
    };
    if (after && lots && small(token)) {
      append(token, *joined.back().number + *small(token));
      continue;
    }
    if (after && lots && token.plain == "and" && i + 1 < tokens.size() && !tokens[i + 1].breaks && small(tokens[i + 1])) {
      const double sum = *joined.back().number + *small(tokens[i + 1]);
      append(token, sum);
      append(tokens[++i], sum);
      continue;
    }
    if (after && In(kUnits, token.plain) && i > 0 && In(kTens, tokens[i - 1].plain)) {
      append(token, *joined.back().number + *In(kUnits, token.plain));
      continue;
    }
    joined.push_back(token);
    lots = In(kLots, token.plain).has_value();
  }
  return joined;
}

}  // namespace

std::vector<TownToken> TownTokens(std::string_view description) {
  std::vector<TownToken> tokens;
  std::string word;
  bool breaks = false;
  const auto add = [&](const std::string& text, const std::string& plain) {
    tokens.push_back({text, plain, {}, breaks});
    breaks = false;
  };
  const auto finish = [&] {
    bool stop = false;
    while (!word.empty() && word.back() == '.') word.pop_back(), stop = true;
    while (!word.empty() && word.front() == '.' && !DigitAt(word, 1)) word.erase(0, 1);
    if (!word.empty()) {
      // "40ha" is two words.
      const size_t digits = std::min(word.find_first_not_of("0123456789.", word[0] == '-' ? 1 : 0), word.size());
      if (digits > (word[0] == '-' ? 1u : 0u) && digits < word.size() && word.find_first_of("0123456789", digits) > word.size() - 2) {
        const std::string unit = word.substr(digits);
        word.resize(digits);
        add(word, word);
        add(unit, TownSingular(unit));
      } else {
        add(word, TownSingular(word));
      }
    }
    breaks = breaks || stop;
    word.clear();
  };
  for (char c : PlainText(description) + " ") {
    if (c == ' ' || c == kBreak) {
      finish();
      breaks = breaks || c == kBreak;
    } else {
      word += c;
    }
  }
  for (TownToken& token : tokens) Number(token);
  return Joined(std::move(tokens));
}

}  // namespace airsim360::internal
