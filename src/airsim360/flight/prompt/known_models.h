// Real multirotors by the figures that their makers publish: what "a Mavic 3" or "like an F450" stands for.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "airsim360/flight/prompt/request.h"

namespace airsim360::internal {

/// Published figures, 0 where none is known. What they leave open the laws fill in.
struct KnownModel {
  std::string_view aliases;  ///< divided by |; spaces as in Word
  std::string_view title;
  std::string_view drone_class;
  int rotors;
  RotorLayout layout;
  double mass;       ///< kg, ready to fly; without payload unless the source says otherwise
  double diagonal;   ///< mm, motor to motor
  double propeller;  ///< inches
  double pitch;      ///< inches
  int cells;
  double capacity;  ///< Ah
  double energy;    ///< Wh
  double flight;    ///< minutes
  double hover;     ///< minutes
  double speed;     ///< m/s
  std::string_view source;
};

std::span<const KnownModel> DjiModels();
std::span<const KnownModel> OtherModels();
std::span<const KnownModel> BuilderModels();

/// The model for a text without spaces and hyphens, else nullptr.
const KnownModel* FindKnownModel(std::string_view key);

/// "0.895 kg, 4 rotors, 380 mm, 9.4 inch, ...": the facts in words.
std::string ModelFacts(const KnownModel& model);

/// Fills what was not said from the model's facts, and names those fields in request.facts.
void ApplyModel(const KnownModel& model, DroneRequest& request);

}  // namespace airsim360::internal
