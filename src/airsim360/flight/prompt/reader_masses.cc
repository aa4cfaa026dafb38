// Whose mass a number with a unit of mass is.
#include <algorithm>
#include <cmath>
#include <utility>

#include "airsim360/flight/prompt/reader.h"
#include "airsim360/flight/prompt/thing_words.h"

namespace airsim360::internal {

/// A thing whose own mass is said in a way of its own: "a RED Komodo at 1.8 kg", "Sony A7 + gimbal, 2 kg",
/// "carries my doll, she weighs 30 g".
size_t Reader::WeighedThing(const Quantity& q, size_t noun) const {
  size_t before = q.first;
  while (before-- > 0 && SaysLittle(before)) {
  }
  if (before == kNone || before == 0) return kNone;
  if (noun == kNone && tokens_[before].text == "at" && Is(before - 1, WordKind::kLoad)) return before - 1;
  if (noun == kNone && tokens_[before].text == ",") {
    size_t loads = 0;
    for (size_t k = before; k-- > 0 && tokens_[k].kind != Token::Kind::kComma;) loads += Is(k, WordKind::kLoad);
    const double known = known_load_.value_or(0);
    if (loads > 1 && Is(before - 1, WordKind::kLoad) && q.value > 0.8 * known && q.value < 5 * known) return before - 1;
  }
  const std::string& who = tokens_[before - 1].text;
  if (noun != before || !Is(before, WordKind::kMass) || (who != "he" && who != "she" && who != "they")) return kNone;
  for (size_t k = before; k-- > 0;) {
    if (Is(k, WordKind::kPayload) && !claimed_[k]) return k;
  }
  return kNone;
}

/// "AUW", "total": words that say the mass of the whole drone, whatever stands before them.
bool Reader::IsWhole(size_t noun) const {
  const std::string& text = tokens_[noun].text;
  for (const char* part : {"total", "all", "auw", "tow", "mto", "take", "gross", "fly", "flight", "launch", "loaded", "rtf", "abflug",
                           "start", "decoll", "despeg", "gesamt"}) {
    if (text.find(part) != std::string::npos) return true;
  }
  return false;
}

/// "AUW with GoPro 265 g", "take-off weight incl. camera and battery: 1.9 kg": the mass before what it
/// includes.
size_t Reader::WholeBefore(const Quantity& q) const {
  // "Take off with 3 kg of sand"
  const size_t of = q.last + 1;
  if (of + 1 < tokens_.size() && tokens_[of].text == "of" && IsThing(of + 1)) return kNone;
  // "AUW incl. camera (290 g) = 2.35 kg": what stands in parentheses is of the thing before them.
  const bool apposed = q.first > 1 && tokens_[q.first - 1].text == "(" && IsThing(q.first - 2) && Masses().size() > 1;
  if (apposed) return kNone;
  bool includes = false, battery = false;
  size_t verb = kNone;
  for (size_t k = q.first; k-- > 0 && q.first - k <= 10;) {
    const std::string& text = tokens_[k].text;
    if (Is(k, WordKind::kMassUnit) && used_[k]) return kNone;  // the whole has its mass: this is what it includes
    // "The aircraft with gimbal and camera weighs 11 kg"
    if (Is(k, WordKind::kMass) && k + 1 == q.first && text.starts_with("weigh") && verb == kNone && !claimed_[k]) {
      verb = k;
      continue;
    }
    if (Is(k, WordKind::kMass) && text.find("battery") == std::string::npos) return includes && !claimed_[k] ? k : kNone;
    includes |= Is(k, WordKind::kMass) && (MeansIncluding(text) || text.starts_with("incl") || text.starts_with("with"));
    includes |= Is(k, WordKind::kBreak) && (IsOneOf(text, {"with", "w", "&", "con", "mit", "avec", "com"}) || text.starts_with("incl"));
    // "The drone with camera and battery 6.9 kg"
    const bool own = Is(k, WordKind::kDrone) || Is(k, WordKind::kRotors);
    if (own && includes && (battery || verb != kNone) && k > 0 && IsArticle(tokens_[k - 1].text) && !claimed_[k])
      return verb != kNone ? verb : k;
    battery |= Is(k, WordKind::kBattery);
    const bool thing = IsThing(k) || Is(k, WordKind::kLoad) || Is(k, WordKind::kBattery) || Is(k, WordKind::kLithiumIon) ||
                       Is(k, WordKind::kMass) || Is(k, WordKind::kRotors) || Is(k, WordKind::kDrone) ||
                       tokens_[k].kind == Token::Kind::kUnknown || SaysLittle(k) || includes || text == "and" || text == "+" ||
                       text == "/" || text == "(" || text == ")" || (text == "." && k > 0 && tokens_[k - 1].text == "incl");
    if (!thing) return kNone;
  }
  return kNone;
}

/// The noun that a mass is of, else kNone.
size_t Reader::NounOfMass(const Quantity& q) const {
  const auto kind_of = [&](size_t noun) { return WordAt(noun) ? WordAt(noun)->kind : WordKind::kDrone; };
  const auto is_part = [&](size_t noun) {
    return Is(noun, WordKind::kFrame) || Is(noun, WordKind::kMotor) || Is(noun, WordKind::kPropeller);
  };
  const auto is_label = [&](size_t noun) {
    if (noun == kNone) return false;
    const WordKind kind = kind_of(noun);
    return kind == WordKind::kMass || kind == WordKind::kPayload || kind == WordKind::kEmpty || kind == WordKind::kBattery ||
           kind == WordKind::kBare;
  };
  if (const size_t bare = BareInParentheses(q); bare != kNone) return bare;
  size_t noun = NounBefore(q, true);
  const size_t after = NounAfter(q);
  // "Empty weight incl. battery: 27 kg"
  if (noun != kNone && noun < q.first && after == kNone && Is(noun, WordKind::kBattery) && IsIncludedBefore(noun)) {
    for (size_t k = noun; k-- > 0 && noun - k <= 4 && tokens_[k].kind != Token::Kind::kComma;) {
      const bool label = Is(k, WordKind::kEmpty) || Is(k, WordKind::kMass) || Is(k, WordKind::kPayload);
      if (label && !claimed_[k]) return k;
    }
  }
  bool owned = false;
  // "camera weighing 300 g", "battery of 400 g" say whose weight it is.
  if (noun != kNone && kind_of(noun) == WordKind::kMass && after == kNone && !IsWhole(noun)) {
    size_t owner = noun;
    while (owner-- > 0 && SaysLittle(owner)) {
    }
    if (owner != kNone &&
        (is_part(owner) || Is(owner, WordKind::kLoad) || Is(owner, WordKind::kBattery) ||
         (Is(owner, WordKind::kPayload) && tokens_[owner].text.starts_with("payload"))) &&
        !claimed_[owner] && !(owner + 1 < tokens_.size() && EndsPhrase(owner + 1))) {
      noun = owner;
      owned = true;
    }
  }
  const bool says_empty = after != kNone && (kind_of(after) == WordKind::kEmpty || kind_of(after) == WordKind::kBare);
  if (const size_t whole = WholeBefore(q); whole != kNone && !says_empty) return whole;
  // "3 kilos all in incl. a 500 g payload": what is included has its own noun.
  for (size_t k = q.first; noun != kNone && noun < q.first && k-- > noun + 1;) {
    if (MeansIncluding(tokens_[k].text)) noun = kNone;
  }
  if (const size_t apposed = Apposed(q); apposed != kNone && !says_empty) {
    noun = apposed;
  } else if ((!owned && !is_label(noun)) || says_empty ||
             (kind_of(noun) == WordKind::kPayload && after != kNone && kind_of(after) == WordKind::kMass))
    noun = after != kNone ? after : NounBefore(q, false);
  // "lifting two bags of 3 kg": the verb governs all of its clause.
  for (size_t i = q.first; noun == kNone && i-- > 0 && !EndsPhrase(i) && q.first - i <= 7;) {
    if (WordAt(i) && IsUnitKind(WordAt(i)->kind)) break;
    if (Is(i, WordKind::kPayload) && !claimed_[i]) noun = i;
  }
  if (const size_t owner = WeighedThing(q, noun); owner != kNone) noun = owner;
  // "quadricoptere camera: 900 g" is a camera drone, in the order of Romance languages.
  if (noun != kNone && noun > 0 && noun < q.first && Is(noun, WordKind::kLoad) && Is(noun - 1, WordKind::kRotors)) return kNone;
  return noun;
}

/// "26 g with the batt in": the mass of what flies, no battery's.
bool Reader::IsWithBattery(const Quantity& q) const {
  size_t k = q.last + 1;
  const auto text = [&](size_t i) { return i < tokens_.size() ? tokens_[i].text : std::string(); };
  if (text(k) != "with" && text(k) != "w" && !text(k).starts_with("incl") && text(k) != "inc") return false;
  ++k;
  while (text(k) == "the" || text(k) == "a" || text(k) == "its" || text(k) == ".") ++k;
  return Is(k, WordKind::kBattery) && (k + 1 >= tokens_.size() || tokens_[k + 1].kind != Token::Kind::kNumber);
}

/// "I bring my 1.6 kg quadcopter to the hill": a person carries the drone.
bool Reader::IsBrought(const Quantity& q) const {
  if (q.first < 2 || request_.mass || !IsOneOf(tokens_[q.first - 1].text, {"my", "our"}) || !IsCarryVerb(tokens_[q.first - 2].text))
    return false;
  for (size_t k = 0; k < q.first; ++k) {
    if (Is(k, WordKind::kRotors) || Is(k, WordKind::kDrone) || tokens_[k].kind == Token::Kind::kModel) return false;
  }
  return Is(q.last + 1, WordKind::kRotors) || Is(q.last + 1, WordKind::kDrone);
}

void Reader::ReadMass(const Quantity& q) {
  if (const auto role = roles_.find(q.first); role != roles_.end()) return ReadMassAs(role->second, q);
  if (IsWithBattery(q) && !request_.mass && NounBefore(q, true) == kNone)
    return Set({"mass", 0.01, 400, "kg"}, request_.mass, q.value, q.words);
  // "19.5 kg + payload 3.5 kg = 23 kg"
  if (q.first > 0 && IsSumAfter(q.first - 1) && request_.mass && q.value > *request_.mass &&
      std::abs(*request_.mass + request_.payload.value_or(0) - q.value) < 0.03 * q.value) {
    on_top_ = false;
    request_.mass.reset();
    request_.words.erase("mass");
    mass_quantity_ = q;
    whole_of_mass_ = whole_said_ = true;
    return Set({"mass", 0.01, 400, "kg"}, request_.mass, q.value, q.words);
  }
  if (IsBalance(q) || IsBrought(q)) return ReadMassAs(MassRole::kWhole, q);
  if (IsWithThings(q)) return SetLoadedMass(q);
  if (IsRepeatedLoad(q)) return;
  DropCorrected(q);
  on_top_ |= IsOnTop(q);
  if (q.first > 0 && IsPartWord(tokens_[q.first - 1].text) && tokens_[q.first - 1].kind == Token::Kind::kUnknown &&
      WholeBefore(q) == kNone && NounAfter(q) == kNone)
    return loose_masses_.push_back({q, false, true, false, CountOfParts(q)});
  if (IsAddedTo(q)) return Set({"empty_mass", 0.005, 400, "kg"}, request_.empty_mass, q.value, q.words);
  if (IsTaken(q) && !request_.payload) return SetThing(q);
  const size_t noun = NounOfMass(q);
  const auto kind_of = [&](size_t noun) { return WordAt(noun) ? WordAt(noun)->kind : WordKind::kDrone; };
  const bool thing = noun == kNone && q.first > 0 && q.last + 1 < tokens_.size() && tokens_[q.last + 1].kind == Token::Kind::kUnknown &&
                     !MeansDrone(tokens_[q.last + 1].text) && (tokens_[q.first - 1].text == "a" || tokens_[q.first - 1].text == "an") &&
                     q.first > 1 && Is(q.first - 2, WordKind::kBreak);
  const FieldRange payload{"payload", 0.0005, 1000, "kg"};
  // "a 300 g frame quad, 2 kg"
  if (noun != kNone && noun > q.last && Is(q.last + 1, WordKind::kFrame) && Is(noun, WordKind::kRotors))
    return loose_masses_.push_back({q, false, true});
  if (VolumeBefore(q) != kNone && !request_.payload) return Set(payload, request_.payload, q.value, q.words);
  // "8 kilos of mix" are carried; "3 kg + 1 kg payload" are 4 kg in all.
  const size_t next = q.last + 1;
  const bool of_thing =
      noun == kNone && next + 1 < tokens_.size() && tokens_[next].text == "of" && tokens_[next + 1].kind == Token::Kind::kUnknown;
  if ((of_thing || IsHung(q)) && !request_.payload) return Set(payload, request_.payload, q.value, q.words);
  const bool added = (noun == kNone || kind_of(noun) == WordKind::kMass || kind_of(noun) == WordKind::kDrone) &&
                     next + 3 < tokens_.size() && (tokens_[next].text == "+" || tokens_[next].text == "plus") &&
                     tokens_[next + 1].kind == Token::Kind::kNumber && Is(next + 2, WordKind::kMassUnit) &&
                     Is(next + 3, WordKind::kPayload);
  if (added) return Set({"empty_mass", 0.005, 400, "kg"}, request_.empty_mass, q.value, q.words);
  if ((!IsLoaded(q) || IsApposedToThing(q)) && IsOfThing(q, noun)) {
    if (noun != kNone && !Is(noun, WordKind::kMass)) Use(noun);
    return SetThing(q);
  }
  if (noun == kNone) {
    loose_masses_.push_back({q, thing, false, IsLoaded(q)});
    return;
  }
  SetMassOf(noun, q);
}

/// "5.5 kg on the hook", "65 lb of cargo", "cargo 3 kg", "3 kg cargo, ..."
bool Reader::IsHung(const Quantity& q) const {
  const size_t next = q.last + 1;
  const auto is = [&](size_t k, std::initializer_list<const char*> words) {
    return k < tokens_.size() && std::any_of(words.begin(), words.end(), [&](const char* word) { return tokens_[k].text == word; });
  };
  const bool ends = next + 1 >= tokens_.size() || tokens_[next + 1].kind == Token::Kind::kComma;
  return (is(next, {"on"}) && (is(next + 1, {"hook"}) || is(next + 2, {"hook", "sling"}))) ||
         (is(next, {"of"}) && is(next + 1, {"cargo", "freight"})) || (ends && is(next, {"cargo", "freight"})) ||
         (q.first > 0 && is(q.first - 1, {"cargo", "freight", "charge"}));
}

/// "3 kg with camera"
bool Reader::IsLoaded(const Quantity& q) const {
  size_t k = q.last + 1;
  if (k >= tokens_.size() || (tokens_[k].text != "with" && tokens_[k].text != "w")) return false;
  while (++k < tokens_.size() && SaysLittle(k)) {
  }
  return (Is(k, WordKind::kLoad) || Is(k, WordKind::kPayload)) && !(k + 1 < tokens_.size() && !EndsPhrase(k + 1));
}

/// "Drone 4.2 kg, with the lidar 5.6 kg": what the mass before has in addition stands alone before this one.
bool Reader::IsWithThings(const Quantity& q) const {
  const double before = request_.mass           ? *request_.mass
                        : request_.empty_mass   ? *request_.empty_mass
                        : loose_masses_.empty() ? 0
                                                : loose_masses_.back().quantity.value;
  if (before <= 0 || q.value <= before * 1.02 || q.value > before * 2.5 || whole_of_mass_ || (request_.mass && request_.empty_mass))
    return false;
  size_t k = q.first;
  bool thing = false;
  while (k-- > 0 && q.first - k <= 6) {
    if (IsOneOf(tokens_[k].text, {"with", "w", "incl", "including", "mit", "avec", "con"})) break;
    if (!SaysLittle(k) && !IsThing(k) && tokens_[k].text != "and" && !IsArticle(tokens_[k].text)) return false;
    thing |= IsThing(k);
  }
  return thing && k != kNone && k > 0 && q.first - k <= 6 && (EndsPhrase(k - 1) || tokens_[k - 1].text == "or");
}

/// The mass with what was named, after the mass without it.
void Reader::SetLoadedMass(const Quantity& q) {
  if (!request_.mass && request_.empty_mass) return ReadMassAs(MassRole::kWhole, q);
  if (!request_.mass) {
    request_.mass = loose_masses_.back().quantity.value;
    request_.words["mass"] = loose_masses_.back().quantity.words;
    loose_masses_.pop_back();
  }
  request_.empty_mass = std::exchange(request_.mass, std::nullopt);
  request_.words["empty_mass"] = request_.words["mass"];
  request_.words.erase("mass");
  ReadMassAs(MassRole::kWhole, q);
}

/// "Weighs 2.4 kg, 3 kg with camera": the first is the mass without payload.
void Reader::FinishLoadedMass() {
  for (size_t i = 0; i < loose_masses_.size(); ++i) {
    const Quantity q = loose_masses_[i].quantity;
    if (!loose_masses_[i].loaded || request_.empty_mass || request_.payload) continue;
    if (!request_.mass && i > 0 && loose_masses_[i - 1].quantity.value < q.value) {
      request_.mass = loose_masses_[i - 1].quantity.value;
      request_.words["mass"] = loose_masses_[i - 1].quantity.words;
      loose_masses_.erase(loose_masses_.begin() + static_cast<long>(--i));
    }
    if (!request_.mass || *request_.mass >= q.value || *request_.mass < 0.4 * q.value) continue;
    request_.empty_mass = request_.mass;
    request_.words["empty_mass"] = request_.words["mass"];
    request_.mass = q.value;
    request_.words["mass"] = q.words;
    loose_masses_.erase(loose_masses_.begin() + static_cast<long>(i));
    return;
  }
}

/// Whether a mass of which nothing more is said is of a thing carried: "carry a carton of eggs? 700 g", or,
/// beside the larger mass of the drone, "magnetometer on a cable, 1.1 kg" and "RFID reader 150 g".
bool Reader::IsOfLoad(const Quantity& q) const {
  if (request_.payload || !q.unit || IsAtMost(q) || q.first < 2) return false;
  size_t before = q.first - 1;
  if (tokens_[before].text == "?") {
    for (size_t k = before; k-- > 0 && tokens_[k].kind != Token::Kind::kComma;) {
      if (Is(k, WordKind::kPayload) && !claimed_[k]) return true;
    }
  }
  double whole = request_.mass.value_or(0);
  for (const Loose& other : loose_masses_) whole = std::max(whole, other.quantity.value);
  if (whole < 1.3 * q.value) return false;
  if (tokens_[before].kind == Token::Kind::kUnknown) {  // no abbreviation
    return tokens_[before].text.find_first_not_of("bcdfghjklmnpqrstvwxz") != std::string::npos;
  }
  if (tokens_[before].kind != Token::Kind::kComma) return false;
  while (before-- > 0 && tokens_[before].kind != Token::Kind::kComma) {
    if (Is(before, WordKind::kDrone) || Is(before, WordKind::kRotors)) return false;
    if (Is(before, WordKind::kLoad)) return true;
  }
  return false;
}

/// A mass without battery: with the battery's, where it is said, it is the mass.
void Reader::FinishBareMass() {
  FinishOwnMass();
  if (!request_.bare_mass) return;
  const std::string words = request_.words["bare_mass"];
  if (request_.mass && *request_.mass < *request_.bare_mass) Contradiction("mass", words);
  if (request_.mass || request_.empty_mass || !request_.battery_mass) return;
  const double whole = *request_.bare_mass + *request_.battery_mass + request_.payload.value_or(0);
  Set({"mass", 0.01, 400, "kg"}, request_.mass, whole, words + " and " + request_.words["battery_mass"]);
}

void Reader::SetMassOf(size_t noun, const Quantity& q) {
  const FieldRange payload{"payload", 0.0005, 1000, "kg"};
  const WordKind kind = WordAt(noun) ? WordAt(noun)->kind : WordKind::kDrone;
  if (kind == WordKind::kElse || kind == WordKind::kMotor || kind == WordKind::kPropeller || kind == WordKind::kFrame ||
      kind == WordKind::kWind)
    return kind == WordKind::kElse ? (++unexplained_, NameElse(q, noun))
                                   : loose_masses_.push_back({q, false, kind != WordKind::kWind, false, CountOfParts(q)});
  // A drone has other figures besides.
  if (kind >= WordKind::kRotorNoun) Use(noun);
  switch (kind) {
    case WordKind::kLoad:
      return SetThing(q);
    case WordKind::kPayload:
      CorrectWith("payload", request_.payload, q.first);
      if (things_said_ && request_.payload && *request_.payload < q.value) {  // "... payload 3 kg in all"
        request_.payload.reset();
        request_.words.erase("payload");
        things_said_ = false;
      }
      if (!request_.payload && (IsNamedBeside(q, noun) || NamesThingAfter(q))) return SetThing(q);
      return Set(payload, request_.payload, q.value, q.words);
    case WordKind::kBattery:
      // "410 g without battery, with the 1300 battery 630 g"
      if (request_.bare_mass && q.value > *request_.bare_mass && noun < q.first && IsIncludedBefore(noun))
        return ReadMassAs(MassRole::kWhole, q);
      if (IsAllWithBattery(noun, q)) return ReadMassAs(MassRole::kWhole, q);
      if (IsLeftOut(noun)) return Set({"bare_mass", 0.004, 400, "kg"}, request_.bare_mass, q.value, q.words);
      return Set({"battery_mass", 0.001, 200, "kg"}, request_.battery_mass, q.value, q.words);
    case WordKind::kBare: {
      // The dry weight of a sprayer is that without its liquid.
      if (tokens_[noun].text.starts_with("dry") && liquid_said_)
        return Set({"empty_mass", 0.005, 400, "kg"}, request_.empty_mass, q.value, q.words);
      return Set({"bare_mass", 0.004, 400, "kg"}, request_.bare_mass, q.value, q.words);
    }
    case WordKind::kEmpty:
      return Set({"empty_mass", 0.005, 400, "kg"}, request_.empty_mass, q.value, q.words);
    default:
      return SetOwnMass(noun, q);
  }
}

/// The mass of the drone, of which others may have been said.
void Reader::SetOwnMass(size_t noun, const Quantity& q) {
  if (IsWithoutLoad(noun)) return Set({"empty_mass", 0.005, 400, "kg"}, request_.empty_mass, q.value, q.words);
  // "under 250 g" is met just below, unless the mass itself is said.
  if (IsAtMost(q)) return loose_masses_.push_back({q, false});
  CorrectWith("mass", request_.mass, q.first);
  const bool whole = Is(noun, WordKind::kMass) && IsWhole(noun);
  if (whole) {
    whole_said_ = true;
    SumUpMass(q);
    if (request_.mass && IsSumOf(q.value, *request_.mass)) {  // "2 kg, payload 500 g, total 2.5 kg"
      request_.empty_mass = request_.mass;
      request_.words["empty_mass"] = request_.words["mass"];
      request_.mass.reset();
      request_.words.erase("mass");
    }
  }
  if (request_.mass && std::abs(*request_.mass - q.value) > 0.02 * std::max(*request_.mass, q.value)) {
    // Only two wholes contradict each other: the smaller mass beside a whole is of something else.
    const bool smaller = q.value < *request_.mass;
    if (whole_of_mass_ && !whole && smaller) return loose_masses_.push_back({q, false});
    if (whole && !whole_of_mass_ && !smaller) {
      request_.mass.reset();
      request_.words.erase("mass");
      loose_masses_.push_back({mass_quantity_, false});
    }
  }
  if (!request_.mass) {
    mass_quantity_ = q;
    const size_t after = NounAfter(q);
    whole_of_mass_ = whole || (after != kNone && Is(after, WordKind::kMass) && IsWhole(after));
  }
  Set({"mass", 0.01, 400, "kg"}, request_.mass, q.value, q.words);
}

/// "Including its 300 g camera"
bool Reader::IsIncluded(const Quantity& q) const {
  for (size_t k = q.first; k-- > 0 && q.first - k <= 3;) {
    if (MeansIncluding(tokens_[k].text)) return true;
  }
  return false;
}

/// "Without tools and battery 11 kg": whether what noun `i` names is not in the mass.
bool Reader::IsLeftOut(size_t i) const {
  for (size_t k = i; k-- > 0 && i - k <= 5 && tokens_[k].kind != Token::Kind::kComma && tokens_[k].kind != Token::Kind::kNumber;) {
    const std::string& text = tokens_[k].text;
    if (text == "with" || text == "but") return false;
    if (text.starts_with("without") || text.starts_with("w o") || text.starts_with("excl") || text == "ohne" || text == "sans") return true;
  }
  return false;
}

/// "Payload: lidar 1.35 kg": a thing between the label and its mass.
bool Reader::IsNamedBeside(const Quantity& q, size_t noun) const {
  return noun + 1 < q.first && q.first - noun <= 5 && IsThing(q.first - 1);
}

/// "Payload is a 370 g IR cam": a thing right after the mass.
bool Reader::NamesThingAfter(const Quantity& q) const {
  for (size_t k = q.last + 1; k < tokens_.size() && k <= q.last + 3 && !EndsPhrase(k); ++k) {
    if (Is(k, WordKind::kPayload) || Is(k, WordKind::kMass)) return false;
    if (IsThing(k)) return true;
  }
  return false;
}

/// "7 inch quad, with battery 1.05 kg", "together with its battery I read 10 kg": the only mass, of a phrase that begins so.
bool Reader::IsAllWithBattery(size_t noun, const Quantity& q) const {
  if (noun > q.first || Masses().size() != 1) return false;
  size_t with = noun;
  while (with-- > 0 && IsArticle(tokens_[with].text)) {
  }
  if (with == kNone || !IsOneOf(tokens_[with].text, {"with", "w", "mit", "avec", "con", "com"})) return false;
  return with == 0 || tokens_[with - 1].kind == Token::Kind::kComma || tokens_[with - 1].text == "together";
}

/// Whether `whole` is a mass of the drone without payload and the payload that was said.
bool Reader::IsSumOf(double whole, double own) const {
  if (!request_.payload || request_.empty_mass) return false;
  return *request_.payload > 0.03 * whole && std::abs(own + *request_.payload - whole) < 0.015 * whole;
}

/// "570 g, put a 30 g sensor on top, so 600 g total"
void Reader::SumUpMass(const Quantity& q) {
  bool so = false;
  for (size_t k = q.first; k-- > 0 && q.first - k <= 6;)
    so |= tokens_[k].text == "so" || tokens_[k].text == "makes" || tokens_[k].text == "then" || tokens_[k].text == "=";
  if (!so || !request_.mass || q.value <= *request_.mass) return;
  Decide("'" + q.words + "' is the sum of '" + request_.words["mass"] + "' and what is added");
  request_.mass.reset();
  request_.words.erase("mass");
}

/// "Weighs 9 kg with battery and could carry 6 kg": more than a drone of 9 kg in all can, so these 9 kg are
/// its own.
void Reader::FinishOwnMass() {
  if (!request_.mass || !request_.payload || whole_said_ || request_.empty_mass) return;
  if (*request_.payload <= 0.6 * *request_.mass || *request_.payload > *request_.mass) return;
  const std::string words = request_.words["mass"];
  Decide("'" + words + "' is read as the mass without payload, for '" + request_.words["payload"] + "' is most of it");
  request_.empty_mass = request_.mass;
  request_.words["empty_mass"] = words;
  request_.mass.reset();
  request_.words.erase("mass");
}

}  // namespace airsim360::internal
