// The words that prompts may use, by meaning.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace airsim360::internal {

enum class WordKind {
  kFiller,        ///< says nothing: "a", "with", "drone"
  kNumber,        ///< "five": value
  kMassUnit,      ///< value in kg
  kLengthUnit,    ///< value in metres
  kTimeUnit,      ///< value in seconds
  kSpeedUnit,     ///< value in m/s
  kCapacityUnit,  ///< value in Ah
  kCells,         ///< "s", "cell"
  kClass,         ///< text: name of a DroneClass
  kSize,          ///< text
  kRotors,        ///< "hexacopter": value
  kRotorNoun,     ///< "rotors": a number before it counts them
  kLayout,        ///< text: x, plus, h, wide_x, coaxial
  kBlades,        ///< "blade": a number before it counts them; "tri-blade": value
  kPropeller,
  kArm,
  kWheelbase,
  kPayload,
  kBattery,
  kPitch,
  kEndurance,
  kSpeed,        ///< nouns that claim a number
  kThrustRatio,  ///< "twr"
  kGuards,
};

struct Word {
  std::string_view text;
  WordKind kind;
  double value = 0;
  std::string_view meaning = {};
};

std::span<const Word> Lexicon();
const Word* FindWord(std::string_view text);
/// Every word as text, for nearest-word messages.
const std::vector<std::string>& LexiconTexts();

}  // namespace airsim360::internal
