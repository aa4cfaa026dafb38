// What words say about a drone, before anything is worked out.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace airsim360 {

enum class RotorLayout { kX, kPlus, kH, kWideX, kCoaxial };

/// Only what was said, or is known of the real drone that was named. `words` holds, for each field by its name,
/// the words that said it; `facts` names the fields that stand in for a real drone: they give way where they do
/// not go with what was said.
struct DroneRequest {
  std::string prompt;
  std::optional<double> mass;          ///< kg, ready to fly, payload included
  std::optional<double> empty_mass;    ///< kg, ready to fly without payload
  std::optional<double> bare_mass;     ///< kg, without battery and payload
  std::optional<double> payload;       ///< kg
  std::optional<double> battery_mass;  ///< kg
  std::optional<double> propeller;     ///< metres
  std::optional<double> pitch;         ///< metres
  std::optional<double> blades;
  std::optional<double> arm;  ///< metres, hub to centre
  std::optional<double> rotors;
  std::optional<double> thrust_to_weight;
  std::optional<double> hover_time;   ///< seconds of hovering
  std::optional<double> flight_time;  ///< seconds at the speed of least power
  std::optional<double> speed;        ///< m/s, level
  std::optional<double> least_speed;  ///< m/s that level flight reaches at least: of a wind, of cruising
  std::optional<double> altitude;     ///< metres above the sea that it flies at
  std::optional<double> range;        ///< metres that it flies on one charge
  std::optional<double> cells;
  std::optional<double> capacity_ah;
  std::optional<double> energy_wh;
  std::optional<double> motor_kv;  ///< rpm per volt
  std::optional<RotorLayout> layout;
  std::optional<std::string> drone_class;
  std::optional<std::string> size;  ///< "tiny", "small", "medium", "large", "huge"
  bool guarded = false;
  bool brushless = false;
  bool lithium_ion = false;
  std::map<std::string, std::string> words;
  std::set<std::string> facts;
  std::map<std::string, std::pair<double, double>> ranges;  ///< of fields said as a range, whose middle they hold
  std::vector<std::string> unused;                          ///< words that say nothing of a drone's figures
  std::vector<std::string> decided;                         ///< what was chosen for the user, one sentence each
};

/// Reads a description such as "a 250 g five-inch racing quad" or "like a Mavic 3 but twice as heavy". A word
/// that carries no figure is listed in `unused`. InputError for figures out of range, figures that contradict
/// each other, and for what is not a multirotor. Prompts of up to 1000 bytes, any bytes.
DroneRequest ParsePrompt(std::string_view prompt);

/// Whether these words, and nothing besides, name a real drone whose figures are known: "iris", "Mavic 3".
bool NamesRealDrone(std::string_view words);

/// What can be said, by kind, for help: one line each.
std::string PromptHelp();

}  // namespace airsim360
