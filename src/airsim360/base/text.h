// Small texts.
#pragma once

#include <charconv>
#include <string>
#include <string_view>

namespace airsim360 {

/// `text` without the characters of `blanks` at its ends.
inline std::string_view Trimmed(std::string_view text, std::string_view blanks = " \t\r") {
  const size_t first = text.find_first_not_of(blanks);
  return first == std::string_view::npos ? std::string_view() : text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

/// The shortest decimal text that reads back as exactly `value`.
inline std::string ShortestText(double value) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

/// In double quotes, with a backslash before each of its own double quotes and backslashes.
inline std::string InQuotes(std::string_view text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') quoted += '\\';
    quoted += c;
  }
  return quoted + "\"";
}

}  // namespace airsim360
