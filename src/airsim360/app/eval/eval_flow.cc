// airsim360 eval flow: errors of optical flow.
#include <limits>
#include <memory>

#include "airsim360/app/eval/eval_commands.h"
#include "airsim360/app/eval/eval_sheet.h"
#include "airsim360/app/eval/eval_views.h"
#include "airsim360/app/flags/arguments.h"
#include "airsim360/base/error.h"
#include "airsim360/eval/files/file_pairs.h"
#include "airsim360/eval/files/picture_files.h"
#include "airsim360/eval/flow/flow_metrics.h"
#include "airsim360/eval/sphere/panorama_ray.h"

namespace airsim360 {
namespace {

using Json = nlohmann::ordered_json;

const std::vector<std::string> kEndings = {".flo", ".npy", ".exr", ".png"};

struct FlowResult {
  std::vector<FlowErrors> views, rolled;
  LikelyMistake mistake;
};

struct FlowArguments {
  std::string pred, gt;
  bool visible = false;
  ViewOptions view;
  ReportOptions report;
  SheetOptions sheet;
};

std::pair<NumberPicture, NumberPicture> ReadPair(const FilePair& pair, bool visible) {
  NumberPicture pred = ReadFlowPicture(pair.prediction, false), gt = ReadFlowPicture(pair.truth, visible);
  if (pred.width != gt.width || pred.height != gt.height)
    throw InputError(pair.prediction.string() + " has " + std::to_string(pred.width) + "x" + std::to_string(pred.height) + " pixels, " +
                     pair.truth.string() + " has " + std::to_string(gt.width) + "x" + std::to_string(gt.height));
  return {std::move(pred), std::move(gt)};
}

FlowErrors MeasureView(const std::vector<double>& pred, const NumberPicture& gt, bool panorama, const PixelView& view) {
  if (view.source.empty()) return MeasureFlow(pred, gt.values, gt.width, gt.height, panorama, view.source, view.weights);
  std::vector<double> p, g;
  for (const uint32_t i : view.source) {
    p.insert(p.end(), {pred[2 * size_t{i}], pred[2 * size_t{i} + 1]});
    g.insert(g.end(), {gt.values[2 * size_t{i}], gt.values[2 * size_t{i} + 1]});
  }
  return MeasureFlow(p, g, gt.width, gt.height, panorama, view.source, view.weights);
}

// What was predicted in a picture that was moved, of the one that was not. A flow along the columns stays what it is.
std::vector<double> FlowBack(const NumberPicture& pred, const Rolled& rolled) {
  if (rolled.turn_deg) {
    const Vec3d turn = *rolled.turn_deg * kDegree;
    return TurnFlowBack(pred.values, pred.width, pred.height, TurnedCamera(turn.x, turn.y, turn.z));
  }
  return RollBack<double>(pred.values, 2 * pred.width, 2 * rolled.columns);
}

FlowResult MeasurePair(const FilePair& pair, const std::vector<FilePairs>& rolled, const std::vector<Rolled>& turns, size_t index,
                       const FlowArguments& a, bool panoramas, ViewCache& cache) {
  const auto [pred, gt] = ReadPair(pair, a.visible);
  const bool panorama = panoramas && gt.width == 2 * gt.height;
  FlowResult result;
  result.mistake = LikelyFlowMistake(pred.values, gt.values, gt.width, gt.height, panorama);
  const auto views = cache.Of(gt.width, gt.height);
  std::filesystem::path read = pair.prediction;
  try {
    for (const PixelView& view : *views) result.views.push_back(MeasureView(pred.values, gt, panorama, view));
    for (size_t r = 0; r < turns.size(); ++r) {
      read = rolled[r].pairs[index].prediction;
      const NumberPicture turned = ReadPair(rolled[r].pairs[index], a.visible).first;
      result.rolled.push_back(MeasureView(FlowBack(turned, turns[r]), gt, panorama, views->front()));
    }
  } catch (const InputError& error) {
    throw InputError(read.string() + ": " + error.what());
  }
  return result;
}

// Means over pictures of what of(result) measured of each.
template <class Of>
std::vector<double> MeanFigures(const std::vector<FlowResult>& results, const Of& of, std::span<const uint32_t> draws = {}) {
  std::vector<double> sums(kFlowFigures.size(), 0);
  double count = 0;
  for (size_t i = 0; i < results.size(); ++i) {
    const double times = draws.empty() ? 1 : draws[i];
    const FlowErrors& errors = of(results[i]);
    if (errors.valid == 0 || times == 0) continue;
    const auto figures = Figures(errors);
    for (size_t f = 0; f < sums.size(); ++f) sums[f] += times * figures[f];
    count += times;
  }
  for (double& sum : sums) sum = count > 0 ? sum / count : std::numeric_limits<double>::quiet_NaN();
  return sums;
}

std::vector<double> ViewMeans(const std::vector<FlowResult>& results, size_t view, std::span<const uint32_t> draws = {}) {
  return MeanFigures(
      results, [view](const FlowResult& r) -> const FlowErrors& { return r.views[view]; }, draws);
}

std::vector<Figure> Named(const std::vector<double>& means) {
  std::vector<Figure> figures;
  for (size_t f = 0; f < means.size(); ++f) figures.emplace_back(kFlowFigures[f], means[f]);
  return figures;
}

Json ViewJson(const std::vector<FlowResult>& results, size_t view) {
  Json json = ToJson(Named(ViewMeans(results, view)));
  int64_t valid = 0;
  for (const FlowResult& result : results) valid += result.views[view].valid;
  json["valid"] = valid;
  return json;
}

void Run(FlowArguments a, const GlobalOptions& globals) {
  CheckViewOptions(a.view);
  CheckSheetOptions(a.sheet);
  const bool panorama = ArePanoramas(a.view, {a.pred, a.gt});
  const FilePairs files = PairFiles(a.pred, a.gt, kEndings, "flow");
  CheckDatasetFiles(a.gt, {"flow"});
  const std::vector<Rolled> turns = ParseRolled(a.view);
  std::vector<FilePairs> rolled;
  for (const Rolled& turn : turns) rolled.push_back(PairFiles(turn.path, a.gt, kEndings, "flow"));
  ViewCache cache(a.view);
  const auto results = MeasureAll<FlowResult>("eval flow", files.pairs.size(),
                                              [&](size_t i) { return MeasurePair(files.pairs[i], rolled, turns, i, a, panorama, cache); });
  Json json = ViewJson(results, 0);
  JudgeMistakes(results, a.view.force, json, [&](size_t i) { return files.pairs[i].prediction.string(); });
  if (json["valid"].get<int64_t>() == 0) throw InputError(a.gt + ": no pixel has a flow");
  json["pictures"] = results.size();
  json["weights"] = a.view.weights;
  json["projection"] = a.view.projection;
  AppendViews(json, a.view, [&](size_t view) { return ViewJson(results, view); });
  std::vector<std::vector<Figure>> turned;
  for (size_t r = 0; r < turns.size(); ++r)
    turned.push_back(Named(MeanFigures(results, [r](const FlowResult& one) -> const FlowErrors& { return one.rolled[r]; })));
  AppendRolled(json, turns, turned, Named(ViewMeans(results, 0)));
  const std::vector<std::string> names(kFlowFigures.begin(), kFlowFigures.end());
  AppendIntervals(json, a.report, globals.seed, results.size(), names,
                  [&](std::span<const uint32_t> draws) { return ViewMeans(results, 0, draws); });
  std::vector<std::vector<std::string>> rows = {{"picture", "valid"}};
  rows[0].insert(rows[0].end(), names.begin(), names.end());
  for (size_t i = 0; i < results.size(); ++i) {
    auto& row = rows.emplace_back(std::vector<std::string>{files.pairs[i].name, std::to_string(results[i].views[0].valid)});
    for (const double value : Figures(results[i].views[0])) row.push_back(NumberText(value));
  }
  WriteCsv(a.report.csv, rows);
  std::vector<SheetItem> items;
  for (size_t i = 0; i < results.size(); ++i) items.push_back({i, files.pairs[i].name, results[i].views[0].epe});
  AppendWorst(json, a.sheet, items, "epe", [&](size_t i) {
    const auto [pred, gt] = ReadPair(files.pairs[i], a.visible);
    return FlowStrip(pred, gt, panorama && gt.width == 2 * gt.height);
  });
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
  AddViewFlags(*flow, a->view);
  AddReportFlags(*flow, a->report, "a row a picture");
  AddSheetFlags(*flow, a->sheet);
  flow->callback([a, &globals] { Run(*a, globals); });
}

}  // namespace airsim360
