// airsim360 eval semantic: mIoU of label pictures.
#include <algorithm>
#include <cmath>
#include <memory>

#include "airsim360/app/eval/eval_commands.h"
#include "airsim360/app/eval/eval_sheet.h"
#include "airsim360/app/eval/eval_views.h"
#include "airsim360/app/flags/arguments.h"
#include "airsim360/base/error.h"
#include "airsim360/eval/files/class_file.h"
#include "airsim360/eval/files/file_pairs.h"
#include "airsim360/eval/files/picture_files.h"
#include "airsim360/eval/mistakes/likely_cause.h"
#include "airsim360/eval/semantic/confusion.h"

namespace airsim360 {
namespace {

using Json = nlohmann::ordered_json;

struct SemanticArguments {
  std::string pred, gt, classes, protocol;
  std::vector<std::string> ignore, held_out;
  ViewOptions view;
  ReportOptions report;
  SheetOptions sheet;
};

struct SemanticResult {
  std::vector<Confusion> views, rolled;
  LikelyMistake mistake;
  int64_t unknown = 0;  // predicted ids that are no class, or an ignored one
};

constexpr uint32_t kVoidLabel = 0xffffffff;

// Index of a class by id.
using ClassIndex = std::vector<uint16_t>;

constexpr const char* kWildpassQuirk =
    "wildpass: pictures are brought to 1024x512 (nearest pixel) before they are compared; truths of 255 are left out, where its evaluator "
    "counts predictions of its classes as wrong";

size_t FindClass(const std::vector<LabelClass>& classes, const std::string& name, const char* flag) {
  std::vector<std::string> names;
  for (size_t c = 0; c < classes.size(); ++c) {
    if (classes[c].name == name || std::to_string(classes[c].id) == name) return c;
    names.push_back(classes[c].name);
  }
  throw InputError(std::string(flag) + ": " + UnknownChoiceMessage("class", name, names));
}

// What is asked of every pair.
struct SemanticTask {
  ClassIndex index, listed;  // of the classes that count; of all in the file
  size_t classes = 0;
  bool panorama = true;
};

ClassIndex IndexClasses(const std::vector<LabelClass>& classes) {
  ClassIndex index(65536, Confusion::kOther);
  for (size_t c = 0; c < classes.size(); ++c) index[classes[c].id] = static_cast<uint16_t>(c);
  return index;
}

std::vector<uint16_t> ClassesOf(const LabelPicture& picture, const ClassIndex& index) {
  std::vector<uint16_t> classes;
  classes.reserve(picture.ids.size());
  for (const uint32_t id : picture.ids) classes.push_back(id < index.size() ? index[id] : Confusion::kOther);
  return classes;
}

// Of another size than the truth only where a protocol brings both to its own.
LabelPicture ReadPrediction(const std::filesystem::path& path, const LabelPicture& gt, const std::filesystem::path& gt_path,
                            const ViewOptions& options) {
  LabelPicture pred = ReadLabelPicture(path);
  const bool resized =
      options.resize_width > 0 && options.seam == 0 && options.bands == 0 && options.rolled.empty() && options.turned.empty();
  if ((pred.width != gt.width || pred.height != gt.height) && !resized)
    throw InputError(path.string() + " has " + std::to_string(pred.width) + "x" + std::to_string(pred.height) + " pixels, " +
                     gt_path.string() + " has " + std::to_string(gt.width) + "x" + std::to_string(gt.height) +
                     ": resize the predictions (nearest pixel)");
  return pred;
}

Confusion Measure(const std::vector<uint16_t>& pred, const std::vector<uint16_t>& gt, const PixelView& view, size_t classes) {
  Confusion confusion(classes);
  if (view.source.empty())
    confusion.Add(pred, gt, view.weights);
  else
    confusion.Add(Take<uint16_t>(pred, view), Take<uint16_t>(gt, view), view.weights);
  return confusion;
}

SemanticResult MeasurePair(const FilePair& pair, const std::vector<FilePairs>& rolled, const std::vector<Rolled>& turns, size_t i,
                           const SemanticTask& task, ViewCache& cache, const ViewOptions& options) {
  const LabelPicture gt = ReadLabelPicture(pair.truth), pred = ReadPrediction(pair.prediction, gt, pair.truth, options);
  const auto views = cache.Of(gt.width, gt.height);
  const std::vector<uint16_t> gt_classes = ClassesOf(gt, task.index), pred_classes = ClassesOf(pred, task.index);
  SemanticResult result;
  for (const uint16_t c : pred_classes) result.unknown += c == Confusion::kOther;
  if (pred.width != gt.width || pred.height != gt.height) {
    const auto bring = [&](const std::vector<uint16_t>& ids, const LabelPicture& of) {
      return Take<uint16_t>(ids, ResizedView(of.width, of.height, options.resize_width, options.resize_height));
    };
    result.views.push_back(Measure(bring(pred_classes, pred), bring(gt_classes, gt), PixelView{}, task.classes));
    return result;
  }
  std::vector<uint32_t> truths = gt.ids;
  for (size_t p = 0; p < truths.size(); ++p) {
    if (gt_classes[p] == Confusion::kOther) truths[p] = kVoidLabel;
  }
  const auto is_class = [&](uint32_t id) { return id < task.listed.size() && task.listed[id] != Confusion::kOther; };
  result.mistake =
      LikelyLabelMistake(pred.ids, truths, gt.width, gt.height,
                         {.void_label = kVoidLabel, .panorama = task.panorama && gt.width == 2 * gt.height, .is_class = is_class});
  if (!result.mistake.sure && std::ranges::none_of(pred.ids, is_class))
    result.mistake = {
        "no predicted pixel is of a class of the file (the first is " + std::to_string(pred.ids[0]) + "): are they other ids, or a mask?",
        true};
  for (const PixelView& view : *views) result.views.push_back(Measure(pred_classes, gt_classes, view, task.classes));
  for (size_t r = 0; r < turns.size(); ++r) {
    const LabelPicture turned = ReadPrediction(rolled[r].pairs[i].prediction, gt, pair.truth, options);
    result.rolled.push_back(
        Measure(turns[r].Back<uint16_t>(ClassesOf(turned, task.index), gt.width), gt_classes, views->front(), task.classes));
  }
  return result;
}

std::vector<Figure> FiguresOf(const Confusion& c) {
  return {{"miou", c.MeanIou()},
          {"miou_present", c.MeanIouOfPresent()},
          {"pixel_accuracy", c.PixelAccuracy()},
          {"macc", c.MeanAccuracy()},
          {"fwiou", c.FrequencyWeightedIou()}};
}

template <class Of>
Confusion Sum(const std::vector<SemanticResult>& results, size_t classes, const Of& of, std::span<const uint32_t> draws = {}) {
  Confusion sum(classes);
  for (size_t i = 0; i < results.size(); ++i) {
    const uint32_t times = draws.empty() ? 1 : draws[i];
    if (times > 0) sum.Add(of(results[i]), times);
  }
  return sum;
}

Json PerClass(const Confusion& c, const std::vector<LabelClass>& classes) {
  Json list = Json::object();
  for (size_t k = 0; k < classes.size(); ++k)
    list[classes[k].name] = {
        {"id", classes[k].id}, {"iou", c.Iou(k)}, {"acc", c.Accuracy(k)}, {"truth", c.True(k)}, {"predicted", c.Predicted(k)}};
  return list;
}

void WriteTable(const std::string& path, const Confusion& c, const std::vector<LabelClass>& classes) {
  std::vector<std::vector<std::string>> rows = {{"class", "id", "iou", "acc", "truth", "predicted"}};
  for (size_t k = 0; k < classes.size(); ++k)
    rows.push_back({classes[k].name, std::to_string(classes[k].id), NumberText(c.Iou(k)), NumberText(c.Accuracy(k)), NumberText(c.True(k)),
                    NumberText(c.Predicted(k))});
  WriteCsv(path, rows);
}

// mIoU of the classes that training has seen and of those that it has not.
Json OpenWorld(const Confusion& c, const std::vector<LabelClass>& classes, const std::vector<std::string>& held_out) {
  std::vector<bool> held(classes.size(), false);
  for (const std::string& name : held_out) held[FindClass(classes, name, "--open-world")] = true;
  double sums[2] = {0, 0}, counts[2] = {0, 0};
  for (size_t k = 0; k < classes.size(); ++k) {
    if (std::isnan(c.Iou(k))) continue;
    sums[held[k]] += c.Iou(k);
    counts[held[k]] += 1;
  }
  return {{"held_out", held_out}, {"miou_known", sums[0] / counts[0]}, {"miou_held_out", sums[1] / counts[1]}};
}

void Check(SemanticArguments& a) {
  if (a.protocol == "wildpass")
    a.view.resize_width = 1024, a.view.resize_height = 512;
  else if (!a.protocol.empty())
    throw InputError("--protocol: " +
                     UnknownChoiceMessage("protocol of semantic pictures", a.protocol, std::vector<std::string>{"wildpass"}));
  CheckViewOptions(a.view);
  CheckSheetOptions(a.sheet);
  if (a.view.resize_width > 0 && (a.view.weights != "pixel" || a.view.projection != "erp"))
    throw InputError("--protocol wildpass counts pixels of its own size: leave --weights and --projection out");
}

Json Notes(const SemanticArguments& a, const FilePairs& files, const std::vector<SemanticResult>& results) {
  Json notes = files.notes;
  notes.push_back(
      "one confusion table of all pictures; classes that neither truth nor prediction has are left out of means, truths that are no class are ignored");
  if (!a.protocol.empty()) notes.push_back(kWildpassQuirk);
  int64_t unknown = 0;
  for (const SemanticResult& r : results) unknown += r.unknown;
  if (unknown > 0)
    notes.push_back(std::to_string(unknown) + " predicted pixels are of no class of the file" +
                    (a.ignore.empty() ? "" : ", or of an ignored one") + ": where the truth has one they are wrong");
  return notes;
}

void Run(SemanticArguments a, const GlobalOptions& globals) {
  Check(a);
  std::vector<LabelClass> classes = ReadClassFile(a.classes);
  SemanticTask task;
  task.listed = IndexClasses(classes);
  // Their truths do not count, so their own IoU means nothing; where others are taken for them is an error of the others.
  for (const std::string& name : a.ignore)
    classes.erase(classes.begin() + static_cast<std::ptrdiff_t>(FindClass(classes, name, "--ignore")));
  if (classes.empty()) throw InputError("--ignore: leaves no class of " + a.classes);
  task.index = IndexClasses(classes);
  task.classes = classes.size();
  for (const std::string& name : a.held_out) FindClass(classes, name, "--open-world");

  const std::vector<std::string> endings = {".png", ".npy"};
  const FilePairs files = PairFiles(a.pred, a.gt, endings, "semantic");
  CheckDatasetFiles(a.gt, {"semantic"});
  task.panorama = ArePanoramas(a.view, {a.gt, a.pred});
  const std::vector<Rolled> turns = ParseRolled(a.view);
  std::vector<FilePairs> rolled;
  for (const Rolled& turn : turns) rolled.push_back(PairFiles(turn.path, a.gt, endings, "semantic"));
  ViewCache cache(a.view);
  const size_t n = classes.size();
  const auto results = MeasureAll<SemanticResult>(
      "eval semantic", files.pairs.size(), [&](size_t i) { return MeasurePair(files.pairs[i], rolled, turns, i, task, cache, a.view); });

  const auto of_view = [&](size_t view, std::span<const uint32_t> draws = {}) {
    return Sum(
        results, n, [view](const SemanticResult& r) -> const Confusion& { return r.views[view]; }, draws);
  };
  Json json;
  JudgeMistakes(results, a.view.force, json, [&](size_t i) { return files.pairs[i].prediction.string(); });
  const Confusion whole = of_view(0);
  if (std::isnan(whole.PixelAccuracy())) throw InputError(a.gt + ": no pixel is of a class of " + a.classes);
  const std::vector<Figure> main = FiguresOf(whole);
  json.update(ToJson(main));
  json["pictures"] = results.size();
  json["weights"] = a.view.weights;
  json["projection"] = a.view.projection;
  json["per_class"] = PerClass(whole, classes);
  if (!a.held_out.empty()) json["open_world"] = OpenWorld(whole, classes, a.held_out);
  AppendViews(json, a.view, [&](size_t view) { return ToJson(FiguresOf(of_view(view))); });
  std::vector<std::vector<Figure>> turned;
  for (size_t r = 0; r < turns.size(); ++r)
    turned.push_back(FiguresOf(Sum(results, n, [r](const SemanticResult& one) -> const Confusion& { return one.rolled[r]; })));
  AppendRolled(json, turns, turned, main);
  std::vector<std::string> names;
  for (const Figure& figure : main) names.push_back(figure.first);
  AppendIntervals(json, a.report, globals.seed, results.size(), names, [&](std::span<const uint32_t> draws) {
    std::vector<double> values;
    for (const Figure& figure : FiguresOf(of_view(0, draws))) values.push_back(figure.second);
    return values;
  });
  WriteTable(a.report.csv, whole, classes);
  std::vector<SheetItem> items;
  for (size_t i = 0; i < results.size(); ++i) items.push_back({i, files.pairs[i].name, 1 - results[i].views[0].PixelAccuracy()});
  AppendWorst(json, a.sheet, items, "pixel_error", [&](size_t i) {
    const LabelPicture gt = ReadLabelPicture(files.pairs[i].truth);
    return LabelStrip(ReadPrediction(files.pairs[i].prediction, gt, files.pairs[i].truth, ViewOptions{}), gt);
  });
  json["notes"] = Notes(a, files, results);
  if (globals.json) {
    PrintJson(json);
    return;
  }
  PrintFigures(json);
  for (size_t k = 0; k < n; ++k) std::printf("  %-30s iou %8.4f  acc %8.4f\n", classes[k].name.c_str(), whole.Iou(k), whole.Accuracy(k));
}

}  // namespace

void AddEvalSemantic(CLI::App& command, GlobalOptions& globals) {
  CLI::App* semantic = command.add_subcommand("semantic", "mIoU of label pictures");
  const auto a = std::make_shared<SemanticArguments>();
  semantic->add_option("pred", a->pred, "label .png (gray or palette) or .npy, a folder of them, or a dataset of ours (its semantic)")
      ->required();
  semantic->add_option("gt", a->gt, "the truth: the same, with the same names")->required();
  semantic->add_option("--classes", a->classes, "classes and their ids: .json (a list of id and name, or meta.json) or lines \"id name\"")
      ->required();
  semantic->add_option("--ignore", a->ignore, "classes that do not count, by name or id: neither their truths nor their IoU")
      ->delimiter(',');
  semantic
      ->add_option("--open-world", a->held_out, "classes that training has not seen, by name or id: their mIoU beside that of the others")
      ->delimiter(',');
  semantic->add_option("--protocol", a->protocol, "wildpass: as that benchmark measures");
  AddViewFlags(*semantic, a->view);
  AddReportFlags(*semantic, a->report, "a row a class");
  AddSheetFlags(*semantic, a->sheet);
  semantic->callback([a, &globals] { Run(*a, globals); });
}

}  // namespace airsim360
