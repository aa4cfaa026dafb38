// What was said and no law of nature lets be: energy out of nothing, more power than a battery holds, voltages that
// no number of cells has.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "airsim360/base/error.h"
#include "airsim360/flight/drone_model.h"
#include "airsim360/flight/prompt/reader.h"

namespace airsim360::internal {
namespace {

constexpr double kAirDensity = 1.225, kNominalCell = 3.7;  // kg/m^3, V
// A lithium cell between empty and full; that of a high voltage pack is full at 4.35 V.
constexpr double kEmptyCell = 2.9, kFullestCell = 4.4;

std::string Number(double value) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.3g", value);
  return text;
}

}  // namespace

/// "4 Hobbywing X8 (100 KV)": a motor by its maker or its count, no layout.
bool Reader::IsMotorName(size_t i) const {
  for (size_t k = i; k-- > 0 && i - k <= 3;) {
    const std::string& text = tokens_[k].text;
    if (IsOneOf(text, {"hobbywing", "xrotor", "tmotor", "motor", "motors"})) return true;
    if (tokens_[k].kind == Token::Kind::kNumber && i - k <= 2 && tokens_[k].value >= 4 && tokens_[k].value <= 8) {
      const bool kv =
          i + 2 < tokens_.size() && (Is(i + 1, WordKind::kKvUnit) || Is(i + 2, WordKind::kKvUnit) || Is(i + 3, WordKind::kKvUnit));
      return kv || Is(i + 1, WordKind::kMotor);
    }
    if (tokens_[k].kind != Token::Kind::kUnknown && !Is(k, WordKind::kTimes)) return false;
  }
  return false;
}

/// "Hover power 400 W", "hovers at 250 W": true when it was read.
bool Reader::ReadPower(const Quantity& q) {
  const std::string& unit = tokens_[q.last].text;
  const bool kilo = unit == "kw";
  if (!kilo && unit != "w" && unit != "watt" && unit != "watts") return false;
  bool hover = false;
  const auto look = [&](size_t k) { hover |= Is(k, WordKind::kHover); };
  for (size_t k = q.first;
       k-- > 0 && q.first - k <= 10 && tokens_[k].kind != Token::Kind::kComma && tokens_[k].kind != Token::Kind::kNumber;)
    look(k);
  for (size_t k = q.last + 1; k < tokens_.size() && k <= q.last + 4 && !EndsPhrase(k) && tokens_[k].kind != Token::Kind::kNumber; ++k)
    look(k);
  if (!hover || power_) return false;
  Quantity watts = q;
  watts.value = tokens_[q.first].value * (kilo ? 1000 : 1);
  power_ = watts;
  Decide("'" + q.words + "' of hovering only checks the design");
  return true;
}

/// "6 axis" is what shops call six rotors; gimbals and gyroscopes have axes of their own.
bool Reader::ReadAxes(const Quantity& q) {
  const double value = tokens_[q.first].value;
  if (!tokens_[q.last].text.starts_with("ax") || request_.rotors || rotor_words_ > 0) return false;
  if (value != 4 && value != 6 && value != 8) return false;
  const size_t next = q.last + 1;
  if (next < tokens_.size() && !Is(next, WordKind::kDrone) && !EndsPhrase(next) && !Is(next, WordKind::kClass) &&
      !Is(next, WordKind::kFrame) && !SaysLittle(next) && tokens_[next].kind != Token::Kind::kNumber)
    return false;
  for (size_t k = 0; k + 1 < tokens_.size(); ++k) {  // "4 axis 8 rotor"
    const bool pairs = tokens_[k].kind == Token::Kind::kNumber && tokens_[k].value == 2 * value && Is(k + 1, WordKind::kRotorNoun);
    if (pairs) return SetArms(value, q.words), true;
  }
  SetRotors(value, q.words);
  return true;
}

/// Whether a voltage stands beside what is said of the battery: "4S 22.2 V 5000 mAh lipo".
bool Reader::IsOfBattery(const Quantity& q) const {
  const auto of_battery = [&](size_t k) { return Is(k, WordKind::kCells) || Is(k, WordKind::kCapacityUnit) || Is(k, WordKind::kBattery); };
  // "6S battery, 11.1 V": a voltage that packs have reaches over the comma.
  const double cells = q.value / kNominalCell, full = q.value / 4.2;
  const bool of_pack = std::abs(cells - std::round(cells)) < 0.02 || std::abs(full - std::round(full)) < 0.02;
  for (size_t k = q.first;
       k-- > 0 && q.first - k <= 4 && (of_pack || tokens_[k].text != ",") && tokens_[k].text != "." && !IsDroneWord(k);) {
    if (of_battery(k)) return true;
  }
  for (size_t k = q.last + 1; k < tokens_.size() && k <= q.last + 4 && !(EndsPhrase(k) && tokens_[k].text != "("); ++k) {
    if (of_battery(k)) return true;
  }
  return false;
}

/// A real drone keeps its own size: no figure of it gives way to a load of several times its mass.
void Reader::CheckLoadOfModel() const {
  constexpr double kMostLoads = 5;
  if (model_ == nullptr || !request_.payload || request_.mass || request_.empty_mass) return;
  if (*request_.payload <= kMostLoads * model_->mass) return;
  throw InputError("no drone fits the description: '" + request_.words.at("payload") + "' are more than " + std::string(model_->title) +
                   ", which weighs " + Number(model_->mass) + " kg, can lift");
}

void Reader::CheckVoltage() const {
  if (!request_.cells || request_.facts.count("cells")) return;
  for (const Quantity& q : volts_) {
    const double cell = q.value / *request_.cells;
    if (cell >= kEmptyCell && cell <= kFullestCell) continue;
    throw InputError("'" + q.words + "' contradicts '" + request_.words.at("cells") + "': a lithium cell has 3 to 4.35 V, " +
                     "nominally 3.7 V, so that these cells have " + Number(kNominalCell * *request_.cells) + " V");
  }
}

/// "Props turning at 60,000 rpm": true when it was read.
bool Reader::ReadTurns(const Quantity& q) {
  if (tokens_[q.last].text != "rpm" || turns_) return false;
  turns_ = q;
  turns_->value = tokens_[q.first].value;
  NameElse(q, kNone);
  return true;
}

/// Tips of propellers stay below the speed of sound.
void Reader::CheckTips() const {
  constexpr double kSound = 340.3;  // m/s
  if (!turns_ || !request_.propeller || request_.facts.count("propeller")) return;
  const double tips = std::numbers::pi * *request_.propeller * turns_->value / 60;
  if (tips < kSound) return;
  throw InputError("no drone fits the description: propellers of '" + request_.words.at("propeller") + "' at '" + turns_->words +
                   "' have tips at Mach " + Number(tips / kSound) + ", where thrust ends below Mach 1");
}

void Reader::CheckPower() const {
  if (!power_) return;
  const double energy = request_.energy_wh.value_or(request_.capacity_ah.value_or(0) * kNominalCell * request_.cells.value_or(0));
  const double time = request_.hover_time.value_or(request_.flight_time.value_or(0));
  const double needed = power_->value * time / 3600;
  if (energy > 0 && needed > 1.05 * energy) {
    const char* said = request_.hover_time ? "hover_time" : "flight_time";
    throw InputError("no drone fits the description: '" + power_->words + "' for '" + request_.words.at(said) + "' take " + Number(needed) +
                     " Wh, and the battery holds " + Number(energy) + " Wh");
  }
  if (!request_.mass || !request_.propeller || request_.facts.count("mass") || request_.facts.count("propeller")) return;
  // Actuator disc: no rotor hovers with less.
  const double rotors = request_.rotors.value_or(request_.layout == RotorLayout::kCoaxial ? 8 : 4);
  const double disc = rotors * std::numbers::pi / 4 * *request_.propeller * *request_.propeller;
  const double least = std::sqrt(std::pow(*request_.mass * kGravity, 3) / (2 * kAirDensity * disc));
  if (power_->value >= least) return;
  throw InputError("no drone fits the description: '" + request_.words.at("mass") + "' on propellers of '" +
                   request_.words.at("propeller") + "' hover with " + Number(least) + " W at least, not with '" + power_->words + "'");
}

/// Generators on the propellers give back less than they take.
void Reader::RefuseFreeEnergy() const {
  bool generator = false, on_board = false;
  for (size_t i = 0; i < tokens_.size(); ++i) {
    const std::string& text = tokens_[i].text;
    if (i > 1 && text == "generator" && tokens_[i - 1].text == "the" && IsOneOf(tokens_[i - 2].text, {"on", "from", "at"})) continue;
    generator |= text.starts_with("generator") || text.starts_with("dynamo") || text.starts_with("alternator") ||
                 text.starts_with("windmill") || text.starts_with("generador") || text.starts_with("generateur") ||
                 text.starts_with("lichtmaschine");
    on_board |= Is(i, WordKind::kBare) || text.starts_with("recharg") || text.starts_with("charg") || text == "themselves" ||
                text == "itself" || (Is(i, WordKind::kNoMultirotor) && tokens_[i].word->meaning == "an endless flight");
  }
  const bool fuel = std::any_of(tokens_.begin(), tokens_.end(), [](const Token& token) {
    return token.text.starts_with("petrol") || token.text.starts_with("gasoline") || token.text == "hybrid" || token.text == "fuel" ||
           IsOneOf(token.text, {"ground", "truck", "van", "pickup", "trailer", "jeep", "car", "diesel"});
  });
  if (!generator || !on_board || fuel) return;
  throw InputError(
      "no drone fits the description: generators that its own propellers drive take more power out of the flight "
      "than they give back; it flies as long as its battery lasts");
}

/// "No battery and no cable": nothing that its motors could run on. A battery alone that is missing is one that the
/// shop does not send along.
void Reader::RefuseNoEnergy() const {
  const auto is_source = [&](size_t k) {
    return Is(k, WordKind::kBattery) ||
           IsOneOf(tokens_[k].text, {"cable", "cables", "tether", "tethers", "fuel", "engine", "cord", "power", "energy"});
  };
  size_t missing = 0;
  bool power = false;
  for (size_t k = 0; k < tokens_.size(); ++k) {
    missing += Is(k, WordKind::kBare) && (tokens_[k].text.starts_with("no ") || tokens_[k].text.starts_with("without"));
    if (k == 0) continue;
    if (!is_source(k) || !(IsOneOf(tokens_[k - 1].text, {"no", "without", "nor", "any", "or", "neither"}))) continue;
    ++missing;
    const bool source = k + 1 < tokens_.size() && tokens_[k + 1].text == "source";
    power |= IsOneOf(tokens_[k].text, {"power", "energy"}) && (source || k + 1 == tokens_.size() || EndsPhrase(k + 1));
  }
  // "Without any battery, fuel, tether or other energy source"
  for (size_t k = 2; k < tokens_.size(); ++k) {
    if (tokens_[k].text != "source" || !IsOneOf(tokens_[k - 1].text, {"energy", "power"})) continue;
    for (size_t n = k - 1; n-- > 0 && k - n <= 10 && tokens_[n].text != ".";)
      power |= IsOneOf(tokens_[n].text, {"no", "without"}) || tokens_[n].text.starts_with("without ");
  }
  if (missing < 2 && !power) return;
  throw InputError("no drone fits the description: without a battery or a cable its motors have nothing to run on");
}

}  // namespace airsim360::internal
