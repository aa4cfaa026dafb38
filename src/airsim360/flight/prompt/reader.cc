#include "airsim360/flight/prompt/reader.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "airsim360/base/error.h"
#include "airsim360/flight/prompt/plain_text.h"

namespace airsim360::internal {
namespace {

std::string Kilograms(double value) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.4g kg", value);
  return text;
}

}  // namespace

Reader::Reader(std::string_view prompt, std::vector<Token> tokens, std::map<size_t, MassRole> roles)
    : tokens_(std::move(tokens)), roles_(std::move(roles)) {
  request_.prompt = PrintableText(prompt);
  used_.assign(tokens_.size(), false);
  claimed_.assign(tokens_.size(), false);
  for (const Token& token : tokens_) {
    const bool layout = token.Is(WordKind::kLayout) && token.word->meaning == "coaxial";
    const size_t i = static_cast<size_t>(&token - tokens_.data());
    coaxial_said_ |= layout || (token.Is(WordKind::kCoaxial) && !IsMotorName(i));
    liquid_said_ |= token.Is(WordKind::kVolumeUnit);
    rotor_words_ += token.Is(WordKind::kRotors) || (token.Is(WordKind::kCoaxial) && !IsMotorName(i));
  }
}

DroneRequest Reader::Run() {
  RefuseFreeEnergy();
  RefuseNoEnergy();
  RefuseOthers();
  for (const Token& token : tokens_) {
    if (!token.respelled.empty()) Decide("'" + token.text + "' is read as '" + token.respelled + "'");
    if (token.kind != Token::Kind::kModel) continue;
    anything_ = true;
    if (model_ == nullptr) model_ = token.model;
  }
  // Kinds and layouts first: counts and numbers lean on them.
  for (size_t i = 0; i < tokens_.size(); ++i) {
    if (tokens_[i].kind == Token::Kind::kWord) ReadWord(i);
    if (tokens_[i].kind == Token::Kind::kUnknown || Is(i, WordKind::kTimes) || tokens_[i].text == "h") ReadSign(i);
  }
  for (size_t i = 0; i < tokens_.size(); ++i) {
    if (used_[i]) continue;
    ReadToken(i);
  }
  if (!anything_) ReadNothing();
  if (!anything_) {
    throw InputError(tokens_.empty() ? "the description is empty; say for example \"a 250 g five-inch racing quad\""
                                     : "nothing in '" + request_.prompt.substr(0, 80) +
                                           "' describes a drone; say for example \"a 250 g five-inch racing quad\"");
  }
  Finish();
  return std::move(request_);
}

void Reader::ReadToken(size_t i) {
  spanning_ = nullptr;
  if (tokens_[i].kind == Token::Kind::kPropellerCode && Is(i + 1, WordKind::kMassUnit)) {  // "2x1.5 kg"
    tokens_[i].kind = Token::Kind::kNumber;
    tokens_[i].value = tokens_[i].code[0] * tokens_[i].code[1];
  }
  if (tokens_[i].kind == Token::Kind::kPropellerCode) return ReadCode(i);
  if (Is(i, WordKind::kFactor)) {
    ReadFactor(i);
    return;
  }
  if (tokens_[i].kind != Token::Kind::kNumber) return;
  if (!ReadQuantity(i)) ReadBareNumber(i);
}

void Reader::ReadWord(size_t i) {
  const Word& word = *tokens_[i].word;
  const std::string& text = tokens_[i].text;
  const std::string meaning(word.meaning);
  switch (word.kind) {
    case WordKind::kClass:
      return ReadClass(meaning, text), Use(i);
    case WordKind::kSize:
      used_[i] = anything_ = true;
      if (!request_.size) {
        request_.size = meaning;
        request_.words["size"] = text;
      }
      return;
    case WordKind::kRotors:
      return ReadRotorsWord(i);
    case WordKind::kCoaxial:
      used_[i] = true;
      if (IsMotorName(i)) return;
      SetRotors(word.value, text);
      return SetLayout("coaxial", text);
    case WordKind::kLayout:
      used_[i] = true;
      return SetLayout(meaning, text);
    case WordKind::kBlades:
      if (word.value <= 0) return;
      used_[i] = true;
      return Set({"blades", 2, 6, ""}, request_.blades, word.value, text);
    case WordKind::kGuards:
      used_[i] = anything_ = request_.guarded = true;
      request_.words["guarded"] = text;
      return;
    case WordKind::kBrushless:
      used_[i] = request_.brushless = true;
      return;
    case WordKind::kLithiumIon:
      used_[i] = request_.lithium_ion = true;
      return;
    case WordKind::kLoad:
      return ReadLoad(i);
    case WordKind::kDrone:
      anything_ = true;
      return;
    default:
      return;
  }
}

void Reader::ReadLoad(size_t i) {
  const Word& word = *tokens_[i].word;
  if (word.meaning == "camera" && hinted_class_.empty()) {
    hinted_class_ = "camera";
    hinted_words_ = tokens_[i].text;
    used_[i] = anything_ = true;
  }
  if (word.value <= 0) return;
  used_[i] = anything_ = true;
  known_load_ = known_load_.value_or(0) + word.value;
  known_load_words_ += (known_load_words_.empty() ? "" : ", ") + tokens_[i].text;
}

void Reader::ReadClass(const std::string& name, const std::string& words) {
  anything_ = true;
  if (!request_.drone_class) {
    request_.drone_class = name;
    request_.words["drone_class"] = words;
  } else if (*request_.drone_class != name) {
    Decide("of the kinds '" + request_.words["drone_class"] + "' and '" + words + "' the first is taken");
  }
}

/// "x", "h" and "plus" say a layout before a word for the drone only.
void Reader::ReadSign(size_t i) {
  const std::string& text = tokens_[i].text;
  const std::string meaning = text == "+" || text == "plus" ? "plus" : text == "x" ? "x" : text == "h" ? "h" : "";
  if (meaning.empty() || (i > 0 && tokens_[i - 1].kind == Token::Kind::kNumber)) return;
  const size_t next = i + 1;
  const bool sign = next < tokens_.size() && (tokens_[next].text == "plus" || tokens_[next].text == "+");
  if (!sign && !Is(next, WordKind::kRotors) && !Is(next, WordKind::kDrone) && !Is(next, WordKind::kClass)) return;
  used_[i] = true;
  SetLayout(meaning, text);
}

void Reader::SetLayout(const std::string& meaning, const std::string& text) {
  const RotorLayout layout = meaning == "plus"      ? RotorLayout::kPlus
                             : meaning == "h"       ? RotorLayout::kH
                             : meaning == "wide"    ? RotorLayout::kWideX
                             : meaning == "coaxial" ? RotorLayout::kCoaxial
                                                    : RotorLayout::kX;
  anything_ = true;
  // "wide X" says X twice.
  if (request_.layout == RotorLayout::kWideX && layout == RotorLayout::kX) return;
  if (request_.layout && *request_.layout != layout) Contradiction("layout", text);
  request_.layout = layout;
  request_.words["layout"] = text;
}

void Reader::Finish() {
  spanning_ = nullptr;
  FinishRotors();
  FinishLengths();
  FinishTimes();
  FinishMasses();
  CheckLoadOfModel();
  if (request_.brushless && request_.drone_class == "nano") request_.drone_class = "nano_brushless";
  if (model_ != nullptr) {
    ApplyModel(*model_, request_);
    Decide(std::string(model_->title) + " is known: " + ModelFacts(*model_) + " (" + std::string(model_->source) + ")");
  } else if (!request_.drone_class && !hinted_class_.empty()) {
    ReadClass(hinted_class_, hinted_words_);
  }
  FinishThrust();
  CheckVoltage();
  CheckTips();
  CheckPower();
  ListUnused();
}

void Reader::FinishMasses() {
  const FieldRange mass{"mass", 0.01, 400, "kg"}, payload{"payload", 0.0005, 1000, "kg"};
  // "... and a 4S 5 Ah battery weighing 2 kg": no battery of that charge is so heavy, the drone is.
  const double energy = request_.energy_wh.value_or(request_.capacity_ah.value_or(0) * 3.7 * request_.cells.value_or(0));
  const bool above_model = model_ && energy <= 0 && request_.battery_mass.value_or(0) > 0.7 * model_->mass;
  if (request_.battery_mass && !request_.mass && (above_model || (energy > 0 && energy < 60 * *request_.battery_mass))) {
    const std::string words = request_.words["battery_mass"];
    Decide("'" + words + "' is too much for that battery and is read as the mass of the drone");
    Set(mass, request_.mass, *request_.battery_mass, words);
    request_.battery_mass.reset();
    request_.words.erase("battery_mass");
  }
  FinishLoadedMass();
  SumUpParts();
  RefuseHeavyParts();
  // What is said outright before what is only bounded, parts last.
  const auto order = [&](const Loose& loose) { return 2 * loose.part + (loose.quantity.unit && IsAtMost(loose.quantity)); };
  std::stable_sort(loose_masses_.begin(), loose_masses_.end(), [&](const Loose& a, const Loose& b) { return order(a) < order(b); });
  for (const Loose& loose : loose_masses_) PlaceLoose(loose);
  spanning_ = nullptr;
  FinishLoads();
  FinishOnTop();
  FinishBareMass();
  if (!request_.empty_mass) return;
  const std::string words = request_.words["empty_mass"];
  constexpr double kMostLoad = 0.6;  // of the whole
  if (request_.mass && *request_.mass - *request_.empty_mass > kMostLoad * *request_.mass) {
    // What is between is not all load: the empty drone was weighed without its battery.
    Decide("'" + words + "' is read as the mass without battery, for '" + request_.words["mass"] + "' is so much more");
    request_.bare_mass = std::exchange(request_.empty_mass, std::nullopt);
    request_.words["bare_mass"] = request_.words["empty_mass"];
    request_.words.erase("empty_mass");
    return;
  }
  if (request_.mass && !request_.payload && *request_.mass > *request_.empty_mass) {
    Set(payload, request_.payload, *request_.mass - *request_.empty_mass, request_.words["mass"] + " less " + words);
    return;
  }
  const double whole = *request_.empty_mass + request_.payload.value_or(0);
  // "12.5 kg dry, 10 l, 24.5 kg at take-off": the rest is of what was not said.
  if (request_.mass && *request_.mass >= whole) return;
  Set(mass, request_.mass, whole, request_.payload ? words + " and " + request_.words["payload"] : words);
}

/// A mass of which nothing says whose it is: the drone's, what it carries, or a part of it.
void Reader::PlaceLoose(const Loose& loose) {
  const FieldRange mass{"mass", 0.01, 400, "kg"}, payload{"payload", 0.0005, 1000, "kg"};
  const Quantity& q = loose.quantity;
  spanning_ = &tokens_[q.first];
  const bool bound = q.unit && IsAtMost(q);
  const double value = bound ? 0.996 * q.value : q.value;
  if (q.value < mass.low) {  // of a part, or a tolerance
    ++unexplained_;
    return Decide("'" + q.words + "' is too little for a drone and left out");
  }
  if (bound && request_.mass && *request_.mass <= q.value * 1.005) {
    unexplained_ += *request_.mass < 0.6 * q.value;
    return;
  }
  if (loose.part && request_.mass && *request_.mass > 1.3 * q.value) {
    Decide("'" + q.words + "' is of a part and left to the design");
    return;
  }
  if (!bound && request_.mass && IsSumOf(*request_.mass, q.value)) {  // "total 2.5 kg, payload 500 g, 2 kg drone"
    Set({"empty_mass", 0.005, 400, "kg"}, request_.empty_mass, q.value, q.words);
    return;
  }
  // What is beside the mass of a drone is carried.
  const bool carried = (loose.thing || IsOfLoad(q)) && !bound && !request_.payload;
  const bool inside = loose.part || loose.thing || IsIncluded(q);
  if (whole_of_mass_ && inside && request_.mass && q.value * loose.count > *request_.mass) {
    throw InputError("no drone fits the description: parts of '" + q.words + "' are more than '" + request_.words["mass"] + "' in all");
  }
  if (whole_of_mass_ && !carried && !bound && request_.mass && q.value < 0.98 * *request_.mass) {
    Decide("'" + q.words + "' is of a part of '" + request_.words["mass"] + "' and left to the design");
    ++unexplained_;
  } else if (carried) {
    Decide("'" + q.words + "' is read as payload");
    Set(payload, request_.payload, q.value, q.words);
  } else {
    if (bound) Decide("'" + q.words + "' is not reached by a little: " + Kilograms(value));
    Set(mass, request_.mass, value, q.words);
  }
}

/// Liquids and things of known mass, where no payload was said.
void Reader::FinishLoads() {
  const FieldRange payload{"payload", 0.0005, 1000, "kg"};
  if (liquid_ && !request_.payload) {
    Decide("'" + liquid_words_ + "' of liquid weigh " + Kilograms(*liquid_) + ", as water");
    Set(payload, request_.payload, *liquid_, liquid_words_);
  }
  if (known_load_ && !request_.payload) {
    Decide("'" + known_load_words_ + "' weighs " + Kilograms(*known_load_) + " and is the payload");
    Set(payload, request_.payload, *known_load_, known_load_words_);
    request_.facts.insert("payload");
  }
}

void Reader::ListUnused() {
  for (size_t i = 0; i < tokens_.size(); ++i) {
    if (used_[i]) continue;
    const Token& token = tokens_[i];
    const Word* word = WordAt(i);
    const bool says_nothing =
        token.kind == Token::Kind::kUnknown || token.kind == Token::Kind::kNumber ||
        (word && ((IsUnitKind(word->kind) && i > 0 && tokens_[i - 1].kind == Token::Kind::kNumber) || word->kind == WordKind::kElse ||
                  word->kind == WordKind::kVehicle || word->kind == WordKind::kNoMultirotor || word->kind == WordKind::kLoad ||
                  word->kind == WordKind::kFactor));
    if (says_nothing) request_.unused.push_back(token.text);
  }
}

}  // namespace airsim360::internal
