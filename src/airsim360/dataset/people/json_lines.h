// Walking through JSON lines of this program.
#pragma once

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>

namespace airsim360 {

/// Calls body(line) for every line of the text.
template <class Body>
void ForEachLine(const std::string& text, const Body& body) {
  for (size_t begin = 0; begin < text.size();) {
    const size_t end = std::min(text.find('\n', begin), text.size());
    body(nlohmann::ordered_json::parse(text.begin() + static_cast<ptrdiff_t>(begin), text.begin() + static_cast<ptrdiff_t>(end)));
    begin = end + 1;
  }
}

}  // namespace airsim360
