// airsim360 eval panoptic: panoptic quality.
#include <cmath>
#include <map>
#include <memory>
#include <set>

#include "airsim360/app/eval/eval_commands.h"
#include "airsim360/app/eval/eval_panoptic_input.h"
#include "airsim360/app/eval/eval_sheet.h"
#include "airsim360/app/eval/eval_views.h"
#include "airsim360/app/flags/arguments.h"
#include "airsim360/base/error.h"
#include "airsim360/eval/mistakes/likely_cause.h"

namespace airsim360 {
namespace {

using Json = nlohmann::ordered_json;
using Counts = std::vector<PanopticCount>;

struct PanopticArguments {
  PanopticPaths paths;
  ViewOptions view;
  ReportOptions report;
  SheetOptions sheet;
  std::vector<std::string> held_out;
};

struct PanopticResult {
  std::vector<Counts> views, rolled;
  LikelyMistake mistake;
};

Counts Measure(const LabelPicture& pred, const LabelPicture& gt, const PanopticFrame& pred_frame, const PanopticFrame& gt_frame,
               const PixelView& view, size_t categories) {
  Counts counts(categories);
  PanopticOverlap overlap;
  if (view.source.empty()) {
    overlap.Add(pred.ids, gt.ids, view.weights);
    overlap.Count(pred_frame.segments, gt_frame.segments, counts);
  } else {
    overlap.Add(Take<uint32_t>(pred.ids, view), Take<uint32_t>(gt.ids, view), view.weights);
    overlap.Count(overlap.PresentPredictions(pred_frame.segments), overlap.PresentTruths(gt_frame.segments), counts);
  }
  return counts;
}

PanopticResult MeasureFrame(const PanopticInput& input, size_t i, const std::vector<PanopticInput>& rolled,
                            const std::vector<Rolled>& turns, ViewCache& cache, bool panorama) {
  const size_t categories = input.truth.categories.size();
  const PanopticFrame &gt_frame = input.truth.frames[i], &pred_frame = input.Prediction(i);
  const auto [pred, gt] = input.Read(i);
  const auto views = cache.Of(gt.width, gt.height);
  PanopticResult result;
  try {
    // What is listed and what is drawn must agree in whole pictures, whatever is measured.
    if (!views->front().source.empty()) Measure(pred, gt, pred_frame, gt_frame, PixelView{}, categories);
    for (const PixelView& view : *views) result.views.push_back(Measure(pred, gt, pred_frame, gt_frame, view, categories));
    for (size_t r = 0; r < turns.size(); ++r) {
      LabelPicture turned = rolled[r].Read(i).first;
      turned.ids = turns[r].Back<uint32_t>(turned.ids, turned.width);
      result.rolled.push_back(Measure(turned, gt, rolled[r].Prediction(i), gt_frame, views->front(), categories));
    }
  } catch (const InputError& error) {
    throw InputError("picture " + gt_frame.image + " (" + gt_frame.file + "): " + error.what());
  }
  result.mistake = LikelyLabelMistake(CategoriesOf(pred, pred_frame), CategoriesOf(gt, gt_frame), gt.width, gt.height,
                                      {.void_label = 0, .panorama = panorama && gt.width == 2 * gt.height});
  return result;
}

template <class Of>
Counts Sum(const std::vector<PanopticResult>& results, size_t categories, const Of& of, std::span<const uint32_t> draws = {}) {
  Counts sum(categories);
  for (size_t i = 0; i < results.size(); ++i) {
    AddCounts(of(results[i]), sum, draws.empty() ? 1 : draws[i]);
  }
  return sum;
}

std::vector<Figure> Flat(const Counts& counts, const std::vector<PanopticCategory>& categories) {
  std::vector<Figure> figures;
  for (const auto& [group, chosen] : PanopticGroups(categories)) {
    const PanopticQuality q = MeanQuality(counts, chosen);
    for (const auto& [name, value] : {Figure{"pq", q.pq}, Figure{"sq", q.sq}, Figure{"rq", q.rq}})
      figures.emplace_back(group + "." + name, value);
  }
  return figures;
}

double Whole(const Counts& counts) { return MeanQuality(counts, std::vector<bool>(counts.size(), true)).pq; }

void WriteTable(const std::string& path, const Counts& counts, const std::vector<PanopticCategory>& categories) {
  std::vector<std::vector<std::string>> rows = {{"category", "id", "thing", "pq", "sq", "rq", "tp", "fp", "fn"}};
  for (size_t c = 0; c < counts.size(); ++c) {
    const PanopticQuality q = QualityOf(counts[c]);
    rows.push_back({categories[c].name, std::to_string(categories[c].id), categories[c].thing ? "1" : "0", NumberText(q.pq),
                    NumberText(q.sq), NumberText(q.rq), std::to_string(counts[c].tp), std::to_string(counts[c].fp),
                    std::to_string(counts[c].fn)});
  }
  WriteCsv(path, rows);
}

Json OpenWorld(const Counts& counts, const std::vector<PanopticCategory>& categories, const std::vector<std::string>& held_out) {
  const std::vector<bool> held = ChooseCategories(categories, held_out, "--open-world");
  std::vector<bool> known(held);
  known.flip();
  return {{"held_out", held_out}, {"known", QualityJson(MeanQuality(counts, known))}, {"unknown", QualityJson(MeanQuality(counts, held))}};
}

void Run(PanopticArguments a, const GlobalOptions& globals) {
  CheckViewOptions(a.view);
  CheckSheetOptions(a.sheet);
  CheckTruthFiles(a.paths);
  const PanopticInput input(a.paths);
  const auto& categories = input.truth.categories;
  ChooseCategories(categories, a.held_out, "--open-world");
  const bool panorama = ArePanoramas(a.view, {a.paths.gt, a.paths.pred});
  const std::vector<Rolled> turns = ParseRolled(a.view);
  std::vector<PanopticInput> rolled;
  for (const Rolled& turn : turns) rolled.emplace_back(PanopticPaths{turn.path, a.paths.gt, "", a.paths.gt_dir});
  ViewCache cache(a.view);
  const auto results = MeasureAll<PanopticResult>("eval panoptic", input.truth.frames.size(),
                                                  [&](size_t i) { return MeasureFrame(input, i, rolled, turns, cache, panorama); });

  const auto of_view = [&](size_t view, std::span<const uint32_t> draws = {}) {
    return Sum(
        results, categories.size(), [view](const PanopticResult& r) -> const Counts& { return r.views[view]; }, draws);
  };
  Json json;
  JudgeMistakes(results, a.view.force, json, [&](size_t i) { return input.Prediction(i).file; });
  const Counts whole = of_view(0);
  AppendPanoptic(json, whole, categories, true);
  json["pictures"] = results.size();
  json["weights"] = a.view.weights;
  json["projection"] = a.view.projection;
  if (!a.held_out.empty()) json["open_world"] = OpenWorld(whole, categories, a.held_out);
  AppendViews(json, a.view, [&](size_t view) {
    Json one;
    AppendPanoptic(one, of_view(view), categories, false);
    return one;
  });
  const std::vector<Figure> main = Flat(whole, categories);
  std::vector<std::vector<Figure>> turned;
  for (size_t r = 0; r < turns.size(); ++r)
    turned.push_back(
        Flat(Sum(results, categories.size(), [r](const PanopticResult& one) -> const Counts& { return one.rolled[r]; }), categories));
  AppendRolled(json, turns, turned, main);
  std::vector<std::string> names;
  for (const Figure& figure : main) names.push_back(figure.first);
  AppendIntervals(json, a.report, globals.seed, results.size(), names, [&](std::span<const uint32_t> draws) {
    std::vector<double> values;
    for (const Figure& figure : Flat(of_view(0, draws), categories)) values.push_back(figure.second);
    return values;
  });
  WriteTable(a.report.csv, whole, categories);
  std::vector<SheetItem> items;
  for (size_t i = 0; i < results.size(); ++i) items.push_back({i, input.truth.frames[i].file, 1 - Whole(results[i].views[0])});
  AppendWorst(json, a.sheet, items, "1-pq", [&](size_t i) {
    const auto [pred, gt] = input.Read(i);
    return LabelStrip(pred, gt);
  });
  json["notes"].push_back(
      "areas are counted from the pictures, not read from the JSON; of several crowds of a category the last one excuses predictions, as in panopticapi");
  for (const std::string& note : input.notes) json["notes"].push_back(note);
  for (const std::string& warning : input.warnings) json["warnings"].push_back(warning);
  if (globals.json)
    PrintJson(json);
  else
    PrintPanoptic(json);
}

}  // namespace

void AddEvalPanoptic(CLI::App& command, GlobalOptions& globals) {
  CLI::App* panoptic = command.add_subcommand("panoptic", "panoptic quality: PQ, SQ, RQ");
  const auto a = std::make_shared<PanopticArguments>();
  AddPanopticPaths(*panoptic, a->paths);
  panoptic
      ->add_option("--open-world", a->held_out,
                   "categories that training has not seen, by name or id: their quality beside that of the others")
      ->delimiter(',');
  AddViewFlags(*panoptic, a->view);
  AddReportFlags(*panoptic, a->report, "a row a category");
  AddSheetFlags(*panoptic, a->sheet);
  panoptic->callback([a, &globals] { Run(*a, globals); });
}

}  // namespace airsim360
