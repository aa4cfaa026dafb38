#include "airsim360/view/viewed_plan.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "airsim360/base/error.h"
#include "airsim360/dataset/plan/plan_spec.h"
#include "airsim360/view/planes.h"

namespace airsim360 {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kMostColumns = 1024;
// Those that a plane message holds.
constexpr const char* kShownOfPlans[] = {"rgb", "range", "semantic", "entity", "normal", "albedo", "position", "coverage", "flow"};

bool IsShown(const std::string& product) { return std::ranges::find(kShownOfPlans, product) != std::end(kShownOfPlans); }

DatasetSpec PicturesOf(const DatasetPlan& plan) {
  RecipePicture picture = plan.recipe.picture;
  const int columns = std::atoi(picture.size.c_str());
  if (columns > kMostColumns) picture.size = std::to_string(kMostColumns) + "x" + std::to_string(kMostColumns / 2);
  return SpecOfPicture(picture, CameraChoice{"erp", picture.size, "", 0});
}

}  // namespace

ViewedPlan::ViewedPlan(const std::filesystem::path& file, const DeviceChoice& device)
    : name_(file.filename().string()), spec_(PicturesOf(ReadPlan(file))), frames_(ReadPlan(file), {.pictures = spec_, .device = device}) {}

std::optional<std::string> ViewedPlan::Made(std::string_view path) {
  if (path == "index.json") return Index();
  if (path == "entities.json") return Entities();
  const std::optional<int64_t> number = FrameNumber(path, frames_.plan().frames());
  if (!number) return std::nullopt;
  return Frame(*number);
}

std::string ViewedPlan::Index() const {
  const DatasetPlan& plan = frames_.plan();
  Json products = Json::object(), stems = Json::array(), worlds = Json::array(), names = Json::array();
  for (const ProductFolder& product : ProductFolders(spec_))
    if (IsShown(product.name)) products[product.name] = "";
  for (const RecipeRow& row : plan.recipe.rows) {
    if (std::ranges::find(names, Json(row.world)) == names.end()) names.push_back(row.world);
    for (int64_t i = 0; i < static_cast<int64_t>(row.frames); ++i) worlds.push_back(row.world);
  }
  for (int64_t i = 0; i < plan.frames(); ++i) stems.push_back(FrameStem(i));
  const std::string world = names.size() == 1 ? names[0].get<std::string>() : std::to_string(names.size()) + " worlds";
  return Json{{"name", name_},
              {"planned", true},
              {"world", world},
              {"seed", plan.seed},
              {"people", std::ranges::any_of(plan.recipe.rows, [](const RecipeRow& row) { return row.people > 0; })},
              {"products", products},
              {"categories", Json::parse(CategoriesJson(frames_.Categories()))},
              {"frames", {{"stem", stems}, {"t", Json::array()}, {"range", Json::array()}, {"world", worlds}}},
              {"views", {{{"suffix", ""}, {"projection", "erp"}}}}}
      .dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string ViewedPlan::Entities() {
  Json entities = Json::object();
  for (const PlanFrames::Thing& thing : frames_.Things())
    entities[std::to_string(thing.id)] = {
        {"name", thing.name}, {"category_path", thing.category}, {"kind", thing.countable ? "thing" : "stuff"}};
  return entities.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string ViewedPlan::Frame(int64_t number) {
  const PlanFrame frame = frames_.Take(number);
  PlaneMessage message;
  for (const StoredPicture& picture : frame.pictures)
    if (IsShown(picture.product)) message.AddStored(picture);
  Json about = Json::parse(frame.about);
  about["p"] = about["X_WC"]["p"];
  about["q"] = about["X_WC"]["q_wxyz"];
  const std::string text = about.dump(-1, ' ', false, Json::error_handler_t::replace);
  return message.Finish(text.substr(1, text.size() - 2));
}

}  // namespace airsim360
