// What is no multirotor, and what is one of which nothing else is said.
#include <algorithm>

#include "airsim360/base/error.h"
#include "airsim360/flight/prompt/reader.h"

namespace airsim360::internal {

/// Whether a thing is only what the drone is for: "a drone to film boats".
bool Reader::IsPurpose(size_t i) const {
  bool purpose = false;
  for (size_t k = 0; k < i; ++k) {
    const std::string& text = tokens_[k].text;
    if (text == "for" || text == "to" || text == "near" || text == "over" || text == "from" || text == "through" || text == "against" ||
        text == "following" || text == "filming" || text == "film" || text == "chasing" || text == "inspecting" || text == "inspection" ||
        text == "launched from" || text == "on" || text == "off")
      purpose = true;
    if (tokens_[k].kind == Token::Kind::kComma) purpose = false;
  }
  return purpose;
}

/// Whether a thing is what is described: nothing before it that speaks of flying, and no verb that it is the object of.
bool Reader::IsHead(size_t i) const {
  for (size_t k = 0; k < i; ++k) {
    const Word* word = WordAt(k);
    if (tokens_[k].kind == Token::Kind::kComma || tokens_[k].text == "that" || tokens_[k].text == "which") return false;
    if (word && (word->kind == WordKind::kBreak || word->kind == WordKind::kClass || word->kind == WordKind::kHover ||
                 word->kind == WordKind::kFlight || word->kind == WordKind::kPayload || word->kind == WordKind::kGuards ||
                 word->kind == WordKind::kPropeller))
      return false;
  }
  const bool object = i > 1 && tokens_[i - 2].kind == Token::Kind::kUnknown && Is(i - 1, WordKind::kFiller);
  return !object;
}

/// Something that flies, and no word of what it is like.
void Reader::ReadNothing() {
  bool flies = false, home = false;
  for (size_t i = 0; i < tokens_.size(); ++i) {
    const std::string& text = tokens_[i].text;
    const auto is = [&](std::initializer_list<const char*> words) {
      return std::any_of(words.begin(), words.end(), [&](const char* word) { return text == word; });
    };
    flies |=
        Is(i, WordKind::kFlight) || Is(i, WordKind::kHover) || Is(i, WordKind::kWind) ||
        is({"fly", "flies", "flys", "flying", "flyer", "flier", "airborne", "something", "anything", "fliegt", "vuele", "vole", "vola"});
    home |= is({"indoor", "indoors", "inside", "house",    "home",     "room",          "kitchen", "child", "children", "kid",
                "nephew", "niece",   "son",    "daughter", "grandson", "granddaughter", "toddler", "boy",   "girl",     "cheap"});
  }
  if (!flies) return;
  anything_ = true;
  if (!home) return Decide("nothing is said of its kind or size: an ordinary quadrotor is built");
  Decide("nothing is said of its kind or size: a tiny quadrotor for the house is built");
  ReadClass("hobby", "house");
  request_.size = "tiny";
  request_.words["size"] = "house";
}

void Reader::RefuseOthers() const {
  const bool head = std::any_of(tokens_.begin(), tokens_.end(), [](const Token& token) {
    return token.kind == Token::Kind::kModel || token.Is(WordKind::kDrone) || token.Is(WordKind::kRotors) || token.Is(WordKind::kCoaxial);
  });
  for (size_t i = 1; i < tokens_.size(); ++i) {
    const bool part = Is(i, WordKind::kRotorNoun) || Is(i, WordKind::kPropeller) || Is(i, WordKind::kMotor);
    if (part && tokens_[i - 1].text == "no" && i > 1 && Is(i - 2, WordKind::kBreak))
      throw InputError("'no " + tokens_[i].text + "': a drone here is carried by 4 to 8 fixed propellers");
  }
  for (size_t i = 0; i < tokens_.size(); ++i) {
    const bool strong = Is(i, WordKind::kNoMultirotor), vehicle = Is(i, WordKind::kVehicle);
    if (!strong && !vehicle) continue;
    bool negated = false;  // "not a plane", "cheaper than a helicopter"
    for (size_t k = i; k-- > 0 && i - k <= 3;) {
      const std::string& text = tokens_[k].text;
      negated |= Is(k, WordKind::kNegation) || text == "than" || text.starts_with("replac") || text == "unlike" || text == "not" ||
                 text == "without" || text == "versus";
    }
    // "Parrot Disco? no, the Anafi"
    // "Blimp replacement"
    negated |= i + 1 < tokens_.size() && StartsAny(tokens_[i + 1].text, {"replac", "alternative", "substitute", "ersatz"});
    for (size_t k = i + 1; k + 1 < tokens_.size() && k <= i + 3; ++k)  // "underwater inspection? no, over water"
      negated |= tokens_[k].text == "?" && IsOneOf(tokens_[k + 1].text, {"no", "no no", "nope", "nah"});
    negated |= !(strong && tokens_[i].word->meaning == "an endless flight") && i + 2 < tokens_.size() &&
               tokens_[i + 1].kind == Token::Kind::kComma && tokens_[i + 2].text == "no";
    const bool drone_before = std::any_of(tokens_.begin(), tokens_.begin() + static_cast<long>(i), [](const Token& t) {
      return t.kind == Token::Kind::kModel || t.Is(WordKind::kDrone) || t.Is(WordKind::kRotors);
    });
    const bool always =
        strong && (tokens_[i].word->meaning == "a VTOL with wings" || tokens_[i].word->meaning == "a place without air to fly in" ||
                   tokens_[i].word->meaning == "an endless flight");
    // The law of three rotors says more of it.
    const bool tricopter = tokens_[i].text.starts_with("tilt") && std::any_of(tokens_.begin(), tokens_.end(), [](const Token& token) {
                             return token.Is(WordKind::kRotors) && token.word->value == 3;
                           });
    if (tricopter) continue;
    // What is carried is not what it is: "drops a water balloon".
    if (!always && FollowsCarryVerb(i) && drone_before) continue;
    if (negated || (strong && !always && drone_before && IsPurpose(i)) || (vehicle && (head || IsPurpose(i) || !IsHead(i)))) continue;
    throw InputError("'" + tokens_[i].text + "' is " + std::string(tokens_[i].word->meaning) +
                     ", not a multirotor: a drone here is carried by 4 to 8 fixed propellers alone");
  }
}

}  // namespace airsim360::internal
