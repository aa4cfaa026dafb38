// What is around a number of a description: shared by the files that look for figures of other things.
#pragma once

#include <initializer_list>
#include <string>
#include <vector>

#include "airsim360/flight/prompt/tokens.h"

namespace airsim360::internal {

/// A number with its unit, by their tokens; `is`: there is a unit.
struct Figure {
  size_t number = 0, unit = 0;
  bool is = false;
};

/// Tokens, and which of them are set apart: those that are no figures of the drone.
class FigureWords {
 public:
  static constexpr size_t kClause = 16;  ///< tokens that a word reaches

  FigureWords(std::vector<Token>& tokens, std::vector<bool>& apart) : tokens_(tokens), apart_(apart) {}

 protected:
  bool Is(size_t i, WordKind kind) const { return i < tokens_.size() && tokens_[i].Is(kind); }

  bool EndsSegment(size_t i) const { return tokens_[i].kind == Token::Kind::kComma; }

  const std::string& Text(size_t i) const {
    static const std::string kNone;
    return i < tokens_.size() ? tokens_[i].text : kNone;
  }

  bool Is(size_t i, std::initializer_list<const char*> words) const { return IsOneOf(Text(i), words); }

  Figure FigureAt(size_t i) const {
    Figure figure{i, 0, false};
    if (i >= tokens_.size() || tokens_[i].kind != Token::Kind::kNumber) return figure;
    figure.unit = i + 1;
    if (figure.unit < tokens_.size() && tokens_[figure.unit].kind == Token::Kind::kDash) ++figure.unit;
    figure.is =
        figure.unit < tokens_.size() && tokens_[figure.unit].kind == Token::Kind::kWord && IsUnitKind(tokens_[figure.unit].word->kind);
    if (!figure.is) figure.unit = 0;
    return figure;
  }

  bool HasUnit(const Figure& figure, WordKind kind) const { return tokens_[figure.unit].word->kind == kind; }

  bool IsMetric(const Figure& figure) const {
    constexpr double kFar = 500;  // m: an altitude or a journey, which have laws of their own
    return HasUnit(figure, WordKind::kLengthUnit) && tokens_[figure.unit].word->value != 0.0254 && Value(figure) < kFar;
  }

  double Value(const Figure& figure) const { return tokens_[figure.number].value * tokens_[figure.unit].word->value; }

  bool IsDrone(size_t k) const {
    return k < tokens_.size() && (tokens_[k].kind == Token::Kind::kModel || tokens_[k].Is(WordKind::kDrone) || IsRotors(k) ||
                                  Is(k, {"one", "ones", "build", "rig", "frame"}));
  }

  /// A word for how many rotors there are: "hexa", "X8".
  bool IsRotors(size_t k) const { return Is(k, WordKind::kRotors) || Is(k, WordKind::kCoaxial); }

  /// Another figure of that kind, which is the drone's as far as is known.
  bool HasOther(const Figure& figure) const {
    for (size_t k = 0; k < tokens_.size(); ++k) {
      const Figure other = FigureAt(k);
      if (!other.is || k == figure.number || apart_[k] || !HasUnit(other, tokens_[figure.unit].word->kind)) continue;
      if (!HasUnit(figure, WordKind::kLengthUnit) || IsMetric(other) == IsMetric(figure)) return true;
    }
    return false;
  }

  void MarkFigure(size_t k) {
    if (tokens_[k].kind == Token::Kind::kNumber || tokens_[k].kind == Token::Kind::kPropellerCode) apart_[k] = true;
  }

  bool HasNear(const Figure& figure, size_t reach, std::initializer_list<const char*> stems) const {
    for (size_t k = figure.number; k-- > 0 && figure.number - k <= reach && !EndsSegment(k);) {
      if (StartsAny(Text(k), stems)) return true;
      if (tokens_[k].kind == Token::Kind::kNumber) break;
    }
    for (size_t k = figure.unit + 1; k < tokens_.size() && k <= figure.unit + reach && !EndsSegment(k); ++k) {
      if (StartsAny(Text(k), stems)) return true;
      if (tokens_[k].kind == Token::Kind::kNumber) break;
    }
    return false;
  }

  std::vector<Token>& tokens_;
  std::vector<bool>& apart_;
};

/// Sets apart what was before a change or is of another drone, what is only claimed, what a law says, and all but one of
/// several conditions.
void SetPastFiguresApart(std::vector<Token>& tokens, std::vector<bool>& apart);

/// Sets apart what sentences of another drone, of a former one, or of what can be had besides say again.
void SetOtherSentencesApart(std::vector<Token>& tokens, std::vector<bool>& apart);

/// Sets apart numbers of names ("turbine 14", "job 0093"), money in pounds and hours of work; "hex keys" are no drones.
void SetSideNumbersApart(std::vector<Token>& tokens, std::vector<bool>& apart);

/// Whether the "in" at that token, after a number, begins a phrase ("two in spring") rather than being inches.
bool IsPreposition(const std::vector<Token>& tokens, size_t in);

}  // namespace airsim360::internal
