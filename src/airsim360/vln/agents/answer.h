// What an agent may answer, in one JSON object of a strict grammar. Texts come from models and programs: untrusted.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "airsim360/tasks/agent_server/agent_action.h"

namespace airsim360 {

/// How an agent decides.
enum class Decisions {
  kYomo,       ///< you only move once: turns, then one move, and the episode ends where it leads
  kDiscrete,   ///< steps of a fixed list until `stop`
  kWaypoints,  ///< polylines until it says stop
};
inline constexpr const char* kDecisionNames[] = {"yomo", "discrete", "waypoints"};

struct Answer {
  std::optional<AgentAction> action = {};  ///< none: stay
  bool stop = false;                       ///< after the action
};

/// Longest answer that is read, bytes; what is longer is a fault.
inline constexpr size_t kLongestAnswer = 65'536;
inline constexpr double kFarthestMove = 500;  ///< metres
inline constexpr size_t kMostWaypoints = 64;

/// yomo: {"azimuth_deg": -75, "elevation_deg": 5, "distance_m": 30}, distance 0 turns only; or {"stop": true}.
/// discrete: {"action": "forward"}, one of kPresetNames.
/// waypoints: {"waypoints": [[forward, left, up], …], "stop": true}, or {"turn_deg": 90}, positive to the right.
/// Each may hold "reason", a text. InputError naming the field for anything else: other fields, other kinds, numbers that are
/// none, texts around the object.
Answer ParseAnswer(std::string_view text, Decisions decisions);

/// An answer as a text of that grammar, or of the action's name where the grammar has none.
std::string AnswerText(const Answer& answer);

/// The grammar in words, for whoever answers.
std::string AnswerGrammar(Decisions decisions);

}  // namespace airsim360
