#include "airsim360/flight/prompt/plain_text.h"

#include <algorithm>
#include <cstdint>

namespace airsim360::internal {
namespace {

struct Decoded {
  uint32_t code = 0;
  size_t length = 0;  ///< 0: the bytes are no UTF-8
};

Decoded Decode(std::string_view text) {
  const auto byte = [&](size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char first = byte(0);
  const size_t length = first < 0x80 ? 1 : first < 0xc2 ? 0 : first < 0xe0 ? 2 : first < 0xf0 ? 3 : first < 0xf5 ? 4 : 0;
  if (length == 0 || length > text.size()) return {};
  if (length == 1) return {first, 1};
  uint32_t code = first & (0x7fu >> length);
  for (size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xc0) != 0x80) return {};
    code = code << 6 | (byte(i) & 0x3f);
  }
  const bool shortest = code >= (length == 2 ? 0x80u : length == 3 ? 0x800u : 0x10000u);
  if (!shortest || code > 0x10ffff || (code >= 0xd800 && code < 0xe000)) return {};
  return {code, length};
}

struct Sign {
  uint32_t code;
  const char* plain;
};
constexpr Sign kSigns[] = {
    {0xb5, "u"},   {0x3bc, "u"},  {0xd7, "x"},       {0xbd, ".5"},      {0xbc, ".25"},  {0xbe, ".75"},  {0xdf, "ss"},
    {0xe6, "ae"},  {0xc6, "ae"},  {0x153, "oe"},     {0x2032, "'"},     {0x2033, "\""}, {0x201c, "\""}, {0x201d, "\""},
    {0x2018, "'"}, {0x2019, "'"}, {0x2010, "-"},     {0x2011, "-"},     {0x2012, "-"},  {0x2013, "-"},  {0x2014, " - "},
    {0x2212, "-"}, {0x2248, " "}, {0x2264, " max "}, {0x2265, " min "}, {0x3001, ","},  {0x3002, ". "}, {0x2026, "..."},
    {0x3000, " "}, {0xb1, "+-"},  {0x2a09, "x"},     {0x2715, "x"},     {0x2716, "x"},  {0x300c, " "},  {0x300d, " "},
};

/// Latin letters of U+00C0 to U+017F without their accents, in order.
constexpr std::string_view kLatin =
    "aaaaaaaceeeeiiiidnooooo ouuuuytsaaaaaaaceeeeiiiidnooooo ouuuuyty"
    "aaaaaaccccccccddddeeeeeeeeeegggggggghhhhiiiiiiiiiiiijjkkklllllll"
    "lllnnnnnnnnnoooooooorrrrrrssssssssttttttuuuuuuuuuuuuwwyyyzzzzzzs";

std::string Folded(uint32_t code) {
  if (code >= 0xff01 && code <= 0xff5e) code -= 0xfee0;  // fullwidth
  for (const Sign& sign : kSigns) {
    if (sign.code == code) return sign.plain;
  }
  if (code >= 'A' && code <= 'Z') return std::string(1, static_cast<char>(code - 'A' + 'a'));
  if (code == '\n') return ", ";
  if (code < 0x80) return std::string(1, code < 0x20 || code == 0x7f ? ' ' : static_cast<char>(code));
  if (code >= 0xc0 && code < 0xc0 + kLatin.size()) return std::string(1, kLatin[code - 0xc0]);
  return {};
}

}  // namespace

size_t CharacterLength(std::string_view text) {
  const size_t length = Decode(text).length;
  return length == 0 ? 1 : length;
}

std::string PrintableText(std::string_view bytes) {
  std::string text;
  for (size_t at = 0; at < bytes.size();) {
    const auto [code, length] = Decode(bytes.substr(at));
    const bool control = code < 0x20 || (code >= 0x7f && code < 0xa0) || (code >= 0x2000 && code < 0x2010) ||
                         (code >= 0x2028 && code < 0x2030) || (code >= 0xfe00 && code < 0xff01) || (code >= 0xff5f && code < 0x10000) ||
                         (code >= 0xe000 && code < 0xf900);
    if (length == 0 || control) {
      text += ' ';
    } else {
      text += bytes.substr(at, length);
    }
    at += std::max<size_t>(length, 1);
  }
  return text;
}

std::string PlainText(std::string_view bytes) {
  std::string text;
  for (size_t at = 0; at < bytes.size();) {
    const Decoded character = Decode(bytes.substr(at));
    if (character.length == 0) {
      text += ' ';
      ++at;
      continue;
    }
    const std::string plain = Folded(character.code);
    const bool accent = character.code >= 0x300 && character.code < 0x370;  // of the letter before
    // Letters of other scripts stay; signs and pictures say nothing.
    const bool writing = character.code >= 0x370 && character.code < 0x2000;
    const bool east_asian = character.code >= 0x3040 && character.code < 0xfb00;
    if (!plain.empty()) {
      text += plain;
    } else if (writing || east_asian || accent) {
      if (!accent) text += bytes.substr(at, character.length);
    } else {
      text += ' ';
    }
    at += character.length;
  }
  return text;
}

}  // namespace airsim360::internal
