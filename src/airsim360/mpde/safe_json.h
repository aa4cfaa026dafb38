// JSON of strangers. For .cc files of mpde alone.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "airsim360/base/error.h"
#include "airsim360/base/json_depth.h"

namespace airsim360 {

/// The value of a text. InputError naming `where` for bad syntax and for more than 32 levels, found before the parser recurses.
inline nlohmann::json ParseBoundedJson(std::string_view text, const std::string& where) {
  constexpr int kDeepest = 32;
  if (JsonDepth(text) > kDeepest) throw InputError(where + ": nests deeper than " + std::to_string(kDeepest) + " levels");
  try {
    return nlohmann::json::parse(text);
  } catch (const nlohmann::json::parse_error& error) {
    throw InputError(where + ": is no JSON: byte " + std::to_string(error.byte));
  } catch (const nlohmann::json::exception&) {
    throw InputError(where + ": a number is too large");
  }
}

}  // namespace airsim360
