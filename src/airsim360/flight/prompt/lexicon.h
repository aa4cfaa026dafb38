// The words that descriptions may use, by meaning; words that are not here say nothing.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace airsim360::internal {

enum class WordKind {
  kFiller,      ///< says nothing: "a", "of", "about"
  kBreak,       ///< ends a phrase: "with", "and", "but"
  kTo,          ///< between the ends of a range
  kNumber,      ///< value; 100 and 1000 multiply what is before them
  kMultiplier,  ///< "hundred": value
  kHalf,        ///< "half", "quarter": value, of a unit
  // Units: value in SI, but Ah, Wh, rpm/V.
  kMassUnit,
  kLengthUnit,
  kDistanceUnit,  ///< km, miles: never of the drone itself
  kTimeUnit,
  kSpeedUnit,
  kCapacityUnit,
  kEnergyUnit,
  kVolumeUnit,  ///< value in litres
  kVoltUnit,
  kKvUnit,
  kCells,
  kPercent,
  kOtherUnit,  ///< of what is no figure of a drone: "megapixels", "dollars"
  // What is described.
  kDrone,    ///< "drone", "copter"
  kClass,    ///< meaning: name of a DroneClass
  kSize,     ///< meaning
  kRotors,   ///< "hexacopter": value
  kLayout,   ///< meaning: x, plus, h, wide, coaxial
  kCoaxial,  ///< "X8", "Y6": value rotors in coaxial pairs
  kGuards,   ///< ducts, cages
  kBrushless,
  kLithiumIon,
  // Nouns that claim the number beside them.
  kRotorNoun,
  kMotor,
  kPropeller,
  kBlades,  ///< "tri-blade": value
  kArm,
  kWheelbase,
  kAcross,  ///< "in diameter": of the propellers where they are spoken of, else of the drone
  kFrame,
  kSizeNoun,  ///< "class", "size": with a bare number a wheelbase in mm
  kPitch,
  kMass,     ///< "take-off weight", "weighs"
  kEmpty,    ///< "empty weight"
  kBare,     ///< "without battery"
  kPayload,  ///< "payload", "carries"
  kLoad,     ///< a thing that is carried: value in kg where it is known, meaning a class that it hints at
  kBattery,
  kHover,
  kFlight,
  kSpeed,
  kWind,  ///< a speed that is to be withstood or cruised at
  kThrustRatio,
  kThrust,  ///< "thrust", "pull"
  kThing,   ///< has lengths of its own, which are none of the drone's: "doorway", "GSD"
  kElse,    ///< its number is none of the drone's: "sensor", "altitude", "limit"
  // Comparing.
  kAtMost,   ///< "under": what follows is not reached
  kFactor,   ///< "twice": value
  kTimes,    ///< "times"
  kHeavier,  ///< meaning of a factor; value -1: "lighter"
  kBigger,
  kLonger,
  kFaster,
  kCorrection,  ///< "rather": what follows replaces what was said
  kNegation,
  // What does not fly as a multirotor.
  kNoMultirotor,  ///< "submarine"
  kVehicle,       ///< "boat": refused where no drone is spoken of
};

/// Whether a word of that kind is a unit.
constexpr bool IsUnitKind(WordKind kind) { return kind >= WordKind::kMassUnit && kind <= WordKind::kOtherUnit; }

/// An entry of the lexicon; `aliases` are divided by |. A space in an alias is any or no space or hyphen.
struct Word {
  WordKind kind;
  double value;
  std::string_view meaning;
  std::string_view aliases;
};

std::span<const Word> EnglishWords();
std::span<const Word> NounWords();
std::span<const Word> LoadWords();
std::span<const Word> ForeignWords();

/// The entry for a text without spaces and hyphens; of several written words (`joined`) only what is listed as
/// several. nullptr: unknown.
const Word* FindWord(std::string_view key, bool joined);

/// A listed word of at least six letters that `text` misspells (one letter wrong, missing, added or swapped; two
/// from nine letters on) and that matters; empty when there is none.
std::string_view Respelled(std::string_view text);

/// The name of a unit of at least five letters that `text`, written after a number, sounds like ("minits",
/// "kilograms" with one m too many); empty when there is none.
std::string_view UnitAsHeard(std::string_view text);

/// The head of a German compound, which is its last part: "Landwirtschaftsdrohne" is a "drohne"; nullptr: none.
const Word* FindCompound(std::string_view text);

}  // namespace airsim360::internal
