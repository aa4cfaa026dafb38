// Texts from elsewhere in messages of ours.
#pragma once

#include <cstdio>
#include <string>
#include <string_view>

namespace airsim360 {

namespace internal {
/// Bytes of the character of UTF-8 that `text` begins with; 0 if it begins with none (RFC 3629).
inline size_t Utf8Length(std::string_view text) {
  const auto byte = [&](size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u; };
  const unsigned first = byte(0);
  if (first < 0x80) return text.empty() ? 0 : 1;
  const size_t length = first >= 0xC2 && first < 0xE0 ? 2 : first >= 0xE0 && first < 0xF0 ? 3 : first >= 0xF0 && first < 0xF5 ? 4 : 0;
  for (size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xC0) != 0x80) return 0;
  }
  // Too long for what they say, halves of pairs, beyond the last character.
  const unsigned second = byte(1);
  if ((first == 0xE0 && second < 0xA0) || (first == 0xED && second > 0x9F) || (first == 0xF0 && second < 0x90) ||
      (first == 0xF4 && second > 0x8F))
    return 0;
  return length;
}
}  // namespace internal

/// `text` with U+FFFD for each byte that is no UTF-8.
inline std::string ValidUtf8(std::string_view text) {
  std::string valid;
  while (!text.empty()) {
    const size_t length = internal::Utf8Length(text);
    length > 0 ? valid.append(text.substr(0, length)) : valid.append("\xEF\xBF\xBD");
    text.remove_prefix(length > 0 ? length : 1);
  }
  return valid;
}

/// The same with "\x00" and the like for control characters: a message goes on after them, and stays on its line.
inline std::string Printable(std::string_view text) {
  std::string shown;
  for (const char c : ValidUtf8(text)) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte >= 0x20 && byte != 0x7F) {
      shown += c;
      continue;
    }
    char code[8];
    std::snprintf(code, sizeof code, "\\x%02x", byte);
    shown += code;
  }
  return shown;
}

}  // namespace airsim360
