#include "airsim360/assets/obj/mtl.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "airsim360/assets/text_lines.h"

namespace airsim360::internal {
namespace {

Vec3f ParseColor(std::string_view rest, const TextLines& lines) {
  // "spectral" and "xyz" colours are not RGB: keep grey.
  std::string_view word = NextWord(rest);
  if (word == "spectral" || word == "xyz") return {0.5f, 0.5f, 0.5f};
  Vec3f color;
  color.x = ParseFloat(word, lines);
  word = NextWord(rest);
  color.y = word.empty() ? color.x : ParseFloat(word, lines);
  word = NextWord(rest);
  color.z = word.empty() ? color.x : ParseFloat(word, lines);
  return Max(color, Vec3f{});
}

// File name of a map statement: options ("-bm 0.5", "-s 1 1 1") come first, the name may have blanks.
std::string ParseMap(std::string_view rest, const TextLines& lines, float* bump_scale) {
  static const std::map<std::string_view, int> kOptions = {{"-blendu", 1},  {"-blendv", 1}, {"-boost", 1},  {"-mm", 2},    {"-o", 3},
                                                           {"-s", 3},       {"-t", 3},      {"-texres", 1}, {"-clamp", 1}, {"-bm", 1},
                                                           {"-imfchan", 1}, {"-type", 1},   {"-cc", 1}};
  while (rest.starts_with('-')) {
    std::string_view after = rest;
    const auto option = kOptions.find(NextWord(after));
    if (option == kOptions.end()) break;
    const bool vector = option->second == 3;
    for (int i = 0; i < option->second; ++i) {
      // -o, -s and -t take one to three numbers.
      std::string_view peek = after;
      const std::string_view value = NextWord(peek);
      const bool number = !value.empty() && value.find_first_not_of("+-.0123456789eE") == std::string_view::npos;
      if (vector && i > 0 && !number) break;
      if (option->first == "-bm" && bump_scale) *bump_scale = ParseFloat(value, lines);
      after = peek;
    }
    rest = Trimmed(after);
  }
  std::string name(rest);
  std::replace(name.begin(), name.end(), '\\', '/');
  return name;
}

void ParseStatement(std::string_view key, std::string_view rest, const TextLines& lines, MtlMaterial& m) {
  const auto number = [&] {
    std::string_view words = rest;
    return ParseFloat(NextWord(words), lines);
  };
  const auto unit = [&] { return std::clamp(number(), 0.0f, 1.0f); };
  if (key == "Kd")
    m.diffuse = Min(ParseColor(rest, lines), Vec3f{1, 1, 1});
  else if (key == "Ks")
    m.specular = Min(ParseColor(rest, lines), Vec3f{1, 1, 1});
  else if (key == "Ke")
    m.emission = Min(ParseColor(rest, lines), Vec3f{1e6f, 1e6f, 1e6f});
  else if (key == "Ns")
    m.shininess = std::clamp(number(), 0.0f, 1e6f);
  else if (key == "d")
    m.opacity = rest.starts_with("-halo") ? 1 : unit();
  else if (key == "Tr")
    m.opacity = 1 - unit();
  else if (key == "Pm")
    m.metallic = unit();
  else if (key == "Pr")
    m.roughness = unit();
  else if (key == "illum")
    m.illumination = static_cast<int>(std::clamp(number(), 0.0f, 10.0f));
  else if (key == "map_Kd")
    m.map_diffuse = ParseMap(rest, lines, nullptr);
  else if (key == "map_d")
    m.map_opacity = ParseMap(rest, lines, nullptr);
  else if (key == "map_Ke")
    m.map_emission = ParseMap(rest, lines, nullptr);
  else if (key == "norm")
    m.map_normal = ParseMap(rest, lines, &m.bump_scale);
}

}  // namespace

std::vector<MtlMaterial> ParseMtl(const std::string& file, std::string_view text) {
  std::vector<MtlMaterial> materials;
  TextLines lines(file, text, true);
  std::string_view line;
  while (lines.Next(line)) {
    if (line.empty() || line.front() == '#') continue;
    if (line.find('\0') != std::string_view::npos) lines.Fail("a zero byte: this is not a text file");
    const std::string_view key = NextWord(line);
    const std::string_view rest = Trimmed(line);
    if (key == "newmtl") {
      materials.emplace_back().name = CleanName(rest);
      continue;
    }
    // Some exporters write properties before the first newmtl: they are read and belong to nothing.
    MtlMaterial ignored;
    ParseStatement(key, rest, lines, materials.empty() ? ignored : materials.back());
  }
  return materials;
}

}  // namespace airsim360::internal
