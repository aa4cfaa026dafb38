// How many rotors and arms there are.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "airsim360/base/error.h"
#include "airsim360/flight/prompt/reader.h"

namespace airsim360::internal {
namespace {

/// How much larger eight propellers are that have the disc area of `count`.
std::string LargerBy(double count) {
  char text[16];
  std::snprintf(text, sizeof(text), "%.2f", std::sqrt(count / 8));
  return text;
}

}  // namespace

/// A word such as "hexacopter", "quad-arm", "tri".
void Reader::ReadRotorsWord(size_t i) {
  const Word& word = *tokens_[i].word;
  const std::string& text = tokens_[i].text;
  const size_t next = i + 1 < tokens_.size() && tokens_[i + 1].kind == Token::Kind::kDash ? i + 2 : i + 1;
  const auto next_is = [&](std::initializer_list<const char*> words) {
    return next < tokens_.size() && std::any_of(words.begin(), words.end(), [&](const char* w) { return tokens_[next].text == w; });
  };
  if (next_is({"core", "cores", "bike", "lock", "hd", "band", "sim"})) return;  // "a quad-core computer"
  // "tri-blade" and "tri 51466" are of the propellers.
  if (text == "tri" && (rotor_words_ > 1 || Is(next, WordKind::kPropeller) || Is(next, WordKind::kBlades) ||
                        (next < tokens_.size() && tokens_[next].kind != Token::Kind::kComma)))
    return;
  used_[i] = true;
  // "A quad-arm octo", but no "quadrotor arm length"
  if (next_is({"arm", "arms"}) && !(next + 1 < tokens_.size() && tokens_[next + 1].kind == Token::Kind::kNumber)) {
    SetArms(word.value, text + " " + tokens_[next].text);
    return Use(next);
  }
  const bool negated = i > 0 && ((Is(i - 1, WordKind::kNegation) && tokens_[i - 1].text != "never") || tokens_[i - 1].text == "not");
  if (negated) return;
  if (i > 1 && (tokens_[i - 1].text == "or" || tokens_[i - 1].text == "/") &&
      (Is(i - 2, WordKind::kRotors) || Is(i - 2, WordKind::kCoaxial)))
    return Decide("of '" + tokens_[i - 2].text + "' and '" + text + "' the first is taken");
  CorrectWith("rotors", request_.rotors, i);
  SetRotors(word.value, text);
}

/// A number of rotors that no drone here has is refused at the end, unless it is taken back.
void Reader::SetRotors(double value, const std::string& words) {
  if (value < 4 || value > 8 || value != std::floor(value)) {
    anything_ = true;
    if (!bad_rotors_) bad_rotors_ = {value, words};
    return;
  }
  // "A coaxial octo on a quad frame" has four arms.
  if (coaxial_said_ && request_.rotors && *request_.rotors == 2 * value) return SetArms(value, words);
  if (coaxial_said_ && request_.rotors && 2 * *request_.rotors == value) {
    SetArms(*request_.rotors, request_.words["rotors"]);
    request_.rotors.reset();
  }
  Set({"rotors", 4, 8, ""}, request_.rotors, value, words);
}

void Reader::SetArms(double value, const std::string& words) {
  anything_ = true;
  arm_count_ = value;
  request_.words["arms"] = words;
}

/// "Two spare propellers", "a bag of 8 props", "motors: two spare".
bool Reader::IsSpare(size_t i, size_t noun) const {
  const size_t first = i >= 3 ? i - 3 : 0, last = std::min(noun + 3, tokens_.size());
  for (size_t k = i; k-- > first && tokens_[k].kind != Token::Kind::kComma;) {
    if (tokens_[k].text == "spare" || tokens_[k].text == "bag" || tokens_[k].text == "extra") return true;
  }
  for (size_t k = i + 1; k < last && (k < noun || tokens_[k].kind != Token::Kind::kComma); ++k) {
    for (const char* word : {"spare", "spares", "extra", "replacement", "additional", "backup", "broken", "bent"}) {
      if (tokens_[k].text == word) return true;
    }
  }
  return false;
}

/// "Two motors on each arm"
bool Reader::IsPairOnArm(size_t i, size_t noun) const {
  if (tokens_[i].value != 2) return false;
  for (size_t n = noun + 1; n < tokens_.size() && n < noun + 5; ++n) {
    if (tokens_[n].text == "each" || tokens_[n].text == "per" || Is(n, WordKind::kArm)) return true;
  }
  for (size_t n = i; n-- > 0 && i - n < 5;) {
    if (Is(n, WordKind::kArm)) return true;
  }
  return false;
}

/// Number `i` of rotors, motors or propellers.
void Reader::ReadRotorCount(size_t i, size_t noun) {
  const double value = tokens_[i].value;
  const std::string words = tokens_[i].text + " " + tokens_[noun].text;
  if (IsSpare(i, noun)) return;
  if (IsPairOnArm(i, noun)) {
    used_[i] = true;
    return SetLayout("coaxial", words);
  }
  // "One motor has a bent bell" counts nothing where the number of rotors is said otherwise.
  const bool known = request_.rotors || model_ || rotor_words_ > 0 || arm_count_;
  const bool chipped = noun + 1 < tokens_.size() && tokens_[noun + 1].kind == Token::Kind::kUnknown;
  const bool exactly = i > 0 && (tokens_[i - 1].text == "exactly" || tokens_[i - 1].text == "only" || tokens_[i - 1].text == "just");
  if (value < 3 && exactly && Is(noun, WordKind::kRotorNoun)) return SetRotors(value, words);
  if (value < 3 && (known || (chipped && !Is(noun, WordKind::kRotorNoun)))) return;
  used_[i] = true;
  if (value == 3 && request_.layout == RotorLayout::kCoaxial) return;
  // "4 or 6 rotors"
  if (i > 1 && tokens_[i - 1].text == "or" && tokens_[i - 2].kind == Token::Kind::kNumber) {
    Decide("of '" + tokens_[i - 2].text + "' and '" + words + "' the first is taken");
    used_[i - 2] = true;
    return SetRotors(tokens_[i - 2].value, tokens_[i - 2].text + " " + tokens_[noun].text);
  }
  CorrectWith("rotors", request_.rotors, i);
  SetRotors(value, words);
}

/// "six rotors", "4x 2212 motors", "three 12 inch propellers", "3-blade".
bool Reader::ReadCount(size_t i) {
  const Token& token = tokens_[i];
  const bool whole = token.value == std::floor(token.value);
  const bool none = token.value < 1 || (i + 1 < tokens_.size() && Is(i + 1, WordKind::kRotorNoun) && (!whole || token.value > 40));
  if (none && (Is(i + 1, WordKind::kRotorNoun) || Is(i + 1, WordKind::kPropeller) || Is(i + 1, WordKind::kMotor)) && token.value < 1000)
    SetRotors(token.value, token.text + " " + tokens_[i + 1].text);
  if (!whole || token.value > 40 || token.value < 1) return false;
  // "A quick one: 4 rotors": a pronoun, and the number to come counts.
  if (token.text == "one" && i + 1 < tokens_.size() && tokens_[i + 1].kind == Token::Kind::kNumber) return false;
  bool other_words = false;
  for (size_t k = i + 1; k < tokens_.size() && k <= i + 5; ++k) {
    const Word* word = WordAt(k);
    const Token::Kind kind = tokens_[k].kind;
    if (word && word->kind == WordKind::kBlades && k <= i + 2) {
      used_[i] = true;
      Set({"blades", 2, 6, ""}, request_.blades, token.value, token.text + " " + tokens_[k].text);
      return true;
    }
    if (word && (word->kind == WordKind::kRotorNoun || word->kind == WordKind::kMotor || word->kind == WordKind::kPropeller)) {
      // "14 pole motors" are no count.
      if (other_words && (token.value < 3 || token.value > 12)) return false;
      ReadRotorCount(i, k);
      return true;
    }
    if (word && word->kind == WordKind::kArm) {
      if (other_words && !tokens_[k].text.ends_with("s")) return false;  // "a 7 joint arm"
      if (token.value < 3) return true;                                  // "one arm is chipped"
      used_[i] = true;
      SetArms(token.value, token.text + " " + tokens_[k].text);
      return true;
    }
    // "6x MN3508 380 kv"
    if (word && word->kind == WordKind::kKvUnit && Is(i + 1, WordKind::kTimes) && token.value >= 4 && token.value <= 8 &&
        !request_.rotors && rotor_words_ == 0) {
      used_[i] = true;
      SetRotors(token.value, token.text + " motors");
      return true;
    }
    const bool size = kind == Token::Kind::kNumber || kind == Token::Kind::kPropellerCode ||
                      (word && (word->kind == WordKind::kLengthUnit || word->kind == WordKind::kTimes ||
                                word->kind == WordKind::kBrushless || word->kind == WordKind::kKvUnit));
    other_words |= kind == Token::Kind::kUnknown;
    if (!size && kind != Token::Kind::kDash && kind != Token::Kind::kUnknown) break;
  }
  return false;
}

void Reader::RefuseRotors() const {
  const auto& [value, words] = *bad_rotors_;
  if (value == 3) {
    throw InputError("'" + words +
                     "': three fixed rotors cannot hold a heading, for their torques do not cancel, and a servo that tilts the "
                     "rotor at the tail is not modelled; say 4 to 8 (a quad comes nearest), or Y6 for three arms with two rotors "
                     "each");
  }
  throw InputError("'" + words + "': a drone here has 4 to 8 rotors" +
                   (value > 8 ? ", and the dynamics hold no more than 8: an octocopter or an X8 with " + LargerBy(value) +
                                    " times larger propellers carries the same on the same disc area"
                              : ""));
}

void Reader::FinishRotors() {
  // "A coaxial tricopter" is a Y6.
  const bool coaxial = request_.layout == RotorLayout::kCoaxial;
  if (bad_rotors_ && bad_rotors_->first == 3 && coaxial && request_.rotors.value_or(6) == 6) {
    if (!request_.rotors) SetRotors(6, bad_rotors_->second);
    bad_rotors_.reset();
  }
  if (bad_rotors_) RefuseRotors();
  if (!arm_count_) return;
  const std::string words = request_.words["arms"];
  const double rotors = coaxial ? 2 * *arm_count_ : *arm_count_;
  if (!request_.rotors) {
    SetRotors(rotors, words);
    if (bad_rotors_) RefuseRotors();
    return;
  }
  if (*request_.rotors == 2 * *arm_count_ && !coaxial) {
    if (request_.layout) Contradiction("layout", words);
    Decide("two rotors an arm are coaxial pairs");
    return SetLayout("coaxial", words);
  }
  if (*request_.rotors != rotors) Contradiction("rotors", words);
}

}  // namespace airsim360::internal
