#include "airsim360/worlds/words/word_tokens.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <span>

#include "airsim360/worlds/words/number_words.h"

namespace airsim360::internal {
namespace {

constexpr char kBreak = '\x01';

std::optional<double> In(std::span<const NumberWord> table, std::string_view word) {
  for (const auto& [name, value] : table)
    if (name == word) return value;
  return std::nullopt;
}

bool IsAnyOf(std::string_view word, std::initializer_list<std::string_view> list) {
  return std::find(list.begin(), list.end(), word) != list.end();
}

// "houses" and "house", "cities" and "city", "churches" and "church".
std::string SingularOf(std::string word) {
  const auto ends = [&](std::string_view end) { return word.size() > end.size() + 1 && word.ends_with(end); };
  if (ends("ies") && word.size() > 4) return word.replace(word.size() - 3, 3, "y");
  if (ends("ches") || ends("shes") || ends("sses") || ends("xes")) return word.erase(word.size() - 2);
  if (word.size() > 3 && ends("s") && !ends("ss") && !ends("us") && !ends("is")) word.pop_back();
  return word;
}

bool DigitAt(std::string_view text, size_t i) { return i < text.size() && std::isdigit(static_cast<unsigned char>(text[i])); }
bool LetterAt(std::string_view text, size_t i) { return i < text.size() && std::isalpha(static_cast<unsigned char>(text[i])); }

// Digits from i on, at most `most` of them.
size_t DigitsFrom(std::string_view text, size_t i, size_t most = 99) {
  size_t n = 0;
  while (n < most && DigitAt(text, i + n)) ++n;
  return n;
}

// Of a comma at i: "10,000" has none, "1,5" is a decimal point, any other parts words.
std::string CommaAt(std::string_view text, size_t i) {
  const size_t after = DigitsFrom(text, i + 1);
  if (i == 0 || !DigitAt(text, i - 1) || after == 0) return std::string(1, kBreak);
  return after == 3 ? "" : ".";
}

// Of a point at i: "20.000" is twenty thousand, as no one writes twenty with three noughts behind it.
std::string PointAt(std::string_view text, size_t i) {
  const bool before = i > 0 && DigitAt(text, i - 1), letter = i > 0 && LetterAt(text, i - 1);
  if (before && text.substr(i + 1).starts_with("000") && DigitsFrom(text, i + 1) == 3) return "";
  return !letter && DigitAt(text, i + 1) ? "." : std::string(1, kBreak);
}

// Signs as words or as other signs.
std::string Even(std::string_view text) {
  static constexpr std::pair<std::string_view, std::string_view> kSigns[] = {
      {"é", "e"}, {"è", "e"},     {"ç", "c"},    {"ã", "a"},    {"á", "a"},      {"ü", "u"},      {"ö", "o"},
      {"ä", "a"}, {"ñ", "n"},     {"²", "2"},    {"×", " x "},  {"\u2212", "-"}, {"\u2013", "-"}, {"\u2014", " "},
      {"’", "'"}, {"&", " and "}, {"½", " 1/2"}, {"¼", " 1/4"}, {"¾", " 3/4"},   {"≤", " <= "},   {"≥", " >= "}};
  std::string even;
  for (size_t i = 0; i < text.size();) {
    const auto* sign =
        std::find_if(std::begin(kSigns), std::end(kSigns), [&](const auto& row) { return text.substr(i).starts_with(row.first); });
    if (sign == std::end(kSigns)) {
      even += text[i++];
      continue;
    }
    even += sign->second;
    i += sign->first.size();
  }
  return even;
}

// Words, breaks and signs parted by blanks, in lower case. A minus stays where a number begins with it, so that the bounds of the
// number can refuse it.
std::string Parted(std::string_view text) {
  std::string parted;
  for (size_t i = 0; i < text.size(); ++i) {
    const auto c = static_cast<unsigned char>(text[i]);
    const bool number = DigitAt(text, i + 1) || (i + 1 < text.size() && text[i + 1] == '.' && DigitAt(text, i + 2));
    const bool joined = i > 0 && (std::isalnum(static_cast<unsigned char>(text[i - 1])) || text[i - 1] == '-' || text[i - 1] == '.');
    if (std::isalnum(c) || c >= 0x80)
      parted += static_cast<char>(std::tolower(c));
    else if (c == '%')
      parted += " percent ";
    else if (c == ',')
      parted += CommaAt(text, i);
    else if (c == '.')
      parted += PointAt(text, i);
    else if (std::string_view(";:()!?[]{}\n").find(static_cast<char>(c)) != std::string_view::npos)
      parted += kBreak;
    else if (c == '-')
      parted += number && !joined ? " -" : " - ";
    else if (c == '/' && DigitAt(text, i + 1) && i > 0 && DigitAt(text, i - 1))
      parted += " / ";
    else if (c == '+')
      parted += i > 0 && DigitAt(text, i - 1) ? " or more " : " and ";
    else if (std::string_view("~<>=$@^|\\").find(static_cast<char>(c)) != std::string_view::npos)
      parted += (c == '=' && i > 0 && (text[i - 1] == '<' || text[i - 1] == '>'))
                    ? std::string("= ")
                    : std::string(" ") + static_cast<char>(c) + (i + 1 < text.size() && text[i + 1] == '=' ? "" : " ");
    else
      parted += ' ';
  }
  return parted;
}

std::optional<double> ValueOf(const std::string& text) {
  double value = 0;
  const char* last = text.data() + text.size();
  const auto [end, error] = std::from_chars(text.data(), last, value);
  if (end == last && error == std::errc() && std::isfinite(value) && !LetterAt(text, 0)) return value;
  return std::nullopt;
}

std::optional<double> SmallNumber(const WordToken& token) {
  for (const auto& found : {In(NumberUnits(), token.plain), In(NumberTeens(), token.plain), In(NumberTens(), token.plain)})
    if (found && *found > 0) return found;
  return std::nullopt;
}

class Tokenizer {
 public:
  std::vector<WordToken> Run(std::string_view description) {
    for (char c : Parted(Even(description)) + " ") {
      if (c != ' ' && c != kBreak) {
        word_ += c;
        continue;
      }
      // "approx. 10" does not part.
      const bool goes_on = c == kBreak && IsAnyOf(word_, {"approx", "ca", "sq", "max", "min", "st"});
      Finish();
      breaks_ = breaks_ || (c == kBreak && !goes_on);
    }
    for (WordToken& token : tokens_) Number(token);
    DropDashes();
    Phrases();
    JoinNumbers();
    Fractions();
    Ranges();
    Abouts();
    Limits();
    return std::move(tokens_);
  }

 private:
  void Add(const std::string& text, const std::string& plain) {
    tokens_.push_back({text, plain, ValueOf(text), {}, NumberLimit::kNone, breaks_});
    breaks_ = false;
  }
  // "40x20m" is four words, "600m2" two.
  void Finish() {
    size_t at = 0;
    const auto digit_at = [&](size_t i) { return DigitAt(word_, i) || (i < word_.size() && word_[i] == '.' && DigitAt(word_, i + 1)); };
    while (!ValueOf(word_) && (digit_at(at) || (at == 0 && word_[0] == '-' && digit_at(1)))) {
      const size_t digits = std::min(word_.find_first_not_of("0123456789.", at + (word_[at] == '-')), word_.size());
      size_t letters = std::min(word_.find_first_of("0123456789", digits), word_.size());
      if (letters + 1 == word_.size() && word_[letters] == '2') letters = word_.size();
      Add(word_.substr(at, digits - at), word_.substr(at, digits - at));
      if (letters > digits) Add(word_.substr(digits, letters - digits), SingularOf(word_.substr(digits, letters - digits)));
      at = letters;
    }
    if (at < word_.size()) Add(word_.substr(at), SingularOf(word_.substr(at)));
    word_.clear();
  }

  static void Number(WordToken& token) {
    for (const auto table : {NumberUnits(), NumberTeens(), NumberTens(), NumberLots()})
      if (const auto found = In(table, token.plain)) token.number = found;
  }

  bool IsNumber(size_t i) const { return i < tokens_.size() && tokens_[i].number; }
  bool Reads(size_t i, size_t n, std::string_view phrase) const {
    for (size_t k = i + 1; k < i + n && k < tokens_.size(); ++k)
      if (tokens_[k].breaks) return false;
    return i + n <= tokens_.size() && JoinedTokens(tokens_, i, n) == phrase;
  }
  // The longest of the phrases at i, and its words.
  template <class Row>
  std::pair<const Row*, size_t> LongestAt(std::span<const Row> rows, size_t i) const {
    for (size_t n = std::min<size_t>(4, tokens_.size() - std::min(i, tokens_.size())); n > 0; --n)
      for (const Row& row : rows)
        if (Reads(i, n, row.first)) return {&row, n};
    return {nullptr, 0};
  }
  // Makes n tokens from i on one, a number.
  void Merge(size_t i, size_t n, double value) {
    WordToken& token = tokens_[i];
    token.text = JoinedTokens(tokens_, i, n);
    token.plain = token.text;
    token.number = value;
    Erase(i + 1, n - 1);
  }
  void Erase(size_t i, size_t n) {
    const auto from = tokens_.begin() + static_cast<std::ptrdiff_t>(i);
    tokens_.erase(from, from + static_cast<std::ptrdiff_t>(n));
  }

  // A dash says something between two numbers alone, and not in "twenty-five".
  void DropDashes() {
    for (size_t i = 0; i < tokens_.size();) {
      const bool sign = tokens_[i].text == "-", tens = i > 0 && In(NumberTens(), tokens_[i - 1].plain);
      const bool range = i > 0 && IsNumber(i - 1) && IsNumber(i + 1) && !(tens && In(NumberUnits(), tokens_[i + 1].plain));
      if (!sign || range) {
        ++i;
        continue;
      }
      if (i + 1 < tokens_.size()) tokens_[i + 1].breaks = tokens_[i + 1].breaks || tokens_[i].breaks;
      Erase(i, 1);
    }
  }

  // "couple of", "several", "half a square mile".
  void Phrases() {
    for (size_t i = 0; i < tokens_.size(); ++i) {
      if (const auto [phrase, n] = LongestAt(NumberPhrases(), i); phrase) Merge(i, n, phrase->second);
      if (tokens_[i].text == "several") {
        constexpr double kLeastOfSeveral = 3, kMostOfSeveral = 7;
        tokens_[i].number = kLeastOfSeveral;
        tokens_[i].upper = kMostOfSeveral;
      }
      for (const auto& [words, share] :
           {NumberWord{"half a", 0.5}, NumberWord{"half an", 0.5}, NumberWord{"half", 0.5}, NumberWord{"a quarter of a", 0.25},
            NumberWord{"a quarter of an", 0.25}, NumberWord{"quarter", 0.25}}) {
        const auto n = static_cast<size_t>(std::count(words.begin(), words.end(), ' ')) + 1;
        if (Reads(i, n, words) &&
            (SquareMetresAt(tokens_, i + n).second > 0 || (i + n < tokens_.size() && MetresOf(tokens_[i + n].plain) > 0)))
          Merge(i, n, share);
      }
    }
  }

  // "twenty five", "two hundred", "two hundred and fifty" as one.
  void JoinNumbers() {
    std::vector<WordToken> all = std::move(tokens_);
    tokens_.clear();
    const auto append = [&](const WordToken& next, double value) {
      tokens_.back().text += " " + next.text;
      tokens_.back().plain = tokens_.back().text;
      tokens_.back().number = value;
    };
    bool lots = false;  // the last of them ends in "hundred" or the like
    for (size_t i = 0; i < all.size(); ++i) {
      const WordToken& token = all[i];
      // "twenty two-storey houses" are not of 22 storeys.
      const bool storeys = i + 1 < all.size() && IsStoreyWord(all[i + 1].plain);
      const bool after =
          !tokens_.empty() && tokens_.back().number && !tokens_.back().upper && !token.breaks && !storeys && token.plain != "single";
      if (const auto lot = In(NumberLots(), token.plain); lot && after && !lots && *tokens_.back().number > 0) {
        append(token, *tokens_.back().number * *lot);
        lots = true;
        continue;
      }
      if (after && lots && SmallNumber(token)) {
        append(token, *tokens_.back().number + *SmallNumber(token));
        continue;
      }
      if (after && lots && token.plain == "and" && i + 1 < all.size() && !all[i + 1].breaks && SmallNumber(all[i + 1])) {
        const double sum = *tokens_.back().number + *SmallNumber(all[i + 1]);
        append(token, sum);
        append(all[++i], sum);
        continue;
      }
      if (after && In(NumberUnits(), token.plain) && i > 0 && In(NumberTens(), all[i - 1].plain)) {
        append(token, *tokens_.back().number + *In(NumberUnits(), token.plain));
        continue;
      }
      tokens_.push_back(token);
      lots = In(NumberLots(), token.plain).has_value();
    }
  }

  // "1/2", "2 1/2".
  void Fractions() {
    for (size_t i = 0; i + 2 < tokens_.size(); ++i) {
      if (!IsNumber(i) || tokens_[i + 1].text != "/" || !IsNumber(i + 2) || *tokens_[i + 2].number == 0) continue;
      Merge(i, 3, *tokens_[i].number / *tokens_[i + 2].number);
      if (i > 0 && IsNumber(i - 1) && !tokens_[i].breaks && *tokens_[i].number < 1 &&
          *tokens_[i - 1].number == std::floor(*tokens_[i - 1].number))
        Merge(i - 1, 2, *tokens_[i - 1].number + *tokens_[i].number), --i;
    }
  }

  // "3-5", "3 to 5", "between 3 and 5".
  void Ranges() {
    for (size_t i = 0; i + 2 < tokens_.size(); ++i) {
      if (!IsNumber(i) || !IsNumber(i + 2) || tokens_[i + 1].breaks || tokens_[i + 2].breaks || tokens_[i].upper) continue;
      const std::string& link = tokens_[i + 1].text;
      const bool between = i > 0 && tokens_[i - 1].text == "between", from = i > 0 && tokens_[i - 1].text == "from";
      if (!IsAnyOf(link, {"-", "to", "or"}) && !(between && link == "and")) continue;
      const double low = *tokens_[i].number, high = *tokens_[i + 2].number;
      const bool led = (between || from) && link != "or";
      if (led) --i;
      Merge(i, led ? 4 : 3, low);
      tokens_[i].upper = high;
    }
  }

  void Abouts() {
    for (size_t i = 0; i + 1 < tokens_.size(); ++i) {
      const bool about = std::ranges::find(AboutWords(), tokens_[i].text) != AboutWords().end();
      if (!about || !IsNumber(i + 1) || tokens_[i + 1].breaks) continue;
      const WordToken number = tokens_[i + 1];
      Merge(i, 2, *number.number);
      tokens_[i].upper = number.upper;
    }
  }

  void Limits() {
    for (size_t i = 0; i < tokens_.size(); ++i) {
      if (const auto [limit, n] = LongestAt(LimitsBefore(), i); limit) {
        size_t at = i + n;
        if (at < tokens_.size() && IsAnyOf(tokens_[at].text, {"a", "about"})) ++at;
        if (IsNumber(at) && !tokens_[at].upper) {
          Merge(i, at + 1 - i, *tokens_[at].number);
          tokens_[i].limit = limit->second;
        }
      }
      if (!IsNumber(i)) continue;
      // Behind the number or behind its noun; before another number it belongs to that one.
      for (const size_t at : {i + 1, i + 2}) {
        if (at >= tokens_.size() || tokens_[at].breaks || tokens_[i].limit != NumberLimit::kNone || tokens_[i].upper) break;
        const auto [limit, n] = LongestAt(LimitsBehind(), at);
        if (!limit || (IsNumber(at + n) && !tokens_[at + n].breaks)) continue;
        tokens_[i].limit = limit->second;
        if (at == i + 1) {
          tokens_[i].text = JoinedTokens(tokens_, i, 1 + n);
          tokens_[i].plain = tokens_[i].text;
        } else {
          tokens_[i + 1].text = JoinedTokens(tokens_, i + 1, 1 + n);
        }
        Erase(at, n);
        break;
      }
    }
  }

  std::vector<WordToken> tokens_;
  std::string word_;
  bool breaks_ = false;
};

}  // namespace

std::vector<WordToken> WordTokens(std::string_view description) { return Tokenizer().Run(description); }

std::string JoinedTokens(const std::vector<WordToken>& tokens, size_t i, size_t n, bool plain) {
  std::string text;
  for (size_t k = i; k < i + n && k < tokens.size(); ++k) text += (k > i ? " " : "") + (plain ? tokens[k].plain : tokens[k].text);
  // "3-5", as it was written.
  for (size_t at = 0; (at = text.find(" - ", at)) != std::string::npos;) text.replace(at, 3, "-");
  for (size_t at = 0; (at = text.find(" / ", at)) != std::string::npos;) text.replace(at, 3, "/");
  return text;
}

double MetresOf(std::string_view plain) { return In(LengthUnits(), plain).value_or(0); }

std::pair<double, size_t> SquareMetresAt(const std::vector<WordToken>& tokens, size_t i) {
  if (i >= tokens.size()) return {0, 0};
  if (const auto area = In(AreaUnits(), tokens[i].plain)) return {*area, 1};
  if (!IsAnyOf(tokens[i].plain, {"square", "sq"}) || i + 1 >= tokens.size()) return {0, 0};
  const double side = MetresOf(tokens[i + 1].plain);
  return {side * side, side > 0 ? 2 : 0};
}

}  // namespace airsim360::internal
