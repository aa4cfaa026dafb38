// Units that stand apart from their numbers.
#include <algorithm>

#include "airsim360/flight/prompt/other_figures.h"

namespace airsim360::internal {
namespace {

bool IsUnit(const std::vector<Token>& tokens, size_t i) {
  return i < tokens.size() && tokens[i].kind == Token::Kind::kWord && IsUnitKind(tokens[i].word->kind);
}
bool IsNumber(const std::vector<Token>& tokens, size_t i) { return i < tokens.size() && tokens[i].kind == Token::Kind::kNumber; }

Token UnitLike(const Token& unit) {
  Token token = unit;
  token.glued = false;
  return token;
}

/// A noun that a figure can be of.
bool IsLabel(const Token& token) {
  return token.kind == Token::Kind::kWord && token.word->kind >= WordKind::kDrone && token.word->kind <= WordKind::kElse;
}

/// "Seventeen kg, no wait, eighteen": the unit of what is taken back.
bool CorrectsBefore(const std::vector<Token>& tokens, size_t i, size_t& unit) {
  bool takes_back = false;
  size_t k = i;
  while (k-- > 0 && i - k <= 6) {
    if (IsUnit(tokens, k) && k > 0 && IsNumber(tokens, k - 1)) {
      unit = k;
      const double ratio = tokens[i].value / std::max(tokens[k - 1].value, 1e-9);
      return takes_back && ratio > 0.3 && ratio < 3 && tokens[k].word->kind != WordKind::kOtherUnit;
    }
    const bool correction = tokens[k].Is(WordKind::kCorrection) || IsOneOf(tokens[k].text, {"no", "sorry", "wait", "rather", "mean"});
    takes_back |= correction;
    if (takes_back && IsLabel(tokens[k])) continue;  // "350 mm wheelbase, no, 450"
    if (!correction && tokens[k].kind != Token::Kind::kComma && tokens[k].kind != Token::Kind::kDash && !tokens[k].Is(WordKind::kFiller))
      return false;
  }
  return false;
}

/// The end of "both in inches", "all in mm", "weights in grams": its unit, else 0.
size_t SharedUnit(const std::vector<Token>& tokens, size_t i) {
  const bool all_in = tokens[i].text == "all in";
  if (!all_in && !IsOneOf(tokens[i].text, {"both", "all", "everything", "dimensions", "dims", "sizes", "lengths", "values", "weights",
                                           "masses", "distances", "units", "unit", "figures", "numbers"}))
    return 0;
  size_t k = i + 1;
  while (k < tokens.size() && IsOneOf(tokens[k].text, {"are", "is", "of", "them", "these", "given", "length", "the"})) ++k;
  const bool units = tokens[i].text.starts_with("unit");
  if (k + 1 < tokens.size() && tokens[k].text == "in" && IsUnit(tokens, k + 1)) {
    ++k;
  } else if (!(all_in || units) || !IsUnit(tokens, k)) {
    return 0;
  }
  return tokens[k].Is(WordKind::kLengthUnit) || tokens[k].Is(WordKind::kMassUnit) ? k : 0;
}

/// The noun right before number `i` that can have such a unit.
bool HasLabel(const std::vector<Token>& tokens, size_t i, WordKind unit) {
  for (size_t k = i; k-- > 0 && i - k <= 3 && tokens[k].kind != Token::Kind::kComma && tokens[k].kind != Token::Kind::kNumber;) {
    const bool length = tokens[k].Is(WordKind::kPropeller) || tokens[k].Is(WordKind::kWheelbase) || tokens[k].Is(WordKind::kArm);
    const bool mass =
        tokens[k].Is(WordKind::kMass) || tokens[k].Is(WordKind::kPayload) || tokens[k].Is(WordKind::kEmpty) ||
        ((tokens[k].Is(WordKind::kRotors) || tokens[k].Is(WordKind::kDrone) || tokens[k].Is(WordKind::kBattery)) && k + 1 == i);
    if (unit == WordKind::kLengthUnit ? length : mass) return true;
  }
  return false;
}

/// "One hour twenty": the minutes after an hour.
bool IsMinutesAfterHour(const std::vector<Token>& tokens, size_t i) {
  const Token& token = tokens[i];
  const size_t hour = i > 2 && tokens[i - 1].text == "and" ? i - 2 : i - 1;
  if (hour != i - 1 && i + 1 < tokens.size() && tokens[i + 1].kind != Token::Kind::kComma && !tokens[i + 1].Is(WordKind::kFiller) &&
      !tokens[i + 1].Is(WordKind::kHover) && !tokens[i + 1].Is(WordKind::kFlight))
    return false;
  return i > 1 && tokens[hour].Is(WordKind::kTimeUnit) && tokens[hour].word->value == 3600 && IsNumber(tokens, hour - 1) &&
         token.value < 60 && token.value == std::floor(token.value) && token.high == 0 && !IsUnit(tokens, i + 1) &&
         !(i + 1 < tokens.size() && tokens[i + 1].kind == Token::Kind::kDash);
}

}  // namespace

std::vector<Token> WithBorrowedUnits(std::vector<Token> tokens) {
  static const Word* const kMinutes = FindWord("min", false);
  for (size_t i = 0; i < tokens.size(); ++i) {
    size_t unit = 0;
    if (const size_t shared = SharedUnit(tokens, i); shared > 0) {
      const Token borrowed = UnitLike(tokens[shared]);
      for (size_t k = tokens.size(); k-- > 0;) {
        if (!IsNumber(tokens, k) || IsUnit(tokens, k + 1) || !HasLabel(tokens, k, borrowed.word->kind)) continue;
        tokens.insert(tokens.begin() + static_cast<long>(k) + 1, borrowed);
        i += k < i;
      }
      continue;
    }
    if (!IsNumber(tokens, i) || IsUnit(tokens, i + 1)) continue;
    const bool ends = i + 1 >= tokens.size() || tokens[i + 1].kind == Token::Kind::kComma || tokens[i + 1].Is(WordKind::kBreak);
    if (IsMinutesAfterHour(tokens, i)) {
      Token minutes;
      minutes.kind = Token::Kind::kWord;
      minutes.text = "min";
      minutes.word = kMinutes;
      tokens.insert(tokens.begin() + static_cast<long>(i) + 1, minutes);
    } else if (ends && CorrectsBefore(tokens, i, unit)) {
      // The number alone is said anew.
      const Token number = tokens[i];
      size_t from = unit + 1;
      while (from < i && IsLabel(tokens[from])) ++from;
      tokens.erase(tokens.begin() + static_cast<long>(from), tokens.begin() + static_cast<long>(i) + 1);
      tokens[unit - 1] = number;
      i = unit;
    }
  }
  return tokens;
}

}  // namespace airsim360::internal
