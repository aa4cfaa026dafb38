// Which figure of the drone a number with a unit is.
#include "airsim360/flight/prompt/reader.h"

#include <algorithm>
#include <cmath>

#include "airsim360/base/error.h"
#include "airsim360/flight/drone_model.h"
#include "airsim360/flight/prompt/figure_words.h"

namespace airsim360::internal {
namespace {

constexpr double kMostThings = 12;

/// "two 6 kg balls", "2 x 1.5 kg", "two bags of 3 kg each": the things whose mass is said, else 1.
double ThingsOf(const std::vector<Token>& tokens, const Quantity& q) {
  const size_t i = q.first;
  const auto text = [&](size_t k) { return k < tokens.size() ? tokens[k].text : std::string(); };
  if (q.unit->kind != WordKind::kMassUnit) return 1;
  if (i > 1 && tokens[i - 1].Is(WordKind::kTimes) && tokens[i - 2].Counts(kMostThings)) return tokens[i - 2].value;
  const bool thing =
      q.last + 1 < tokens.size() && (tokens[q.last + 1].kind == Token::Kind::kUnknown || tokens[q.last + 1].Is(WordKind::kLoad));
  if (i > 0 && thing && tokens[i - 1].Counts(kMostThings)) return tokens[i - 1].value;
  // "Three cartons of 400 g"
  const bool plural = i > 2 && text(i - 1) == "of" && text(i - 2).ends_with("s") &&
                      (tokens[i - 2].kind == Token::Kind::kUnknown || tokens[i - 2].Is(WordKind::kLoad));
  if (plural && tokens[i - 3].Counts(kMostThings)) return tokens[i - 3].value;
  const std::string after = text(q.last + 1);
  constexpr double kMostEach = 500;  // "40 balls of 150 g each"
  const bool each_before = i > 1 && tokens[i - 1].text == "each" && tokens[i - 2].kind == Token::Kind::kComma;
  if (after != "each" && after != "apiece" && !each_before) return 1;
  const bool comma = i > 1 && tokens[i - 1].kind == Token::Kind::kComma;  // "2 crates, 1.5 kg each"
  for (size_t k = each_before ? i - 2 : comma ? i - 1 : i; k-- > 0 && i - k <= 7 && tokens[k].kind != Token::Kind::kComma;) {
    const bool part = tokens[k].Is(WordKind::kDrone) || tokens[k].Is(WordKind::kRotors) || tokens[k].Is(WordKind::kMotor) ||
                      tokens[k].Is(WordKind::kPropeller) || tokens[k].Is(WordKind::kRotorNoun) || tokens[k].Is(WordKind::kBattery);
    if (part) return 1;
    if (tokens[k].Counts(kMostThings) && tokens[k + 1].Is(WordKind::kCells)) return 1;
    if (tokens[k].Counts(kMostEach)) return tokens[k].value;
  }
  return 1;
}

}  // namespace

bool Reader::ReadQuantity(size_t i) {
  size_t unit = i + 1;
  if (unit < tokens_.size() && tokens_[unit].kind == Token::Kind::kDash) ++unit;
  const Word* word = WordAt(unit);
  if (word == nullptr || word->kind < WordKind::kMassUnit || word->kind > WordKind::kOtherUnit) return false;
  if (!IsInchUnit(i, unit)) return false;
  // "6010 KV130": the KV is of the number onto it.
  if (word->kind == WordKind::kKvUnit && unit + 1 < tokens_.size() && tokens_[unit + 1].kind == Token::Kind::kNumber &&
      tokens_[unit + 1].glued)
    return false;
  Quantity q{i, unit, tokens_[i].value * word->value, word, tokens_[i].text + " " + tokens_[unit].text};
  const bool minus = i > 0 && (tokens_[i - 1].text == "minus" || tokens_[i - 1].text == "negative") &&
                     (i < 2 || tokens_[i - 2].kind != Token::Kind::kWord || SaysLittle(i - 2) || Claims(i - 2)) &&
                     (i < 3 || !Is(i - 2, WordKind::kMassUnit));
  // "-20 C" is of the weather.
  const bool weather = word->kind == WordKind::kOtherUnit;
  if ((tokens_[i].negative || minus) && !weather) throw InputError("a negative number describes no drone: '-" + q.words + "'");
  // "1.2.3 kg", "0x10 kg": what stands onto it belongs to it, and no part of a number is one.
  const bool part = tokens_[i].glued && i > 0 &&
                    ((tokens_[i].text.starts_with('.') && tokens_[i - 1].kind == Token::Kind::kNumber) ||
                     (i > 1 && tokens_[i - 1].glued && tokens_[i - 1].text == "x" && tokens_[i - 2].text == "0"));
  if (part) throw InputError("'" + (tokens_[i - 1].text == "x" ? "0x" : tokens_[i - 1].text) + q.words + "' is no number");
  used_[i] = used_[unit] = true;
  spanning_ = &tokens_[i];
  if (word->kind == WordKind::kKvUnit) claimed_[unit] = true;
  // "2 lb 3 oz", "1 h 30 min"
  const size_t next = unit + (Is(unit + 1, WordKind::kBreak) && tokens_[unit + 1].text == "and" ? 2 : 1);
  if (next + 1 < tokens_.size() && tokens_[next].kind == Token::Kind::kNumber && Is(next + 1, word->kind) &&
      tokens_[next + 1].word->value < 0.7 * word->value && tokens_[next].value * tokens_[next + 1].word->value < word->value) {
    q.value += tokens_[next].value * tokens_[next + 1].word->value;
    q.last = next + 1;
    q.words += " " + tokens_[next].text + " " + tokens_[next + 1].text;
    used_[next] = used_[next + 1] = true;
  }
  Extend(q);
  if (IsRestated(q)) return true;
  q.value *= ThingsOf(tokens_, q);
  if (IsTakenBack(q)) {
    NameElse(q, kNone);
    return true;
  }
  if (tokens_[i].high > 0 && word->kind != WordKind::kCells) Decide("of '" + q.words + "' the middle is taken");
  if (!ReadDifference(q)) Dispatch(q);
  return true;
}

/// "Hovers 20 in the wind", "two 5000 in parallel": no inches.
bool Reader::IsInchUnit(size_t i, size_t unit) const {
  if (tokens_[unit].text != "in") return true;
  if (tokens_[i].value > 100) return false;
  const size_t next = unit + 1;
  if (next >= tokens_.size()) return true;
  if (IsPreposition(tokens_, unit)) return false;
  // "14 in P mode", "24 in real life": before a word that is unknown only with a propeller or a length to come.
  if (tokens_[unit].glued || tokens_[next].kind != Token::Kind::kUnknown) return true;
  for (size_t k = next; k < tokens_.size() && k <= next + 4 && tokens_[k].kind != Token::Kind::kComma; ++k) {
    if (IsPart(k) || Is(k, WordKind::kWheelbase) || Is(k, WordKind::kAcross) || Is(k, WordKind::kRotors) || Is(k, WordKind::kDrone) ||
        Is(k, WordKind::kClass) || (k > next && IsThing(k)))
      return true;
  }
  return false;
}

/// "30 min without load", beside a load: gives way to a time of the loaded drone.
bool Reader::IsOfEmptyDrone(const Quantity& q) const {
  const bool loaded = std::any_of(tokens_.begin(), tokens_.end(), [](const Token& token) {
    return token.Is(WordKind::kPayload) || token.Is(WordKind::kLoad) || token.Is(WordKind::kVolumeUnit);
  });
  const auto times = std::count_if(tokens_.begin(), tokens_.end(), [](const Token& token) { return token.Is(WordKind::kTimeUnit); });
  if (!loaded && times < 2) return false;
  const auto empty = [&](size_t k) { return Is(k, WordKind::kEmpty) && !tokens_[k].text.ends_with("weight"); };
  for (size_t k = q.last + 1; k < tokens_.size() && k <= q.last + 4 && tokens_[k].kind != Token::Kind::kNumber; ++k) {
    if (empty(k)) return true;
    if (tokens_[k].kind == Token::Kind::kComma && tokens_[k].text != "(") break;
  }
  for (size_t k = q.first; k-- > 0 && q.first - k <= 5 && tokens_[k].kind != Token::Kind::kNumber;) {
    if (tokens_[k].kind == Token::Kind::kComma && tokens_[k].text != "(" && tokens_[k].text != ")") break;
    if (empty(k)) return true;
  }
  return false;
}

/// "a kilo and a half", "une heure et demie".
void Reader::Extend(Quantity& q) {
  const size_t link = q.last + 1;
  // "two kilos four hundred"
  const bool hundreds = q.unit->kind == WordKind::kMassUnit && q.unit->value == 1 && link < tokens_.size() &&
                        tokens_[link].kind == Token::Kind::kNumber && tokens_[link].text.find("hundred") != std::string::npos &&
                        tokens_[link].value < 1000 && (link + 1 >= tokens_.size() || EndsPhrase(link + 1));
  if (hundreds) {
    q.value += tokens_[link].value / 1000;
    q.last = link;
    q.words += " " + tokens_[link].text;
    used_[link] = true;
    return;
  }
  const bool half = Is(link, WordKind::kBreak) && Is(link + 1, WordKind::kHalf);
  if (!half || (WordAt(link + 2) && IsUnitKind(WordAt(link + 2)->kind))) return;
  q.value += tokens_[link + 1].word->value * q.unit->value;
  q.last = link + 1;
  q.words += " " + tokens_[link].text + " " + tokens_[link + 1].text;
  used_[link] = used_[link + 1] = true;
}

/// Whether the sign of a foot means minutes: beside a word for flying, or alone where no other time is said and no
/// drone is so large.
bool Reader::IsMinutes(const Quantity& q) const {
  if (PhraseHas(q, WordKind::kFlight) || PhraseHas(q, WordKind::kHover)) return true;
  const bool alone = q.first > 0 && EndsPhrase(q.first - 1) && (q.last + 1 >= tokens_.size() || EndsPhrase(q.last + 1));
  const bool timed = std::any_of(tokens_.begin(), tokens_.end(), [](const Token& token) { return token.Is(WordKind::kTimeUnit); });
  return alone && !timed && q.value > 1.2 && q.value < 36;
}

void Reader::Dispatch(const Quantity& q) {
  const size_t i = q.first;
  switch (q.unit->kind) {
    case WordKind::kMassUnit:
      if (!ReadThrust(q)) ReadMass(q);
      break;
    case WordKind::kLengthUnit:
      // "Flight time 22'"
      if (tokens_[q.last].text == "'" && IsMinutes(q)) return ReadTime({i, q.last, tokens_[i].value * 60, q.unit, q.words});
      if (!ReadDistance(q)) ReadLength(q);
      break;
    case WordKind::kTimeUnit:
      ReadTime(q);
      break;
    case WordKind::kSpeedUnit:
      ReadSpeed(q);
      break;
    case WordKind::kCapacityUnit:
      CorrectWith("capacity_ah", request_.capacity_ah, i);
      ReadCapacity(q);
      break;
    case WordKind::kEnergyUnit:
      Set({"energy_wh", 0.1, 50000, "Wh"}, request_.energy_wh, q.value * PacksOf(q), q.words);
      break;
    case WordKind::kVolumeUnit:
      ReadVolume(q);
      break;
    case WordKind::kVoltUnit:
      ReadVoltage(q);
      break;
    case WordKind::kKvUnit:
      CorrectWith("motor_kv", request_.motor_kv, i);
      Set({"motor_kv", 10, 50000, "rpm/V"}, request_.motor_kv, q.value, q.words);
      break;
    case WordKind::kCells:
      return ReadCells(q);
    case WordKind::kPercent:
      if (!ReadComparison(i, tokens_[i].value * 0.01, q.last)) NameElse(q, kNone);
      break;
    default:
      if (q.unit->kind == WordKind::kDistanceUnit && ReadDistance(q)) return;
      if (!ReadThrust(q) && !ReadWeight(q) && !ReadPower(q) && !ReadTurns(q) && !ReadAxes(q)) ReadDays(q);
  }
}

void Reader::ReadCapacity(const Quantity& q) {
  SumUp("capacity_ah", request_.capacity_ah, q);
  const FieldRange range{"capacity_ah", 0.03, 500, "Ah"};
  const double packs = std::max(PacksInParallel(q), CellsInParallel(q));
  if (packs > 1 && !request_.capacity_ah) Decide("the packs of '" + q.words + "' are taken in parallel");
  // "2 x 16 Ah in parallel" after the sum of both was said says nothing new.
  const bool sum_said =
      packs > 1 && request_.capacity_ah && std::abs(*request_.capacity_ah - packs * q.value) < 0.02 * *request_.capacity_ah;
  if (!sum_said) Set(range, request_.capacity_ah, packs * q.value, q.words);
}

/// "Two 6S packs in series": how many packs, else 1.
double Reader::PacksInSeries(size_t i) const {
  // "6S 16 Ah, you use two in series"
  for (size_t k = i + 2; k < tokens_.size() && k < i + 11 && tokens_[k].text != "."; ++k) {
    const size_t link = tokens_[k - 1].text == "in" ? k - 2 : k - 1;
    if (tokens_[k].text == "series" && tokens_[link].Counts(4)) return tokens_[link].value;
  }
  const size_t count = i > 1 && Is(i - 1, WordKind::kTimes) ? i - 2 : i - 1;
  if (i == 0 || !tokens_[count].Counts(kMostThings)) return 1;
  for (size_t k = i + 2; k < tokens_.size() && k < i + 8; ++k) {
    if (tokens_[k].text == "series") return tokens_[count].value;
  }
  return 1;
}

/// "A weight of 25 N", "weighing 15 N": true when it was read.
bool Reader::ReadWeight(const Quantity& q) {
  const std::string& unit = tokens_[q.last].text;
  if (unit != "n" && !unit.starts_with("newton")) return false;
  const size_t noun = NounBefore(q, true);
  if (noun == kNone || !Is(noun, WordKind::kMass)) return false;
  ReadMass({q.first, q.last, tokens_[q.first].value / kGravity, FindWord("kg", false), q.words});
  return true;
}

/// A quantity that is none of the drone's own figures.
void Reader::NameElse(const Quantity& q, size_t noun) {
  for (size_t i = q.first; i <= q.last; ++i) used_[i] = false;
  if (noun != kNone) claimed_[noun] = true;
}

namespace {

// Whether a word says of what a length is.
bool HasLength(WordKind kind) {
  constexpr WordKind kKinds[] = {WordKind::kPropeller, WordKind::kArm,   WordKind::kWheelbase, WordKind::kPitch,  WordKind::kRotorNoun,
                                 WordKind::kElse,      WordKind::kThing, WordKind::kFrame,     WordKind::kBlades, WordKind::kAcross};
  return std::find(std::begin(kKinds), std::end(kKinds), kind) != std::end(kKinds);
}

}  // namespace

void Reader::ReadLength(const Quantity& q) {
  const bool inches = q.unit->value == 0.0254;
  size_t noun = NounAfter(q);
  const size_t before = NounBefore(q, true);
  const auto kind_of = [&](size_t n) { return WordAt(n) ? WordAt(n)->kind : WordKind::kDrone; };
  const auto says = [&](size_t n) { return n != kNone && HasLength(kind_of(n)); };
  const size_t head = noun;
  if (!says(noun)) noun = says(before) ? before : says(Apposed(q)) ? Apposed(q) : kNone;
  double value = q.value;
  const bool radius = noun != kNone && tokens_[noun].text == "radius";
  if (noun != kNone && (kind_of(noun) == WordKind::kAcross || radius)) {
    const size_t owner = OwnerOfDiameter(q);
    if (owner != kNone && Is(owner, WordKind::kLoad)) return NameElse(q, noun);
    const bool propellers =
        owner != kNone && (Is(owner, WordKind::kPropeller) || Is(owner, WordKind::kRotorNoun) || Is(owner, WordKind::kBlades));
    // "Octo / dia 13 in / 950 mm diagonal"
    const bool alone = inches && owner == kNone && !radius && !request_.propeller &&
                       std::any_of(tokens_.begin(), tokens_.end(), [](const Token& token) { return token.Is(WordKind::kWheelbase); });
    if (propellers || !radius) Use(noun);
    if (propellers || alone) noun = owner;
    if (propellers && radius) value *= 2;
  }
  WordKind kind = noun == kNone ? WordKind::kFiller : kind_of(noun) == WordKind::kAcross ? WordKind::kWheelbase : kind_of(noun);
  if (kind == WordKind::kPropeller && WordAt(noun)->value > 0) value *= WordAt(noun)->value;
  // "5 inch sensor", "a 6 inch screen", "at 30 m": not of the drone.
  // A figure of what is carried: "1 inch camera", "30 cm box".
  const bool load_only =
      noun == kNone && head != kNone && kind_of(head) == WordKind::kLoad && (!inches || q.value < 0.04 || tokens_[head].text == "sensor");
  const bool across = noun != kNone && kind_of(noun) == WordKind::kAcross;  // "across campus (400 m)"
  const bool of_drone = kind == WordKind::kPropeller || kind == WordKind::kWheelbase || kind == WordKind::kArm ||
                        kind == WordKind::kRotorNoun || kind == WordKind::kFrame;
  const bool far = q.value > 3 && (!of_drone || across);
  if (kind == WordKind::kElse || kind == WordKind::kThing || load_only || far) return NameElse(q, noun);
  // "Protective cage 32 cm wide"
  for (size_t k = q.first; !inches && k-- > 0 && q.first - k <= 5 && !EndsPhrase(k) && !IsDroneWord(k) && !Is(k, WordKind::kPropeller);) {
    if (Is(k, WordKind::kGuards)) return NameElse(q, kNone);
  }
  // "AprilTag 20 cm": of the thing that is named right before; millimetres after a name are of a frame.
  if (noun == kNone && !inches && q.unit->value > 1e-3 && q.first > 0 && tokens_[q.first - 1].kind == Token::Kind::kUnknown &&
      IsThing(q.first - 1))
    return NameElse(q, kNone);
  if (noun == kNone && !inches && IsOfPlace(q)) {
    loose_lengths_.push_back(q);
    return NameElse(q, kNone);
  }
  if (noun != kNone && kind != WordKind::kFrame) Use(noun);
  if (kind == WordKind::kBlades) claimed_[noun] = false;
  if (kind == WordKind::kFrame) used_[noun] = true;
  if (kind == WordKind::kPitch) return Set({"pitch", 0.005, 1, "m"}, request_.pitch, q.value, q.words);
  const bool blades = kind == WordKind::kPropeller || kind == WordKind::kRotorNoun || kind == WordKind::kBlades;
  if (blades || (inches && kind != WordKind::kArm && kind != WordKind::kWheelbase)) {
    CorrectWith("propeller", request_.propeller, q.first);
    if (GivesWay("propeller", request_.propeller, value, blades ? 2 : PlainnessOf(q, head), q.words)) return NameElse(q, kNone);
    return Set(kPropellerRange, request_.propeller, value, q.words);
  }
  SetArmLength(q, kind, noun, head);
}

/// A length between motors, which `noun` says (kNone: nothing does) as `kind`; `head` as PlainnessOf takes it.
void Reader::SetArmLength(const Quantity& q, WordKind kind, size_t noun, size_t head) {
  CorrectWith("arm", request_.arm, q.first);
  if (noun != kNone && Is(noun, WordKind::kAcross)) {
    if (!across_) across_ = q;
    return;
  }
  const double arm = kind == WordKind::kArm || (kind != WordKind::kWheelbase && IsFromCentre(q)) ? q.value : q.value / 2;
  if (GivesWay("arm", request_.arm, arm, noun != kNone ? 2 : PlainnessOf(q, head), q.words)) return NameElse(q, kNone);
  Set({"arm", 0.02, 3, "m"}, request_.arm, arm, q.words);
}

/// How plainly a length without a label of its own is the drone's: 2 with a word for the drone after it, 1 alone, 0 as
/// one of several ("22 inch uppers, 20 inch lowers").
int Reader::PlainnessOf(const Quantity& q, size_t head) const {
  const size_t next = q.last + 1;
  if (next < tokens_.size() && StartsAny(tokens_[next].text, {"upper", "lower", "top", "bottom", "front", "rear"})) return 0;
  return head != kNone && (IsDroneWord(head) || Is(head, WordKind::kSizeNoun)) ? 2 : 1;
}

/// "Motors 32 cm from the centre", "from the middle to each motor 30 cm"
bool Reader::IsFromCentre(const Quantity& q) const {
  const auto is_centre = [&](size_t k) { return IsOneOf(tokens_[k].text, {"centre", "center", "middle", "hub", "cog", "mitte"}); };
  for (size_t k = q.last + 1; k < tokens_.size() && k <= q.last + 4 && tokens_[k].kind != Token::Kind::kComma; ++k) {
    if (is_centre(k)) return true;
  }
  for (size_t k = q.first; k-- > 0 && q.first - k <= 8 && tokens_[k].kind != Token::Kind::kComma;) {
    if (is_centre(k)) return true;
  }
  return false;
}

/// Whether a length of which nothing is said may be of a place or a thing: "inside a 3 m cube", "GSD 2 cm".
bool Reader::IsOfPlace(const Quantity& q) const {
  if (q.value < 0.04) return true;
  const size_t next = q.last + 1;
  const bool thing = next < tokens_.size() && tokens_[next].kind == Token::Kind::kUnknown;
  size_t before = q.first;
  while (before-- > 0 && SaysLittle(before)) {
  }
  if (before == kNone) return thing;
  for (const char* word : {"through", "inside", "within", "into", "above", "over", "behind", "from", "past", "every"}) {
    if (tokens_[before].text == word) return true;
  }
  return thing;
}

/// Of the lengths that may be of something else, the first is the drone's where nothing else says its size.
void Reader::FinishLengths() {
  if (across_) {  // "0.8 m tip to tip, 550 mm motor to motor"
    const FieldRange arm{"arm", 0.02, 3, "m"};
    if (!request_.arm || *request_.arm * 2 > across_->value) {
      Set(arm, request_.arm, across_->value / 2, across_->words);
    } else if (std::abs(*request_.arm * 2 - across_->value) > 0.02 * across_->value) {
      Decide("'" + across_->words + "' is said of the whole and left to the distance of its motors");
    }
  }
  for (const Quantity& q : loose_lengths_) {
    if (request_.arm || q.value < 0.04 || q.value > 3) continue;
    const size_t next = q.last + 1;
    const bool thing = next < tokens_.size() && tokens_[next].kind == Token::Kind::kUnknown;
    size_t before = q.first;
    while (before-- > 0 && SaysLittle(before)) {
    }
    const bool place =
        before != kNone && IsOneOf(tokens_[before].text, {"on", "onto", "into", "in", "through", "inside", "over", "at", "under"});
    if (!thing || place) continue;
    for (size_t i = q.first; i <= q.last; ++i) used_[i] = true;
    Set({"arm", 0.02, 3, "m"}, request_.arm, q.value / 2, q.words);
  }
}

/// "Hover time with payload: 20 min"
bool Reader::IsLabelledHover(const Quantity& q) const {
  for (size_t k = q.first; k-- > 0 && q.first - k <= 5 && tokens_[k].kind != Token::Kind::kComma;) {
    if (tokens_[k].kind == Token::Kind::kNumber || Is(k, WordKind::kFlight)) return false;
    if (Is(k, WordKind::kHover)) return tokens_[k].text == "hover time" || tokens_[k].text == "hovering time";
  }
  return false;
}

void Reader::ReadTime(const Quantity& q) {
  if (IsOfEmptyDrone(q)) {
    if (!empty_time_) empty_time_ = q;
    return;
  }
  // "40 min. hover": the point is that of the unit.
  const size_t beyond = q.last + 2;
  const bool abbreviated = Is(beyond, WordKind::kHover) && tokens_[q.last + 1].text == "." &&
                           (beyond + 1 >= tokens_.size() || tokens_[beyond + 1].kind != Token::Kind::kNumber);
  const bool said_hover = abbreviated || PhraseHas(q, WordKind::kHover) || IsLabelledHover(q);
  if (!said_hover && PhraseHas(q, WordKind::kElse)) return NameElse(q, kNone);
  const size_t apposed = Apposed(q);
  const bool hover = said_hover || (apposed != kNone && Is(apposed, WordKind::kHover));
  const char* name = hover ? "hover_time" : "flight_time";
  const char* other = hover ? "flight_time" : "hover_time";
  Field& field = hover ? request_.hover_time : request_.flight_time;
  CorrectWith(other, hover ? request_.flight_time : request_.hover_time, q.first);
  CorrectWith(name, field, q.first);
  SumUp(name, field, q);
  Set({name, 10, 36000, "s"}, field, q.value, q.words);
}

/// The time without load, where no other was said.
void Reader::FinishTimes() {
  if (!empty_time_) return;
  if (!request_.hover_time && !request_.flight_time) {
    const bool hover = PhraseHas(*empty_time_, WordKind::kHover);
    const char* name = hover ? "hover_time" : "flight_time";
    Set({name, 10, 36000, "s"}, hover ? request_.hover_time : request_.flight_time, empty_time_->value, empty_time_->words);
    request_.facts.insert(name);  // gives way where the load takes more
    return;
  }
  Decide("'" + empty_time_->words + "' without load is left to the design, which is that of the loaded drone");
}

void Reader::ReadSpeed(const Quantity& q) {
  // "4K/30fps": pictures a second, where no word speaks of speed.
  if (tokens_[q.last].text == "fps" && !PhraseHas(q, WordKind::kSpeed)) return NameElse(q, kNone);
  // "can climb at 5 m/s, cruise at 10 m/s"
  size_t verb = q.first;
  while (verb-- > 0 && (SaysLittle(verb) || tokens_[verb].text == "at")) {
  }
  if (PhraseHas(q, WordKind::kElse) || Is(verb, WordKind::kElse)) return NameElse(q, kNone);
  // "the wind is bad, so a top speed of 18 m/s"
  const size_t label = NounBefore(q, true);
  const std::string& said = label == kNone ? q.words : tokens_[label].text;
  const bool top = Is(label, WordKind::kSpeed) &&
                   (said.starts_with("top") || said.starts_with("max") || said.starts_with("full") || said.starts_with("vmax"));
  const bool cruises = Is(verb, WordKind::kWind) && tokens_[verb].text.starts_with("cruis");
  if (!top && (cruises || PhraseHas(q, WordKind::kWind))) {
    if (request_.least_speed && *request_.least_speed >= q.value) return;
    request_.least_speed.reset();
    return Set({"least_speed", 0.1, 150, "m/s"}, request_.least_speed, q.value, q.words);
  }
  CorrectWith("speed", request_.speed, q.first);
  if (q.unit && GivesWay("speed", request_.speed, q.value, top || IsTopSpeed(q) ? 2 : 1, q.words)) return NameElse(q, kNone);
  Set({"speed", 0.5, 150, "m/s"}, request_.speed, q.value, q.words);
}

/// "Max 16 m/s", "20 m/s flat out": the most, by a word beside it.
bool Reader::IsTopSpeed(const Quantity& q) const {
  const auto says = [&](size_t k) {
    return StartsAny(tokens_[k].text, {"max", "top", "horizontal", "full", "flat out", "vmax", "fastest", "spitze", "hochst"}) ||
           tokens_[k].text.find("max") != std::string::npos;
  };
  for (size_t k = q.first; k-- > 0 && q.first - k <= 4 && tokens_[k].kind != Token::Kind::kComma;) {
    if (says(k)) return true;
  }
  for (size_t k = q.last + 1; k < tokens_.size() && k <= q.last + 3 && tokens_[k].kind != Token::Kind::kComma; ++k) {
    if (says(k)) return true;
  }
  return false;
}

void Reader::ReadVolume(const Quantity& q) {
  if (PhraseHas(q, WordKind::kElse)) return NameElse(q, kNone);
  for (const WordKind kind : {WordKind::kLoad, WordKind::kPayload}) {
    if (const size_t noun = NounAfter(q); noun != kNone && Is(noun, kind)) Use(noun);
  }
  anything_ = true;
  if (liquid_) return;
  liquid_ = q.value;
  liquid_words_ = q.words;
}

void Reader::ReadVoltage(const Quantity& q) {
  CorrectWith("cells", request_.cells, q.first);
  const double full = q.value / 4.2;
  const bool charged = std::abs(full - std::round(full)) < 0.01;
  const double cells = charged ? std::round(full) : std::round(q.value / 3.8);
  if (IsOfBattery(q)) volts_.push_back(q);
  const bool cells_said = std::any_of(tokens_.begin(), tokens_.end(), [](const Token& token) { return token.Is(WordKind::kCells); });
  if (request_.cells || cells_said || cells < 1) return NameElse(q, kNone);
  Decide("'" + q.words + "' is read as " + std::to_string(static_cast<int>(cells)) + " cells");
  Set({"cells", 1, 24, ""}, request_.cells, cells, q.words);
}

}  // namespace airsim360::internal
