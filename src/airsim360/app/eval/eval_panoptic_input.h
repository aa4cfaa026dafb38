// What `eval panoptic` and `eval video` share: their files, and the report.
#pragma once

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "airsim360/eval/files/panoptic_file.h"
#include "airsim360/eval/files/picture_files.h"

namespace airsim360 {

struct PanopticPaths {
  std::string pred, gt, pred_dir, gt_dir;  ///< folders "" = as PanopticFolder
};
void AddPanopticPaths(CLI::App& command, PanopticPaths& paths);

/// The file that a folder stands for: its panoptic.json, or VIPSeg's panoptic_gt.json; "" where it has neither, `path` itself where it is no folder.
std::filesystem::path PanopticJson(const std::string& path);

/// CheckDatasetFiles of a truth that is a dataset of ours.
void CheckTruthFiles(const PanopticPaths& paths);

/// Truth and prediction, read and matched by image_id. Folders stand for their PanopticJson.
class PanopticInput {
 public:
  /// InputError naming how many truths have no prediction, or a category that has another id in the truth.
  explicit PanopticInput(const PanopticPaths& paths);

  /// The annotation of the prediction of truth.frames[i].
  const PanopticFrame& Prediction(size_t i) const { return prediction_.frames[by_truth_[i]]; }
  /// Ids of prediction and truth; InputError for different sizes.
  std::pair<LabelPicture, LabelPicture> Read(size_t i) const;

  PanopticFile truth;
  std::vector<std::string> notes, warnings;

 private:
  PanopticFile prediction_;
  std::vector<size_t> by_truth_;
  std::filesystem::path pred_dir_, gt_dir_;
};

/// Index of the category + 1 of every pixel, 0 = void.
std::vector<uint32_t> CategoriesOf(const LabelPicture& ids, const PanopticFrame& frame);

/// "all", "things" and "stuff" with a flag a category.
std::vector<std::pair<std::string, std::vector<bool>>> PanopticGroups(const std::vector<PanopticCategory>& categories);
/// A flag a category, true where it is named (by name or id); InputError naming the flag otherwise.
std::vector<bool> ChooseCategories(const std::vector<PanopticCategory>& categories, const std::vector<std::string>& names,
                                   const char* flag);
nlohmann::ordered_json QualityJson(const PanopticQuality& quality);
/// `all`, `things`, `stuff` with pq, sq, rq, n; and `per_class` by id.
void AppendPanoptic(nlohmann::ordered_json& json, const std::vector<PanopticCount>& counts, const std::vector<PanopticCategory>& categories,
                    bool per_class);
void PrintPanoptic(const nlohmann::ordered_json& json);

}  // namespace airsim360
