#include "airsim360/app/eval/eval_panoptic_input.h"

#include <map>

#include "airsim360/app/eval/eval_views.h"
#include "airsim360/base/error.h"
#include "airsim360/eval/files/file_pairs.h"

namespace airsim360 {
namespace {

namespace fs = std::filesystem;

// Categories that the prediction names must be those of the truth: a name under another id is a mistake, another name for an id may be one.
void CompareCategories(const PanopticFile& prediction, const PanopticFile& truth, const std::string& path,
                       std::vector<std::string>& warnings) {
  std::map<std::string, int64_t> ids;
  std::map<int64_t, std::string> names;
  for (const PanopticCategory& category : truth.categories) {
    if (category.name.empty()) continue;
    ids[category.name] = category.id;
    names[category.id] = category.name;
  }
  std::vector<std::string> renamed;
  for (const PanopticCategory& category : prediction.own_categories) {
    const auto name = names.find(category.id);
    const auto id = ids.find(category.name);
    if (id != ids.end() && id->second != category.id)
      throw InputError(path + ": the category '" + category.name + "' is " + std::to_string(category.id) + " here and " +
                       std::to_string(id->second) + " in the truth: use the truth's ids (or leave `categories` out if the ids are its)");
    if (name != names.end() && !category.name.empty() && name->second != category.name)
      renamed.push_back(std::to_string(category.id) + " is '" + category.name + "', in the truth '" + name->second + "'");
  }
  if (!renamed.empty())
    warnings.push_back(path + ": categories of other names than the truth's, " + renamed[0] +
                       (renamed.size() > 1 ? " (and " + std::to_string(renamed.size() - 1) + " more)" : "") + ": are they the same?");
}

fs::path JsonPath(const std::string& path) {
  const fs::path json = PanopticJson(path);
  if (json.empty()) throw InputError(path + ": a folder without panoptic.json or panoptic_gt.json");
  return json;
}

}  // namespace

fs::path PanopticJson(const std::string& path) {
  if (!fs::is_directory(path)) return path;
  for (const char* name : {"panoptic.json", "panoptic_gt.json"}) {
    if (fs::exists(fs::path(path) / name)) return fs::path(path) / name;
  }
  return {};
}

void AddPanopticPaths(CLI::App& command, PanopticPaths& paths) {
  command.add_option("pred", paths.pred, "COCO panoptic JSON, or a dataset of ours")->required();
  command.add_option("gt", paths.gt, "the truth: the same")->required();
  command.add_option("--pred-dir", paths.pred_dir,
                     "folder of the prediction's PNGs (default: named as the file, or entity beside it, or its own)");
  command.add_option("--gt-dir", paths.gt_dir, "folder of the truth's PNGs");
}

void CheckTruthFiles(const PanopticPaths& paths) {
  if (paths.gt_dir.empty()) CheckDatasetFiles(paths.gt, {"panoptic.json", "entity"});
}

PanopticInput::PanopticInput(const PanopticPaths& paths)
    : truth(ReadPanopticFile(JsonPath(paths.gt))),
      prediction_(ReadPanopticFile(JsonPath(paths.pred), &truth.categories)),
      pred_dir_(paths.pred_dir.empty() ? PanopticFolder(JsonPath(paths.pred)) : fs::path(paths.pred_dir)),
      gt_dir_(paths.gt_dir.empty() ? PanopticFolder(JsonPath(paths.gt)) : fs::path(paths.gt_dir)) {
  std::map<std::string, size_t> predictions;
  for (size_t i = 0; i < prediction_.frames.size(); ++i) predictions[prediction_.frames[i].image] = i;
  size_t missing = 0;
  std::string first;
  for (const PanopticFrame& frame : truth.frames) {
    const auto found = predictions.find(frame.image);
    if (found != predictions.end()) {
      by_truth_.push_back(found->second);
    } else if (missing++ == 0) {
      first = frame.image;
    }
  }
  CompareCategories(prediction_, truth, paths.pred, warnings);
  if (truth.frames.empty()) throw InputError(paths.gt + ": has no annotations");
  if (missing > 0)
    throw InputError(paths.pred + ": has no annotation for " + std::to_string(missing) + " of " + std::to_string(truth.frames.size()) +
                     " pictures, image_id " + first + " first" +
                     (missing == truth.frames.size() ? ": are pictures numbered otherwise?" : ""));
  if (prediction_.frames.size() > truth.frames.size())
    notes.push_back(std::to_string(prediction_.frames.size() - truth.frames.size()) + " predicted pictures have no truth and are left out");
}

std::pair<LabelPicture, LabelPicture> PanopticInput::Read(size_t i) const {
  const fs::path pred_path = pred_dir_ / Prediction(i).file, gt_path = gt_dir_ / truth.frames[i].file;
  LabelPicture pred = ReadIdPicture(pred_path), gt = ReadIdPicture(gt_path);
  if (pred.width != gt.width || pred.height != gt.height)
    throw InputError(pred_path.string() + " has " + std::to_string(pred.width) + "x" + std::to_string(pred.height) + " pixels, " +
                     gt_path.string() + " has " + std::to_string(gt.width) + "x" + std::to_string(gt.height) +
                     ": resize the predictions (nearest pixel)");
  return {std::move(pred), std::move(gt)};
}

std::vector<uint32_t> CategoriesOf(const LabelPicture& ids, const PanopticFrame& frame) {
  std::unordered_map<uint32_t, uint32_t> category;
  for (const PanopticSegment& segment : frame.segments) category[segment.id] = static_cast<uint32_t>(segment.category) + 1;
  std::vector<uint32_t> categories;
  categories.reserve(ids.ids.size());
  uint32_t last = 0, last_category = 0;
  for (const uint32_t id : ids.ids) {
    if (id != last) {
      const auto found = category.find(id);
      last = id;
      last_category = found == category.end() ? 0 : found->second;
    }
    categories.push_back(last_category);
  }
  return categories;
}

std::vector<std::pair<std::string, std::vector<bool>>> PanopticGroups(const std::vector<PanopticCategory>& categories) {
  std::vector<bool> all(categories.size(), true), things, stuff;
  for (const PanopticCategory& category : categories) {
    things.push_back(category.thing);
    stuff.push_back(!category.thing);
  }
  return {{"all", all}, {"things", things}, {"stuff", stuff}};
}

std::vector<bool> ChooseCategories(const std::vector<PanopticCategory>& categories, const std::vector<std::string>& names,
                                   const char* flag) {
  std::vector<bool> chosen(categories.size(), false);
  std::vector<std::string> known;
  for (const PanopticCategory& category : categories) known.push_back(category.name);
  for (const std::string& name : names) {
    bool found = false;
    for (size_t c = 0; c < categories.size(); ++c) {
      if (categories[c].name == name || std::to_string(categories[c].id) == name) found = chosen[c] = true;
    }
    if (!found) throw InputError(std::string(flag) + ": " + UnknownChoiceMessage("category", name, known));
  }
  return chosen;
}

nlohmann::ordered_json QualityJson(const PanopticQuality& q) { return {{"pq", q.pq}, {"sq", q.sq}, {"rq", q.rq}, {"n", q.categories}}; }

void AppendPanoptic(nlohmann::ordered_json& json, const std::vector<PanopticCount>& counts, const std::vector<PanopticCategory>& categories,
                    bool per_class) {
  for (const auto& [group, chosen] : PanopticGroups(categories)) json[group] = QualityJson(MeanQuality(counts, chosen));
  if (!per_class) return;
  json["per_class"] = nlohmann::ordered_json::object();
  for (size_t c = 0; c < counts.size(); ++c) {
    const PanopticQuality q = QualityOf(counts[c]);
    json["per_class"][std::to_string(categories[c].id)] = {{"name", categories[c].name},
                                                           {"isthing", categories[c].thing},
                                                           {"pq", q.pq},
                                                           {"sq", q.sq},
                                                           {"rq", q.rq},
                                                           {"iou", counts[c].iou},
                                                           {"tp", counts[c].tp},
                                                           {"fp", counts[c].fp},
                                                           {"fn", counts[c].fn}};
  }
}

void PrintPanoptic(const nlohmann::ordered_json& json) {
  std::printf("%-30s %8s %8s %8s\n", "", "PQ", "SQ", "RQ");
  const auto number = [](const nlohmann::ordered_json& value) { return value.is_number() ? value.get<double>() : std::nan(""); };
  const auto line = [&](const std::string& name, const nlohmann::ordered_json& q) {
    std::printf("%-30s %8.4f %8.4f %8.4f\n", name.c_str(), number(q["pq"]), number(q["sq"]), number(q["rq"]));
  };
  for (const char* group : {"all", "things", "stuff"}) line(group, json[group]);
  if (json.contains("per_class")) {
    for (const auto& [id, q] : json["per_class"].items()) {
      if (q["tp"].get<int64_t>() + q["fp"].get<int64_t>() + q["fn"].get<int64_t>() > 0) line("  " + q["name"].get<std::string>(), q);
    }
  }
  PrintFigures(json);
}

}  // namespace airsim360
