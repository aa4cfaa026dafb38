// Inside ParsePrompt: tokens become fields of a request.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "airsim360/flight/prompt/request.h"
#include "airsim360/flight/prompt/tokens.h"

namespace airsim360::internal {

/// A number with its unit, somewhere in the sentence.
struct Quantity {
  size_t first = 0, last = 0;  ///< tokens
  double value = 0;            ///< SI, or Ah, Wh, litres, volts, cells, rpm/V
  const Word* unit = nullptr;
  std::string words;
};

/// A field that was said: its name in the request, and the range it may have in words and figures.
struct FieldRange {
  const char* name;
  double low, high;
  const char* unit;
};

inline constexpr size_t kMostMasses = 10;  // of more only two readings are compared

/// What a mass is of.
enum class MassRole { kWhole, kEmpty, kBare, kPayload, kThing, kBattery, kPart };

struct MassClaim {
  MassRole role = MassRole::kWhole;
  int cost = 0;  ///< the likelier the less
};

inline constexpr FieldRange kPropellerRange{"propeller", 0.02, 1.85, "m"};  // palm-sized toys to 72 inch lifters

class Reader {
 public:
  /// `roles`: what the masses are of that begin at these tokens; the grammar says it of the others.
  Reader(std::string_view prompt, std::vector<Token> tokens, std::map<size_t, MassRole> roles);
  /// Once.
  DroneRequest Run();
  /// All numbers with a unit of mass, by their tokens.
  std::vector<Quantity> Masses() const;
  /// Masses that were said and are no part of the balance.
  int unexplained() const { return unexplained_; }
  /// Whether it was refused for two figures of one thing.
  bool contradicted() const { return contradicted_; }
  /// Whether it was refused for parts that are more than their whole.
  bool heavy_parts() const { return heavy_parts_; }
  std::vector<MassClaim> ClaimsOf(const Quantity& q, bool alone = false) const;
  size_t MassBefore(const Quantity& q) const;

 private:
  using Field = std::optional<double>;

  // reader_others.cc
  void RefuseOthers() const;
  bool IsPurpose(size_t i) const;
  bool IsHead(size_t i) const;
  void ReadNothing();

  // reader.cc
  void ReadToken(size_t i);
  void ReadWord(size_t i);
  void ReadSign(size_t i);
  void ReadClass(const std::string& name, const std::string& words);
  void ReadLoad(size_t i);
  void SetLayout(const std::string& meaning, const std::string& text);
  void Finish();
  void FinishMasses();
  void FinishLoads();
  void ListUnused();

  // reader_counts.cc
  void ReadRotorsWord(size_t i);
  void ReadRotorCount(size_t i, size_t noun);
  void SetRotors(double value, const std::string& words);
  void SetArms(double value, const std::string& words);
  bool IsSpare(size_t i, size_t noun) const;
  bool IsPairOnArm(size_t i, size_t noun) const;
  bool ReadCount(size_t i);
  [[noreturn]] void RefuseRotors() const;
  void FinishRotors();

  // reader_laws.cc
  bool IsMotorName(size_t i) const;
  bool ReadPower(const Quantity& q);
  bool ReadAxes(const Quantity& q);
  bool IsOfBattery(const Quantity& q) const;
  void RefuseFreeEnergy() const;
  void RefuseNoEnergy() const;
  void CheckPower() const;
  void CheckVoltage() const;
  void CheckTips() const;
  bool ReadTurns(const Quantity& q);
  void CheckLoadOfModel() const;

  // reader_distances.cc
  bool HasNear(const Quantity& q, bool (*is_word)(const std::string&)) const;
  bool ReadDistance(const Quantity& q);
  double PacksInParallel(const Quantity& q) const;
  double PacksOf(const Quantity& q) const;
  double CellsInParallel(const Quantity& q) const;
  bool IsOfCalendar(const Quantity& q) const;
  void ReadDays(const Quantity& q);

  // reader_thrust.cc
  bool ReadThrust(const Quantity& q);
  bool ReadThrustOfWeight(size_t i, size_t last, double factor);
  void FinishThrust();

  // reader_fields.cc
  void Set(const FieldRange& range, Field& field, double value, const std::string& words);
  /// Of two figures for one field the one whose words say it plainly; true: this one is left out for the other.
  bool GivesWay(const char* name, Field& field, double value, int plainness, const std::string& words);
  void CorrectWith(const char* name, Field& field, size_t i);
  void SumUp(const char* name, Field& field, const Quantity& q);
  [[noreturn]] void Contradiction(const char* name, const std::string& words);
  void Decide(const std::string& sentence);
  const Word* WordAt(size_t i) const;
  bool Is(size_t i, WordKind kind) const { return i < tokens_.size() && tokens_[i].Is(kind); }
  bool EndsPhrase(size_t i) const;
  bool SaysLittle(size_t i) const;
  /// The token that names what a quantity is of, after it and before it in its phrase; nothing: npos.
  size_t NounAfter(const Quantity& q) const;
  size_t LabelInParentheses(size_t open) const;
  size_t VolumeBefore(const Quantity& q) const;
  size_t NounBefore(const Quantity& q, bool adjacent) const;
  /// For a quantity in parentheses the noun before them, else kNone.
  size_t Apposed(const Quantity& q) const;
  /// The same in other units, in parentheses: "5 lb (2.27 kg)".
  bool IsRestated(const Quantity& q) const;
  bool IsTakenBack(const Quantity& q) const;
  /// The noun of the propellers, drone or load that "in diameter" is said of; kNone: the drone.
  size_t OwnerOfDiameter(const Quantity& q) const;
  bool PhraseHas(const Quantity& q, WordKind kind) const;
  bool Claims(size_t i) const;
  void Use(size_t i);
  bool IsAtMost(const Quantity& q) const;

  // reader_claims.cc
  std::vector<MassClaim> ClaimsAfter(const Quantity& q) const;
  void AddClaimsBefore(const Quantity& q, std::vector<MassClaim>& claims) const;
  std::optional<MassRole> RoleOf(size_t k) const;
  bool IsIncludedBefore(size_t k) const;
  bool EndsLabel(size_t k) const;
  void ReadMassAs(MassRole role, const Quantity& q);

  // reader_masses.cc
  void ReadMass(const Quantity& q);
  size_t NounOfMass(const Quantity& q) const;
  void SetMassOf(size_t noun, const Quantity& q);
  void SetOwnMass(size_t noun, const Quantity& q);
  size_t WeighedThing(const Quantity& q, size_t noun) const;
  bool IsOfLoad(const Quantity& q) const;
  bool IsHung(const Quantity& q) const;
  bool IsLoaded(const Quantity& q) const;
  bool IsWithThings(const Quantity& q) const;
  void SetLoadedMass(const Quantity& q);
  void FinishLoadedMass();
  size_t WholeBefore(const Quantity& q) const;
  bool IsWhole(size_t noun) const;
  void SumUpMass(const Quantity& q);
  bool IsNamedBeside(const Quantity& q, size_t noun) const;
  bool NamesThingAfter(const Quantity& q) const;
  bool IsIncluded(const Quantity& q) const;
  bool IsLeftOut(size_t i) const;
  bool IsAllWithBattery(size_t noun, const Quantity& q) const;
  bool IsWithBattery(const Quantity& q) const;
  void FinishBareMass();
  void FinishOwnMass();
  bool IsSumOf(double whole, double own) const;

  // reader_sums.cc
  void SumUpParts();
  double CountOfParts(const Quantity& q) const;
  bool IsAddedTo(const Quantity& q) const;
  bool IsWithoutLoad(size_t noun) const;
  bool IsSumAfter(size_t k) const;
  bool IsRepeatedLoad(const Quantity& q) const;
  bool IsBalance(const Quantity& q) const;
  bool IsBrought(const Quantity& q) const;
  bool IsTaken(const Quantity& q) const;
  bool IsOnTop(const Quantity& q) const;
  void FinishOnTop();
  void DropCorrected(const Quantity& q);
  size_t BareInParentheses(const Quantity& q) const;
  void RefuseHeavyParts();

  // reader_things.cc
  bool IsDroneWord(size_t i) const;
  bool IsThing(size_t i) const;
  bool IsNamedThing(size_t i) const;
  bool FollowsCarryVerb(size_t i) const;
  size_t FirstOf(const Quantity& q) const;
  bool IsShare(const Quantity& q) const;
  bool IsPart(size_t i) const;
  bool SpeaksOfDrone(size_t from, size_t to) const;
  size_t CarryVerbBefore(size_t i) const;
  bool IsIntroduced(size_t i) const;
  bool IsObject(size_t i, bool weak) const;
  bool IsSubject(size_t i) const;
  bool HasItsMass(size_t i) const;
  bool IsFitted(size_t i) const;
  bool IsOfThingAfter(const Quantity& q) const;
  bool IsOfWeighedThing(const Quantity& q) const;
  bool IsApposedToThing(const Quantity& q) const;
  bool IsForThing(size_t end) const;
  bool IsOfThingBefore(const Quantity& q) const;
  bool IsBeforeFinalVerb(const Quantity& q) const;
  bool Hangs(const Quantity& q) const;
  bool IsOfThing(const Quantity& q, size_t noun) const;
  bool ContinuesList(const Quantity& q) const;
  void SetThing(const Quantity& q);

  // reader_quantities.cc
  bool ReadQuantity(size_t i);
  void ReadLength(const Quantity& q);
  bool IsOfPlace(const Quantity& q) const;
  void SetArmLength(const Quantity& q, WordKind kind, size_t noun, size_t head);
  int PlainnessOf(const Quantity& q, size_t head) const;
  bool IsTopSpeed(const Quantity& q) const;
  bool IsMinutes(const Quantity& q) const;
  bool IsFromCentre(const Quantity& q) const;
  bool IsInchUnit(size_t i, size_t unit) const;
  bool IsOfEmptyDrone(const Quantity& q) const;
  bool IsLabelledHover(const Quantity& q) const;
  void FinishLengths();
  void FinishTimes();
  void ReadTime(const Quantity& q);
  void ReadSpeed(const Quantity& q);
  void ReadVolume(const Quantity& q);
  void ReadVoltage(const Quantity& q);
  void ReadCapacity(const Quantity& q);
  double PacksInSeries(size_t i) const;
  bool ReadWeight(const Quantity& q);
  void Dispatch(const Quantity& q);
  void Extend(Quantity& q);
  void ReadCode(size_t i);
  void ReadBareNumber(size_t i);
  bool ReadPartNumber(size_t i);
  bool ReadMotorCode(size_t i);
  void ReadCells(const Quantity& q);
  bool ReadPlural(size_t i, size_t unit);
  bool ReadInchesAsPlural(size_t i, size_t unit);
  const Word* Comparative(size_t k) const;
  bool ReadComparison(size_t i, double factor, size_t last);
  bool ReadFactor(size_t i);
  bool ReadDifference(const Quantity& q);
  bool ReadLabelled(size_t i);
  bool ReadLabelledPart(size_t i);
  bool ReadBareMass(size_t i);
  bool ReadCharge(size_t i);
  void NameElse(const Quantity& q, size_t noun);
  /// The token of `kind` among the words just before or after a bare number, else kNone.
  size_t Beside(size_t i, WordKind kind, bool after) const;

  static constexpr size_t kNone = static_cast<size_t>(-1);

  std::vector<Token> tokens_;
  std::map<size_t, MassRole> roles_;
  int unexplained_ = 0;
  bool heavy_parts_ = false, contradicted_ = false;
  bool on_top_ = false;        ///< what is carried is not in the mass of the drone
  std::vector<bool> used_;     ///< tokens that said something
  std::vector<bool> claimed_;  ///< nouns that have their number
  DroneRequest request_;
  const KnownModel* model_ = nullptr;
  struct Loose {
    Quantity quantity;
    bool thing = false;   ///< "a 300 g sandwich"
    bool part = false;    ///< "a 300 g frame"
    bool loaded = false;  ///< "3 kg with camera"
    double count = 1;     ///< parts that have it each
  };
  void PlaceLoose(const Loose& loose);
  std::vector<Loose> loose_masses_;
  std::vector<Quantity> volts_;          ///< of the battery
  std::optional<Quantity> power_;        ///< of hovering, in watts
  std::vector<Quantity> loose_lengths_;  ///< that may be of something else
  std::optional<Quantity> across_;       ///< of the whole drone: gives way to the distance of its motors
  std::optional<Quantity> empty_time_;   ///< of flying without load
  std::optional<Quantity> turns_;        ///< of its propellers, rpm
  const Token* spanning_ = nullptr;      ///< the number that is being read
  /// A number of rotors that no drone here has, and its words.
  std::optional<std::pair<double, std::string>> bad_rotors_;
  bool whole_said_ = false;     ///< the mass is that of take-off
  bool whole_of_mass_ = false;  ///< the same, of request_.mass as it stands
  Quantity mass_quantity_;      ///< that request_.mass was read from
  bool things_said_ = false;    ///< the payload is the sum of things
  size_t last_thing_ = kNone;   ///< token that ends the mass of the last of them
  size_t rotor_words_ = 0;      ///< "quad", "Y6"
  bool coaxial_said_ = false;
  bool liquid_said_ = false;  ///< litres of something
  struct Thrust {
    double kilograms = 0;
    bool each = false, whole = false;  ///< of one motor, of all together; neither: not said
    std::string words;
  };
  std::map<std::string, int> plainness_;  ///< of the fields, as GivesWay has it
  std::optional<Thrust> thrust_;
  std::optional<double> arm_count_, liquid_, known_load_;
  std::string liquid_words_, known_load_words_;
  std::string hinted_class_, hinted_words_;  ///< a kind that things carried hint at
  bool anything_ = false;
};

/// The reading of a description that explains most of its masses; InputError where there is none.
DroneRequest ReadPrompt(std::string_view prompt);

}  // namespace airsim360::internal
