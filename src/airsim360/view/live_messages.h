// What all live sources do with the messages of the page. Json: that of who calls, nlohmann's, which public headers leave out.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <exception>
#include <string>
#include <string_view>

#include "airsim360/base/error.h"
#include "airsim360/base/json_depth.h"
#include "airsim360/http/http_server.h"

namespace airsim360 {

/// What a stick pushed all the way, or a key, asks of a drone.
inline constexpr double kStickSpeed = 15, kStickTurnRate = 1.5;  ///< m/s, rad/s
/// Ends of the scale that colours of ranges follow, metres.
inline constexpr double kNearestColor = 0.5, kFarthestColor = 200;

struct MessageLimits {
  size_t bytes = 4096;
  int depth = 4;  ///< levels of nesting
};

/// What `act(message, may_fly)` makes of a message, a JSON object; may_fly: it holds the page's token. Never throws: what is
/// wrong is answered with {"error": …}.
template <class Json, class Act>
SocketMessage AnswerMessage(std::string_view text, const MessageLimits& limits, const std::string& token, const Act& act) {
  const auto problem = [](const std::string& what) {
    return SocketMessage{Json{{"error", what}}.dump(-1, ' ', false, Json::error_handler_t::replace)};
  };
  if (text.size() > limits.bytes) return problem("a message has at most " + std::to_string(limits.bytes) + " bytes");
  const Json message = JsonDepth(text) > limits.depth ? Json() : Json::parse(text, nullptr, false);
  if (!message.is_object()) return problem("a message is a JSON object");
  try {
    return act(message, message.contains("token") && message["token"] == token);
  } catch (const std::exception& error) {
    return problem(error.what());
  }
}

/// "input" of a message: forward, left, up, turn left, each in -1 … 1. InputError for anything else.
template <class Json>
std::array<double, 4> SticksOf(const Json& input) {
  if (!input.is_array() || input.size() != 4) throw InputError("input: four numbers in -1 ... 1: forward, left, up, turn left");
  std::array<double, 4> sticks{};
  for (size_t i = 0; i < sticks.size(); ++i) {
    sticks[i] = input[i].is_number() ? input[i].template get<double>() : std::nan("");
    if (!(std::abs(sticks[i]) <= 1)) throw InputError("input: " + input[i].dump() + " is not in -1 ... 1");
  }
  return sticks;
}

}  // namespace airsim360
