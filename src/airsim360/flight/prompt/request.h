// What words say about a drone, before anything is worked out.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace airsim360 {

enum class RotorLayout { kX, kPlus, kH, kWideX, kCoaxial };

/// Only what was said. `words` holds, for each field by its name, the words that said it.
struct DroneRequest {
  std::string prompt;
  std::optional<double> mass;       ///< kg, ready to fly, payload included
  std::optional<double> payload;    ///< kg
  std::optional<double> propeller;  ///< metres
  std::optional<double> pitch;      ///< metres
  std::optional<double> blades;
  std::optional<double> arm;  ///< metres, hub to centre
  std::optional<double> rotors;
  std::optional<double> thrust_to_weight;
  std::optional<double> endurance;  ///< seconds of hovering
  std::optional<double> speed;      ///< m/s, level
  std::optional<double> cells;
  std::optional<double> capacity_ah;
  std::optional<RotorLayout> layout;
  std::optional<std::string> drone_class;
  std::optional<std::string> size;  ///< "tiny", "small", "medium", "large", "huge"
  bool guarded = false;
  std::map<std::string, std::string> words;
};

/// Reads a description such as "a 250 g five-inch racing quad with a 4S battery". InputError naming the word
/// that is not understood and the nearest one that is, or the two parts that contradict each other. Prompts
/// of up to 1000 bytes.
DroneRequest ParsePrompt(std::string_view prompt);

/// What can be said, by kind, for help: one line each.
std::string PromptHelp();

}  // namespace airsim360
