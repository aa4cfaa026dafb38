#include <charconv>
#include <filesystem>
#include <optional>

#include "airsim360/assets/imported.h"
#include "airsim360/assets/sweethome3d/properties.h"
#include "airsim360/assets/sweethome3d/sweethome3d.h"
#include "airsim360/assets/text_lines.h"
#include "airsim360/base/error.h"

namespace airsim360::internal {
namespace {

// Short licence name of the texts that Debian's libraries carry.
std::string LicenceName(const std::string& text) {
  if (text.find("Public domain") != std::string::npos) return "CC0-1.0";
  if (text.find("Attribution 3.0 United States") != std::string::npos) return "CC-BY-3.0-US";
  if (text.find("Attribution 3.0") != std::string::npos) return "CC-BY-3.0";
  return CleanName(text);
}

struct Reader {
  const std::string& file;
  std::map<std::string, std::string> values;

  std::string Text(const std::string& key) const {
    const auto it = values.find(key);
    return it == values.end() ? std::string() : CleanName(it->second);
  }
  // Consecutive finite numbers of a value.
  std::vector<double> Numbers(const std::string& key) const {
    std::vector<double> numbers;
    const auto it = values.find(key);
    std::string_view rest = it == values.end() ? std::string_view() : it->second;
    for (std::string_view word = NextWord(rest); !word.empty(); word = NextWord(rest)) {
      double value = 0;
      const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
      if (error != std::errc() || end != word.data() + word.size() || !(std::abs(value) <= 1e6)) {
        throw InputError(file + ": " + CleanName(key) + ": '" + CleanName(word) + "' is not a number in range");
      }
      numbers.push_back(value);
    }
    return numbers;
  }
  double Metres(const std::string& key) const {
    const std::vector<double> cm = Numbers(key);
    return cm.size() == 1 ? cm[0] / 100 : 0;
  }
};

std::optional<CatalogueModel> ReadCatalogueModel(const Reader& reader, const std::string& number) {
  CatalogueModel model;
  model.path = reader.Text("model" + number);
  model.path.erase(0, model.path.find_first_not_of('/'));
  model.stem = std::filesystem::path(model.path).stem().string();
  model.title = reader.Text("name" + number);
  model.creator = reader.Text("creator" + number);
  model.category = reader.Text("category" + number);
  model.tags = reader.Text("tags" + number);
  model.size = VecCast<float>(Vec3d{reader.Metres("width" + number), reader.Metres("depth" + number), reader.Metres("height" + number)});
  if (model.stem.empty() || !(model.size.x > 0) || !(model.size.y > 0) || !(model.size.z > 0)) return std::nullopt;

  // Rotation by rows.
  const std::vector<double> m = reader.Numbers("modelRotation" + number);
  if (m.size() == 9) model.rotation_G = {{{{m[0], m[1], m[2]}, {m[3], m[4], m[5]}, {m[6], m[7], m[8]}}}};
  return model;
}

}  // namespace

std::vector<CatalogueModel> ParseCatalogue(const std::string& file, std::string_view text) {
  const Reader reader{file, ParseProperties(file, text)};
  const std::string licence = LicenceName(reader.Text("license"));
  std::vector<CatalogueModel> models;
  for (int i = 1; reader.values.contains("model#" + std::to_string(i)); ++i) {
    std::optional<CatalogueModel> model = ReadCatalogueModel(reader, std::string("#").append(std::to_string(i)));
    if (!model) continue;
    model->licence = licence;
    models.push_back(std::move(*model));
  }
  return models;
}

}  // namespace airsim360::internal
