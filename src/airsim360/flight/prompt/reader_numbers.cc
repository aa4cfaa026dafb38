// Numbers without a unit: counts, ratios, codes of parts, comparisons with a real drone.
#include "airsim360/flight/prompt/reader.h"

#include <algorithm>
#include <cmath>

#include "airsim360/base/error.h"
#include "airsim360/flight/prompt/number_words.h"

namespace airsim360::internal {

namespace {

/// "2207", "2806.5": a stator's diameter and height in mm, two figures each.
bool IsStator(double figures) {
  const double height = std::fmod(figures, 100);
  const double width = std::floor(figures / 100);
  return figures >= 600 && figures < 10000 && height >= 2 && height <= std::min(45.0, 1.5 * width);
}

}  // namespace

size_t Reader::Beside(size_t i, WordKind kind, bool after) const {
  for (size_t n = 1; n <= 4; ++n) {
    if (!after && n > i) break;
    const size_t k = after ? i + n : i - n;
    if (!after && n == 1 && tokens_[k].text == ")") {  // "TWR (empty) 3"
      if (k > 2 && tokens_[k - 2].text == "(" && Is(k - 3, kind)) return k - 3;
    }
    if (k >= tokens_.size() || EndsPhrase(k)) break;
    const bool blades = after && tokens_[k].kind == Token::Kind::kNumber && (Is(k + 1, WordKind::kBlades) || Is(k + 2, WordKind::kBlades));
    if (tokens_[k].kind == Token::Kind::kNumber && !blades) break;  // "5051 3-blade propellers"
    if (Is(k, kind)) return k;
    const bool goes_on = blades || Is(k, WordKind::kBlades) || SaysLittle(k) || tokens_[k].kind == Token::Kind::kUnknown ||
                         Is(k, WordKind::kBrushless) || Is(k, WordKind::kSize);
    if (!goes_on) break;
  }
  return kNone;
}

void Reader::ReadCode(size_t i) {
  const Token& token = tokens_[i];
  spanning_ = nullptr;
  used_[i] = true;
  if (Is(i + 1, WordKind::kLengthUnit)) used_[i + 1] = true;
  Use(Beside(i, WordKind::kPropeller, true));
  const int plainness = PlainnessOf({i, Is(i + 1, WordKind::kLengthUnit) ? i + 1 : i, 0, nullptr, {}}, kNone);
  if (GivesWay("propeller", request_.propeller, token.code[0] * 0.0254, 2 * plainness, token.text)) return;
  Set(kPropellerRange, request_.propeller, token.code[0] * 0.0254, token.text);
  Set({"pitch", 0.005, 1, "m"}, request_.pitch, token.code[1] * 0.0254, token.text);
  if (token.code[2] > 0) Set({"blades", 2, 6, ""}, request_.blades, std::floor(token.code[2]), token.text);
}

/// "KDE4215XF-465", "2207-1950": the KV that is written onto the name or the stator of a motor.
bool Reader::ReadMotorCode(size_t i) {
  const double value = tokens_[i].value;
  if (i < 2 || request_.motor_kv || !tokens_[i].glued || value < 50 || value > 30000 || value != std::floor(value)) return false;
  const bool onto = tokens_[i - 1].kind == Token::Kind::kDash || tokens_[i - 1].text == "/";
  const Token& name = tokens_[i - 2];
  if (!onto || !tokens_[i - 1].glued || (i + 1 < tokens_.size() && WordAt(i + 1) && IsUnitKind(WordAt(i + 1)->kind))) return false;
  const size_t digits = static_cast<size_t>(std::count_if(name.text.begin(), name.text.end(), [](char c) { return c >= '0' && c <= '9'; }));
  const bool coded = name.kind == Token::Kind::kUnknown && digits >= 3 && digits < name.text.size();
  const bool stator = name.kind == Token::Kind::kNumber && IsStator(name.value) && used_[i - 2];
  // "3510XF-475"
  const bool lettered = name.kind == Token::Kind::kUnknown && name.glued && name.text.size() <= 3 && i > 2 &&
                        tokens_[i - 3].kind == Token::Kind::kNumber && IsStator(tokens_[i - 3].value);
  if (!coded && !stator && !lettered) return false;
  Decide("'" + name.text + tokens_[i - 1].text + tokens_[i].text + "' is read as a motor of " + tokens_[i].text + " KV");
  Set({"motor_kv", 10, 50000, "rpm/V"}, request_.motor_kv, value, tokens_[i].text + " kv");
  return used_[i] = true;
}

/// "9450s" are propellers, "2207s" motors, no seconds.
bool Reader::ReadPlural(size_t i, size_t unit) {
  const double value = tokens_[i].value;
  if (tokens_[unit].text != "s" || !tokens_[unit].glued || value < 1000 || value > 99999) return false;
  if (i > 0 && Is(i - 1, WordKind::kCells)) return false;
  double code[3];
  const double tail = std::fmod(value, 100);
  const bool series = value >= 3000 && tail >= 25 && std::fmod(value, 5) == 0;  // "5030", "6040"
  const bool flat = tail > 36 || value > 9999 || series;
  if (!flat) return IsStator(value) && (used_[i] = true);
  if (!ReadPropellerFigures(tokens_[i].text, code)) return false;
  std::copy(std::begin(code), std::end(code), std::begin(tokens_[i].code));
  ReadCode(i);
  return true;
}

/// "4S", "6 cells", which may be seconds, codes of parts or propellers.
void Reader::ReadCells(const Quantity& q) {
  const size_t i = q.first;
  if (ReadPlural(i, q.last)) return;
  // "no less than 1500 s": no battery has so many cells, these are seconds.
  if (tokens_[i].value >= 100 && i > 0 && Is(i - 1, WordKind::kCells) && ReadCharge(i)) return;  // "4S 1500s"
  if (tokens_[i].value > 40 && tokens_[q.last].text == "s") return ReadTime({i, q.last, tokens_[i].value, q.unit, q.words});
  if (tokens_[i].high > 0) {  // "3-4S": what takes both is made for the higher
    Decide("of '" + q.words + "' the higher is taken");
    tokens_[i].value = tokens_[i].high;
    spanning_ = nullptr;
  }
  if (tokens_[i].value != std::floor(tokens_[i].value)) {
    throw InputError("'" + q.words + "' is not a whole number");
  }
  // "6S6P (36 cells)": all cells of the pack.
  for (size_t k = 1; tokens_[i].value > 24 && k < tokens_.size(); ++k) {
    if (tokens_[k].text == "p" && request_.cells && tokens_[i].value == *request_.cells * tokens_[k - 1].value) return NameElse(q, kNone);
  }
  if (const double packs = PacksInSeries(i); packs > 1)
    return Set({"cells", 1, 24, ""}, request_.cells, packs * tokens_[i].value, tokens_[i - 1].text + " " + q.words);
  if (ReadInchesAsPlural(i, q.last)) return;
  CorrectWith("cells", request_.cells, i);
  // Beside "6S" a "2 s" are seconds.
  if (const bool apart = tokens_[q.last].text == "s" && !tokens_[q.last].glued;
      GivesWay("cells", request_.cells, tokens_[i].value, apart ? 1 : 2, q.words))
    return NameElse(q, kNone);
  Set({"cells", 1, 24, ""}, request_.cells, tokens_[i].value, q.words);
}

/// "On 15s" beside a battery whose cells were said: propellers.
bool Reader::ReadInchesAsPlural(size_t i, size_t unit) {
  const double value = tokens_[i].value;
  if (!request_.cells || request_.propeller || *request_.cells == value || i == 0) return false;
  if (tokens_[unit].text != "s" || !tokens_[unit].glued || value < 5 || value > 40) return false;
  const std::string& before = tokens_[i - 1].text;
  if (before != "on" && before != "with" && before != "and" && before != "w") return false;
  Decide("'" + tokens_[i].text + "s' is read as propellers of " + tokens_[i].text + " inches");
  Set(kPropellerRange, request_.propeller, value * 0.0254, tokens_[i].text + "s");
  return true;
}

/// "9450 props", "2212 920 KV", "3S 2200".
bool Reader::ReadPartNumber(size_t i) {
  const Token& token = tokens_[i];
  if (token.value < 1000 || token.value > 99999) return false;
  if (IsStator(token.value) && Is(i - 1, WordKind::kKvUnit) && Beside(i, WordKind::kPropeller, true) == kNone)
    return used_[i] = true;  // "1300 kv 2806.5"
  // "6S 2200, 1800 kv", "4S 1500 2400kv": a charge, for no stator is so high.
  if (!IsStator(token.value) && Is(i - 1, WordKind::kCells) && used_[i - 1]) return false;
  if (Is(i - 1, WordKind::kCells) && used_[i - 1] && i + 1 < tokens_.size() && tokens_[i + 1].text == "," &&
      std::fmod(token.value, 50) == 0 && std::fmod(token.value, 100) < 60)
    return false;
  size_t next = i + 1;
  while (next < tokens_.size() && next < i + 3 &&
         (tokens_[next].text == "/" || tokens_[next].kind == Token::Kind::kDash || tokens_[next].text == ","))
    ++next;
  const bool kv = next + 1 < tokens_.size() && tokens_[next].kind == Token::Kind::kNumber &&
                  (Is(next + 1, WordKind::kKvUnit) || (tokens_[next + 1].kind == Token::Kind::kDash && Is(next + 2, WordKind::kKvUnit)));
  const bool written_on = next == i + 2 && next < tokens_.size() && tokens_[next].kind == Token::Kind::kNumber && tokens_[next].glued &&
                          IsStator(token.value) && tokens_[next - 1].text != "," && tokens_[next].value >= 50;
  // "1045, 1000 kv": no stator is as high as that.
  const bool stator = kv && (IsStator(token.value) || std::fmod(token.value, 100) < 40 || token.value > 9999);
  if (stator || written_on || Beside(i, WordKind::kMotor, true) != kNone) return used_[i] = true;
  double code[3];
  const bool propeller = Beside(i, WordKind::kPropeller, true) != kNone || Beside(i, WordKind::kPropeller, false) != kNone ||
                         Beside(i, WordKind::kBlades, true) != kNone;
  if (propeller && ReadPropellerFigures(token.text, code)) {
    Token read = token;
    std::copy(std::begin(code), std::end(code), std::begin(read.code));
    tokens_[i].kind = Token::Kind::kPropellerCode;
    std::copy(std::begin(code), std::end(code), std::begin(tokens_[i].code));
    ReadCode(i);
    return true;
  }
  if (Beside(i, WordKind::kMotor, false) != kNone) return used_[i] = true;
  return false;
}

/// "4S 1500", "2S 450 pack", "850 4S", "battery 5000": a number without unit beside cells or a battery is mAh.
bool Reader::ReadCharge(size_t i) {
  const double value = tokens_[i].value;
  if (value < 100 || value > 99999) return false;
  for (const WordKind kind : {WordKind::kRotors, WordKind::kFrame, WordKind::kSizeNoun, WordKind::kDrone, WordKind::kWheelbase,
                              WordKind::kPropeller, WordKind::kMotor}) {
    if (Beside(i, kind, true) != kNone && value < 1000) return false;
  }
  size_t before = i;
  while (before-- > 0 &&
         (SaysLittle(before) || tokens_[before].text == "/" || Is(before, WordKind::kBattery) || Is(before, WordKind::kLithiumIon))) {
    if (Is(before, WordKind::kBattery)) break;
  }
  if (before != kNone && before > 1 && Is(before, WordKind::kTimes) && tokens_[before - 1].value <= 8) before -= 2;  // "6S 2x 4500"
  const bool cells_before = before != kNone && Is(before, WordKind::kCells) && used_[before];
  const bool cells_after = i + 2 < tokens_.size() && tokens_[i + 1].kind == Token::Kind::kNumber && Is(i + 2, WordKind::kCells);
  const bool battery = Is(i + 1, WordKind::kBattery) || (before != kNone && Is(before, WordKind::kBattery));
  if (!cells_before && !cells_after && !battery) return false;
  // "Battery 155" of a list of grams, beside "1500 mAh"
  const bool said = std::any_of(tokens_.begin(), tokens_.end(), [](const Token& token) { return token.Is(WordKind::kCapacityUnit); });
  if (said && !cells_before && !cells_after) return false;
  CorrectWith("capacity_ah", request_.capacity_ah, i);
  if (request_.capacity_ah) return false;
  Decide("'" + tokens_[i].text + "' is read as mAh");
  used_[i] = true;
  ReadCapacity({i, i, value / 1000, FindWord("mah", false), tokens_[i].text});
  return true;
}

/// "AUW 680", "MTOW 8.8": a mass without a unit, in that of the other masses, else kilograms below 20.
bool Reader::ReadBareMass(size_t i) {
  const size_t noun = Beside(i, WordKind::kMass, false);
  const double value = tokens_[i].value;
  if (noun == kNone || claimed_[noun] || i - noun > 2 || request_.mass) return false;
  if (i + 1 < tokens_.size() && !EndsPhrase(i + 1)) return false;
  const std::vector<Quantity> masses = Masses();
  if (!IsWhole(noun) && !masses.empty()) return false;
  const bool toy =
      std::any_of(tokens_.begin(), tokens_.end(), [](const Token& token) { return token.text.find("whoop") != std::string::npos; });
  const Word* unit = FindWord(masses.empty() ? (value < 20 && !toy ? "kg" : "g") : tokens_[masses[0].last].text, false);
  if (unit == nullptr || value * unit->value < 0.01 || value * unit->value > 400) return false;
  used_[i] = true;
  Decide("'" + tokens_[noun].text + " " + tokens_[i].text + "' is read in " +
         std::string(unit->value < 0.1 ? "grams" : "the unit of the masses"));
  Use(noun);
  ReadMassAs(MassRole::kWhole, {i, i, value * unit->value, unit, tokens_[i].text});
  return true;
}

/// What the noun before a number says of it: "rotors=6", "cells: 4", "props: 14", "weight (g): 1200", "Mach 2".
bool Reader::ReadLabelled(size_t i) {
  const Token& token = tokens_[i];
  const auto unit_in_parentheses = [&] {
    return i > 3 && (tokens_[i - 1].text == ")" || tokens_[i - 1].text == "]") && WordAt(i - 2) &&
           WordAt(i - 2)->kind >= WordKind::kMassUnit && WordAt(i - 2)->kind <= WordKind::kKvUnit &&
           tokens_[i - 3].kind == Token::Kind::kComma;
  };
  if (unit_in_parentheses()) {
    const Word* unit = WordAt(i - 2);
    used_[i] = used_[i - 2] = true;
    Dispatch({i, i, token.value * unit->value, unit, token.text + " " + tokens_[i - 2].text});
    return true;
  }
  if (i > 0 && IsOneOf(tokens_[i - 1].text, {"axis", "axes"}) && rotor_words_ == 0 && !request_.rotors && token.Counts(8)) {
    used_[i] = used_[i - 1] = true;
    SetRotors(token.value, tokens_[i - 1].text + " " + token.text);
    return true;
  }
  if (i > 0 && tokens_[i - 1].text == "mach") {
    used_[i] = true;
    ReadSpeed({i - 1, i, token.value * 340.3, nullptr, "mach " + token.text});
    return true;
  }
  // "U8 100KV x 6", "motors x4"
  const bool counted =
      i > 1 && Is(i - 1, WordKind::kTimes) &&
      (Is(i - 2, WordKind::kKvUnit) || Is(i - 2, WordKind::kMotor) || Is(i - 2, WordKind::kRotorNoun) || Is(i - 2, WordKind::kPropeller));
  if (counted && token.Counts(8) && token.value >= 4 && rotor_words_ == 0 && !request_.rotors &&
      (i + 1 >= tokens_.size() || EndsPhrase(i + 1))) {
    used_[i] = true;
    SetRotors(token.value, tokens_[i - 2].text + " x " + token.text);
    return true;
  }
  return ReadBareMass(i) || ReadLabelledPart(i);
}

/// A number beside arms, rotors, cells or propellers: how many of them, or how large.
bool Reader::ReadLabelledPart(size_t i) {
  const Token& token = tokens_[i];
  const auto label = [&](WordKind kind) {
    const size_t noun = Beside(i, kind, false);
    return noun != kNone && !claimed_[noun] ? noun : kNone;
  };
  const bool count = token.value == std::floor(token.value) && token.value < 41;
  if (const size_t arms = label(WordKind::kArm);
      arms != kNone && token.Counts(12) && !arm_count_ && tokens_[arms].text == "arms" && (i + 1 >= tokens_.size() || EndsPhrase(i + 1))) {
    Use(arms);
    used_[i] = true;
    SetArms(token.value, "arms " + token.text);
    return true;
  }
  for (const WordKind kind : {WordKind::kRotorNoun, WordKind::kMotor}) {
    const size_t noun = label(kind);
    if (noun == kNone || !count || request_.rotors) continue;
    Use(noun);
    used_[i] = true;
    SetRotors(token.value, tokens_[noun].text + " " + token.text);
    return true;
  }
  if (const size_t noun = label(WordKind::kCells);
      noun != kNone && count && !used_[noun] && !request_.cells && tokens_[noun].text.size() > 1) {
    Use(noun);
    used_[i] = true;
    Set({"cells", 1, 24, ""}, request_.cells, token.value, token.text + " cells");
    return true;
  }
  for (const bool after : {false, true}) {
    const size_t noun = after ? Beside(i, WordKind::kPropeller, true) : label(WordKind::kPropeller);
    if (noun == kNone || token.value < 1.2 || token.value > 60 || request_.propeller ||
        tokens_[i + 1 < tokens_.size() ? i + 1 : i].text == "x")
      continue;
    if (after && (count && token.value < 9)) continue;
    Use(noun);
    used_[i] = true;
    Decide("'" + token.text + "' is read as the diameter of the propellers in inches");
    Set(kPropellerRange, request_.propeller, token.value * 0.0254, token.text);
    return true;
  }
  return false;
}

/// "100 g more than normal", "5 minutes longer": beside what is known of a real drone. True when it was read.
bool Reader::ReadDifference(const Quantity& q) {
  if (model_ == nullptr) return false;
  size_t k = q.last + 1;
  if (Is(q.first > 0 ? q.first - 1 : kNone, WordKind::kPayload)) return false;
  if (k >= tokens_.size()) return false;
  const auto begins = [&](std::initializer_list<const char*> words) {
    return std::any_of(words.begin(), words.end(), [&](const char* word) { return tokens_[k].text.starts_with(word); });
  };
  const double sign = begins({"more", "extra", "additional", "heavier", "longer", "faster"}) ? 1
                      : begins({"less", "lighter", "shorter", "slower", "fewer"})            ? -1
                                                                                             : 0;
  const bool load = Is(k + 1, WordKind::kPayload) || Is(k + 1, WordKind::kLoad);
  if (sign == 0 || load) return false;
  const std::string words = q.words + " " + tokens_[k].text;
  if (q.unit->kind == WordKind::kMassUnit) {
    Set({"mass", 0.01, 400, "kg"}, request_.mass, model_->mass + sign * q.value, words);
  } else if (q.unit->kind == WordKind::kTimeUnit && model_->flight > 0) {
    Set({"flight_time", 10, 36000, "s"}, request_.flight_time, model_->flight * 60 + sign * q.value, words);
  } else if (q.unit->kind == WordKind::kSpeedUnit && model_->speed > 0) {
    Set({"speed", 0.5, 150, "m/s"}, request_.speed, model_->speed + sign * q.value, words);
  } else {
    return false;
  }
  used_[k] = true;
  Decide("'" + words + "' is more or less than that of " + std::string(model_->title));
  return true;
}

/// The word at `k`; "lighter than" compares here.
const Word* Reader::Comparative(size_t k) const {
  if (!Is(k, WordKind::kAtMost)) return WordAt(k);
  for (const char* word : {"lighter", "smaller", "shorter"}) {
    if (tokens_[k].text.starts_with(word)) return FindWord(word, false);
  }
  return nullptr;
}

/// What a real drone's figure is multiplied with: "twice as heavy", "20 % heavier". True when it was read.
bool Reader::ReadComparison(size_t i, double factor, size_t last) {
  if (ReadThrustOfWeight(i, last, factor)) return true;
  if (model_ == nullptr) return false;
  const bool share = last + 1 < tokens_.size() && tokens_[last + 1].text == "of";  // "70 % of"
  for (size_t k = last + 1; k < tokens_.size() && k <= last + 5; ++k) {
    const Word* word = Comparative(k);
    // "70 % of a Mavic 3" is said of its mass.
    if (share && tokens_[k].kind == Token::Kind::kModel) word = FindWord("weight", false);
    if (word == nullptr || word->kind == WordKind::kFiller || word->kind == WordKind::kTo) continue;
    const bool percent = Is(last, WordKind::kPercent);
    const bool compares = word->kind >= WordKind::kHeavier && word->kind <= WordKind::kFaster;
    const double f = percent && !share                           ? 1 + (compares && word->value < 0 ? -factor : factor)
                     : compares && word->value < 0 && factor > 1 ? 1 / factor
                                                                 : factor;
    const std::string words = tokens_[i].text + (percent ? " % " : " ") + tokens_[k].text;
    const std::string of = "'" + words + "' is of " + std::string(model_->title);
    const auto use = [&] {
      for (size_t n = i; n <= k; ++n) used_[n] = true;
      claimed_[k] = true;
    };
    if (word->kind == WordKind::kHeavier || word->kind == WordKind::kMass) {
      Set({"mass", 0.01, 400, "kg"}, request_.mass, model_->mass * f, words);
    } else if (word->kind == WordKind::kBigger || word->kind == WordKind::kSizeNoun) {
      if (model_->diagonal > 0) Set({"arm", 0.02, 3, "m"}, request_.arm, f * model_->diagonal / 2000, words);
      if (model_->propeller > 0) Set(kPropellerRange, request_.propeller, f * model_->propeller * 0.0254, words);
      if (!request_.mass) loose_masses_.push_back({{i, k, f * f * model_->mass, nullptr, words}, false});
    } else if (word->kind == WordKind::kLonger || word->kind == WordKind::kFlight || word->kind == WordKind::kHover) {
      const double minutes = model_->flight > 0 && word->kind != WordKind::kHover ? model_->flight : model_->hover;
      if (minutes <= 0) return false;
      Field& field = minutes == model_->flight ? request_.flight_time : request_.hover_time;
      Set({minutes == model_->flight ? "flight_time" : "hover_time", 10, 36000, "s"}, field, f * minutes * 60, words);
    } else if ((word->kind == WordKind::kFaster || word->kind == WordKind::kSpeed) && model_->speed > 0) {
      Set({"speed", 0.5, 150, "m/s"}, request_.speed, f * model_->speed, words);
    } else {
      return false;
    }
    use();
    Decide(of);
    return true;
  }
  return false;
}

bool Reader::ReadFactor(size_t i) {
  if (Is(i, WordKind::kFactor)) return ReadComparison(i, tokens_[i].word->value, i);
  if (tokens_[i].kind != Token::Kind::kNumber) return false;
  if (Is(i + 1, WordKind::kTimes)) return ReadComparison(i, tokens_[i].value, i + 1);
  return false;
}

void Reader::ReadBareNumber(size_t i) {
  const double value = tokens_[i].value;
  spanning_ = &tokens_[i];
  if (ReadMotorCode(i)) return;
  // "400 W" beside hovering: elsewhere "w" is "with".
  if (i + 1 < tokens_.size() && tokens_[i + 1].text == "w" &&
      ReadPower({i, i + 1, value, FindWord("watt", false), tokens_[i].text + " W"})) {
    used_[i] = used_[i + 1] = true;
    return;
  }
  if (ReadFactor(i) || ReadPartNumber(i) || ReadCharge(i)) return;
  for (const bool after : {true, false}) {
    const size_t ratio = Beside(i, WordKind::kThrustRatio, after);
    if (ratio == kNone || claimed_[ratio]) continue;
    Use(ratio);
    used_[i] = true;
    if (Is(i + 1, WordKind::kTo) && i + 2 < tokens_.size() && tokens_[i + 2].value == 1) used_[i + 2] = true;
    return Set({"thrust_to_weight", 1.05, 20, ""}, request_.thrust_to_weight, value, "thrust to weight " + tokens_[i].text);
  }
  if (ReadCount(i) || ReadLabelled(i)) return;
  if (const size_t kv = Beside(i, WordKind::kKvUnit, false); kv != kNone && !claimed_[kv]) {
    Use(kv);
    used_[i] = true;
    return Set({"motor_kv", 10, 50000, "rpm/V"}, request_.motor_kv, value, tokens_[i].text + " kv");
  }
  // "2212 920kv, 9450, 4S": figures that propellers have and nothing else.
  const double pitch = std::fmod(value, 100);
  if (value >= 1000 && value < 10000 && !request_.propeller && (pitch == 45 || pitch == 47 || value == 9450) &&
      ReadPropellerFigures(tokens_[i].text, tokens_[i].code))
    return ReadCode(i);
  if (tokens_[i].text.ends_with(":1") && value >= 1.05 && value <= 20 && !request_.thrust_to_weight) {
    used_[i] = true;
    Decide("'" + tokens_[i].text + "' is read as the thrust over the weight");
    return Set({"thrust_to_weight", 1.05, 20, ""}, request_.thrust_to_weight, value, tokens_[i].text);
  }
  // "a 250 class quad", "450 frame", "a 450 quad": millimetres between motors that face each other.
  const bool size = Beside(i, WordKind::kSizeNoun, true) != kNone || (i > 0 && Is(i - 1, WordKind::kSizeNoun)) ||
                    Beside(i, WordKind::kFrame, true) != kNone || Beside(i, WordKind::kWheelbase, true) != kNone ||
                    Beside(i, WordKind::kWheelbase, false) != kNone || Beside(i, WordKind::kRotors, true) != kNone ||
                    Beside(i, WordKind::kFrame, false) != kNone;
  if (size && value >= 60 && value <= 2500 && !request_.arm) {
    used_[i] = true;
    Decide("'" + tokens_[i].text + "' is read as the diagonal in millimetres");
    Set({"arm", 0.02, 3, "m"}, request_.arm, value / 2000, tokens_[i].text);
  }
}

}  // namespace airsim360::internal
