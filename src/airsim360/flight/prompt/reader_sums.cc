// Sums of masses: lists of parts, what is added to a drone, and wholes that parts must not exceed.
#include <algorithm>
#include <cmath>

#include "airsim360/base/error.h"
#include "airsim360/flight/prompt/reader.h"
#include "airsim360/flight/prompt/thing_words.h"

namespace airsim360::internal {

/// A list of parts without their sum: "frame 400 g, motors and ESCs 320 g, battery 350 g".
void Reader::SumUpParts() {
  const bool said = request_.mass || request_.empty_mass || request_.bare_mass || model_ != nullptr;
  const auto parts = std::count_if(loose_masses_.begin(), loose_masses_.end(), [](const Loose& loose) { return loose.part; });
  if (said || parts + (request_.battery_mass ? 1 : 0) < 2 || parts < 1) return;
  double sum = request_.battery_mass.value_or(0) + request_.payload.value_or(0);
  for (const Loose& loose : loose_masses_) sum += loose.quantity.value * loose.count;
  for (const Loose& loose : loose_masses_) {
    const double value = loose.quantity.value * loose.count;
    if (!loose.part && value > 0.8 * (sum - value)) return;  // the drone itself
  }
  Decide("the mass is the sum of its parts");
  for (const Quantity& q : Masses()) {  // a whole that was said is none of the parts
    const std::vector<MassClaim> claims = ClaimsOf(q);
    unexplained_ += !claims.empty() && claims[0].role == MassRole::kWhole;
  }
  Set({"mass", 0.01, 400, "kg"}, request_.mass, sum, "the sum of the parts");
  whole_of_mass_ = true;
  loose_masses_.clear();
}

/// "Four motors 34 g each", "6 ESCs @ 40 g": how many parts have that mass, else 1.
double Reader::CountOfParts(const Quantity& q) const {
  if (q.first > 0 && Is(q.first - 1, WordKind::kTimes)) return 1;  // "4x 55 g" is multiplied already
  for (size_t k = q.first; k-- > 0 && q.first - k <= 6 && tokens_[k].kind != Token::Kind::kComma;) {
    if (Is(k, WordKind::kMassUnit)) break;
    if (tokens_[k].kind == Token::Kind::kNumber) return tokens_[k].Counts(12) ? tokens_[k].value : 1;
  }
  return 1;
}

/// "Craft with cell 27 g, plus a deck of 4 g": what is added to it is carried. Not where the whole is said.
bool Reader::IsAddedTo(const Quantity& q) const {
  if (request_.mass || request_.empty_mass || request_.bare_mass || IsAtMost(q)) return false;
  size_t plus = q.last + 1;
  if (plus < tokens_.size() && (tokens_[plus].text == "," || IsDroneWord(plus))) ++plus;
  if (plus >= tokens_.size() || !(tokens_[plus].text == "plus" || tokens_[plus].text == "plus a" || tokens_[plus].text == "+"))
    return false;
  const std::vector<MassClaim> own = ClaimsOf(q);
  if (own.empty() || own[0].role != MassRole::kWhole) return false;
  bool added = false;
  const std::vector<Quantity> masses = Masses();
  if (masses.size() > kMostMasses) return false;
  for (const Quantity& other : masses) {
    const std::vector<MassClaim> claims = ClaimsOf(other);
    const bool thing = !claims.empty() && (claims[0].role == MassRole::kThing || claims[0].role == MassRole::kPayload);
    added |= other.first > plus && other.first - plus <= 8 && thing;
    // A second whole says the sum itself.
    if (other.first != q.first && !claims.empty() && claims[0].role == MassRole::kWhole) return false;
  }
  for (size_t k = q.first; k-- > 0 && q.first - k <= 4 && tokens_[k].kind != Token::Kind::kComma;) {
    if (Is(k, WordKind::kMass) && IsWhole(k)) return false;
  }
  return added && !(Is(q.last + 1, WordKind::kMass) && IsWhole(q.last + 1));
}

/// "19.5 kg + payload 3.5 kg = 23 kg", "... so 3.4 kg"
bool Reader::IsSumAfter(size_t k) const { return IsOneOf(tokens_[k].text, {"=", "so", "makes", "making", "giving", "equals", "then"}); }

/// "Payload of 0.3 kg on top of that", "an additional 500 g sensor"
bool Reader::IsOnTop(const Quantity& q) const {
  const auto adds = [&](size_t k) {
    return IsOneOf(tokens_[k].text,
                   {"on top", "top", "another", "additional", "additionally", "extra", "addition", "zusatzlich", "ademas", "add"});
  };
  for (size_t k = q.first; k-- > 0 && q.first - k <= 5 && tokens_[k].kind != Token::Kind::kComma;) {
    if (Is(k, WordKind::kMassUnit)) break;
    if (adds(k)) return true;
  }
  for (size_t k = q.last + 1; k < tokens_.size() && k <= q.last + 4 && tokens_[k].kind != Token::Kind::kComma; ++k) {
    if (adds(k)) return true;
  }
  return false;
}

/// What is carried on top of the mass that was said of the drone.
void Reader::FinishOnTop() {
  if (!on_top_ || whole_of_mass_ || !request_.mass || request_.empty_mass || !request_.payload) return;
  request_.empty_mass = request_.mass;
  request_.words["empty_mass"] = request_.words["mass"];
  request_.mass.reset();
  request_.words.erase("mass");
}

/// "Hovers 20 min with 12 kg" after a payload of 12 kg.
bool Reader::IsRepeatedLoad(const Quantity& q) const {
  if (!request_.payload || q.first == 0 || std::abs(*request_.payload - q.value) > 0.01 * q.value) return false;
  const bool with = IsOneOf(tokens_[q.first - 1].text, {"with", "w", "mit", "avec", "con", "at", "carrying"}) || IsSumAfter(q.first - 1);
  return with && (q.last + 1 >= tokens_.size() || EndsPhrase(q.last + 1));
}

/// "590 g without the pack, the pack is 390 g, makes 980 g": what is as much as its parts together is their whole.
bool Reader::IsBalance(const Quantity& q) const {
  if (request_.mass) return false;
  const double load = request_.payload.value_or(0);
  const auto is = [&](double sum) { return std::abs(sum - q.value) < 0.012 * q.value; };
  if (request_.bare_mass && request_.battery_mass) {
    const double own = *request_.bare_mass + *request_.battery_mass;
    if (is(own) || is(own + load)) return true;
  }
  return request_.empty_mass && load > 0.03 * q.value && is(*request_.empty_mass + load);
}

/// "Can take 5 kg": a load by its verb alone.
bool Reader::IsTaken(const Quantity& q) const {
  size_t verb = q.first;
  while (verb-- > 0 && SaysLittle(verb)) {
  }
  const bool ends = q.last + 1 >= tokens_.size() || EndsPhrase(q.last + 1);
  return ends && verb != kNone &&
         IsOneOf(tokens_[verb].text, {"take", "takes", "handle", "handles", "manage", "manages", "accommodate", "accommodates"});
}

/// "Drone without parcel but with battery 9 kg"
bool Reader::IsWithoutLoad(size_t noun) const {
  if (!Is(noun, WordKind::kMass) || tokens_[noun].text.find("batter") == std::string::npos) return false;
  for (size_t k = noun; k-- > 0 && noun - k <= 3 && tokens_[k].kind != Token::Kind::kComma;) {
    if (Is(k, WordKind::kEmpty)) return true;
  }
  return false;
}

/// "Under 3 kg, let's say 2.9 kg": the bound is taken back.
void Reader::DropCorrected(const Quantity& q) {
  if (q.first == 0 || !Is(q.first - 1, WordKind::kCorrection)) return;
  if (request_.mass && whole_of_mass_ && mass_quantity_.last < q.first && q.first - mass_quantity_.last <= 4) {
    Decide("'" + tokens_[q.first - 1].text + "' takes back '" + request_.words["mass"] + "'");
    request_.mass.reset();
    request_.words.erase("mass");
    return;
  }
  if (loose_masses_.empty()) return;
  if (q.first - loose_masses_.back().quantity.last <= 4) loose_masses_.pop_back();
}

/// "Net weight (without battery): 14.5 kg"
size_t Reader::BareInParentheses(const Quantity& q) const {
  size_t close = q.first;
  while (close-- > 0 && SaysLittle(close)) {
  }
  if (close == kNone || tokens_[close].text != ")") return kNone;
  for (size_t k = close; k-- > 0 && close - k <= 5 && tokens_[k].text != "(";) {
    if (Is(k, WordKind::kBare)) return k;
  }
  return kNone;
}

/// Parts that are more than the whole that they are of.
void Reader::RefuseHeavyParts() {
  if (!request_.mass || request_.facts.count("mass")) return;
  double sum = request_.battery_mass.value_or(0) + request_.payload.value_or(0);
  std::string words;
  for (const Loose& loose : loose_masses_) {
    if (!loose.part) continue;
    sum += loose.count * loose.quantity.value;
    words += (words.empty() ? "'" : ", '") + loose.quantity.words + "'";
  }
  if (words.empty() || sum <= 1.03 * *request_.mass) return;
  heavy_parts_ = true;
  throw InputError("no drone fits the description: parts of " + words + " are more than '" + request_.words.at("mass") + "' in all");
}

}  // namespace airsim360::internal
