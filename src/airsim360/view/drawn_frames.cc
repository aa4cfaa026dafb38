#include "airsim360/view/drawn_frames.h"

#include <charconv>
#include <nlohmann/json.hpp>

#include "airsim360/scene/category_colors.h"

namespace airsim360 {

std::optional<int64_t> FrameNumber(std::string_view path, int64_t count) {
  constexpr std::string_view kFramePath = "frame/";
  if (!path.starts_with(kFramePath)) return std::nullopt;
  int64_t number = -1;
  const std::string_view digits = path.substr(kFramePath.size());
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  if (error != std::errc() || end != digits.data() + digits.size() || number < 0 || number >= count) return std::nullopt;
  return number;
}

std::string FrameStem(int64_t number) {
  const std::string digits = std::to_string(number);
  return std::string(digits.size() < 6 ? 6 - digits.size() : 0, '0') + digits;
}

std::string CategoriesJson(const SemanticTree& tree) {
  nlohmann::ordered_json categories = nlohmann::ordered_json::array();
  for (const auto& [id, category] : tree.categories()) {
    const Rgb8 color = CategoryColor(tree, id);
    categories.push_back({{"id", id}, {"path", category.path}, {"color", {color.r, color.g, color.b}}, {"thing", category.thing}});
  }
  return categories.dump();
}

}  // namespace airsim360
