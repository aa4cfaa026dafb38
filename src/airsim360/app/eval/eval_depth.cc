// airsim360 eval depth: errors of predicted ranges.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>

#include "airsim360/app/eval/eval_commands.h"
#include "airsim360/app/eval/eval_sheet.h"
#include "airsim360/app/eval/eval_views.h"
#include "airsim360/app/flags/arguments.h"
#include "airsim360/base/error.h"
#include "airsim360/base/file_name.h"
#include "airsim360/eval/depth/depth_metrics.h"
#include "airsim360/eval/files/file_pairs.h"
#include "airsim360/eval/files/picture_files.h"
#include "airsim360/eval/mistakes/likely_cause.h"

namespace airsim360 {
namespace {

using Json = nlohmann::ordered_json;

struct DepthArguments {
  std::string pred, gt, protocol;
  ViewOptions view;
  ReportOptions report;
  SheetOptions sheet;
  DepthFileOptions files;
  double pred_scale = 1, gt_scale = 1, clip_low = 0, clip_high = 0;
  std::vector<double> clip;
  DepthOptions depth;
  bool panorama = true;
  bool png_scale_given = false;
};

struct Protocol {
  const char *name, *quirk;
  double min_depth, max_depth;  // 0 = leave
  bool square_by_square, cos_latitude;
};
constexpr std::array<Protocol, 3> kProtocols = {{
    {"unik3d", "figures of each picture, then their mean; SILog with n - 1; the _si figures after scaling by medians", 0.01, 0, false,
     false},
    {"deep360", "SqRel divides by the square of the truth; shares are fractions here, per cent there", 0, 1000, true, false},
    {"pano3d",
     "weights are the cosine of the latitude of the row's centre, also in the denominator of masked means (their code divides by the unmasked sum)",
     0, 0, false, true},
}};

// What one picture gives: errors of each view, of each rolled prediction, and after scaling; what looks like a mistake.
struct DepthResult {
  std::vector<DepthErrors> views, rolled;
  DepthErrors scaled;
  LikelyMistake mistake;
  std::string shared;  // of the truths
};

const Protocol* FindProtocol(const std::string& name) {
  if (name.empty()) return nullptr;
  std::vector<std::string> names;
  for (const Protocol& protocol : kProtocols) {
    if (name == protocol.name) return &protocol;
    names.emplace_back(protocol.name);
  }
  throw InputError("--protocol: " + UnknownChoiceMessage("protocol of depth", name, names));
}

void ApplyProtocol(const Protocol* protocol, DepthArguments& a) {
  if (!protocol) return;
  if (protocol->min_depth > 0) a.depth.min_depth = std::max(a.depth.min_depth, protocol->min_depth);
  if (protocol->max_depth > 0) a.depth.max_depth = std::min(a.depth.max_depth, protocol->max_depth);
  a.depth.square_by_square = protocol->square_by_square;
  a.view.cos_latitude = protocol->cos_latitude;
  if (protocol->cos_latitude && (a.view.weights != "pixel" || a.view.projection != "erp"))
    throw InputError("--protocol " + a.protocol + " brings its own weights: leave --weights and --projection out");
}

void Check(DepthArguments& a) {
  CheckViewOptions(a.view);
  CheckSheetOptions(a.sheet);
  ApplyProtocol(FindProtocol(a.protocol), a);
  CheckPositive("--pred-scale", a.pred_scale);
  CheckPositive("--gt-scale", a.gt_scale);
  CheckPositive("--png-scale", a.files.png_scale);
  CheckDepthOptions(a.depth);
  if (!a.clip.empty() && !(a.clip[0] > 0 && a.clip[1] > a.clip[0])) throw InputError("--clip: must be 0 < MIN < MAX");
}

NumberPicture ReadScaled(const std::filesystem::path& path, const DepthArguments& a, bool prediction) {
  NumberPicture picture = ReadDepthPicture(path, a.files);
  const double scale = prediction ? a.pred_scale : a.gt_scale;
  for (double& v : picture.values) {
    if (scale != 1) v *= scale;
    if (prediction && !a.clip.empty() && !std::isnan(v)) v = std::clamp(v, a.clip[0], a.clip[1]);
  }
  return picture;
}

void CheckSizes(const NumberPicture& pred, const NumberPicture& gt, const std::filesystem::path& pred_path,
                const std::filesystem::path& gt_path) {
  if (pred.width == gt.width && pred.height == gt.height) return;
  throw InputError(pred_path.string() + " has " + std::to_string(pred.width) + "x" + std::to_string(pred.height) + " pixels, " +
                   gt_path.string() + " has " + std::to_string(gt.width) + "x" + std::to_string(gt.height) +
                   (pred.width == gt.height && pred.height == gt.width ? ": are rows and columns exchanged?" : ": resize the predictions"));
}

DepthErrors Measure(const NumberPicture& pred, const NumberPicture& gt, const PixelView& view, const DepthOptions& options,
                    const std::filesystem::path& path) {
  try {
    if (view.source.empty()) return MeasureDepth(pred.values, gt.values, view.weights, options);
    return MeasureDepth(Take<double>(pred.values, view), Take<double>(gt.values, view), view.weights, options);
  } catch (const InputError& error) {
    throw InputError(path.string() + ": " + error.what() + " (--clip MIN,MAX holds infinite predictions)");
  }
}

// Looks at the truths that count.
void JudgePair(const FilePair& pair, const NumberPicture& pred, const NumberPicture& gt, const DepthArguments& a, DepthResult& result) {
  std::vector<double> truths = gt.values;
  for (double& t : truths) {
    if (!(t > a.depth.min_depth && t <= a.depth.max_depth)) t = 0;
  }
  const bool png = LowerCaseExtension(pair.prediction) == ".png";
  const DepthLook look = {a.panorama && gt.width == 2 * gt.height, png ? a.files.png_scale * a.pred_scale : 0};
  result.mistake = LikelyDepthMistake(pred.values, truths, gt.width, gt.height, look);
  result.shared = SharedMaximum(truths, std::numeric_limits<double>::infinity());
  const double most = 65535 * look.png_scale * (1 - 1e-12);
  const auto saturated = png ? std::count_if(pred.values.begin(), pred.values.end(), [most](double p) { return p >= most; }) : 0;
  if (100 * static_cast<size_t>(saturated) > pred.values.size() && result.mistake.text.empty())
    result.mistake = {std::to_string(saturated) + " predictions are 65535, the largest of a 16-bit PNG: are they cut off there?", false};
}

DepthResult MeasurePair(const FilePair& pair, const std::vector<FilePairs>& rolled, const std::vector<Rolled>& turns, size_t index,
                        const DepthArguments& a, ViewCache& cache) {
  const NumberPicture pred = ReadScaled(pair.prediction, a, true), gt = ReadScaled(pair.truth, a, false);
  CheckSizes(pred, gt, pair.prediction, pair.truth);
  const auto views = cache.Of(gt.width, gt.height);
  DepthResult result;
  JudgePair(pair, pred, gt, a, result);
  for (const PixelView& view : *views) result.views.push_back(Measure(pred, gt, view, a.depth, pair.prediction));
  if (a.protocol == "unik3d") {
    DepthOptions scaled = a.depth;
    scaled.median_scale = true;
    result.scaled = Measure(pred, gt, views->front(), scaled, pair.prediction);
  }
  for (size_t r = 0; r < turns.size(); ++r) {
    NumberPicture turned = ReadScaled(rolled[r].pairs[index].prediction, a, true);
    CheckSizes(turned, gt, rolled[r].pairs[index].prediction, pair.truth);
    turned.values = turns[r].Back<double>(turned.values, turned.width);
    result.rolled.push_back(Measure(turned, gt, views->front(), a.depth, rolled[r].pairs[index].prediction));
  }
  return result;
}

// Means over pictures with valid pixels, `draws[i]` times each.
template <class Of>
std::vector<double> MeanFigures(const std::vector<DepthResult>& results, const Of& of, std::span<const uint32_t> draws = {}) {
  std::vector<double> sums(kDepthFigures.size(), 0);
  double count = 0;
  for (size_t i = 0; i < results.size(); ++i) {
    const DepthErrors& errors = of(results[i]);
    const double times = draws.empty() ? 1 : draws[i];
    if (errors.valid == 0 || times == 0) continue;
    const auto figures = Figures(errors);
    for (size_t f = 0; f < sums.size(); ++f) sums[f] += times * figures[f];
    count += times;
  }
  for (double& sum : sums) sum = count > 0 ? sum / count : std::numeric_limits<double>::quiet_NaN();
  return sums;
}

std::vector<Figure> WithNames(const std::vector<double>& values, const char* suffix = "") {
  std::vector<Figure> figures;
  for (size_t f = 0; f < values.size(); ++f) figures.emplace_back(std::string(kDepthFigures[f]) + suffix, values[f]);
  return figures;
}

int64_t Valid(const std::vector<DepthResult>& results, size_t view) {
  return std::accumulate(results.begin(), results.end(), int64_t{0},
                         [view](int64_t sum, const DepthResult& r) { return sum + r.views[view].valid; });
}

void WriteTable(const std::string& path, const std::vector<FilePair>& pairs, const std::vector<DepthResult>& results) {
  std::vector<std::vector<std::string>> rows = {{"picture", "valid"}};
  for (const auto name : kDepthFigures) rows[0].emplace_back(name);
  for (size_t i = 0; i < results.size(); ++i) {
    auto& row = rows.emplace_back(std::vector<std::string>{pairs[i].name, std::to_string(results[i].views[0].valid)});
    for (const double value : Figures(results[i].views[0])) row.push_back(NumberText(value));
  }
  WriteCsv(path, rows);
}

void AppendNotes(Json& json, const DepthArguments& a, const FilePairs& files, const std::vector<DepthResult>& results) {
  Json notes = files.notes;
  if (const Protocol* protocol = FindProtocol(a.protocol)) notes.push_back(std::string(protocol->name) + ": " + protocol->quirk);
  if (a.depth.min_depth > 0 || std::isfinite(a.depth.max_depth))
    notes.push_back("truths above " + NumberText(a.depth.min_depth) + " m" +
                    (std::isfinite(a.depth.max_depth) ? " and up to " + NumberText(a.depth.max_depth) + " m" : "") + " count");
  WarnOfEmptyTruths(json, files.pairs, [&](size_t i) { return results[i].views[0].valid; });
  const auto shared = std::find_if(results.begin(), results.end(), [](const DepthResult& r) { return !r.shared.empty(); });
  if (shared != results.end())
    json["warnings"].push_back(files.pairs[static_cast<size_t>(shared - results.begin())].truth.string() + ": " + shared->shared);
  int64_t not_positive = 0;
  for (const DepthResult& r : results) not_positive += r.views[0].not_positive;
  if (not_positive > 0)
    json["warnings"].push_back(
        std::to_string(not_positive) +
        " predictions are not above 0: they have no logarithm, so rmselog, log10 and silog are infinite (null); --clip MIN,MAX holds them");
  if (!notes.empty()) json["notes"] = notes;
}

// Flags of a kind of file need one of it.
void CheckFileFlags(const DepthArguments& a, const FilePairs& files) {
  const auto any = [&](std::initializer_list<const char*> endings) {
    return std::any_of(files.pairs.begin(), files.pairs.end(), [&](const FilePair& pair) {
      return std::any_of(endings.begin(), endings.end(), [&](const char* ending) {
        return LowerCaseExtension(pair.prediction) == ending || LowerCaseExtension(pair.truth) == ending;
      });
    });
  };
  if (a.png_scale_given && !any({".png"}))
    throw InputError("--png-scale is for 16-bit PNGs, and no file is one (--pred-scale and --gt-scale are for all)");
  if (!a.files.h5_key.empty() && !any({".h5", ".hdf5"})) throw InputError("--h5-key is for HDF5 files, and no file is one");
}

void Run(DepthArguments a, const GlobalOptions& globals) {
  Check(a);
  const std::vector<std::string> endings = {".npy", ".exr", ".h5", ".hdf5", ".png"};
  const FilePairs files = PairFiles(a.pred, a.gt, endings, "range");
  CheckDatasetFiles(a.gt, {"range"});
  CheckFileFlags(a, files);
  a.panorama = ArePanoramas(a.view, {a.gt, a.pred});
  const std::vector<Rolled> turns = ParseRolled(a.view);
  std::vector<FilePairs> rolled;
  for (const Rolled& turn : turns) rolled.push_back(PairFiles(turn.path, a.gt, endings, "range"));
  ViewCache cache(a.view);
  const auto results = MeasureAll<DepthResult>("eval depth", files.pairs.size(),
                                               [&](size_t i) { return MeasurePair(files.pairs[i], rolled, turns, i, a, cache); });

  const auto of_view = [&](size_t view, std::span<const uint32_t> draws = {}) {
    return MeanFigures(
        results, [view](const DepthResult& r) -> const DepthErrors& { return r.views[view]; }, draws);
  };
  Json json;
  const std::vector<Figure> main = WithNames(of_view(0));
  json.update(ToJson(main));
  json["valid"] = Valid(results, 0);
  json["pictures"] = results.size();
  json["weights"] = a.view.cos_latitude ? "cos_latitude" : a.view.weights;
  json["projection"] = a.view.projection;
  if (!a.protocol.empty()) json["protocol"] = a.protocol;
  if (a.protocol == "unik3d")
    json.update(ToJson(WithNames(MeanFigures(results, [](const DepthResult& r) -> const DepthErrors& { return r.scaled; }), "_si")));
  JudgeMistakes(results, a.view.force, json, [&](size_t i) { return files.pairs[i].prediction.string(); });
  if (Valid(results, 0) == 0) throw InputError(a.gt + ": " + NoDepthText(a.depth));
  AppendViews(json, a.view, [&](size_t view) {
    Json one = ToJson(WithNames(of_view(view)));
    one["valid"] = Valid(results, view);
    return one;
  });
  std::vector<std::vector<Figure>> turned;
  for (size_t r = 0; r < turns.size(); ++r)
    turned.push_back(WithNames(MeanFigures(results, [r](const DepthResult& one) -> const DepthErrors& { return one.rolled[r]; })));
  AppendRolled(json, turns, turned, main);
  std::vector<std::string> names(kDepthFigures.begin(), kDepthFigures.end());
  AppendIntervals(json, a.report, globals.seed, results.size(), names, [&](std::span<const uint32_t> draws) { return of_view(0, draws); });
  WriteTable(a.report.csv, files.pairs, results);

  std::vector<SheetItem> items;
  for (size_t i = 0; i < results.size(); ++i) items.push_back({i, files.pairs[i].name, results[i].views[0].absrel});
  AppendWorst(json, a.sheet, items, "absrel", [&](size_t i) {
    return DepthStrip(ReadScaled(files.pairs[i].prediction, a, true), ReadScaled(files.pairs[i].truth, a, false));
  });

  AppendNotes(json, a, files, results);
  if (globals.json)
    PrintJson(json);
  else
    PrintFigures(json);
}

}  // namespace

void AddEvalDepth(CLI::App& command, GlobalOptions& globals) {
  CLI::App* depth = command.add_subcommand("depth", "errors of predicted ranges or depths");
  const auto a = std::make_shared<DepthArguments>();
  depth->add_option("pred", a->pred, ".npy, .exr, .h5 or 16-bit .png, a folder of them, or a dataset of ours (its range)")->required();
  depth->add_option("gt", a->gt, "the truth: the same, with the same names")->required();
  depth->add_option("--protocol", a->protocol, "unik3d, deep360 or pano3d: as those papers' code measures");
  depth->add_option("--min-depth", a->depth.min_depth, "truths above this count, metres (default 0)");
  depth->add_option("--max-depth", a->depth.max_depth, "truths up to this count, metres");
  depth->add_option("--clip", a->clip, "MIN,MAX: hold predictions within, metres")->delimiter(',')->expected(2);
  depth->add_option("--pred-scale", a->pred_scale, "metres a unit of predictions (default 1)");
  depth->add_option("--gt-scale", a->gt_scale, "metres a unit of truths (default 1)");
  depth->add_option("--png-scale", a->files.png_scale, "metres a unit of 16-bit PNGs, before the other scales (default 0.001)");
  depth->add_option("--h5-key", a->files.h5_key, "name of the dataset in .h5 files (default: depth, range, data or the only one)");
  AddViewFlags(*depth, a->view);
  AddReportFlags(*depth, a->report, "a row a picture");
  AddSheetFlags(*depth, a->sheet);
  depth->callback([a, depth, &globals] {
    a->png_scale_given = depth->count("--png-scale") > 0;
    Run(*a, globals);
  });
}

}  // namespace airsim360
