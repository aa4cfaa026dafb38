// Masses of things that are carried. Nouns are an open class, so no list has them all: a mass that a sentence gives
// to something other than the drone or its parts is carried, whatever that something is.
#include <algorithm>

#include "airsim360/flight/prompt/reader.h"
#include "airsim360/flight/prompt/thing_words.h"

namespace airsim360::internal {
namespace {

constexpr size_t kClause = 14;      // tokens that a verb reaches
constexpr size_t kSpanOfThing = 5;  // tokens of a thing's name

/// Ends a sentence, not only a phrase.
bool EndsSentence(const Token& token) { return token.kind == Token::Kind::kComma && IsOneOf(token.text, {".", "!", "?", ";", "|"}); }

bool IsParenthesis(const Token& token) { return token.text == "(" || token.text == "["; }

bool IsLink(const Token& token) {
  return IsOneOf(token.text, {"is",      "are",       "was",      "be",    "comes",        "come",           "coming",
                              "totals",  "totalling", "totaling", "total", "makes",        "make",           "weighs",
                              "weigh",   "weighing",  "weight",   "mass",  "weighs in at", "weighing in at", "tips the scales at",
                              "wiegt",   "wiegen",    "schwer",   "pese",  "pesant",       "pesa",           "pesan",
                              "pesando", "gewicht",   "has",      "have",  "hat",          "tiene",          "ha",
                              "adds",    "add",       "poids",    "peso",  "masse",        "masa",           "weighed",
                              "pesent",  "ist",       "est",      "es"});
}

}  // namespace

/// The drone, by any word for it.
bool Reader::IsDroneWord(size_t i) const {
  const Token& token = tokens_[i];
  const Word* word = WordAt(i);
  if (token.kind == Token::Kind::kModel) return true;
  if (token.kind == Token::Kind::kNumber) return false;
  if (NamesWhole(token.text) && IsNamedThing(i)) return false;
  if (word == nullptr) return MeansDrone(token.text);
  if (IsCarryVerb(token.text)) return false;
  if (word->kind == WordKind::kClass) {
    return token.text.ends_with("er") || token.text.ends_with("ers") || token.text.find("whoop") != std::string::npos ||
           token.text.find("drone") != std::string::npos || token.text.find("drohne") != std::string::npos;
  }
  return word->kind == WordKind::kDrone || word->kind == WordKind::kRotors || word->kind == WordKind::kCoaxial || MeansDrone(token.text);
}

/// "Defibrillator kit", "carry a rescue kit": no drone, though a kit alone is one.
bool Reader::IsNamedThing(size_t i) const { return (i > 0 && IsThing(i - 1)) || FollowsCarryVerb(i); }

bool Reader::FollowsCarryVerb(size_t i) const {
  for (size_t k = i; k-- > 0 && i - k <= kSpanOfThing && !EndsPhrase(k);) {
    if (IsCarryVerb(tokens_[k].text)) return true;
  }
  return false;
}

/// The number before a mass that counts what has it ("5 x 800 g", "two 900 g"), else the mass itself.
size_t Reader::FirstOf(const Quantity& q) const {
  const size_t times = q.first > 1 && Is(q.first - 1, WordKind::kTimes) ? 1 : 0;
  if (q.first < times + 1) return q.first;
  const size_t count = q.first - times - 1;
  return tokens_[count].kind == Token::Kind::kNumber && tokens_[count].value <= 12 ? count : q.first;
}

/// "Of that 300 g is gimbal", "1.5 kg of which are reserved".
bool Reader::IsShare(const Quantity& q) const {
  const auto points = [&](size_t k) {
    return k < tokens_.size() && IsOneOf(tokens_[k].text, {"that", "which", "this", "it", "these", "those"});
  };
  const size_t after = q.last + 1;
  if (after < tokens_.size() && tokens_[after].text == "of" && points(after + 1)) return true;
  for (size_t k = q.first; k-- > 0 && q.first - k <= 4 && tokens_[k].kind != Token::Kind::kComma;) {
    if (IsOneOf(tokens_[k].text, {"davon", "dont", "thereof"})) return true;
    if (tokens_[k].text == "of" && points(k + 1)) return true;
  }
  return false;
}

/// Something that can be carried.
bool Reader::IsThing(size_t i) const {
  const Token& token = tokens_[i];
  const Word* word = WordAt(i);
  if (NamesWhole(token.text) && IsNamedThing(i)) return true;
  if (token.kind == Token::Kind::kUnknown) {
    const bool code = IsProductCode(token.text) && i > 0 && tokens_[i - 1].kind == Token::Kind::kUnknown;
    return CanBeThing(code ? tokens_[i - 1].text : token.text);
  }
  if (word == nullptr) return false;
  if (token.text == "arm" && i > 0 && tokens_[i - 1].text == "dof") return true;  // "2-DoF arm"
  if (token.text == "arm" && i > 0 && tokens_[i - 1].kind == Token::Kind::kUnknown)
    return CanBeThing(tokens_[i - 1].text);  // "contact arm"
  if (word->kind == WordKind::kClass) return IsOneOf(token.text, {"cargo", "freight", "drop", "crop", "spray"});
  if (word->kind == WordKind::kElse) {
    return IsOneOf(token.text, {"lens", "screen", "display", "monitor", "tv", "lcd", "oled", "antenna", "barrel", "filter", "cable",
                                "goggles", "controller", "transmitter", "imager", "tether", "sensor"});
  }
  return word->kind == WordKind::kLoad || word->kind == WordKind::kThing || word->kind == WordKind::kVehicle ||
         (word->kind == WordKind::kPayload && token.text.starts_with("payload"));
}

bool Reader::IsPart(size_t i) const {
  const Word* word = WordAt(i);
  return word && ((word->kind >= WordKind::kRotorNoun && word->kind <= WordKind::kBlades) || word->kind == WordKind::kArm ||
                  word->kind == WordKind::kFrame || word->kind == WordKind::kBattery || word->kind == WordKind::kGuards ||
                  word->kind == WordKind::kLithiumIon || word->kind == WordKind::kCells);
}

bool Reader::SpeaksOfDrone(size_t from, size_t to) const {
  for (size_t k = from; k < to; ++k) {
    const Word* word = WordAt(k);
    if (IsDroneWord(k) || (word && (word->kind == WordKind::kClass || word->kind == WordKind::kSize || word->kind == WordKind::kLayout)))
      return true;
  }
  return false;
}

/// The verb of carrying whose object reaches token `i`, else kNone. A drone, another mass and the end of the
/// sentence end it.
size_t Reader::CarryVerbBefore(size_t i) const {
  size_t commas = 0;
  for (size_t k = i; k-- > 0 && i - k <= kClause;) {
    if (EndsSentence(tokens_[k]) || tokens_[k].kind == Token::Kind::kModel) return kNone;
    commas += tokens_[k].text == ",";
    if (commas > 2 || IsDroneWord(k)) return kNone;
    if (Is(k, WordKind::kMassUnit) && k > 0 && tokens_[k - 1].kind == Token::Kind::kNumber) return kNone;
    // "Supports", "holds" are nouns and names as well: a noun has its article.
    const bool verb = IsCarryVerb(tokens_[k].text) && !(k > 0 && IsArticle(tokens_[k - 1].text));
    if (verb && (!claimed_[k] || Is(k, WordKind::kClass))) return k;
  }
  return kNone;
}

/// "900 g self-inflating buoy", "5 lb boxes": the thing named right after a mass, with what makes it one of the
/// sentence's things: a verb of carrying, "with", "for", "plus", or "a" where the drone was named before.
bool Reader::IsOfThingAfter(const Quantity& q) const {
  // Chinese has no articles.
  if (q.first > 0 && IsOneOf(tokens_[q.first - 1].text, {"携带", "搭载", "带", "装", "挂", "吊"})) return true;
  size_t head = q.last + 1;
  bool of = false;
  if (head < tokens_.size() && tokens_[head].text == "worth") return true;
  for (; head < tokens_.size() &&
         (IsOneOf(tokens_[head].text, {"of", "de", "di", "von", "d", "worth"}) || tokens_[head].kind == Token::Kind::kDash);
       ++head)
    of |= tokens_[head].kind != Token::Kind::kDash;
  size_t last = kNone;
  for (size_t k = head; k < tokens_.size() && k < head + kSpanOfThing && !EndsPhrase(k); ++k) {
    const Token::Kind kind = tokens_[k].kind;
    if (kind == Token::Kind::kNumber || kind == Token::Kind::kPropellerCode || Is(k, WordKind::kPayload)) break;
    // "Hexa with a 4 kg spreader": of two words for a drone the second is a thing.
    const bool second = Is(k, WordKind::kClass) && SpeaksOfDrone(0, q.first) && IsFitted(q.first);
    if (second) return true;
    if (IsDroneWord(k) || IsPart(k) || Is(k, WordKind::kMass) || Is(k, WordKind::kBare) || Is(k, WordKind::kEmpty)) return false;
    const bool can = k > head && tokens_[k].text == "can" && !IsArticle(tokens_[k - 1].text);  // "a spray can"
    if (k > head && SaysLittle(k) && kind != Token::Kind::kDash && !can) break;
    if (kind != Token::Kind::kDash && !(SaysLittle(k) && of)) last = k;
  }
  if (last == kNone || (!IsThing(last) && tokens_[last].text != "can")) return false;
  const size_t first = FirstOf(q);
  return of || CarryVerbBefore(first) != kNone || IsIntroduced(first);
}

/// Whether "with", "for", "plus" or an article after the drone's name introduce what follows token `i`.
bool Reader::IsIntroduced(size_t i) const {
  bool article = false;
  size_t k = i;
  for (; k-- > 0 && i - k <= kSpanOfThing;) {
    const std::string& text = tokens_[k].text;
    if (IsArticle(text)) {
      article = true;
    } else if (!(SaysLittle(k) || Is(k, WordKind::kLoad) || (tokens_[k].kind == Token::Kind::kUnknown && !MeansDrone(text))) ||
               JoinsThing(text)) {
      break;
    }
  }
  if (k == kNone) return false;
  const std::string& text = tokens_[k].text;
  const bool sought = k > 0 && IsOneOf(tokens_[k - 1].text, {"looking", "search", "searching", "quote", "quotes", "asking", "shopping",
                                                             "hunting", "plans", "aiming"});
  if (JoinsThing(text)) return !sought;
  const bool wished = IsOneOf(text, {"want", "need", "build", "make", "have", "got", "is", "design", "give me"});
  return article && !wished && !Is(k, WordKind::kCorrection) && SpeaksOfDrone(0, k + 1);
}

/// "With a", "+": what follows token `i` is fitted to the drone.
bool Reader::IsFitted(size_t i) const {
  while (i-- > 0 && (SaysLittle(i) || tokens_[i].kind == Token::Kind::kUnknown)) {
    if (tokens_[i].text == "+" || tokens_[i].text == "plus") return true;
  }
  return i != kNone && IsOneOf(tokens_[i].text, {"with", "w", "mit", "avec", "con", "plus a", "equipped with"});
}

/// The thing that token `i` ends: a noun with its governor before it. Not for a drone's own words before it.
bool Reader::IsObject(size_t i, bool weak) const {
  if (!IsThing(i)) return false;
  if (CarryVerbBefore(i) != kNone) return true;
  return weak && IsIntroduced(i);
}

/// "Scanner weighs 1.8 kg", "camera, gimbal and follow focus come to 4.2 kg", "for my teddy, he weighs 250 g".
bool Reader::IsOfWeighedThing(const Quantity& q) const {
  if (WholeBefore(q) != kNone) return false;  // "whose mass including all sensors is 1.7 kg"
  bool link = false, finite = false, pronoun = false, person = false, it = false;
  size_t k = q.first;
  while (k-- > 0) {
    const std::string& text = tokens_[k].text;
    if (IsLink(tokens_[k])) {
      link = true;
      finite |= text != "weighing" && text != "pesant" && text != "pesando";
    } else if (text == "i" && link && tokens_[k + 1].text != "weighed") {
      return true;  // who speaks wants to be carried
    } else if (IsOneOf(text, {"he", "she", "they", "it", "which", "that", "who", "it s", "il", "elle", "ella"})) {
      pronoun = link;
      it |= link && (text == "it" || text == "it s");
      person |= link && IsOneOf(text, {"he", "she", "they", "il", "elle", "ella"});
    } else if (!SaysLittle(k) && !IsOneOf(text, {"at", "in", "out", "to", "de", "von", "of", "roughly", "exactly"})) {
      break;
    }
  }
  if (k == kNone || !link) return false;
  const bool apart = tokens_[k].kind == Token::Kind::kComma || Is(k, WordKind::kBreak);
  if (pronoun && apart && k > 0) --k;
  // "With the 300 g camera it weighs 1.5 kg" is said of the drone.
  if (it && !apart) return false;
  if (tokens_[k].text == ")") {
    while (k > 0 && tokens_[k].text != "(") --k;
    if (k > 0) --k;
  }
  // "A rope 25 m long weighing 1.2 kg"
  while (k > 0 && (SaysLittle(k) || (tokens_[k].kind == Token::Kind::kUnknown && !IsThing(k)) ||
                   (!finite && (Is(k, WordKind::kLengthUnit) || tokens_[k].kind == Token::Kind::kNumber))))
    --k;
  if (pronoun && HasItsMass(k)) return false;
  if (!IsThing(k) || IsDroneWord(k) || IsPart(k)) return false;
  if (const Word* known = WordAt(k); known && known->kind == WordKind::kLoad && known->value > 0 && q.value > 2.5 * known->value)
    return false;
  if (pronoun && person) return true;
  if (pronoun && !SpeaksOfDrone(0, k)) return true;
  if (pronoun || !finite) return IsObject(k, true);
  return IsSubject(k);
}

/// "A 300 g camera": whether the mass of thing `i` stands before it.
bool Reader::HasItsMass(size_t i) const {
  for (size_t k = i; k-- > 0 && i - k <= 3 && !EndsPhrase(k);) {
    if (Is(k, WordKind::kMassUnit) && used_[k]) return true;
  }
  return false;
}

/// Whether the clause of token `i` is of a thing: no word for the drone before it, but where a verb carries it.
bool Reader::IsSubject(size_t i) const {
  // "The quad that we launch from the stern weighs": the verb's place, not its object.
  size_t before = i;
  while (before-- > 0 && IsArticle(tokens_[before].text)) {
  }
  const bool place = before != kNone && IsOneOf(tokens_[before].text, {"from", "off", "near", "behind", "beside"});
  for (size_t k = i; k-- > 0 && i - k <= kClause;) {
    if (EndsSentence(tokens_[k]) || tokens_[k].kind == Token::Kind::kNumber) return true;
    if (tokens_[k].text == "," || tokens_[k].text == "(") return true;
    if (!place && IsCarryVerb(tokens_[k].text) && (!claimed_[k] || Is(k, WordKind::kClass))) return true;
    // "A drone for my teddy weighs": of the drone. "The drone's camera weighs": of the camera.
    if (IsDroneWord(k) || IsPart(k)) return i - k == 1;
  }
  return true;
}

/// "Haul a Komodo with lens, 1.6 kg", "for a Sony a6000 (468 g with the 20 mm lens)".
bool Reader::IsApposedToThing(const Quantity& q) const {
  size_t comma = FirstOf(q);
  while (comma-- > 0 && ((SaysLittle(comma) && (tokens_[comma].kind != Token::Kind::kDash || tokens_[comma].glued)) ||
                         IsOneOf(tokens_[comma].text, {"exactly", "roughly", "precisely", "say"}))) {
  }
  if (comma == kNone || comma == 0) return false;
  const bool parenthesis = IsParenthesis(tokens_[comma]);
  const bool dash = tokens_[comma].kind == Token::Kind::kDash && !tokens_[comma].glued;
  if (!parenthesis && !dash && tokens_[comma].text != "," && tokens_[comma].text != "at") return false;
  // What follows the mass may say whose it is.
  for (size_t k = q.last + 1; k < tokens_.size() && k < q.last + 7; ++k) {
    if (tokens_[k].text == ")" || (!parenthesis && tokens_[k].kind == Token::Kind::kComma)) break;
    const bool whole =
        Is(k, WordKind::kMass) || Is(k, WordKind::kBare) || Is(k, WordKind::kEmpty) || IsDroneWord(k) || Is(k, WordKind::kBattery);
    if (whole) return false;
  }
  const size_t thing = comma - 1;
  const size_t verb = CarryVerbBefore(thing);
  if (verb != kNone && IsOneOf(tokens_[thing].text, {"me", "myself", "him", "her", "us", "you"})) return true;
  if (verb == kNone && tokens_[comma].text == "," && IsForThing(comma)) return true;
  if (!IsThing(thing)) return false;
  if (const Word* known = WordAt(thing); known && known->kind == WordKind::kLoad && known->value > 0) {
    if (q.value > 2.5 * known->value) return false;
    if (q.value > 0.4 * known->value) return true;
  }
  if (verb == kNone) return (parenthesis || tokens_[comma].text == "at") && IsIntroduced(thing);
  // "For carrying bait, 2.4 kg" only says what the drone is for.
  for (size_t k = verb + 1; k < thing; ++k) {
    if (IsArticle(tokens_[k].text) || tokens_[k].kind == Token::Kind::kNumber) return true;
  }
  return parenthesis || Is(thing, WordKind::kLoad);
}

/// "For a Phase One with an 80 mm lens and gimbal,": a purpose that can be weighed, by its name or code.
bool Reader::IsForThing(size_t end) const {
  bool named = false;
  for (size_t k = end; k-- > 0 && end - k <= kClause;) {
    if (tokens_[k].kind == Token::Kind::kComma || IsDroneWord(k) || IsPart(k)) return false;
    const std::string& text = tokens_[k].text;
    const bool code =
        tokens_[k].kind == Token::Kind::kUnknown && std::any_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
    named |= code || Is(k, WordKind::kLoad);
    if (text == "for") return named && k + 1 < end && IsArticle(tokens_[k + 1].text);
  }
  return false;
}

/// "With an altavoz de 150 g", "plus scanner 1.8 kg": the thing named right before a mass.
bool Reader::IsOfThingBefore(const Quantity& q) const {
  size_t thing = FirstOf(q);
  const bool with = thing > 1 && IsOneOf(tokens_[thing - 1].text, {"with", "mit", "avec", "con"}) && IsThing(thing - 2);
  if (with) --thing;  // "a parcel with 1.5 kg"
  bool of = false;
  while (thing-- > 0 && SaysLittle(thing)) of |= IsOneOf(tokens_[thing].text, {"of", "de", "von", "di", "d"});
  if (thing == kNone || !IsThing(thing) || Is(thing, WordKind::kVehicle)) return false;
  const size_t after = q.last + 1;
  if (after < tokens_.size() && !EndsPhrase(after) && !SaysLittle(after) && tokens_[after].kind != Token::Kind::kDash &&
      (IsDroneWord(after) || Is(after, WordKind::kMass)))
    return false;
  if (CarryVerbBefore(thing) != kNone) return true;
  // "A life buoy of 900 g" beside the drone
  for (size_t k = thing; of && k-- > 0 && thing - k <= 3 && !EndsPhrase(k);) {
    if (IsArticle(tokens_[k].text) && SpeaksOfDrone(0, k)) return true;
  }
  size_t start = thing;
  for (; start-- > 0 && thing - start <= kSpanOfThing;) {
    if (JoinsThing(tokens_[start].text)) return true;
    if (IsDroneWord(start) || IsPart(start)) return false;
    if (!SaysLittle(start) && tokens_[start].kind != Token::Kind::kUnknown && !IsThing(start)) break;
  }
  // ", scanner 1.8 kg," beside a drone that was named.
  return start != kNone && tokens_[start].kind == Token::Kind::kComma && SpeaksOfDrone(0, start);
}

/// "Soll Blutproben (500 g) weit bringen": the verb that ends a German clause.
bool Reader::IsBeforeFinalVerb(const Quantity& q) const {
  size_t thing = q.first;
  while (thing-- > 0 && (SaysLittle(thing) || IsParenthesis(tokens_[thing]) || IsOneOf(tokens_[thing].text, {"mit", "von"}))) {
  }
  const size_t next = q.last + 1;
  if (!(thing != kNone && IsThing(thing)) && !(next < tokens_.size() && IsThing(next))) return false;
  for (size_t k = next; k < tokens_.size() && k < next + 9; ++k) {
    if (IsOneOf(tokens_[k].text, {"bringen", "bringt", "tragen", "tragt", "heben", "hebt", "liefern", "ausliefern", "transportieren",
                                  "transportiert", "befordern", "schleppen", "abwerfen"}))
      return true;
    if (tokens_[k].kind == Token::Kind::kComma && tokens_[k].text != ")") return false;
  }
  return false;
}

/// "40 kg on a hook", "2 kg slung under it".
bool Reader::Hangs(const Quantity& q) const {
  size_t k = q.last + 1;
  for (; k < tokens_.size() && k < q.last + 5 && tokens_[k].kind != Token::Kind::kComma; ++k) {
    if (IsOneOf(tokens_[k].text, {"hook", "sling", "winch", "slung", "underslung", "hanging", "suspended", "dangling", "hung", "underneath",
                                  "beneath", "strapped", "claw", "claws", "gripper", "aboard", "hopper", "tank"}))
      return true;
    const bool goes_on = SaysLittle(k) || IsOneOf(tokens_[k].text, {"on", "in", "from", "under", "by", "off"});
    if (!goes_on && !IsThing(k)) return false;
  }
  return false;
}

/// Whether a mass with `noun` beside it is of a thing that is carried.
bool Reader::IsOfThing(const Quantity& q, size_t noun) const {
  if (!q.unit || q.unit->kind != WordKind::kMassUnit || IsAtMost(q)) return false;
  if (noun != kNone) {
    const Word* word = WordAt(noun);
    const bool weighs = word && word->kind == WordKind::kMass && !IsWhole(noun) && IsLink(tokens_[noun]);
    const bool heavy = word && word->kind == WordKind::kMass && noun > q.last && tokens_[noun].text == "heavy";
    const bool drone = IsDroneWord(noun);
    const bool vague = word && (word->kind == WordKind::kElse || word->kind == WordKind::kLoad);
    if (drone && (noun > q.last || noun + 1 == q.first)) return false;
    if (!weighs && !heavy && !drone && !vague) return false;
  }
  const bool labelled = noun != kNone && Is(noun, WordKind::kMass);
  if (labelled) return IsShare(q) || IsOfWeighedThing(q);
  return IsShare(q) || IsOfWeighedThing(q) || IsOfThingAfter(q) || IsApposedToThing(q) || IsOfThingBefore(q) || IsBeforeFinalVerb(q) ||
         Hangs(q);
}

/// "A 370 g camera, a 250 g camera", "camera 380 g, gimbal 420 g": whether a comma alone, and no word for the drone,
/// stands between a thing's mass and this one.
bool Reader::ContinuesList(const Quantity& q) const {
  bool comma = false;
  for (size_t k = q.first; k-- > 0 && q.first - k <= kSpanOfThing + 4;) {
    if (k == last_thing_) return comma && !IsShare(q);
    if (EndsSentence(tokens_[k]) || IsDroneWord(k) || IsParenthesis(tokens_[k]) || Is(k, WordKind::kMassUnit)) return false;
    comma |= tokens_[k].text == ",";
  }
  return false;
}

/// A carried thing's mass: of several things that are joined the masses add up.
void Reader::SetThing(const Quantity& q) {
  const FieldRange payload{"payload", 0.0005, 1000, "kg"};
  CorrectWith("payload", request_.payload, q.first);
  if (!request_.payload) {
    things_said_ = true;
    last_thing_ = q.last;
    return Set(payload, request_.payload, q.value, q.words);
  }
  bool joined = false;
  for (size_t k = q.first; k-- > 0 && q.first - k <= kSpanOfThing + 3;) {
    joined |= IsOneOf(tokens_[k].text, {"and", "plus", "+", "&", "und", "et", "y", "e"});
    if (EndsSentence(tokens_[k]) || tokens_[k].kind == Token::Kind::kNumber) break;
  }
  joined |= ContinuesList(q);
  if (!things_said_ || !joined) {
    ++unexplained_;
    return Decide("'" + q.words + "' is part of the payload '" + request_.words["payload"] + "'");
  }
  last_thing_ = q.last;
  *request_.payload += q.value;
  request_.words["payload"] += " and " + q.words;
}

}  // namespace airsim360::internal
