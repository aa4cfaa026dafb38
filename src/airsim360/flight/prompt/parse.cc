// Prompts to requests: numbers find the noun or unit that says what they are.
#include <cmath>
#include <cstdio>

#include "airsim360/base/error.h"
#include "airsim360/flight/prompt/request.h"
#include "airsim360/flight/prompt/tokens.h"

namespace airsim360 {
namespace {
using internal::Token;
using internal::Word;
using internal::WordKind;

class Parser {
 public:
  explicit Parser(std::string_view prompt) : tokens_(internal::Tokenize(prompt)) {
    request_.prompt = std::string(prompt);
    used_.assign(tokens_.size(), false);
  }

  DroneRequest Run() {
    bool anything = false;
    for (size_t i = 0; i < tokens_.size(); ++i) {
      if (used_[i]) continue;
      const Token& token = tokens_[i];
      anything |= token.kind != Token::Kind::kComma;
      if (token.kind == Token::Kind::kPropellerCode) ReadCode(i);
      if (token.kind == Token::Kind::kNumber) ReadQuantity(i);
      if (token.kind == Token::Kind::kWord) ReadLoneWord(i);
    }
    if (!anything)
      throw InputError("the description is empty; say for example \"a 250 g five-inch racing quad\"");
    if (brushless_ && request_.drone_class == "nano") request_.drone_class = "nano_brushless";
    return std::move(request_);
  }

 private:
  /// Sets a field once; a second value must agree.
  void Set(const char* name, std::optional<double>& field, double value, const std::string& words, double low,
           double high, const char* unit) {
    if (!(value >= low && value <= high)) {
      char range[96];
      std::snprintf(range, sizeof(range), "%g to %g%s%s", low, high, *unit ? " " : "", unit);
      throw InputError("'" + words + "': the " + Spoken(name) + " of a drone is " + range);
    }
    if (field && std::abs(*field - value) > 1e-6 * value) Contradiction(name, words);
    field = value;
    request_.words[name] = words;
  }
  void Set(const char* name, std::optional<std::string>& field, const std::string& value,
           const std::string& words) {
    if (field && *field != value) Contradiction(name, words);
    field = value;
    request_.words[name] = words;
  }
  static std::string Spoken(std::string name) {
    for (char& c : name) c = c == '_' ? ' ' : c;
    return name;
  }
  [[noreturn]] void Contradiction(const char* name, const std::string& words) const {
    throw InputError("'" + words + "' contradicts '" + request_.words.at(name) + "': both say the " +
                     Spoken(name));
  }

  const Word* WordAt(size_t i) const {
    return i < tokens_.size() && tokens_[i].kind == Token::Kind::kWord ? tokens_[i].word : nullptr;
  }
  static bool EndsPhrase(const Token& token) {
    return token.kind == Token::Kind::kComma || token.text == "with" || token.text == "and" ||
           token.text == "for";
  }
  /// The noun that claims a quantity whose last token is `last`: first after it, then before `first`.
  const Word* Claimant(size_t first, size_t last) {
    for (size_t i = last + 1; i < tokens_.size() && !EndsPhrase(tokens_[i]); ++i) {
      const Word* word = WordAt(i);
      if (word == nullptr) break;
      if (IsNoun(word->kind) && !used_[i]) {
        used_[i] = true;
        return word;
      }
      if (word->kind != WordKind::kFiller) break;
    }
    for (size_t i = first; i-- > 0;) {
      const Word* word = WordAt(i);
      if (word == nullptr || EndsPhrase(tokens_[i])) break;
      if (IsNoun(word->kind)) return word;
      if (word->kind != WordKind::kFiller) break;
    }
    return nullptr;
  }
  static bool IsNoun(WordKind kind) { return kind >= WordKind::kPropeller && kind <= WordKind::kThrustRatio; }

  void ReadCode(size_t i) {
    const Token& token = tokens_[i];
    if (WordAt(i + 1) && WordAt(i + 1)->kind == WordKind::kLengthUnit) used_[i + 1] = true;
    Claimant(i, i);
    Set("propeller", request_.propeller, token.code[0] * 0.0254, token.text, 0.02, 1.6, "m");
    Set("pitch", request_.pitch, token.code[1] * 0.0254, token.text, 0.005, 1.0, "m");
    if (token.code[2] > 0) Set("blades", request_.blades, token.code[2], token.text, 2, 6, "");
  }

  void ReadQuantity(size_t i) {
    const double value = tokens_[i].value;
    const Word* unit = WordAt(i + 1);
    const WordKind kind = unit ? unit->kind : WordKind::kFiller;
    std::string words = tokens_[i].text;
    if (unit && kind != WordKind::kFiller) words += " " + tokens_[i + 1].text;
    const auto take = [&] { used_[i + 1] = true; };
    if (unit && unit->text == "h") {
      take();
      return Set("endurance", request_.endurance, value * 3600, words, 10, 36000, "s");
    }
    switch (kind) {
      case WordKind::kMassUnit: {
        take();
        const Word* noun = Claimant(i, i + 1);
        if (noun && noun->kind == WordKind::kPayload) {
          return Set("payload", request_.payload, value * unit->value, words, 0.001, 100, "kg");
        }
        if (noun && noun->kind == WordKind::kBattery) {
          throw InputError("'" + words + "': a battery is described by cells and capacity, as '4S 1500 mAh'");
        }
        return Set("mass", request_.mass, value * unit->value, words, 0.01, 150, "kg");
      }
      case WordKind::kLengthUnit:
        take();
        return ReadLength(value * unit->value, unit->value == 0.0254, words, Claimant(i, i + 1));
      case WordKind::kTimeUnit:
        take();
        Claimant(i, i + 1);
        return Set("endurance", request_.endurance, value * unit->value, words, 10, 36000, "s");
      case WordKind::kSpeedUnit:
        take();
        Claimant(i, i + 1);
        return Set("speed", request_.speed, value * unit->value, words, 0.5, 80, "m/s");
      case WordKind::kCapacityUnit:
        take();
        return Set("capacity_ah", request_.capacity_ah, value * unit->value, words, 0.03, 200, "Ah");
      case WordKind::kCells:
        take();
        return Set("cells", request_.cells, Whole(value, words), words, 1, 14, "");
      case WordKind::kBlades:
        take();
        return Set("blades", request_.blades, Whole(value, words), words, 2, 6, "");
      case WordKind::kRotorNoun:
      case WordKind::kPropeller:
        take();
        return SetRotors(value, words);
      default:
        break;
    }
    const Word* noun = Claimant(i, i);
    if (noun && noun->kind == WordKind::kThrustRatio) {
      SkipToOne(i);
      return Set("thrust_to_weight", request_.thrust_to_weight, value, "thrust to weight " + words, 1.05, 20,
                 "");
    }
    throw InputError("the number '" + tokens_[i].text +
                     "' has no unit that is understood; say for example '" + tokens_[i].text + " g', '" +
                     tokens_[i].text + " inch' or '" + tokens_[i].text + " rotors'");
  }

  /// "4 to 1": the rest of a ratio.
  void SkipToOne(size_t i) {
    if (i + 2 >= tokens_.size() || tokens_[i + 1].text != "to") return;
    if (tokens_[i + 2].kind == Token::Kind::kNumber && tokens_[i + 2].value == 1) used_[i + 2] = true;
  }

  void ReadLength(double metres, bool inches, const std::string& words, const Word* noun) {
    const WordKind kind = noun ? noun->kind : WordKind::kFiller;
    if (kind == WordKind::kPitch) return Set("pitch", request_.pitch, metres, words, 0.005, 1, "m");
    if (kind == WordKind::kPropeller || (inches && kind != WordKind::kArm && kind != WordKind::kWheelbase)) {
      return Set("propeller", request_.propeller, metres, words, 0.02, 1.6, "m");
    }
    const double arm = kind == WordKind::kArm ? metres : metres / 2;
    Set("arm", request_.arm, arm, words, 0.02, 2, "m");
  }

  void SetRotors(double value, const std::string& words) {
    if (value == 3)
      throw InputError("'" + words + "': three fixed rotors cannot hold a heading; say 4, 6 or 8");
    if (value != 4 && value != 6 && value != 8) {
      throw InputError("'" + words + "': a drone here has 4, 6 or 8 rotors");
    }
    Set("rotors", request_.rotors, value, words, 4, 8, "");
  }

  static double Whole(double value, const std::string& words) {
    if (value != std::floor(value)) throw InputError("'" + words + "' is not a whole number");
    return value;
  }

  void ReadLoneWord(size_t i) {
    const Word& word = *tokens_[i].word;
    const std::string& text = tokens_[i].text;
    const std::string meaning(word.meaning);
    switch (word.kind) {
      case WordKind::kClass:
        if (meaning == "brushless") {
          brushless_ = true;
          return;
        }
        return Set("drone_class", request_.drone_class, meaning, text);
      case WordKind::kSize:
        if (text == "heavy" && WordAt(i + 1) && WordAt(i + 1)->text == "lift") {
          used_[i + 1] = true;
          return Set("drone_class", request_.drone_class, "heavy_lift", "heavy lift");
        }
        return Set("size", request_.size, meaning, text);
      case WordKind::kRotors:
        return SetRotors(word.value, text);
      case WordKind::kLayout:
        return ReadLayout(meaning, text);
      case WordKind::kBlades:
        if (word.value > 0) Set("blades", request_.blades, word.value, text, 2, 6, "");
        return;
      case WordKind::kGuards:
        request_.guarded = true;
        request_.words["guarded"] = text;
        return;
      case WordKind::kMassUnit:
      case WordKind::kTimeUnit:
      case WordKind::kSpeedUnit:
      case WordKind::kCapacityUnit:
      case WordKind::kCells:
        throw InputError("'" + text + "' has no number before it");
      case WordKind::kLengthUnit:
        // "in" and "m" alone are words of speech or nothing; the others lack their number.
        if (text == "in") return;
        throw InputError("'" + text + "' has no number before it");
      default:
        return;
    }
  }

  void ReadLayout(const std::string& meaning, const std::string& text) {
    const RotorLayout layout = meaning == "plus"      ? RotorLayout::kPlus
                               : meaning == "h"       ? RotorLayout::kH
                               : meaning == "wide"    ? RotorLayout::kWideX
                               : meaning == "coaxial" ? RotorLayout::kCoaxial
                                                      : RotorLayout::kX;
    // "wide X" says X twice.
    if (request_.layout == RotorLayout::kWideX && layout == RotorLayout::kX) return;
    if (request_.layout && *request_.layout != layout) Contradiction("layout", text);
    request_.layout = layout;
    request_.words["layout"] = text;
  }

  std::vector<Token> tokens_;
  std::vector<bool> used_;
  DroneRequest request_;
  bool brushless_ = false;
};

}  // namespace

DroneRequest ParsePrompt(std::string_view prompt) { return Parser(prompt).Run(); }

std::string PromptHelp() {
  std::string help =
      "A description is one phrase of these parts, in any order:\n"
      "  mass           250 g, 1.2 kg, 3 lb\n"
      "  propellers     five-inch, 9 inch propellers, 47 mm props, 5x4.3x3 (diameter x pitch x blades in "
      "inches),\n"
      "                 3-blade\n"
      "  size           450 mm wheelbase, 12 cm arms\n"
      "  rotors         quad, hexacopter, octo, 6 rotors; layout X, plus, H, wide X, coaxial X8\n"
      "  flight         20 m/s, 80 km/h, 25 minutes, thrust to weight 4, 2 kg payload\n"
      "  battery        4S, 1500 mAh\n";
  const auto list = [&](const char* title, WordKind kind) {
    help += title;
    for (const Word& word : internal::Lexicon()) {
      if (word.kind == kind && !word.meaning.empty()) help += " " + std::string(word.text);
    }
    help += "\n";
  };
  list("  kinds         ", WordKind::kClass);
  list("  sizes         ", WordKind::kSize);
  return help;
}

}  // namespace airsim360
