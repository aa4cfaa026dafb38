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
}

void Reader::SetRotors(double value, const std::string& words) {
  if (value == 3) {
    throw InputError("'" + words +
                     "': three fixed rotors cannot hold a heading, for their torques do not cancel; say 4, 6 or 8, "
                     "or Y6 for three arms with two rotors each");
  }
  if (value != 4 && value != 6 && value != 8)
    throw InputError("'" + words + "': a drone here has 4, 6 or 8 rotors");
  Set({"rotors", 4, 8, ""}, request_.rotors, value, words);
}

void Reader::CorrectWith(const char* name, Field& field, size_t i) {
  for (size_t k = i; k-- > 0 && i - k < 5;) {
    if (Is(k, WordKind::kCorrection) && field) {
      Decide("'" + tokens_[k].text + "' takes back '" + request_.words[name] + "'");
      field.reset();
      request_.words.erase(name);
    }
  }
}

void Reader::Contradiction(const char* name, const std::string& words) const {
  throw InputError("'" + words + "' contradicts '" + request_.words.at(name) + "': both say the " + Spoken(name));
}

const Word* Reader::WordAt(size_t i) const {
  return i < tokens_.size() && tokens_[i].kind == Token::Kind::kWord ? tokens_[i].word : nullptr;
}

bool Reader::EndsPhrase(size_t i) const {
  return tokens_[i].kind == Token::Kind::kComma || Is(i, WordKind::kBreak) || Is(i, WordKind::kCorrection);
}

bool Reader::SaysLittle(size_t i) const {
  return Is(i, WordKind::kFiller) || Is(i, WordKind::kTo) || Is(i, WordKind::kAtMost) ||
         tokens_[i].kind == Token::Kind::kDash;
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

size_t Reader::NounAfter(const Quantity& q) const {
  size_t found = kNone;
  for (size_t i = q.last + 1; i < tokens_.size() && i <= q.last + kPhrase; ++i) {
    const Token::Kind kind = tokens_[i].kind;
    if (EndsPhrase(i) || kind == Token::Kind::kNumber || kind == Token::Kind::kPropellerCode) break;
    // "of" joins only at once: "2 kg of bait", not "2 kg drone of ..."
    if (found != kNone && SaysLittle(i) && kind != Token::Kind::kDash) break;
    // "a 2 kg quad carrying ..." goes on with something else.
    const std::string& text = tokens_[i].text;
    const bool verb = (Is(i, WordKind::kPayload) || Is(i, WordKind::kMass) || Is(i, WordKind::kHover) ||
                       Is(i, WordKind::kWind)) &&
                      (text.ends_with("ing") || text.ends_with("s") || text == "carry") &&
                      !text.ends_with("payloads") && !text.ends_with("mass");
    if (verb && found != kNone) break;
    if (!Claims(i) || claimed_[i]) continue;
    found = i;
    // These say for certain; of other nouns the last is the head: "249 g camera drone".
    const Word* word = WordAt(i);
    if (word && (word->kind == WordKind::kMass || word->kind == WordKind::kPayload ||
                 word->kind == WordKind::kEmpty || word->kind == WordKind::kElse))
      break;
  }
  return found;
}

size_t Reader::NounBefore(const Quantity& q, bool adjacent) const {
  for (size_t i = q.first; i-- > 0 && q.first - i <= kPhrase;) {
    const Token::Kind kind = tokens_[i].kind;
    if (EndsPhrase(i) || kind == Token::Kind::kNumber || kind == Token::Kind::kPropellerCode) break;
    const Word* word = WordAt(i);
    if (word && word->kind >= WordKind::kMassUnit && word->kind <= WordKind::kOtherUnit && i > 0 &&
        tokens_[i - 1].kind == Token::Kind::kNumber)
      break;
    if (Claims(i)) return claimed_[i] ? kNone : i;
    if (adjacent && !SaysLittle(i)) break;
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
