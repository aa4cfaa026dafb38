// JSON of strangers. For .cc files of mpde alone.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "airsim360/base/error.h"

namespace airsim360 {

/// The value of a text. InputError naming `where` for bad syntax and for more than 32 levels, found before the parser recurses.
inline nlohmann::json ParseBoundedJson(std::string_view text, const std::string& where) {
  constexpr int kDeepest = 32;
  int depth = 0;
  bool quoted = false;
  for (size_t i = 0; i < text.size(); ++i) {
    if (quoted && text[i] == '\\') {
      ++i;
    } else if (text[i] == '"') {
      quoted = !quoted;
    } else if (!quoted && (text[i] == '[' || text[i] == '{')) {
      if (++depth > kDeepest) throw InputError(where + ": nests deeper than " + std::to_string(kDeepest) + " levels");
    } else if (!quoted && (text[i] == ']' || text[i] == '}')) {
      --depth;
    }
  }
  try {
    return nlohmann::json::parse(text);
  } catch (const nlohmann::json::parse_error& error) {
    throw InputError(where + ": is no JSON: byte " + std::to_string(error.byte));
  } catch (const nlohmann::json::exception&) {
    throw InputError(where + ": a number is too large");
  }
}

}  // namespace airsim360
