// airsim360 eval flow: errors of optical flow.
#include <limits>
#include <memory>

#include "airsim360/app/arguments.h"
#include "airsim360/app/eval_commands.h"
#include "airsim360/app/eval_views.h"
#include "airsim360/base/error.h"
#include "airsim360/eval/files/file_pairs.h"
#include "airsim360/eval/files/picture_files.h"
#include "airsim360/eval/flow/flow_metrics.h"

namespace airsim360 {
namespace {

using Json = nlohmann::ordered_json;

struct FlowResult {
  std::vector<FlowErrors> views;
  LikelyMistake mistake;
};

struct FlowArguments {
  std::string pred, gt;
  bool visible = false;
  ViewOptions view;
  ReportOptions report;
};

FlowResult MeasurePair(const FilePair& pair, const FlowArguments& a, bool panoramas, ViewCache& cache) {
  const NumberPicture pred = ReadFlowPicture(pair.prediction, false), gt = ReadFlowPicture(pair.truth, a.visible);
  if (pred.width != gt.width || pred.height != gt.height)
    throw InputError(pair.prediction.string() + " has " + std::to_string(pred.width) + "x" + std::to_string(pred.height) + " pixels, " +
                     pair.truth.string() + " has " + std::to_string(gt.width) + "x" + std::to_string(gt.height));
  const bool panorama = panoramas && gt.width == 2 * gt.height;
  FlowResult result;
  result.mistake = LikelyFlowMistake(pred.values, gt.values, gt.width, gt.height, panorama);
  for (const PixelView& view : *cache.Of(gt.width, gt.height)) {
    try {
      std::vector<double> p, g;
      for (const uint32_t i : view.source) {
        p.insert(p.end(), {pred.values[2 * size_t{i}], pred.values[2 * size_t{i} + 1]});
        g.insert(g.end(), {gt.values[2 * size_t{i}], gt.values[2 * size_t{i} + 1]});
      }
      const bool all = view.source.empty();
      result.views.push_back(
          MeasureFlow(all ? pred.values : p, all ? gt.values : g, gt.width, gt.height, panorama, view.source, view.weights));
    } catch (const InputError& error) {
      throw InputError(pair.prediction.string() + ": " + error.what());
    }
  }
  return result;
}

std::vector<double> MeanFigures(const std::vector<FlowResult>& results, size_t view, std::span<const uint32_t> draws = {}) {
  std::vector<double> sums(kFlowFigures.size(), 0);
  double count = 0;
  for (size_t i = 0; i < results.size(); ++i) {
    const double times = draws.empty() ? 1 : draws[i];
    if (results[i].views[view].valid == 0 || times == 0) continue;
    const auto figures = Figures(results[i].views[view]);
    for (size_t f = 0; f < sums.size(); ++f) sums[f] += times * figures[f];
    count += times;
  }
  for (double& sum : sums) sum = count > 0 ? sum / count : std::numeric_limits<double>::quiet_NaN();
  return sums;
}

Json ViewJson(const std::vector<FlowResult>& results, size_t view) {
  const std::vector<double> means = MeanFigures(results, view);
  Json json;
  int64_t valid = 0;
  for (size_t f = 0; f < means.size(); ++f) json[std::string(kFlowFigures[f])] = means[f];
  for (const FlowResult& result : results) valid += result.views[view].valid;
  json["valid"] = valid;
  return json;
}

void Run(const FlowArguments& a, const GlobalOptions& globals) {
  CheckViewOptions(a.view);
  const bool panorama = ArePanoramas(a.view, {a.pred, a.gt});
  const FilePairs files = PairFiles(a.pred, a.gt, {".flo", ".npy", ".exr", ".png"}, "flow");
  CheckDatasetFiles(a.gt, {"flow"});
  ViewCache cache(a.view);
  const auto results =
      MeasureAll<FlowResult>("eval flow", files.pairs.size(), [&](size_t i) { return MeasurePair(files.pairs[i], a, panorama, cache); });
  Json json = ViewJson(results, 0);
  JudgeMistakes(results, a.view.force, json, [&](size_t i) { return files.pairs[i].prediction.string(); });
  if (json["valid"].get<int64_t>() == 0) throw InputError(a.gt + ": no pixel has a flow");
  json["pictures"] = results.size();
  json["weights"] = a.view.weights;
  json["projection"] = a.view.projection;
  AppendViews(json, a.view, [&](size_t view) { return ViewJson(results, view); });
  const std::vector<std::string> names(kFlowFigures.begin(), kFlowFigures.end());
  AppendIntervals(json, a.report, globals.seed, results.size(), names,
                  [&](std::span<const uint32_t> draws) { return MeanFigures(results, 0, draws); });
  std::vector<std::vector<std::string>> rows = {{"picture", "valid"}};
  rows[0].insert(rows[0].end(), names.begin(), names.end());
  for (size_t i = 0; i < results.size(); ++i) {
    auto& row = rows.emplace_back(std::vector<std::string>{files.pairs[i].name, std::to_string(results[i].views[0].valid)});
    for (const double value : Figures(results[i].views[0])) row.push_back(NumberText(value));
  }
  WriteCsv(a.report.csv, rows);
  Json notes = files.notes;
  notes.push_back("figures of each picture, then their mean; in panoramas dx is taken the shorter way round");
  json["notes"] = notes;
  WarnOfEmptyTruths(json, files.pairs, [&](size_t i) { return results[i].views[0].valid; });
  if (globals.json)
    PrintJson(json);
  else
    PrintFigures(json);
}

}  // namespace

void AddEvalFlow(CLI::App& command, GlobalOptions& globals) {
  CLI::App* flow = command.add_subcommand("flow", "errors of optical flow: EPE, Fl-all, angle on the sphere");
  const auto a = std::make_shared<FlowArguments>();
  flow->add_option("pred", a->pred, ".flo, .npy, .exr or KITTI's .png, a folder of them, or a dataset of ours (its flow)")->required();
  flow->add_option("gt", a->gt, "the truth: the same, with the same names")->required();
  flow->add_flag("--visible", a->visible, "leave out what the truth's channel `occluded` says is hidden in the next picture (.exr)");
  AddViewFlags(*flow, a->view, false);
  AddReportFlags(*flow, a->report, "a row a picture");
  flow->callback([a, &globals] { Run(*a, globals); });
}

}  // namespace airsim360
