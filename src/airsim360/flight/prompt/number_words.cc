#include "airsim360/flight/prompt/number_words.h"

#include <charconv>
#include <cmath>

#include "airsim360/base/error.h"

namespace airsim360::internal {
namespace {

size_t Digits(std::string_view text, size_t at) {
  size_t n = 0;
  while (at + n < text.size() && IsDigit(text[at + n])) ++n;
  return n;
}

/// Length of the exponent "e-3" that may follow a number; 0: there is none.
size_t ExponentLength(std::string_view text, size_t at) {
  if (at >= text.size() || text[at] != 'e') return 0;
  const size_t sign = at + 1 < text.size() && (text[at + 1] == '-' || text[at + 1] == '+');
  const size_t digits = Digits(text, at + 1 + sign);
  return digits == 0 ? 0 : 1 + sign + digits;
}

bool IsUnit(const Token& token) {
  return token.kind == Token::Kind::kWord && token.word->kind >= WordKind::kMassUnit && token.word->kind <= WordKind::kPercent;
}

/// Whole words for a unit, of which there can be "a": "a kilo", but not "a g".
bool IsLongUnit(const Token& token) { return IsUnit(token) && token.text.size() >= 4; }

bool IsNumber(const Token& token) { return token.kind == Token::Kind::kNumber || token.Is(WordKind::kNumber); }

class Joiner {
 public:
  explicit Joiner(std::vector<Token> tokens) : in_(std::move(tokens)) {}

  std::vector<Token> Run() {
    while (at_ < in_.size()) {
      if (IsNumber(in_[at_]) || in_[at_].Is(WordKind::kHalf) || StartsArticle() || IsOneMultiple(at_)) {
        if (!StartsArticle() && Join()) continue;
        if (StartsArticle()) {
          Push(in_[at_].text, 1, 1);
          continue;
        }
      }
      out_.push_back(in_[at_++]);
    }
    return std::move(out_);
  }

 private:
  bool StartsArticle() const {
    const bool article = in_[at_].text == "a" || in_[at_].text == "an" || in_[at_].text == "un" || in_[at_].text == "ein" ||
                         in_[at_].text == "une" || in_[at_].text == "una" || in_[at_].text == "eine" || in_[at_].text == "einer" ||
                         in_[at_].text == "einen";
    return article && at_ + 1 < in_.size() && IsLongUnit(in_[at_ + 1]) && !in_[at_ + 1].Is(WordKind::kCells) &&
           in_[at_ + 1].text != "second" && !IsNumber(Before());
  }
  const Token& Before() const {
    static const Token kNone;
    return out_.empty() ? kNone : out_.back();
  }
  bool At(size_t i, WordKind kind) const { return i < in_.size() && in_[i].Is(kind); }
  bool AtText(size_t i, std::string_view text) const { return i < in_.size() && in_[i].text == text; }

  Token& Push(std::string text, double value, size_t used) {
    Token token;
    token.kind = Token::Kind::kNumber;
    token.text = std::move(text);
    token.value = value;
    token.negative = in_[at_].negative;
    token.glued = in_[at_].glued;
    at_ += used;
    return out_.emplace_back(std::move(token));
  }

  /// "a hundred"
  bool IsOneMultiple(size_t i) const { return AtText(i, "a") && At(i + 1, WordKind::kMultiplier); }

  /// "five hundred" after "two thousand", "fifty" after "nine hundred": the value of the smaller part at `i` and its
  /// words; 0 words: there is none.
  size_t ReadRest(size_t i, double whole, double& rest) const {
    if (!At(i, WordKind::kNumber) || whole < 100) return 0;
    double value = in_[i].word->value;
    size_t used = 1;
    const size_t unit = i + (i + 1 < in_.size() && in_[i + 1].kind == Token::Kind::kDash ? 2 : 1);
    if (At(unit, WordKind::kNumber) && value >= 20 && value < 100 && in_[unit].word->value < 10) {  // "twenty-five"
      value += in_[unit].word->value;
      used = unit + 1 - i;
    }
    if (At(i + used, WordKind::kMultiplier)) value *= in_[i + used++].word->value;
    rest = value;
    const double place = std::fmod(whole, 1000) == 0 ? 1000 : std::fmod(whole, 100) == 0 ? 100 : 1;
    return value > 0 && value < place ? used : 0;
  }

  /// One number from `i` on, of as many words as belong to it; how many those are.
  size_t ReadOne(size_t i, double& value, std::string& text) const {
    const size_t first = i;
    if (!IsNumber(in_[i]) && !IsOneMultiple(i)) return 0;
    const bool digits = in_[i].kind == Token::Kind::kNumber;
    value = digits ? in_[i].value : IsNumber(in_[i]) ? in_[i].word->value : 1;
    text = in_[i++].text;
    const auto extend = [&](double more) {
      value = more;
      text += " " + in_[i++].text;
    };
    for (int n = 0; n < 6 && i < in_.size(); ++n) {
      const size_t word = in_[i].kind == Token::Kind::kDash ? i + 1 : i;
      const size_t rest_at = AtText(i, "and") ? i + 1 : i;
      double rest = 0;
      const size_t rest_words = digits || !At(i - 1, WordKind::kMultiplier) ? 0 : ReadRest(rest_at, value, rest);
      if (At(i, WordKind::kMultiplier)) {
        extend(value * in_[i].word->value);
      } else if (rest_words > 0) {
        value += rest;
        for (const size_t end = rest_at + rest_words; i < end; ++i) text += " " + in_[i].text;
      } else if (!digits && At(word, WordKind::kNumber) && Fits(value, in_[word].word->value)) {
        i = word;
        const double next = in_[i].word->value;
        extend(next == 10 && value < 10 ? value * 10 : value + next);
      } else {
        break;
      }
    }
    // "seven point five"
    if (!digits && AtText(i, "point") && At(i + 1, WordKind::kNumber) && in_[i + 1].word->value < 10) {
      value += in_[i + 1].word->value / 10;
      text += " point " + in_[i + 1].text;
      i += 2;
    }
    // "two and a half", "1 1/2"
    if (AtText(i, "and") && At(i + 1, WordKind::kHalf)) {
      value += in_[i + 1].word->value;
      text += " and " + in_[i + 1].text;
      i += 2;
      if (!digits && At(i, WordKind::kMultiplier)) extend(value * in_[i].word->value);  // "two and a half thousand"
    } else if (i + 2 < in_.size() && AtText(i, "/") && in_[i + 1].kind == Token::Kind::kNumber && value == 1 && in_[i + 1].value >= 2 &&
               in_[i + 1].value <= 8 && IsUnit(in_[i + 2])) {
      value /= in_[i + 1].value;
      text += "/" + in_[i + 1].text;
      i += 2;
    }
    return i - first;
  }

  /// "twenty" before "five", "hundred" before "fifty"; 二 before 十.
  static bool Fits(double before, double next) {
    if (next == 10) return before < 10 && before >= 2;
    if (before >= 20 && before < 100 && std::fmod(before, 10) == 0) return next < 10;
    if (before == 10) return false;
    return before >= 100 && next < 100;
  }

  bool Join() {
    if (in_[at_].Is(WordKind::kHalf)) {
      const bool dash = at_ + 1 < in_.size() && in_[at_ + 1].kind == Token::Kind::kDash;
      const size_t unit = at_ + (dash ? 2 : 1);
      if (unit >= in_.size() || !IsUnit(in_[unit])) return false;
      Push(in_[at_].text, in_[at_].word->value, 1);
      return true;
    }
    double value = 0;
    std::string text;
    const size_t used = ReadOne(at_, value, text);
    if (used == 0) return false;
    if (Range(used, value, text)) return true;
    Push(text, value, used);
    return true;
  }

  bool Range(size_t used, double low, const std::string& text) {
    size_t i = at_ + used;
    if (i >= in_.size()) return false;
    const bool unit_between = IsUnit(in_[i]) && i + 1 < in_.size();
    const size_t link = unit_between ? i + 1 : i;
    // "between 15 and 20 minutes"
    const bool between = Before().text == "between" && AtText(link, "and");
    if (!(between || in_[link].kind == Token::Kind::kDash || in_[link].Is(WordKind::kTo)) || link + 1 >= in_.size()) return false;
    double high = 0;
    std::string high_text;
    const size_t more = ReadOne(link + 1, high, high_text);
    const size_t end = link + 1 + more;
    if (more == 0) return false;
    const bool has_unit = end < in_.size() && IsUnit(in_[end]);
    if (!has_unit && (unit_between || !(between || FollowsRatio()) || high <= 1)) return false;
    if (unit_between && in_[i].word->kind != in_[end].word->kind) return false;
    // "2306-2450kv": a stator before its KV.
    const double height = std::fmod(low, 100);
    if (has_unit && in_[end].Is(WordKind::kKvUnit) && low >= 1000 && low < 10000 && height >= 2 && height <= 45 && std::fmod(low, 10) != 0)
      return false;
    const double scale = unit_between && in_[end].word->value > 0 ? in_[i].word->value / in_[end].word->value : 1;
    if (!(low * scale < high && high < 4 * low * scale)) return false;
    const std::string link_text = in_[link].kind == Token::Kind::kDash ? "-" : " " + in_[link].text + " ";
    Token& token = Push(text + link_text + high_text, (low * scale + high) / 2, end - at_);
    token.low = low * scale;
    token.high = high;
    return true;
  }

  /// "TWR 8-10", "thrust to weight of about 3 to 4"
  bool FollowsRatio() const {
    for (size_t n = 1; n <= 4 && n <= out_.size(); ++n) {
      const Token& token = out_[out_.size() - n];
      if (token.Is(WordKind::kThrustRatio)) return true;
      if (!token.Is(WordKind::kFiller) && token.kind != Token::Kind::kUnknown) return false;
    }
    return false;
  }

  std::vector<Token> in_, out_;
  size_t at_ = 0;
};

}  // namespace

size_t ReadNumber(std::string_view text, double& value) {
  std::string plain;
  size_t at = Digits(text, 0);
  plain = std::string(text.substr(0, at));
  // Commas divide thousands (three digits after each) or are the decimal point.
  while (at > 0 && at < text.size() && text[at] == ',') {
    const size_t digits = Digits(text, at + 1);
    if (digits == 3 && plain.size() <= 3 && plain != "0") {
      plain += text.substr(at + 1, 3);
      at += 4;
    } else {
      if (digits > 0 && (digits != 3 || plain == "0")) {
        plain += "." + std::string(text.substr(at + 1, digits));
        at += 1 + digits;
      }
      break;
    }
  }
  if (at < text.size() && text[at] == '.' && Digits(text, at + 1) > 0 && plain.find('.') == std::string::npos) {
    const size_t digits = Digits(text, at + 1);
    plain += "." + std::string(text.substr(at + 1, digits));
    at += 1 + digits;
  }
  if (plain.empty()) return 0;
  if (plain[0] == '.') plain = "0" + plain;
  // "1.5e3", as programs write figures.
  if (const size_t exponent = ExponentLength(text, at); exponent > 0) {
    const size_t sign = text[at + 1] == '+';  // which from_chars does not read
    plain += "e" + std::string(text.substr(at + 1 + sign, exponent - 1 - sign));
    at += exponent;
  }
  const auto [end, error] = std::from_chars(plain.data(), plain.data() + plain.size(), value);
  if (error != std::errc() || !(value < 1e9)) {
    throw InputError("the number '" + std::string(text.substr(0, 20)) + "' describes no drone");
  }
  return at;
}

size_t ReadThousands(std::string_view text, size_t length, double& value) {
  const auto unit_at = [&](size_t at) {
    while (at < text.size() && text[at] == ' ') ++at;
    size_t end = at;
    while (end < text.size() && text[end] >= 'a' && text[end] <= 'z') ++end;
    return text.substr(at, end - at);
  };
  const auto is_small = [](std::string_view unit) {
    const Word* word = FindWord(unit, false);
    return word != nullptr &&
           (word->kind == WordKind::kMassUnit || word->kind == WordKind::kCapacityUnit || word->kind == WordKind::kLengthUnit) &&
           word->value == 1e-3;
  };
  const std::string_view digits = text.substr(0, length);
  const size_t whole = Digits(digits, 0);
  if (whole == 0 || digits[0] == '0') return 0;
  if (digits.find(',') != std::string_view::npos && digits.find('.') == std::string_view::npos && value >= 1000) {
    const std::string_view unit = unit_at(length);
    const Word* word = FindWord(unit, false);
    if (word != nullptr && word->kind == WordKind::kMassUnit && word->value == 1) value /= 1000;
    return 0;
  }
  if (whole > 2) return 0;
  if (whole + 4 == length && digits[whole] == '.' && is_small(unit_at(length))) {
    value = std::round(value * 1000);
    return 0;
  }
  const bool apart = whole == length && length < text.size() && (text[length] == ' ' || text[length] == '\'');
  if (!apart || Digits(text, length + 1) != 3) return 0;
  const std::string_view unit = unit_at(length + 4);
  // "6 500 mm" rather counts.
  if (!is_small(unit) || (unit == "mm" && value > 2)) return 0;
  double rest = 0;
  std::from_chars(text.data() + length + 1, text.data() + length + 4, rest);
  value = value * 1000 + rest;
  return 4;
}

bool ReadPropellerCode(std::string_view text, double (&code)[3], size_t& length) {
  size_t at = ReadNumber(text, code[0]);
  int parts = at > 0;
  for (; parts > 0 && parts < 3 && at + 1 < text.size() && (text[at] == 'x' || text[at] == '*'); ++parts) {
    const size_t more = ReadNumber(text.substr(at + 1), code[parts]);
    if (more == 0) break;
    at += 1 + more;
  }
  // "4x 10 inch" counts; "8x16 in" as well; "100x80 mm" is a box; "5045x3" says blades.
  if (parts == 2 && code[0] >= 1000 && code[1] <= 6) {
    const double blades = code[1];
    const std::string digits = std::to_string(static_cast<int>(code[0]));
    if (!ReadPropellerFigures(digits, code)) return false;
    code[2] = blades;
  } else if (parts < 2 || code[0] > 60 || code[1] >= code[0] * 2 || (parts == 3 && code[2] > 6)) {
    return false;
  }
  length = at;
  return true;
}

size_t BoxLength(std::string_view text) {
  double sides[3] = {};
  size_t at = 0;
  int parts = 0;
  std::string_view unit;
  bool each = false;  // has a unit of its own
  const auto skip = [&] {
    while (at < text.size() && text[at] == ' ') ++at;
  };
  for (; parts < 3; ++parts) {
    const size_t digits = ReadNumber(text.substr(at), sides[parts]);
    if (digits == 0) return 0;
    at += digits;
    const size_t end = at;
    skip();
    unit = {};
    for (const std::string_view known : {"mm", "cm", "ft", "m"}) {
      const size_t next = at + known.size();
      const bool ends = next >= text.size() || text[next] < 'a' || text[next] > 'z';
      if (unit.empty() && ends && text.substr(at).starts_with(known)) unit = known;
    }
    at = unit.empty() ? end : at + unit.size();
    each |= parts == 0 && !unit.empty();
    const size_t by = at;
    skip();
    if (at + 1 < text.size() && (text[at] == 'x' || text[at] == '*')) {
      ++at;
      skip();
    } else {
      at = by;
      ++parts;
      break;
    }
  }
  // "4x 330 mm" counts; "9x4.5" has no unit.
  const bool counts = parts == 2 && sides[0] <= 12 && sides[0] != sides[1] && !each;
  return parts < 2 || unit.empty() || counts ? 0 : at;
}

bool ReadPropellerFigures(std::string_view digits, double (&code)[3]) {
  if (digits.size() < 4 || digits.size() > 5 || Digits(digits, 0) != digits.size()) return false;
  int figures = 0;
  std::from_chars(digits.data(), digits.data() + digits.size(), figures);
  const double tail = digits.size() == 4 ? figures % 100 / 10.0 : figures % 1000 / 100.0;
  const int head = figures / (digits.size() == 4 ? 100 : 1000);
  // "1045" is 10 x 4.5, "9450" is 9.4 x 5.0: of both readings the one with a pitch that propellers have.
  for (const double diameter : {static_cast<double>(head), head / 10.0}) {
    const bool sizes = diameter >= 10 ? diameter <= 40 : diameter >= 1.2 && diameter < 10;
    if (!sizes || tail < 0.22 * diameter || tail > 1.2 * diameter) continue;
    code[0] = diameter;
    code[1] = tail;
    code[2] = 0;
    return true;
  }
  return false;
}

std::vector<Token> JoinNumbers(std::vector<Token> tokens) { return Joiner(std::move(tokens)).Run(); }

}  // namespace airsim360::internal
