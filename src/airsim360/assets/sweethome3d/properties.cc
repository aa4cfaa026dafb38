#include "airsim360/assets/sweethome3d/properties.h"

#include <algorithm>
#include <charconv>

#include "airsim360/assets/text_lines.h"

namespace airsim360::internal {
namespace {

void AppendUtf8(std::string& out, uint32_t code) {
  if (code < 0x80) {
    out += static_cast<char>(code);
  } else if (code < 0x800) {
    out += {static_cast<char>(0xc0 | (code >> 6)), static_cast<char>(0x80 | (code & 0x3f))};
  } else if (code < 0x10000) {
    out +=
        {static_cast<char>(0xe0 | (code >> 12)), static_cast<char>(0x80 | ((code >> 6) & 0x3f)), static_cast<char>(0x80 | (code & 0x3f))};
  } else {
    out += {static_cast<char>(0xf0 | (code >> 18)), static_cast<char>(0x80 | ((code >> 12) & 0x3f)),
            static_cast<char>(0x80 | ((code >> 6) & 0x3f)), static_cast<char>(0x80 | (code & 0x3f))};
  }
}

// Four hexadecimal digits after "\u".
uint32_t ParseUnit(std::string_view digits, const TextLines& lines) {
  uint32_t unit = 0;
  const std::string_view four = digits.substr(0, 4);
  const auto [end, error] = std::from_chars(four.data(), four.data() + four.size(), unit, 16);
  if (four.size() < 4 || error != std::errc() || end != four.data() + 4) {
    lines.Fail("\\u needs four hexadecimal digits");
  }
  return unit;
}

// ISO-8859-1 with escapes to UTF-8; UTF-16 surrogate pairs are joined, lone ones become U+FFFD.
std::string Decode(std::string_view raw, const TextLines& lines) {
  std::string out;
  uint32_t high = 0;
  for (size_t i = 0; i < raw.size(); ++i) {
    uint32_t code = static_cast<unsigned char>(raw[i]);
    if (raw[i] == '\\' && i + 1 < raw.size()) {
      const char escape = raw[++i];
      code = static_cast<unsigned char>(escape == 't' ? '\t' : escape == 'n' ? '\n' : escape == 'r' ? '\r' : escape);
      if (escape == 'u') {
        code = ParseUnit(raw.substr(i + 1), lines);
        i += 4;
      }
    }
    if (high != 0 && code >= 0xdc00 && code < 0xe000) {
      AppendUtf8(out, 0x10000 + ((high - 0xd800) << 10) + (code - 0xdc00));
      high = 0;
      continue;
    }
    if (high != 0) AppendUtf8(out, 0xfffd);
    high = code >= 0xd800 && code < 0xdc00 ? code : 0;
    if (high == 0) AppendUtf8(out, code >= 0xdc00 && code < 0xe000 ? 0xfffd : code);
  }
  if (high != 0) AppendUtf8(out, 0xfffd);
  return out;
}

// Where the key ends: the first '=', ':' or blank that is not escaped.
size_t KeyLength(std::string_view line) {
  for (size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '\\')
      ++i;
    else if (line[i] == '=' || line[i] == ':' || line[i] == ' ' || line[i] == '\t')
      return i;
  }
  return line.size();
}

}  // namespace

std::map<std::string, std::string> ParseProperties(const std::string& file, std::string_view text) {
  std::map<std::string, std::string> properties;
  TextLines lines(file, text, true);
  std::string_view line;
  while (lines.Next(line)) {
    if (line.empty() || line.front() == '#' || line.front() == '!') continue;
    const size_t length = KeyLength(line);
    std::string_view value = Trimmed(line.substr(length));
    if (value.starts_with('=') || value.starts_with(':')) value = Trimmed(value.substr(1));
    properties[Decode(line.substr(0, length), lines)] = Decode(value, lines);
  }
  return properties;
}

}  // namespace airsim360::internal
