#include "airsim360/scene/parts.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <string>
#include <utility>

namespace airsim360 {
namespace {

struct Word {
  std::string_view root, word;
  Part part;
};
// The first row counts that has the category's root and a word of the material's name.
constexpr Word kWords[] = {
    {"construction", "door", Part::kDoor},    {"construction", "shutter", Part::kShutter},
    {"construction", "glass", Part::kWindow}, {"construction", "window", Part::kWindow},
    {"construction", "pane", Part::kWindow},  {"construction", "frame", Part::kWindow},
    {"vehicle", "glass", Part::kWindow},      {"vehicle", "window", Part::kWindow},
    {"vehicle", "windshield", Part::kWindow}, {"vehicle", "rubber", Part::kWheel},
    {"vehicle", "tyre", Part::kWheel},        {"vehicle", "tire", Part::kWheel},
    {"vehicle", "wheel", Part::kWheel},       {"vehicle", "door", Part::kDoor},
    {"vegetation", "leaf", Part::kFoliage},   {"vegetation", "leaves", Part::kFoliage},
    {"vegetation", "needle", Part::kFoliage}, {"vegetation", "foliage", Part::kFoliage},
    {"vegetation", "bark", Part::kTrunk},     {"vegetation", "trunk", Part::kTrunk},
};

// Whether `word` (or its plural) stands in `name`, not inside a longer word.
bool Has(const std::string& name, std::string_view word) {
  const auto letter = [&](size_t i) { return i < name.size() && name[i] >= 'a' && name[i] <= 'z'; };
  for (size_t at = name.find(word); at != std::string::npos; at = name.find(word, at + 1)) {
    const size_t end = at + word.size();
    if ((at == 0 || !letter(at - 1)) && (!letter(end) || (name[end] == 's' && !letter(end + 1)))) return true;
  }
  return false;
}

}  // namespace

Part PartOf(std::string_view category, std::string_view material) {
  if (category.starts_with("construction/balcony")) return Part::kBalcony;
  std::string name(material);
  for (char& c : name) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  for (const Word& row : kWords)
    if (category.starts_with(row.root) && Has(name, row.word)) return row.part;
  return Part::kNone;
}

Image<uint8_t> PartPicture(const Image<CategoryId>& semantic, const Image<uint16_t>& material, const SemanticTree& tree,
                           std::span<const Material> materials) {
  Image<uint8_t> parts(semantic.width(), semantic.height());
  // Every pair of category and material is looked up once a run of equal pixels.
  std::map<std::pair<CategoryId, uint16_t>, uint8_t> known;
  std::pair<CategoryId, uint16_t> last{kVoid, 0};
  uint8_t part = 0;
  for (size_t i = 0; i < parts.pixels().size(); ++i) {
    const std::pair<CategoryId, uint16_t> key{semantic.pixels()[i], material.pixels()[i]};
    if (key != last) {
      const auto [found, fresh] = known.try_emplace(key, uint8_t{0});
      if (fresh && key.first != kVoid && key.second != 0)
        found->second = static_cast<uint8_t>(PartOf(tree[key.first].path, materials[key.second - 1u].name));
      part = found->second;
      last = key;
    }
    parts.pixels()[i] = part;
  }
  return parts;
}

Image<uint8_t> SkyMask(const Image<EntityId>& entity, EntityId sky) {
  Image<uint8_t> mask(entity.width(), entity.height());
  std::ranges::transform(entity.pixels(), mask.pixels().begin(),
                         [&](EntityId id) -> uint8_t { return id == sky && id != kNoEntity ? 255 : 0; });
  return mask;
}

}  // namespace airsim360
