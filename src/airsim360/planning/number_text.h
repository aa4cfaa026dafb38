// Numbers as text that reads back exactly, for exports.
#pragma once

#include <charconv>
#include <cstdio>
#include <span>
#include <string>

namespace airsim360 {

/// Shortest decimal form that reads back as the same number.
inline void AppendNumber(std::string& out, double value) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value == 0 ? 0.0 : value).ptr;
  out.append(text, end);
}

/// Numbers with a separator between.
inline void AppendNumbers(std::string& out, std::span<const double> values, const char* separator) {
  for (size_t i = 0; i < values.size(); ++i) {
    if (i > 0) out += separator;
    AppendNumber(out, values[i]);
  }
}

}  // namespace airsim360
