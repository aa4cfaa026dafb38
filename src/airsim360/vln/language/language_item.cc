#include "airsim360/vln/language/language_item.h"

#include <algorithm>
#include <fstream>
#include <numbers>
#include <set>
#include <unordered_set>

#include "airsim360/base/error.h"

namespace airsim360 {
namespace internal {
namespace {

constexpr size_t kLongestLine = 1 << 20, kMostChoices = 16, kMostEntities = 256;

EntityId EntityOf(const VlnJson& value, const std::string& where) {
  if (!value.is_number_unsigned() || value.get<uint64_t>() > UINT32_MAX) throw InputError(where + ": is not the number of an entity");
  return value.get<EntityId>();
}

std::string Needed(VlnFields& fields, const char* name) {
  std::string text = fields.Text(name, "");
  if (text.empty()) throw InputError(fields.where() + "." + name + ": is missing");
  return text;
}

LanguagePicture PictureOf(const VlnJson& value, const std::string& where) {
  VlnFields fields(value, where);
  LanguagePicture picture;
  picture.file = Needed(fields, "file");
  const std::filesystem::path path(picture.file);
  if (path.is_absolute() || std::ranges::find(path, "..") != path.end())
    throw InputError(where + ".file: '" + picture.file + "' is not below the items' folder");
  const std::string projection = Needed(fields, "projection");
  const std::vector<std::string> known = {"equirectangular", "perspective"};
  if (std::ranges::find(known, projection) == known.end())
    throw InputError(where + ".projection: " + UnknownChoiceMessage("projection", projection, known));
  picture.panorama = projection == known[0];
  picture.width = static_cast<int>(fields.Number("width", 0, 64, 8192));
  picture.height = static_cast<int>(fields.Number("height", 0, 64, 8192));
  picture.position = fields.Point("position");
  picture.yaw_deg = fields.Number("yaw_deg", 0, -360, 360);
  picture.azimuth_deg = fields.Number("azimuth_deg", 0, -360, 360);
  fields.Number("fov_deg", 90, 90, 90);
  fields.Finish();
  return picture;
}

}  // namespace

LanguageItem ParseLanguageItem(const std::string& line, const std::string& where) {
  const VlnJson json = ParseVlnJson(line, where);
  VlnFields fields(json, where);
  LanguageItem item;
  item.id = Needed(fields, "id");
  item.kind = Needed(fields, "kind");
  const std::vector<std::string> kinds(std::begin(kLanguageKinds), std::end(kLanguageKinds));
  if (std::ranges::find(kinds, item.kind) == kinds.end())
    throw InputError(where + ".kind: " + UnknownChoiceMessage("kind", item.kind, kinds));
  item.type = Needed(fields, "type");
  item.world = Needed(fields, "world");
  const VlnJson& seed = fields.At("world_seed");
  if (!seed.is_number_unsigned()) throw InputError(where + ".world_seed: is not a seed");
  item.world_seed = seed.get<uint64_t>();
  item.split = fields.Text("split", "train");
  const VlnJson& pictures = fields.At("pictures");
  if (!pictures.is_array() || pictures.empty() || pictures.size() > 2) throw InputError(where + ".pictures: is not a list of one or two");
  for (size_t i = 0; i < pictures.size(); ++i) {
    item.pictures.push_back(PictureOf(pictures[i], where + ".pictures[" + std::to_string(i) + "]"));
    item.pictures.back().world = item.world;
    item.pictures.back().world_seed = item.world_seed;
  }
  item.text = Needed(fields, item.kind == "refer" ? "expression" : "question");
  item.answer_type = Needed(fields, "answer_type");
  item.answer = fields.At("answer");
  item.choices = fields.At("choices");
  if (!item.choices.is_array() || item.choices.empty() || item.choices.size() > kMostChoices)
    throw InputError(where + ".choices: is not a list of 1 … 16");
  item.answer_index = static_cast<size_t>(fields.Number("answer_index", 0, 0, static_cast<double>(item.choices.size() - 1)));
  const VlnJson& entities = fields.At("entities");
  if (!entities.is_array() || entities.size() > kMostEntities) throw InputError(where + ".entities: is not a list of at most 256");
  for (const VlnJson& entity : entities) item.entities.push_back(EntityOf(entity, where + ".entities"));
  fields.Find("distractors");
  // Longer than other texts; a line holds it.
  if (const VlnJson* mask = fields.Find("mask")) {
    if (!mask->is_string()) throw InputError(where + ".mask: is not a text");
    item.mask = mask->get<std::string>();
  }
  item.query = fields.At("query");
  item.nouns = fields.At("nouns");
  if (!item.query.is_object()) throw InputError(where + ".query: is not an object");
  if (!item.nouns.is_object()) throw InputError(where + ".nouns: is not an object");
  fields.Find("proof");
  fields.Finish();
  return item;
}

void ReadLanguageItems(const std::filesystem::path& file, const std::function<void(LanguageItem item)>& take) {
  if (std::filesystem::is_directory(file)) throw InputError(file.string() + ": is a folder; give the file of the items");
  std::ifstream in(file);
  if (!in) throw InputError(file.string() + ": cannot be read");
  std::unordered_set<std::string> ids;
  int64_t number = 0;
  for (std::string line; std::getline(in, line);) {
    const std::string where = file.string() + ":" + std::to_string(++number);
    if (line.size() > kLongestLine) throw InputError(where + ": is longer than 1 MiB");
    if (line.empty()) continue;
    LanguageItem item = ParseLanguageItem(line, where);
    if (!ids.insert(item.id).second) throw InputError(where + ".id: '" + item.id + "' is there twice");
    take(std::move(item));
  }
  if (ids.empty()) throw InputError(file.string() + ": holds no item");
}

}  // namespace internal

std::vector<LanguagePicture> PicturesOf(const std::filesystem::path& items) {
  std::vector<LanguagePicture> pictures;
  std::set<std::string> files;
  internal::ReadLanguageItems(items, [&](internal::LanguageItem item) {
    for (LanguagePicture& picture : item.pictures)
      if (files.insert(picture.file).second) pictures.push_back(std::move(picture));
  });
  return pictures;
}

}  // namespace airsim360
