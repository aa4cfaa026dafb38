// What the motors lift: "each motor pulls 900 g", "8 kg of thrust in all".
#include <algorithm>
#include <cstdio>
#include <iterator>

#include "airsim360/base/error.h"
#include "airsim360/flight/drone_model.h"
#include "airsim360/flight/prompt/reader.h"

namespace airsim360::internal {
namespace {

constexpr double kMostRatio = 14;  // what the gate lets pass, with a margin

template <size_t N>
bool IsOneOf(const std::string& text, const char* const (&words)[N]) {
  return std::any_of(std::begin(words), std::end(words), [&](const char* word) { return text == word; });
}

constexpr const char* kEach[] = {"each", "per", "per motor",   "each motor", "apiece", "every", "je",
                                 "por",  "par", "each of the", "单轴",       "单个",   "每个"};
constexpr const char* kWhole[] = {"total",  "together", "all",     "combined",     "altogether",
                                  "in all", "in total", "overall", "all together", "sum"};
constexpr const char* kGives[] = {"produce", "produces", "generate", "generates", "give",      "gives",     "make",    "makes",
                                  "push",    "pushes",   "put out",  "puts out",  "provide",   "provides",  "deliver", "delivers",
                                  "develop", "develops", "exert",    "exerts",    "producing", "generating"};

}  // namespace

/// True when the phrase speaks of thrust and the quantity is a force.
bool Reader::ReadThrust(const Quantity& q) {
  const std::string& unit = tokens_[q.last].text;
  const bool newtons = unit == "n" || unit.starts_with("newton");
  if (q.unit->kind != WordKind::kMassUnit && !newtons) return false;
  // "What thrust do I need for a 1.3 kg quad?"
  if (!newtons && (Is(q.last + 1, WordKind::kRotors) || Is(q.last + 1, WordKind::kDrone))) return false;
  Thrust thrust{newtons ? tokens_[q.first].value / kGravity : q.value, false, false, q.words};
  size_t noun = kNone;
  bool motor = false, gives = newtons;
  const auto look = [&](size_t k) {
    const std::string& text = tokens_[k].text;
    if (Is(k, WordKind::kThrust) && noun == kNone && !claimed_[k]) noun = k;
    motor |= Is(k, WordKind::kMotor) || Is(k, WordKind::kPropeller) || Is(k, WordKind::kRotorNoun) || text == "per motor" ||
             text == "each motor";
    gives |= IsOneOf(text, kGives);
    thrust.each |= IsOneOf(text, kEach);
    thrust.whole |= IsOneOf(text, kWhole) || (Is(k, WordKind::kThrust) && text.find("total") != std::string::npos) ||
                    (Is(k, WordKind::kThrust) && text.find("combined") != std::string::npos) ||
                    (Is(k, WordKind::kThrust) && text.find("gesamt") != std::string::npos) || text.find("总") != std::string::npos;
  };
  // A number with a noun of its own ends the clause on either side.
  const auto ends = [&](size_t k) {
    return tokens_[k].kind == Token::Kind::kComma || tokens_[k].text == "and" || tokens_[k].text == "with" || Is(k, WordKind::kMass) ||
           Is(k, WordKind::kPayload);
  };
  for (size_t k = q.first; k-- > 0 && q.first - k <= 9 && !(ends(k) && tokens_[k].text != "total" && tokens_[k].text != ")");) {
    while (k > 0 && tokens_[k].text == ")") {  // "each rotor (15 cm) delivers"
      while (k > 0 && tokens_[k].text != "(") --k;
      if (k > 0) --k;
    }
    look(k);
  }
  for (size_t k = q.last + 1; k < tokens_.size() && k <= q.last + 9 && !(ends(k) && tokens_[k].text != "total"); ++k) look(k);
  // "The motors produce 30 N in total" needs no word for thrust.
  const bool without_noun = motor && gives && (thrust.each || thrust.whole);
  if (noun == kNone ? !without_noun : tokens_[noun].text.starts_with("pull") && !motor) return false;
  if (const size_t count = FirstOf(q); newtons && count + 2 == q.first && noun != kNone) {  // "max thrust 4 x 9 N"
    thrust.kilograms *= tokens_[count].value;
    thrust.whole = true;
  }
  Use(noun);
  for (size_t k = q.first; k <= q.last; ++k) used_[k] = true;
  if (!thrust_) thrust_ = thrust;
  return true;
}

/// "Max thrust twice its weight", "thrust 900 % of its weight": true when factor `i`, up to token `last`, is of thrust.
bool Reader::ReadThrustOfWeight(size_t i, size_t last, double factor) {
  bool weight = false, thrust = false;
  for (size_t k = last + 1; k < tokens_.size() && k <= last + 4 && tokens_[k].kind != Token::Kind::kComma; ++k)
    weight |= tokens_[k].text == "weight" || tokens_[k].text == "mass" || tokens_[k].text == "all up weight";
  for (size_t k = i; k-- > 0 && i - k <= 6 && tokens_[k].kind != Token::Kind::kNumber;) thrust |= Is(k, WordKind::kThrust);
  if (!weight || !thrust || request_.thrust_to_weight) return false;
  for (size_t k = i; k <= last; ++k) used_[k] = true;
  Set({"thrust_to_weight", 1.05, 20, ""}, request_.thrust_to_weight, factor, "thrust " + tokens_[i].text + " times the weight");
  return true;
}

/// Thrust over the weight is the ratio; where that goes with nothing else it gives way, unless it does not
/// lift.
void Reader::FinishThrust() {
  if (!thrust_) return;
  if (!request_.mass || thrust_->kilograms <= 0)
    return Decide("'" + thrust_->words + "' of thrust is left to the design, for the mass was not said");
  const double rotors = request_.rotors.value_or(request_.layout == RotorLayout::kCoaxial ? 8 : 4);
  const bool each = thrust_->each || (!thrust_->whole && thrust_->kilograms < 1.2 * *request_.mass);
  const double ratio = thrust_->kilograms * (each && !thrust_->whole ? rotors : 1) / *request_.mass;
  if (ratio < 1.05 && !request_.facts.count("mass")) {
    throw InputError("no drone fits the description: '" + thrust_->words + "' of thrust do not lift '" + request_.words["mass"] + "'");
  }
  const bool told = thrust_->each || thrust_->whole;
  if (request_.thrust_to_weight && told && *request_.thrust_to_weight > 1.1 * ratio && !request_.facts.count("thrust_to_weight") &&
      !request_.facts.count("mass")) {
    char figure[32];
    std::snprintf(figure, sizeof(figure), "%.2f", ratio);
    throw InputError("no drone fits the description: '" + thrust_->words + "' of thrust lift '" + request_.words["mass"] + "' " + figure +
                     " times, which contradicts '" + request_.words["thrust_to_weight"] + "'");
  }
  if (request_.thrust_to_weight) return;
  if (ratio < 1.05 || ratio > kMostRatio)
    return Decide("'" + thrust_->words + "' of thrust is not what drones of that mass have and is left to the design");
  request_.thrust_to_weight = ratio;
  request_.words["thrust_to_weight"] = thrust_->words + " of thrust";
  request_.facts.insert("thrust_to_weight");
}

}  // namespace airsim360::internal
