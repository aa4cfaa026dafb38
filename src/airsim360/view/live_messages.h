// What all live sources do with the messages of the page.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "airsim360/http/http_server.h"

namespace airsim360 {

struct MessageLimits {
  size_t bytes = 4096;
  int depth = 4;  ///< levels of nesting
};

/// What `act` makes of a message, a JSON object; `may_fly`: it holds the page's token. Never throws: what is wrong is answered
/// with {"error": …}.
SocketMessage AnswerMessage(std::string_view text, const MessageLimits& limits, const std::string& token,
                            const std::function<SocketMessage(const nlohmann::ordered_json& message, bool may_fly)>& act);

/// "input" of a message: forward, left, up, turn left, each in -1 … 1. InputError for anything else.
std::array<double, 4> SticksOf(const nlohmann::ordered_json& input);

}  // namespace airsim360
