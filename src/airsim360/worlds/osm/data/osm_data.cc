#include "airsim360/worlds/osm/data/osm_data.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>

namespace airsim360::internal {
namespace {

std::string_view Trim(std::string_view text) {
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.front()))) text.remove_prefix(1);
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back()))) text.remove_suffix(1);
  return text;
}

// A decimal number at the start of `text`, which loses it.
std::optional<double> TakeNumber(std::string_view& text) {
  text = Trim(text);
  size_t end = 0;
  while (end < text.size() && end < 24 &&
         (std::isdigit(static_cast<unsigned char>(text[end])) || text[end] == '.' || text[end] == ',' || (end == 0 && text[end] == '-')))
    ++end;
  std::string digits(text.substr(0, end));
  std::replace(digits.begin(), digits.end(), ',', '.');
  double value = 0;
  const auto [stop, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc() || stop != digits.data() + digits.size() || !std::isfinite(value)) return std::nullopt;
  text = Trim(text.substr(end));
  return value;
}

struct NamedColour {
  std::string_view name;
  uint32_t rgb;
};
constexpr NamedColour kNames[] = {
    {"black", 0x202020},    {"white", 0xf0f0f0},    {"gray", 0x808080},      {"grey", 0x808080},       {"silver", 0xc0c0c0},
    {"red", 0xa03028},      {"maroon", 0x802020},   {"brown", 0x7a4a30},     {"yellow", 0xe0c860},     {"olive", 0x808040},
    {"green", 0x4a7a50},    {"lime", 0x80c050},     {"darkgreen", 0x2a5030}, {"lightgreen", 0x90c890}, {"teal", 0x408080},
    {"aqua", 0x80c8c8},     {"cyan", 0x80c8c8},     {"blue", 0x4060a0},      {"navy", 0x203060},       {"lightblue", 0xa0c0d8},
    {"purple", 0x704880},   {"orange", 0xd08840},   {"beige", 0xe0d4b8},     {"cream", 0xf0e8d0},      {"tan", 0xc8b090},
    {"pink", 0xe0a8a8},     {"gold", 0xc8a040},     {"sand", 0xd8c498},      {"lightgray", 0xc8c8c8},  {"lightgrey", 0xc8c8c8},
    {"darkgray", 0x505050}, {"darkgrey", 0x505050}, {"darkred", 0x701c1c},   {"salmon", 0xe09080},     {"sandstone", 0xc8a878},
    {"brick", 0x9a5a44},
};

Vec3f Linear(uint32_t rgb) {
  const auto channel = [](uint32_t byte) {
    const float s = static_cast<float>(byte) / 255;
    const float linear = s <= 0.04045f ? s / 12.92f : std::pow((s + 0.055f) / 1.055f, 2.4f);
    return std::clamp(linear, 0.03f, 0.85f);
  };
  return {channel(rgb >> 16 & 255), channel(rgb >> 8 & 255), channel(rgb & 255)};
}

template <class T>
const T* FindById(const std::vector<T>& list, int64_t id) {
  const auto it = std::lower_bound(list.begin(), list.end(), id, [](const T& a, int64_t key) { return a.id < key; });
  return it != list.end() && it->id == id ? &*it : nullptr;
}

}  // namespace

std::string_view OsmTags::Get(std::string_view key) const {
  for (const auto& tag : list_)
    if (tag.first == key) return tag.second;
  return {};
}

bool OsmTags::Has(std::string_view key) const {
  const std::string_view value = Get(key);
  return !value.empty() && value != "no";
}

const OsmWay* OsmData::FindWay(int64_t id) const { return FindById(ways, id); }
const OsmNode* OsmData::FindNode(int64_t id) const { return FindById(nodes, id); }

bool IsOsmName(std::string_view name) {
  std::string lower;
  for (char c : name) lower += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return lower.ends_with(".osm") || lower.ends_with(".osm.gz") || lower.ends_with(".osm.bz2") || lower.ends_with(".pbf");
}

std::optional<double> ParseOsmLength(std::string_view text, double limit) {
  // "~20": about as much.
  text = Trim(text);
  if (text.starts_with('~')) text.remove_prefix(1);
  std::optional<double> value = TakeNumber(text);
  if (!value) return std::nullopt;
  if (text == "ft" || text == "feet" || text == "'") {
    *value *= 0.3048;
  } else if (!text.empty() && text.front() == '\'') {
    text.remove_prefix(1);
    const std::optional<double> inches = TakeNumber(text);
    if (!inches || (text != "\"" && text != "''")) return std::nullopt;
    *value = *value * 0.3048 + *inches * 0.0254;
  } else if (!text.empty() && text != "m" && text != "metres" && text != "meters" && text != "mtr") {
    return std::nullopt;
  }
  return *value > 0 && *value <= limit ? value : std::nullopt;
}

std::optional<double> ParseOsmNumber(std::string_view text, double low, double high) {
  const std::optional<double> value = TakeNumber(text);
  return value && text.empty() && *value >= low && *value <= high ? value : std::nullopt;
}

std::optional<Vec3f> ParseOsmColour(std::string_view text) {
  text = Trim(text);
  if (text.starts_with('#') && (text.size() == 7 || text.size() == 4)) {
    uint32_t rgb = 0;
    const auto [stop, error] = std::from_chars(text.data() + 1, text.data() + text.size(), rgb, 16);
    if (error != std::errc() || stop != text.data() + text.size()) return std::nullopt;
    if (text.size() == 4) rgb = (rgb >> 8 & 15) * 0x110000 | (rgb >> 4 & 15) * 0x1100 | (rgb & 15) * 0x11;
    return Linear(rgb);
  }
  std::string lower;
  for (char c : text.substr(0, 40))
    if (c != '_' && c != ' ' && c != '-') lower += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  for (const NamedColour& named : kNames)
    if (named.name == lower) return Linear(named.rgb);
  return std::nullopt;
}

}  // namespace airsim360::internal
