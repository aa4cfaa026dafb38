#include "airsim360/scene/category_colors.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <string_view>
#include <vector>

#include "airsim360/base/random.h"
#include "airsim360/image/draw.h"

namespace airsim360 {
namespace {

// A wedge of Oklab for all categories of one family.
struct Family {
  std::string_view root;
  double hue_deg, least_chroma, most_chroma, spread_deg;
};

constexpr Family kFamilies[] = {
    {"animal", 35, .10, .15, 30},      {"barrier", 300, .06, .12, 30}, {"construction", 55, .02, .08, 60}, {"furniture", 80, .07, .15, 60},
    {"ground", 325, .04, .14, 40},     {"human", 18, .14, .20, 30},    {"nature", 115, .03, .09, 30},      {"object", 355, .10, .18, 30},
    {"signage", 108, .10, .17, 30},    {"sky", 235, .06, .12, 30},     {"traffic", 50, .13, .19, 30},      {"uav", 195, .07, .13, 30},
    {"vegetation", 138, .06, .17, 30}, {"vehicle", 268, .08, .20, 30}, {"water", 215, .06, .14, 30},
};
constexpr Family kOther = {"", 0, .02, .2, 360};

// The colours that Cityscapes' label table gives its classes.
struct Known {
  std::string_view path;
  Rgb8 color;
};
constexpr Known kCityscapes[] = {
    {"ground/road", {128, 64, 128}},
    {"ground/sidewalk", {244, 35, 232}},
    {"ground/parking", {250, 170, 160}},
    {"ground/rail", {230, 150, 140}},
    {"ground/terrain", {152, 251, 152}},
    {"construction/building", {70, 70, 70}},
    {"construction/wall", {102, 102, 156}},
    {"construction/bridge", {150, 100, 100}},
    {"barrier/fence", {190, 153, 153}},
    {"traffic/control/traffic_light", {250, 170, 30}},
    {"signage/traffic_sign", {220, 220, 0}},
    {"vegetation", {107, 142, 35}},
    {"sky", {70, 130, 180}},
    {"human/person", {220, 20, 60}},
    {"human/rider", {255, 0, 0}},
    {"vehicle/car", {0, 0, 142}},
    {"vehicle/truck", {0, 0, 70}},
    {"vehicle/bus", {0, 60, 100}},
    {"vehicle/train", {0, 80, 100}},
    {"vehicle/motorcycle", {0, 0, 230}},
    {"vehicle/bicycle", {119, 11, 32}},
};

const Family& FamilyOf(std::string_view path) {
  const std::string_view root = path.substr(0, path.find('/'));
  const auto found = std::ranges::find(kFamilies, root, &Family::root);
  return found == std::end(kFamilies) ? kOther : *found;
}

// The k-th colour of a family: Roberts' R3 sequence spreads lightness, chroma and hue.
Rgb8 ColorOf(const Family& family, double k) {
  const auto part = [&](double step) { return k * step - std::floor(k * step); };
  const double lightness = 0.42 + 0.46 * part(0.8191725133961645);
  const double chroma = family.least_chroma + (family.most_chroma - family.least_chroma) * part(0.6710436067037893);
  return OklchColor(lightness, chroma, family.hue_deg + family.spread_deg * (part(0.5497004779019703) - 0.5));
}

std::array<Rgb8, kFirstCustomId> MakePalette() {
  constexpr int kLeast = 24;  // that generated colours differ from all others by
  constexpr int kTries = 500;
  std::array<Rgb8, kFirstCustomId> palette{};
  std::vector<Rgb8> taken = {Rgb8{}};
  for (const Known& known : kCityscapes) taken.push_back(known.color);
  std::map<std::string_view, int> next;  // of the sequence of each family
  const SemanticTree tree;
  for (const auto& [id, category] : tree.categories()) {
    if (const auto* known = std::ranges::find(kCityscapes, category.path, &Known::path); known != std::end(kCityscapes)) {
      palette[id] = known->color;
      continue;
    }
    const Family& family = FamilyOf(category.path);
    const auto is_near = [&](Rgb8 a) {
      return std::ranges::any_of(taken, [&](Rgb8 b) { return std::abs(a.r - b.r) + std::abs(a.g - b.g) + std::abs(a.b - b.b) < kLeast; });
    };
    int& k = next[family.root];
    for (int i = 0; i == 0 || (i < kTries && is_near(palette[id])); ++i) palette[id] = ColorOf(family, ++k);
    taken.push_back(palette[id]);
  }
  return palette;
}

}  // namespace

const std::array<Rgb8, kFirstCustomId>& CategoryPalette() {
  static const std::array<Rgb8, kFirstCustomId> palette = MakePalette();
  return palette;
}

Rgb8 CategoryColor(const SemanticTree& tree, CategoryId id) {
  if (id < kFirstCustomId) return CategoryPalette()[id];
  const std::string& path = tree[id].path;
  return ColorOf(FamilyOf(path), 1 + static_cast<double>(HashName(path) % 100'000));
}

}  // namespace airsim360
