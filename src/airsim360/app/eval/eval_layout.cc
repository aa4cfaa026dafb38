// airsim360 eval layout and eval mpde: rooms told by corners; distance and orientation of people.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>

#include "airsim360/app/eval/eval_commands.h"
#include "airsim360/app/eval/eval_views.h"
#include "airsim360/app/flags/arguments.h"
#include "airsim360/base/error.h"
#include "airsim360/eval/files/file_pairs.h"
#include "airsim360/eval/files/layout_file.h"
#include "airsim360/eval/files/person_file.h"
#include "airsim360/math/angles.h"
#include "airsim360/math/median.h"

namespace airsim360 {
namespace {

using Json = nlohmann::ordered_json;

struct LayoutArguments {
  std::string pred, gt, size = "1024x512";
  ReportOptions report;
};
struct MpdeArguments {
  std::string pred, gt, protocol;
  bool force = false;
  ReportOptions report;
};

constexpr int kMostWidth = 16384;

// Means, each over the rooms that have the figure.
std::vector<double> LayoutMeans(const std::vector<LayoutErrors>& errors, std::span<const uint32_t> draws = {}) {
  std::vector<double> sums(kLayoutFigures.size(), 0), counts(sums.size(), 0);
  for (size_t i = 0; i < errors.size(); ++i) {
    const auto figures = Figures(errors[i]);
    for (size_t f = 0; f < sums.size(); ++f) {
      if (std::isnan(figures[f])) continue;
      const double times = draws.empty() ? 1 : draws[i];
      sums[f] += times * figures[f];
      counts[f] += times;
    }
  }
  for (size_t f = 0; f < sums.size(); ++f) sums[f] = counts[f] > 0 ? sums[f] / counts[f] : std::numeric_limits<double>::quiet_NaN();
  return sums;
}

void AppendLayoutWarnings(Json& json, const FilePairs& files, const std::vector<LayoutErrors>& errors, const std::vector<double>& any_start,
                          const std::vector<char>& crossing) {
  size_t elsewhere = 0, first = 0, crossed = 0, first_crossed = 0;
  for (size_t i = errors.size(); i-- > 0;) {
    if (errors[i].corner_error > 4 * any_start[i] + 1) ++elsewhere, first = i;
    if (crossing[i]) ++crossed, first_crossed = i;
  }
  if (elsewhere > 0)
    json["warnings"].push_back("corners of " + std::to_string(elsewhere) + (elsewhere == 1 ? " room begin" : " rooms begin") +
                               " elsewhere than the truth's or lie across the seam: from the "
                               "nearest start and round the seam the corner error of room " +
                               files.pairs[first].name + " is " + NumberText(any_start[first]) + " instead of " +
                               NumberText(errors[first].corner_error));
  if (crossed > 0)
    json["warnings"].push_back("predicted walls cross each other in " + std::to_string(crossed) + (crossed == 1 ? " room" : " rooms") +
                               ", " + files.pairs[first_crossed].name +
                               " first: its surfaces mean little; are corners in turn around the room?");
}

void RunLayout(const LayoutArguments& a, const GlobalOptions& globals) {
  int width = 0, height = 0;
  char after = 0;
  if (std::sscanf(a.size.c_str(), "%dx%d%c", &width, &height, &after) != 2 || width < 8 || width > kMostWidth || height != width / 2 ||
      width % 2 != 0)
    throw InputError("--size: '" + a.size + "' is no WIDTHxHEIGHT of a panorama, twice as wide as high, 8 to " +
                     std::to_string(kMostWidth) + " columns");
  const FilePairs files = PairFiles(a.pred, a.gt, {".txt", ".json"}, "layout");
  // Rooms whose corner error is that of another first corner rather than of the network; rooms whose predicted walls cross.
  std::vector<double> any_start(files.pairs.size());
  std::vector<char> crossing(files.pairs.size());
  const auto errors = MeasureAll<LayoutErrors>("eval layout", files.pairs.size(), [&](size_t i) {
    const FilePair& pair = files.pairs[i];
    try {
      const RoomLayout pred = ReadLayoutFile(pair.prediction, width, height), gt = ReadLayoutFile(pair.truth, width, height);
      const LayoutErrors measured = MeasureLayout(pred, gt, width, height);
      any_start[i] = CornerErrorFromAnyStart(pred, gt, width, height);
      crossing[i] = WallsCross(pred, width, height);
      return measured;
    } catch (const InputError& error) {
      throw InputError("room " + pair.name + ": " + error.what());
    }
  });
  const std::vector<std::string> names(kLayoutFigures.begin(), kLayoutFigures.end());
  Json json;
  const std::vector<double> means = LayoutMeans(errors);
  for (size_t f = 0; f < names.size(); ++f) json[names[f]] = means[f];
  json["rooms"] = errors.size();
  AppendIntervals(json, a.report, globals.seed, errors.size(), names,
                  [&](std::span<const uint32_t> draws) { return LayoutMeans(errors, draws); });
  std::vector<std::vector<std::string>> rows = {{"room"}};
  rows[0].insert(rows[0].end(), names.begin(), names.end());
  for (size_t i = 0; i < errors.size(); ++i) {
    auto& row = rows.emplace_back(std::vector<std::string>{files.pairs[i].name});
    for (const double value : Figures(errors[i])) row.push_back(NumberText(value));
  }
  WriteCsv(a.report.csv, rows);
  Json notes = files.notes;
  notes.push_back(
      "definitions of HorizonNet's evaluation for a camera 1.6 m above the floor; surfaces are exact where that code joins rounded columns");
  notes.push_back(
      "corner_error_percent compares corners in the order of the files and does not go round the seam, as HorizonNet's does: both files must begin at the same corner");
  json["notes"] = notes;
  AppendLayoutWarnings(json, files, errors, any_start, crossing);
  if (globals.json)
    PrintJson(json);
  else
    PrintFigures(json);
}

Json MpdeJson(const MpdeErrors& e) {
  return {{"count", e.count},
          {"distance_mae_m", e.distance_mae_m},
          {"angle_mae_deg", e.angle_mae_deg},
          {"angle_unwrapped_mae_deg", e.angle_unwrapped_mae_deg}};
}

// A ratio near 100 or 1000 of most persons is a unit; surely so where nearly all are right in it, and their median is met closely.
LikelyMistake UnitMistake(const PersonPairs& pairs) {
  std::vector<double> ratios;
  for (size_t i = 0; i < pairs.truth.size(); ++i) ratios.push_back(pairs.prediction[i].distance / pairs.truth[i].distance);
  const auto share_within = [&](double low, double high) {
    return static_cast<double>(std::ranges::count_if(ratios, [&](double r) { return r > low && r < high; })) /
           static_cast<double>(ratios.size());
  };
  for (const double factor : {100.0, 1000.0, 0.01, 0.001}) {
    if (share_within(0.7 * factor, 1.4 * factor) <= 0.5) continue;
    const double median = UpperMedian(ratios) / factor;
    return {"distances are about " + NumberText(factor) + " times the truth: are they in " +
                (factor == 100    ? "centimetres"
                 : factor == 1000 ? "millimetres"
                                  : "metres, and the truth is not") +
                "?",
            share_within(factor / 1.25, 1.25 * factor) >= internal::kNearlyAll && std::abs(median - 1) < 0.05};
  }
  return {};
}

// Radians as degrees: all within a turn of radians, and far nearer to the others times 57.3 than as they are or all one.
LikelyMistake RadianMistake(const std::vector<PersonPose>& suspects, const std::vector<PersonPose>& others) {
  constexpr size_t kLeastPersons = 5;
  constexpr double kTurn = 2 * kPi, kRight = 20 * kDegree;
  const size_t n = suspects.size();
  if (n < kLeastPersons) return {};
  double straight = 0, converted = 0, right = 0, x = 0, y = 0;
  for (size_t i = 0; i < n; ++i) {
    const double degrees = suspects[i].angle / kDegree;  // what the file says
    if (std::abs(degrees) > kTurn) return {};
    const double error = std::abs(WrapAngle(degrees - others[i].angle));
    straight += std::abs(WrapAngle(suspects[i].angle - others[i].angle)) / static_cast<double>(n);
    converted += error / static_cast<double>(n);
    right += error < kRight ? 1 / static_cast<double>(n) : 0;
    x += std::cos(others[i].angle), y += std::sin(others[i].angle);
  }
  double same = 0;  // error of one angle for all
  for (const PersonPose& other : others) same += std::abs(WrapAngle(std::atan2(y, x) - other.angle)) / static_cast<double>(n);
  if (straight <= kRight || converted >= 0.5 * straight) return {};
  return {"angles lie within a turn of radians and fit far better as such: angle_deg is degrees",
          right >= internal::kNearlyAll && converted < 0.5 * same};
}

void RunMpde(const MpdeArguments& a, const GlobalOptions& globals) {
  if (!a.protocol.empty() && a.protocol != "monoloco")
    throw InputError("--protocol: " +
                     UnknownChoiceMessage("protocol of distances of people", a.protocol, std::vector<std::string>{"monoloco"}));
  const PersonPairs pairs = ReadPersonFiles(a.pred, a.gt);
  Json json = MpdeJson(MeasureMpde(pairs.prediction, pairs.truth));
  JudgeMistakes({{a.pred, UnitMistake(pairs)}}, a.force, json);
  JudgeMistakes({{a.pred, RadianMistake(pairs.prediction, pairs.truth)}}, a.force, json);
  JudgeMistakes({{a.gt, RadianMistake(pairs.truth, pairs.prediction)}}, a.force, json);
  const auto groups = MeasureMpdeGroups(pairs.prediction, pairs.truth);
  constexpr std::array<const char*, 4> kGroups = {"below_10_m", "10_to_20_m", "20_to_30_m", "from_30_m"};
  for (size_t g = 0; g < groups.size(); ++g) json["by_distance"][kGroups[g]] = MpdeJson(groups[g]);
  const std::vector<std::string> names = {"distance_mae_m", "angle_mae_deg", "angle_unwrapped_mae_deg"};
  std::vector<MpdeErrors> single;
  for (size_t i = 0; i < pairs.ids.size(); ++i) single.push_back(MeasureMpde({&pairs.prediction[i], 1}, {&pairs.truth[i], 1}));
  AppendIntervals(json, a.report, globals.seed, single.size(), names, [&](std::span<const uint32_t> draws) {
    std::vector<MpdeErrors> drawn = single;
    for (size_t i = 0; i < drawn.size(); ++i) drawn[i].count = draws[i];
    const MpdeErrors pooled = PoolMpde(drawn);
    return std::vector<double>{pooled.distance_mae_m, pooled.angle_mae_deg, pooled.angle_unwrapped_mae_deg};
  });
  std::vector<std::vector<std::string>> rows = {{"id", "distance_m", "true_distance_m", "distance_error_m", "angle_error_deg"}};
  for (size_t i = 0; i < single.size(); ++i)
    rows.push_back({pairs.ids[i], NumberText(pairs.prediction[i].distance), NumberText(pairs.truth[i].distance),
                    NumberText(single[i].distance_mae_m), NumberText(single[i].angle_mae_deg)});
  WriteCsv(a.report.csv, rows);
  json["notes"].push_back(
      "angle_mae_deg is the shorter way round; angle_unwrapped_mae_deg is MonoLoco's: angles are not wrapped after the difference, and degrees are rad * 180 / 3.14");
  if (pairs.extra > 0)
    json["notes"].push_back(std::to_string(pairs.extra) + (pairs.extra == 1 ? " predicted person has" : " predicted persons have") +
                            " no truth and are left out, '" + pairs.first_extra + "' first");
  if (globals.json)
    PrintJson(json);
  else
    PrintFigures(json);
}

}  // namespace

void AddEvalLayout(CLI::App& command, GlobalOptions& globals) {
  CLI::App* layout = command.add_subcommand("layout", "errors of room layouts: 2D and 3D IoU, corners, pixels");
  const auto a = std::make_shared<LayoutArguments>();
  layout->add_option("pred", a->pred, "corners: .txt of lines \"x y\", ceiling and floor in turn, .json with uv, or a folder of them")
      ->required();
  layout->add_option("gt", a->gt, "the truth: the same, with the same names")->required();
  layout->add_option("--size", a->size, "WIDTHxHEIGHT of the panoramas (default 1024x512)");
  AddReportFlags(*layout, a->report, "a row a room");
  layout->callback([a, &globals] { RunLayout(*a, globals); });
}

void AddEvalMpde(CLI::App& command, GlobalOptions& globals) {
  CLI::App* mpde = command.add_subcommand("mpde", "errors of distance and orientation of people");
  const auto a = std::make_shared<MpdeArguments>();
  mpde->add_option("pred", a->pred, ".json or .jsonl of persons: id, distance or xyz (metres), angle_deg or yaw_deg")->required();
  mpde->add_option("gt", a->gt, "the truth: the same ids")->required();
  mpde->add_option("--protocol", a->protocol, "monoloco: its figures are always among those given");
  AddForceFlag(*mpde, a->force);
  AddReportFlags(*mpde, a->report, "a row a person");
  mpde->callback([a, &globals] { RunMpde(*a, globals); });
}

}  // namespace airsim360
