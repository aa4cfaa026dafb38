// Fields of the request and what stands around a number.
#include "airsim360/flight/prompt/reader.h"

#include <cmath>
#include <cstdio>

#include "airsim360/base/error.h"

namespace airsim360::internal {
namespace {

std::string Spoken(std::string name) {
  for (char& c : name) c = c == '_' ? ' ' : c;
  return name;
}

/// Whether a noun can have a figure in such a unit at all: masses have no length, speeds no mass.
bool CanHave(WordKind noun, WordKind unit) {
  const bool timed = noun == WordKind::kHover || noun == WordKind::kFlight || noun == WordKind::kSpeed || noun == WordKind::kThrustRatio;
  if (unit == WordKind::kLengthUnit) {
    return !timed && noun != WordKind::kMass && noun != WordKind::kEmpty && noun != WordKind::kPayload && noun != WordKind::kWind &&
           noun != WordKind::kBare && noun != WordKind::kThrust;
  }
  if (unit != WordKind::kMassUnit) return true;
  return !timed && noun != WordKind::kWheelbase && noun != WordKind::kAcross && noun != WordKind::kPitch && noun != WordKind::kArm &&
         noun != WordKind::kThing;
}

constexpr size_t kPhrase = 7;  // tokens on either side that a noun is looked for

}  // namespace

void Reader::Decide(const std::string& sentence) { request_.decided.push_back(sentence); }

void Reader::Set(const FieldRange& range, Field& field, double value, const std::string& words) {
  if (!(value >= range.low && value <= range.high)) {
    char text[96];
    std::snprintf(text, sizeof(text), "%g to %g%s%s", range.low, range.high, *range.unit ? " " : "", range.unit);
    throw InputError("'" + words + "': the " + Spoken(range.name) + " of a drone is " + text);
  }
  anything_ = true;
  // The same in other units ("1 lb (450 g)") is no contradiction.
  if (field && std::abs(*field - value) > 0.02 * std::max(*field, value)) Contradiction(range.name, words);
  if (field) return;
  field = value;
  request_.words[range.name] = words;
  if (spanning_ != nullptr && spanning_->high > 0)
    request_.ranges[range.name] = {value * spanning_->low / spanning_->value, value * spanning_->high / spanning_->value};
}

bool Reader::GivesWay(const char* name, Field& field, double value, int plainness, const std::string& words) {
  constexpr int kSaid = 2;  // of a field that was read elsewhere
  const auto said = plainness_.try_emplace(name, field ? kSaid : plainness).first;
  const bool same = !field || std::abs(*field - value) <= 0.02 * std::max(*field, value);
  if (!same && (plainness == 0 || plainness < said->second)) {
    Decide("'" + words + "' is left out beside '" + request_.words[name] + "'");
    return true;
  }
  if (!same && plainness > said->second) {
    Decide("'" + request_.words[name] + "' is left out beside '" + words + "'");
    field.reset();
    request_.words.erase(name);
  }
  said->second = std::max(said->second, plainness);
  return false;
}

void Reader::CorrectWith(const char* name, Field& field, size_t i) {
  bool near = true;
  for (size_t k = i; k-- > 0 && i - k < 10;) {
    near &= i - k < 5;
    // "a bicopter - scratch that, the supervisor wants a quad": such words reach further, up to the next
    // figure.
    if (!near && tokens_[k].kind == Token::Kind::kNumber) break;
    if (!near && !(Is(k, WordKind::kCorrection) && (tokens_[k].text.size() > 6 || IsOneOf(tokens_[k].text, {"sorry", "oops"})))) continue;
    // "22 inch? no, 18 inch", "half an hour minus a few, say 24 minutes"
    const bool no = (tokens_[k].text == "no" || tokens_[k].text == "say") && k > 0 &&
                    (tokens_[k - 1].kind == Token::Kind::kComma || tokens_[k - 1].kind == Token::Kind::kDash);
    // "four minutes there and four back, so 8 minutes"
    const bool sum = tokens_[k].text == "so" && k + 1 == i && k > 0 && tokens_[k - 1].kind == Token::Kind::kComma;
    // "1S? 2S"
    const bool doubt = tokens_[k].text == "?" && k + 1 == i;
    if ((no || Is(k, WordKind::kCorrection)) && std::string_view(name) == "rotors") bad_rotors_.reset();
    if ((no || doubt || sum || Is(k, WordKind::kCorrection)) && field) {
      Decide("'" + tokens_[k].text + "' takes back '" + request_.words[name] + "'");
      field.reset();
      request_.words.erase(name);
    }
  }
}

/// "2 x 16000 mAh in parallel (32 Ah in all)": a sum replaces what it is of.
void Reader::SumUp(const char* name, Field& field, const Quantity& q) {
  const size_t next = q.last + 1;
  if (!field || next >= tokens_.size() || q.value <= *field) return;
  const std::string& text = tokens_[next].text;
  if (text != "in all" && text != "altogether" && text != "all together" && text != "in total" && text != "total") return;
  Decide("'" + q.words + "' is the sum of '" + request_.words[name] + "'");
  field.reset();
  request_.words.erase(name);
}

void Reader::Contradiction(const char* name, const std::string& words) {
  contradicted_ = true;
  throw InputError("'" + words + "' contradicts '" + request_.words.at(name) + "': both say the " + Spoken(name));
}

const Word* Reader::WordAt(size_t i) const {
  return i < tokens_.size() && tokens_[i].kind == Token::Kind::kWord ? tokens_[i].word : nullptr;
}

bool Reader::EndsPhrase(size_t i) const {
  return tokens_[i].kind == Token::Kind::kComma || Is(i, WordKind::kBreak) || Is(i, WordKind::kCorrection);
}

bool Reader::SaysLittle(size_t i) const {
  return Is(i, WordKind::kFiller) || Is(i, WordKind::kTo) || Is(i, WordKind::kAtMost) || tokens_[i].kind == Token::Kind::kDash;
}

/// Nouns that a number can belong to.
bool Reader::Claims(size_t i) const {
  const Word* word = WordAt(i);
  if (word == nullptr) return tokens_[i].kind == Token::Kind::kModel;
  switch (word->kind) {
    case WordKind::kDrone:
    case WordKind::kRotors:
    case WordKind::kCoaxial:
      return true;
    default:
      return word->kind >= WordKind::kRotorNoun && word->kind <= WordKind::kElse;
  }
}

/// "900 g (without battery)": the label that stands alone in parentheses after a quantity, else kNone.
size_t Reader::LabelInParentheses(size_t open) const {
  if (open >= tokens_.size() || tokens_[open].text != "(") return kNone;
  size_t found = kNone;
  for (size_t i = open + 1; i < tokens_.size() && i < open + 6; ++i) {
    if (tokens_[i].text == ")") return found;
    if (tokens_[i].kind == Token::Kind::kNumber || tokens_[i].kind == Token::Kind::kComma) return kNone;
    const bool label = Is(i, WordKind::kBare) || Is(i, WordKind::kEmpty) || Is(i, WordKind::kMass) || Is(i, WordKind::kWheelbase) ||
                       Is(i, WordKind::kHover) || Is(i, WordKind::kPropeller) ||
                       (Is(i, WordKind::kPayload) && tokens_[i].text.starts_with("payload"));
    if (label && found == kNone && !claimed_[i]) found = i;
  }
  return kNone;
}

size_t Reader::NounAfter(const Quantity& q) const {
  size_t found = kNone;
  if (const size_t label = LabelInParentheses(q.last + 1); label != kNone && q.unit && CanHave(WordAt(label)->kind, q.unit->kind))
    return label;
  for (size_t i = q.last + 1; i < tokens_.size() && i <= q.last + kPhrase; ++i) {
    if (tokens_[i].text == "(" && i == q.last + 1) {  // "5 lb (2.27 kg) payload"
      size_t close = i + 1;
      while (close < tokens_.size() && close < i + 6 && tokens_[close].text != ")") ++close;
      if (close < tokens_.size() && tokens_[close].text == ")" && Is(close - 1, q.unit->kind)) {
        i = close;
        continue;
      }
    }
    const Token::Kind kind = tokens_[i].kind;
    // "40 mm 4-blade props"
    const size_t blades = i + 1 < tokens_.size() && tokens_[i + 1].kind == Token::Kind::kDash ? i + 2 : i + 1;
    if (kind == Token::Kind::kNumber && Is(blades, WordKind::kBlades)) continue;
    if (EndsPhrase(i) || kind == Token::Kind::kNumber || kind == Token::Kind::kPropellerCode) break;
    // "of" joins only at once: "2 kg of bait", not "2 kg drone of ..."
    if (found != kNone && SaysLittle(i) && kind != Token::Kind::kDash) break;
    // "a 2 kg quad carrying ..." goes on with something else.
    const std::string& text = tokens_[i].text;
    const bool verb = (Is(i, WordKind::kPayload) || Is(i, WordKind::kMass) || Is(i, WordKind::kHover) || Is(i, WordKind::kWind)) &&
                      (text.ends_with("ing") || text.ends_with("s") || text == "carry") && !text.ends_with("payloads") &&
                      !text.ends_with("mass");
    if (verb && found != kNone) break;
    if (!Claims(i) || claimed_[i]) continue;
    if (WordAt(i) && q.unit && !CanHave(WordAt(i)->kind, q.unit->kind)) break;
    // "A 1.5 kg parachute: climb, drop"
    if (found != kNone && Is(found, WordKind::kLoad) && Is(i, WordKind::kElse) && q.unit && q.unit->kind == WordKind::kMassUnit) break;
    // "4 kg payload 1 kg": the noun is of the number after it, which has no other.
    size_t own = i + 1;
    while (own < tokens_.size() && SaysLittle(own)) ++own;
    if (own + 1 < tokens_.size() && tokens_[own].kind == Token::Kind::kNumber && q.unit && Is(own + 1, q.unit->kind) &&
        (verb || own + 2 >= tokens_.size() || EndsPhrase(own + 2) || tokens_[own + 2].kind == Token::Kind::kNumber))
      break;
    found = i;
    // These say for certain; of other nouns the last is the head: "249 g camera drone".
    const Word* word = WordAt(i);
    if (word && (word->kind == WordKind::kMass || word->kind == WordKind::kPayload || word->kind == WordKind::kEmpty ||
                 word->kind == WordKind::kElse || word->kind == WordKind::kBare))
      break;
  }
  return found;
}

size_t Reader::NounBefore(const Quantity& q, bool adjacent) const {
  const bool times = q.first > 1 && Is(q.first - 1, WordKind::kTimes);  // "batteries 2 x 1.9 kg"
  for (size_t i = times ? FirstOf(q) : q.first; i-- > 0 && q.first - i <= kPhrase;) {
    if (tokens_[i].text == ")" && i + 1 == q.first) {  // "AUW (with battery) 2 kg"
      while (i > 0 && tokens_[i].text != "(") --i;
      continue;
    }
    const Token::Kind kind = tokens_[i].kind;
    if (EndsPhrase(i) || kind == Token::Kind::kNumber || kind == Token::Kind::kPropellerCode) break;
    const Word* word = WordAt(i);
    if (word && IsUnitKind(word->kind) && i > 0 && tokens_[i - 1].kind == Token::Kind::kNumber) break;
    if (Claims(i)) {
      const bool able = !WordAt(i) || !q.unit || CanHave(WordAt(i)->kind, q.unit->kind);
      return claimed_[i] || !able ? kNone : i;
    }
    if (adjacent && !SaysLittle(i)) break;
  }
  return kNone;
}

size_t Reader::Apposed(const Quantity& q) const {
  size_t open = q.first;
  while (open-- > 0 && SaysLittle(open)) {
  }
  if (open == kNone || (tokens_[open].text != "(" && tokens_[open].text != "[")) return kNone;
  size_t close = q.last + 1;
  while (close < tokens_.size() && SaysLittle(close)) ++close;
  if (Is(close, WordKind::kBreak) && tokens_[close].text == "with" && Is(close + 1, WordKind::kLoad)) close += 2;
  if (close < tokens_.size() && tokens_[close].kind != Token::Kind::kComma) return kNone;
  // "... and the nacelle (600 g)": a thing that the lexicon does not know is named right before.
  const bool thing =
      open > 0 && q.unit->kind == WordKind::kMassUnit && tokens_[open - 1].kind == Token::Kind::kUnknown && IsThing(open - 1);
  if (thing) return kNone;
  bool carried = false;
  for (size_t i = 0; i < open; ++i) carried |= Is(i, WordKind::kPayload);
  for (size_t i = open; i-- > 0 && open - i <= 10 && tokens_[i].kind != Token::Kind::kComma;) {
    if (!Claims(i)) continue;
    if (claimed_[i] || (WordAt(i) && !CanHave(WordAt(i)->kind, q.unit->kind))) return kNone;
    // "a quad with a GoPro (900 g)": no GoPro is so heavy.
    if (Is(i, WordKind::kLoad) && !carried && WordAt(i)->value > 0 && q.value > 2 * WordAt(i)->value) return kNone;
    return i;
  }
  return kNone;
}

/// The number of a volume before the parenthesis that `q` opens: "1 litre of lake water (call it 1 kg)"; else
/// kNone.
size_t Reader::VolumeBefore(const Quantity& q) const {
  size_t open = q.first;
  while (open-- > 0 && (SaysLittle(open) || Is(open, WordKind::kCorrection))) {
  }
  if (open == kNone || tokens_[open].text != "(" || q.unit->kind != WordKind::kMassUnit || NounAfter(q) != kNone) return kNone;
  for (size_t k = open; k-- > 1 && open - k < 6 && tokens_[k].kind != Token::Kind::kComma;) {
    if (Is(k, WordKind::kVolumeUnit)) return k - 1;
    if (tokens_[k].kind == Token::Kind::kNumber) return kNone;
  }
  return kNone;
}

bool Reader::IsRestated(const Quantity& q) const {
  if (const size_t volume = VolumeBefore(q); volume != kNone) {
    const double litres = tokens_[volume].value * tokens_[volume + 1].word->value;
    if (std::abs(litres - q.value) < 0.05 * q.value) return true;
  }
  if (q.first < 3 || tokens_[q.first - 1].text != "(" || !Is(q.first - 2, q.unit->kind)) return false;
  size_t number = q.first - 3;
  if (tokens_[number].kind == Token::Kind::kDash && number > 0) --number;
  if (tokens_[number].kind != Token::Kind::kNumber) return false;
  const double other = tokens_[number].value * tokens_[q.first - 2].word->value;
  return std::abs(other - q.value) < 0.05 * q.value;
}

/// "not 10 inch but 12 inch", "instead of 3S".
bool Reader::IsTakenBack(const Quantity& q) const {
  size_t i = q.first;
  while (i-- > 0 && (tokens_[i].text == "a" || tokens_[i].text == "an" || tokens_[i].text == "the")) {
  }
  return i != kNone && (tokens_[i].text == "not" || tokens_[i].text.starts_with("not a") || tokens_[i].text.starts_with("instead of") ||
                        tokens_[i].text.starts_with("rather than"));
}

size_t Reader::OwnerOfDiameter(const Quantity& q) const {
  const auto owns = [&](size_t i) {
    const Word* word = WordAt(i);
    if (word == nullptr) return tokens_[i].kind == Token::Kind::kModel;
    return word->kind == WordKind::kPropeller || word->kind == WordKind::kRotorNoun || word->kind == WordKind::kBlades ||
           word->kind == WordKind::kArm || word->kind == WordKind::kFrame || word->kind == WordKind::kDrone ||
           word->kind == WordKind::kRotors || word->kind == WordKind::kLoad || word->kind == WordKind::kWheelbase;
  };
  for (size_t i = q.first; i-- > 0 && q.first - i <= kPhrase;) {
    bool each = i + 1 < tokens_.size() && tokens_[i + 1].text == "each";
    for (size_t k = q.last + 1; k < tokens_.size() && k <= q.last + 3; ++k) each |= IsOneOf(tokens_[k].text, {"each", "apiece"});
    // "Six rotors, 22 in dia."
    const bool beside = i > 0 && i + 1 == q.first && q.unit->value == 0.0254 && tokens_[i].text == "," && Is(i - 1, WordKind::kRotorNoun);
    if (tokens_[i].kind == Token::Kind::kComma && !each && !beside && tokens_[i].text != "(") break;
    if (owns(i)) return i;
  }
  for (size_t i = q.last + 1; i < tokens_.size() && tokens_[i].kind != Token::Kind::kComma; ++i) {
    if (owns(i)) return i;
  }
  return kNone;
}

bool Reader::PhraseHas(const Quantity& q, WordKind kind) const {
  for (size_t i = q.last + 1; i < tokens_.size() && !EndsPhrase(i); ++i) {
    if (tokens_[i].kind == Token::Kind::kNumber) break;
    if (Is(i, kind)) return true;
  }
  for (size_t i = q.first; i-- > 0 && !EndsPhrase(i);) {
    if (tokens_[i].kind == Token::Kind::kNumber) break;
    if (Is(i, kind)) return true;
  }
  return false;
}

void Reader::Use(size_t i) {
  if (i == kNone) return;
  used_[i] = claimed_[i] = true;
}

bool Reader::IsAtMost(const Quantity& q) const {
  for (size_t i = q.first; i-- > 0 && q.first - i <= 3;) {
    if (Is(i, WordKind::kAtMost)) return true;
    if (!SaysLittle(i)) break;
  }
  return false;
}

}  // namespace airsim360::internal
