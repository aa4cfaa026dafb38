// What the tasks of `airsim360 eval` on pictures share: their flags, the parts of a panorama that are measured, and the report.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "airsim360/app/flags/commands.h"
#include "airsim360/base/log.h"
#include "airsim360/base/parallel.h"
#include "airsim360/eval/files/file_pairs.h"
#include "airsim360/eval/mistakes/likely_cause.h"
#include "airsim360/eval/sphere/pixel_view.h"
#include "airsim360/math/angles.h"
#include "airsim360/math/vector.h"

namespace airsim360 {

/// The option `name` of a file that is written. InputError if it names an input of the command or lies in one: a file that is there, a
/// picture among pictures, anything in a dataset of ours.
void AddOutputOption(CLI::App& command, const char* name, std::string& file, const std::string& help);

/// --force.
void AddForceFlag(CLI::App& command, bool& force);

struct ReportOptions {
  int bootstrap = 0;  ///< replicates of 95 % intervals; 0 = none
  std::string csv;    ///< a row a class or a picture
};
void AddReportFlags(CLI::App& command, ReportOptions& options, const char* csv_rows);

struct ViewOptions {
  std::string weights = "pixel", projection = "erp";
  int seam = 0, bands = 0;
  std::vector<std::string> rolled, turned;  ///< "COLUMNS=PRED", "YAW,PITCH,ROLL=PRED"
  int resize_width = 0, resize_height = 0;  ///< of a protocol; 0 = as they are
  bool cos_latitude = false;                ///< of a protocol
  bool force = false;
};
/// --seam, --latitude-bands, --rolled, --turned and --force; --weights and --projection where `pixels` are counted.
void AddViewFlags(CLI::App& command, ViewOptions& options, bool pixels = true);
/// InputError for values that do not exist or go together.
void CheckViewOptions(const ViewOptions& options);
/// Whether pictures of width = 2 height are panoramas: false where the datasets of ours among `inputs` (or that they lie in) say that a camera
/// is a pinhole or a fisheye. InputError for views that only panoramas have then.
bool ArePanoramas(const ViewOptions& options, const std::vector<std::string>& inputs);

/// The parts of one size of picture: the first is what the main figures are of, then near the seam and far from it, then bands.
using PictureViews = std::vector<PixelView>;

/// Makes the views of each size once. Safe to use from several threads.
class ViewCache {
 public:
  explicit ViewCache(const ViewOptions& options) : options_(options) {}
  std::shared_ptr<const PictureViews> Of(int width, int height);

 private:
  const ViewOptions& options_;
  std::mutex mutex_;
  std::map<std::pair<int, int>, std::shared_ptr<const PictureViews>> views_;
};

/// Predictions of pictures that were moved: by columns, or as a camera turns.
struct Rolled {
  int columns = 0;
  std::optional<Vec3d> turn_deg;  ///< yaw to the right, pitch upwards, roll clockwise
  std::string path;

  /// What `pixels` were before.
  template <class Pixel>
  std::vector<Pixel> Back(std::span<const Pixel> pixels, int width) const {
    if (!turn_deg) return RollBack<Pixel>(pixels, width, columns);
    const int height = static_cast<int>(pixels.size() / static_cast<size_t>(width));
    return Take<Pixel>(pixels, TurnedView(width, height, turn_deg->x * kDegree, turn_deg->y * kDegree, turn_deg->z * kDegree));
  }
};
/// Those of --rolled, then those of --turned.
std::vector<Rolled> ParseRolled(const ViewOptions& options);

/// Figures of one view, by name.
using Figure = std::pair<std::string, double>;
/// Appends what `of_view` says of the views after the first: `seam` with `near` and `far`, and `latitude_bands` from north to south.
void AppendViews(nlohmann::ordered_json& json, const ViewOptions& options,
                 const std::function<nlohmann::ordered_json(size_t view)>& of_view);
/// `rolled` and `turned` with the figures of each, and `spread`: largest less smallest of each figure over all of them and the main ones.
void AppendRolled(nlohmann::ordered_json& json, std::span<const Rolled> rolled, const std::vector<std::vector<Figure>>& figures,
                  const std::vector<Figure>& main);
/// `intervals`: [low, high] of each figure.
void AppendIntervals(nlohmann::ordered_json& json, const ReportOptions& options, uint64_t seed, size_t items,
                     const std::vector<std::string>& names, const std::function<std::vector<double>(std::span<const uint32_t>)>& statistic);

/// Mistakes of which most pictures are surely one are refused by an InputError that names the first of them, or a warning in `json` if
/// `force`; those that are merely probable in most pictures, and sure ones in a few, are warnings.
void JudgeMistakes(const std::vector<std::pair<std::string, LikelyMistake>>& files_and_mistakes, bool force, nlohmann::ordered_json& json);

/// The same of the mistakes of `results`; file_of(i) names their files.
template <class Result, class FileOf>
void JudgeMistakes(const std::vector<Result>& results, bool force, nlohmann::ordered_json& json, const FileOf& file_of) {
  std::vector<std::pair<std::string, LikelyMistake>> mistakes;
  for (size_t i = 0; i < results.size(); ++i) mistakes.push_back({file_of(i), results[i].mistake});
  JudgeMistakes(mistakes, force, json);
}

/// A warning that names how many pictures have no truth that counts and are therefore in no mean; valid(i) = pixels of the i-th.
void WarnOfEmptyTruths(nlohmann::ordered_json& json, const std::vector<FilePair>& pairs, const std::function<int64_t(size_t)>& valid);

nlohmann::ordered_json ToJson(const std::vector<Figure>& figures);
/// "name  value" lines of the numbers of an object, then its notes and warnings.
void PrintFigures(const nlohmann::ordered_json& json);
/// Writes rows of a table; what contains commas or quotes is quoted. Does nothing without a path.
void WriteCsv(const std::string& path, const std::vector<std::vector<std::string>>& rows);
/// As short as reading it back allows; "" for what is not finite.
std::string NumberText(double value);

/// measure(i) of n items on several threads, with progress.
template <class Result, class Measure>
std::vector<Result> MeasureAll(const char* label, size_t n, const Measure& measure) {
  std::vector<Result> results(n);
  ProgressBar progress(label, static_cast<int64_t>(n));
  std::mutex mutex;
  int64_t done = 0;
  ParallelFor(static_cast<int64_t>(n), [&](int64_t i) {
    results[static_cast<size_t>(i)] = measure(static_cast<size_t>(i));
    const std::lock_guard lock(mutex);
    progress.Update(++done);
  });
  return results;
}

}  // namespace airsim360
