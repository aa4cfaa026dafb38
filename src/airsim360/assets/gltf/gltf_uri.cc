#include "airsim360/assets/gltf/gltf_uri.h"

#include <array>
#include <charconv>

namespace airsim360::internal {
namespace {

// Value of a base64 digit; 64 for blanks, 255 for anything else.
constexpr std::array<uint8_t, 256> MakeDigits() {
  std::array<uint8_t, 256> digits{};
  for (auto& d : digits) d = 255;
  for (int i = 0; i < 26; ++i) {
    digits['A' + i] = static_cast<uint8_t>(i);
    digits['a' + i] = static_cast<uint8_t>(26 + i);
  }
  for (int i = 0; i < 10; ++i) digits['0' + i] = static_cast<uint8_t>(52 + i);
  digits['+'] = digits['-'] = 62;
  digits['/'] = digits['_'] = 63;
  digits[' '] = digits['\n'] = digits['\r'] = digits['\t'] = 64;
  return digits;
}

}  // namespace

std::optional<std::string> DecodePercent(std::string_view text) {
  std::string out;
  for (size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '%') {
      out += text[i];
      continue;
    }
    unsigned value = 0;
    const std::string_view hex = text.substr(i + 1, 2);
    const auto [end, error] = std::from_chars(hex.data(), hex.data() + hex.size(), value, 16);
    if (hex.size() != 2 || error != std::errc() || end != hex.data() + 2) return std::nullopt;
    out += static_cast<char>(value);
    i += 2;
  }
  return out;
}

std::optional<Bytes> DecodeBase64(std::string_view text) {
  static constexpr std::array<uint8_t, 256> kDigits = MakeDigits();
  while (!text.empty() && text.back() == '=') text.remove_suffix(1);
  Bytes out;
  out.reserve(text.size() / 4 * 3 + 3);
  uint32_t bits = 0;
  int held = 0;
  for (char c : text) {
    const uint8_t digit = kDigits[static_cast<unsigned char>(c)];
    if (digit == 64) continue;
    if (digit == 255) return std::nullopt;
    bits = (bits << 6) | digit;
    held += 6;
    if (held >= 8) {
      held -= 8;
      out.push_back(static_cast<std::byte>(bits >> held));
    }
  }
  return out;
}

bool IsDataUri(std::string_view uri) { return uri.substr(0, 5) == "data:"; }

std::optional<Bytes> DecodeDataUri(std::string_view uri) {
  const size_t comma = uri.find(',');
  if (!IsDataUri(uri) || comma == std::string_view::npos) return std::nullopt;
  const std::string_view data = uri.substr(comma + 1);
  const bool base64 = uri.substr(0, comma).ends_with(";base64");
  if (base64 && data.find('%') == std::string_view::npos) return DecodeBase64(data);
  // '+', '/' and '=' may be escaped in a URI.
  const std::optional<std::string> plain = DecodePercent(data);
  if (!plain) return std::nullopt;
  if (base64) return DecodeBase64(*plain);
  const auto bytes = AsBytes(*plain);
  return Bytes(bytes.begin(), bytes.end());
}

}  // namespace airsim360::internal
