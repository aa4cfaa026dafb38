// airsim360 eval entity, keypoints, boxes: average precision as COCO defines it.
#include <algorithm>
#include <limits>
#include <memory>
#include <set>

#include "airsim360/app/eval/eval_coco_sphere.h"
#include "airsim360/app/eval/eval_commands.h"
#include "airsim360/app/eval/eval_sheet.h"
#include "airsim360/app/eval/eval_views.h"
#include "airsim360/app/flags/arguments.h"
#include "airsim360/base/error.h"
#include "airsim360/eval/coco/likely_reading.h"
#include "airsim360/eval/coco/sphere.h"
#include "airsim360/eval/coco/summary.h"
#include "airsim360/eval/files/coco_file.h"

namespace airsim360 {
namespace {

using Json = nlohmann::ordered_json;

struct CocoArguments {
  std::string pred, gt, type = "segm", kind = "bbox", protocol;
  bool class_agnostic = false, wrap = false;
  std::vector<int64_t> most;
  std::vector<std::string> held_out;
  ViewOptions view;
  ReportOptions report;
  SheetOptions sheet;
};

constexpr size_t kUnlimited = std::numeric_limits<size_t>::max();

std::vector<size_t> ParseMost(const std::vector<int64_t>& given, const std::vector<size_t>& usual) {
  if (given.empty()) return usual;
  std::vector<size_t> most;
  for (const int64_t n : given) {
    if (n < 1) throw InputError("--max-detections: " + std::to_string(n) + " is not above 0");
    if (!most.empty() && static_cast<size_t>(n) <= most.back())
      throw InputError("--max-detections: numbers must rise, " + std::to_string(n) + " does not");
    most.push_back(static_cast<size_t>(n));
  }
  return most;
}

struct Task {
  CocoRun run;
  std::vector<CocoFigure> rows;
  bool unlimited = false;  // ap_all beside the limited figures
};

Json PerClass(const CocoTable& table, const CocoTruths& truths, const Task& task) {
  Json list = Json::object();
  for (size_t k = 0; k < truths.categories.size(); ++k) {
    Json one = {{"id", truths.categories[k].id}};
    for (const CocoFigure& row : task.rows) one[row.name] = ValueOf(row, table, task.run.options, k);
    const std::string name = truths.categories[k].name;
    list[name.empty() || list.contains(name) ? std::to_string(truths.categories[k].id) : name] = std::move(one);
  }
  return list;
}

// Means over categories that have truths.
Json OpenWorld(const CocoTable& table, const CocoTruths& truths, const Task& task, const std::vector<std::string>& held_out) {
  std::set<size_t> held;
  std::vector<std::string> names;
  for (const CocoCategory& category : truths.categories) names.push_back(category.name);
  for (const std::string& name : held_out) {
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) throw InputError("--open-world: " + UnknownChoiceMessage("category", name, names));
    held.insert(static_cast<size_t>(found - names.begin()));
  }
  Json json = {{"held_out", held_out}};
  for (const bool unknown : {false, true}) {
    double sum = 0, count = 0;
    for (size_t k = 0; k < truths.categories.size(); ++k) {
      const double ap = ValueOf(task.rows[0], table, task.run.options, k);
      if (held.contains(k) == unknown && ap >= 0) sum += ap, count += 1;
    }
    json[unknown ? "ap_held_out" : "ap_known"] = count > 0 ? sum / count : -1;
  }
  return json;
}

std::vector<Figure> FiguresOf(const CocoTable& table, const Task& task) {
  std::vector<Figure> figures;
  for (const CocoFigure& row : task.rows) figures.emplace_back(row.name, ValueOf(row, table, task.run.options));
  return figures;
}

void WriteTable(const std::string& path, const CocoTable& table, const CocoTruths& truths, const Task& task) {
  std::vector<std::vector<std::string>> rows = {{"category", "id"}};
  for (const CocoFigure& row : task.rows) rows[0].push_back(row.name);
  for (size_t k = 0; k < (task.run.class_agnostic ? 1 : truths.categories.size()); ++k) {
    auto& line = rows.emplace_back(task.run.class_agnostic
                                       ? std::vector<std::string>{"all", "1"}
                                       : std::vector<std::string>{truths.categories[k].name, std::to_string(truths.categories[k].id)});
    for (const CocoFigure& row : task.rows) line.push_back(NumberText(ValueOf(row, table, task.run.options, k)));
  }
  WriteCsv(path, rows);
}

// What makes figures mean nothing is refused, what is left out is said.
void Judge(const CocoArguments& a, const CocoTruths& truths, const std::vector<CocoObject>& results, const CocoRun& run, double ap50,
           Json& json) {
  if (const std::string text = VoidTruths(truths, run.kind); !text.empty()) JudgeMistakes({{a.gt, {text, true}}}, a.view.force, json);
  JudgeMistakes({{a.pred, LikelyReading(truths, results, run, ap50)}}, a.view.force, json);
  if (run.class_agnostic) return;
  std::set<int64_t> known, unknown;
  for (const CocoCategory& category : truths.categories) known.insert(category.id);
  size_t count = 0;
  for (const CocoObject& object : results) {
    if (known.contains(object.category)) continue;
    unknown.insert(object.category);
    ++count;
  }
  if (count == 0) return;
  const std::string text = std::to_string(count) + " of " + std::to_string(results.size()) + " detections have a category_id that " + a.gt +
                           " does not have, " + std::to_string(*unknown.begin()) + " first";
  if (count == results.size()) JudgeMistakes({{a.pred, {text, true}}}, a.view.force, json);
  if (count < results.size()) json["warnings"].push_back(a.pred + ": " + text + ": they are left out");
}

// What is measured: objects of the whole pictures, or masks as a projection sees them.
class Measured {
 public:
  Measured(const CocoArguments& a, const Task& task, const CocoTruths& truths)
      : task_(task), truths_(truths), seen_(truths), categories_(a.class_agnostic ? 1 : truths.categories.size()), cache_(a.view) {
    if (a.view.projection == "erp") return;
    if (task.run.kind != CocoKind::kMasks) throw InputError("--projection is for masks: a box is seen in no pixels");
    projected_ = true;
    seen_.objects = Seen(truths.objects);
  }

  std::vector<std::vector<CocoMatches>> Match(const std::vector<CocoObject>& results) {
    return projected_ ? MatchAll(seen_, Seen(results), task_.run) : MatchAll(truths_, results, task_.run);
  }
  CocoTable Table(const std::vector<std::vector<CocoMatches>>& matches, std::span<const uint32_t> draws = {}) const {
    return AccumulateCoco(matches, task_.run.options, categories_, draws);
  }

 private:
  std::vector<CocoObject> Seen(const std::vector<CocoObject>& objects) {
    return SeenThrough(objects, truths_, [this](int width, int height) {
      const auto views = cache_.Of(width, height);
      return std::shared_ptr<const PixelView>(views, &views->front());
    });
  }

  const Task& task_;
  const CocoTruths& truths_;
  CocoTruths seen_;
  size_t categories_;
  ViewCache cache_;
  bool projected_ = false;
};

// Figures of predictions of pictures that were moved.
void AppendMoved(Json& json, const CocoArguments& a, const Task& task, const CocoTruths& truths, Measured& measured,
                 const std::vector<Figure>& main) {
  const std::vector<Rolled> turns = ParseRolled(a.view);
  std::vector<std::vector<Figure>> figures;
  for (const Rolled& turn : turns) {
    CocoTruths known = truths;  // takes notes of this file, which say nothing new
    std::vector<CocoObject> moved = ReadCocoResults(turn.path, task.run.kind, known, task.run.wrap);
    moved = MovedBack(std::move(moved), truths, task.run.kind, turn);
    figures.push_back(FiguresOf(measured.Table(measured.Match(moved)), task));
  }
  AppendRolled(json, turns, figures, main);
}

// What lies inside each truth and detection of a picture, by an id that a detection shares with the truth that it covers best.
std::pair<LabelPicture, LabelPicture> DrawnObjects(const CocoTruths& truths, const std::vector<CocoObject>& results, CocoKind kind,
                                                   const CocoImage& image) {
  const auto mask_of = [&](const CocoObject& o) {
    return kind == CocoKind::kMasks ? o.mask : RasterizeBox(o.box, image.width, image.height);
  };
  const auto draw = [](const RleMask& mask, uint32_t id, LabelPicture& picture) {
    const std::vector<uint8_t> inside = DecodeMask(mask);
    for (size_t i = 0; i < inside.size(); ++i) picture.ids[i] = inside[i] ? id : picture.ids[i];
  };
  const auto blank = std::vector<uint32_t>(static_cast<size_t>(image.width) * static_cast<size_t>(image.height), 0);
  LabelPicture prediction{image.width, image.height, blank}, truth{image.width, image.height, blank};
  std::vector<RleMask> known;
  for (const CocoObject& object : truths.objects) {
    if (object.image != image.id) continue;
    known.push_back(mask_of(object));
    draw(known.back(), static_cast<uint32_t>(known.size()), truth);
  }
  std::vector<const CocoObject*> found;
  for (const CocoObject& object : results) {
    if (object.image == image.id) found.push_back(&object);
  }
  // The surest last, so that it lies on top.
  std::stable_sort(found.begin(), found.end(), [](const CocoObject* a, const CocoObject* b) { return a->score < b->score; });
  for (size_t d = 0; d < found.size(); ++d) {
    const RleMask mask = mask_of(*found[d]);
    uint32_t id = static_cast<uint32_t>(known.size() + 1 + d);
    uint64_t most = 0;
    for (size_t t = 0; t < known.size(); ++t) {
      const uint64_t shared = SharedArea(mask, known[t]);
      if (shared > most && 2 * shared > MaskArea(mask)) most = shared, id = static_cast<uint32_t>(t + 1);
    }
    draw(mask, id, prediction);
  }
  return {std::move(prediction), std::move(truth)};
}

void AppendWorstPictures(Json& json, const CocoArguments& a, const Task& task, const CocoTruths& truths,
                         const std::vector<CocoObject>& results, const Measured& measured,
                         const std::vector<std::vector<CocoMatches>>& matches) {
  if (a.sheet.worst == 0) return;
  std::vector<SheetItem> items;
  for (size_t i = 0; i < truths.images.size(); ++i) {
    std::vector<uint32_t> alone(truths.images.size(), 0);
    alone[i] = 1;
    const double ap = ValueOf(task.rows[0], measured.Table(matches, alone), task.run.options);
    const CocoImage& image = truths.images[i];
    // A picture without truths has no AP.
    if (ap >= 0) items.push_back({i, image.name.empty() ? std::to_string(image.id) : image.name, 1 - ap});
  }
  AppendWorst(json, a.sheet, items, "1-ap", [&](size_t i) {
    const auto [prediction, truth] = DrawnObjects(truths, results, task.run.kind, truths.images[i]);
    return LabelStrip(prediction, truth);
  });
}

// The figures, what they were counted of, and each category's.
void AppendFigures(Json& json, const CocoArguments& a, const Task& task, const CocoTruths& truths, size_t detections,
                   const CocoTable& table) {
  const std::vector<Figure> figures = FiguresOf(table, task);
  json.update(ToJson(figures));
  Json summary = Json::array();
  for (const Figure& figure : figures) summary.push_back(figure.second);
  json["summary"] = summary;
  if (task.unlimited)
    json["ap_all"] = table.MeanPrecision(CocoTable::kAll, CocoTable::kAll, 0, task.run.options.most_detections.size() - 1);
  json["pictures"] = truths.images.size();
  json["truths"] = truths.objects.size();
  json["detections"] = detections;
  json["class_agnostic"] = a.class_agnostic;
  json["weights"] = a.view.weights;
  if (task.run.kind == CocoKind::kMasks) json["projection"] = a.view.projection;
  if (!a.class_agnostic) json["per_class"] = PerClass(table, truths, task);
  if (a.held_out.empty()) return;
  if (a.class_agnostic) throw InputError("--open-world and --class-agnostic exclude each other: without categories none is held out");
  json["open_world"] = OpenWorld(table, truths, task, a.held_out);
}

void RunTask(CocoArguments a, Task task, const GlobalOptions& globals, std::vector<std::string> notes) {
  CheckViewOptions(a.view);
  CheckSheetOptions(a.sheet);
  CheckSphere(a.view, task.run.kind, a.wrap);
  CocoTruths truths = ReadCocoTruths(a.gt, task.run.kind, task.run.wrap);
  const std::vector<CocoObject> results = ReadCocoResults(a.pred, task.run.kind, truths, task.run.wrap);
  if (truths.images.empty()) throw InputError(a.gt + ": has no images");
  task.run.class_agnostic = a.class_agnostic;
  if (task.unlimited) task.run.options.most_detections.push_back(kUnlimited);
  Measured measured(a, task, truths);
  const auto matches = measured.Match(results);
  const CocoTable table = measured.Table(matches);

  Json json;
  Judge(a, truths, results, task.run, table.MeanPrecision(0, CocoTable::kAll, 0, task.run.options.most_detections.size() - 1), json);
  AppendFigures(json, a, task, truths, results.size(), table);
  AppendPlaces(json, a.view, truths, results, task.run);
  const std::vector<Figure> main = FiguresOf(table, task);
  AppendMoved(json, a, task, truths, measured, main);
  std::vector<std::string> names;
  for (const Figure& figure : main) names.push_back(figure.first);
  AppendIntervals(json, a.report, globals.seed, matches.size(), names, [&](std::span<const uint32_t> draws) {
    std::vector<double> values;
    for (const Figure& figure : FiguresOf(measured.Table(matches, draws), task))
      values.push_back(figure.second < 0 ? std::numeric_limits<double>::quiet_NaN() : figure.second);
    return values;
  });
  WriteTable(a.report.csv, table, truths, task);
  AppendWorstPictures(json, a, task, truths, results, measured, matches);
  notes.insert(notes.end(), truths.notes.begin(), truths.notes.end());
  if (!notes.empty()) json["notes"] = notes;
  if (globals.json)
    PrintJson(json);
  else
    PrintFigures(json);
}

// `pixels`: whether there are masks.
void AddCommon(CLI::App& command, CocoArguments& a, bool pixels = false) {
  command.add_option("pred", a.pred, "COCO results: a list of image_id, category_id, score and what is compared")->required();
  command.add_option("gt", a.gt, "COCO annotations: images, annotations, categories")->required();
  command.add_flag("--class-agnostic", a.class_agnostic, "all categories are one");
  command.add_option("--open-world", a.held_out, "categories that training has not seen, by name: their AP beside that of the others")
      ->delimiter(',');
  AddViewFlags(command, a.view, pixels);
  AddReportFlags(command, a.report, "a row a category");
}

void RunEntity(CocoArguments a, const GlobalOptions& globals) {
  Task task;
  std::vector<std::string> notes;
  const std::vector<std::string> types = {"segm", "bbox"}, protocols = {"coco", "entityseg"};
  if (a.type != "segm" && a.type != "bbox") throw InputError("--type: " + UnknownChoiceMessage("type", a.type, types));
  if (a.protocol == "entityseg") {
    a.class_agnostic = true;
    notes.push_back("entityseg: all categories are one; AP^e of Entityv2 asks for predictions that do not overlap");
  } else if (a.protocol == "coco") {
    notes.push_back("coco: at most " + std::string(a.most.empty() ? "100" : std::to_string(a.most.back())) +
                    " detections of a picture and category count; ap_all lets all count");
  } else if (!a.protocol.empty()) {
    throw InputError("--protocol: " + UnknownChoiceMessage("protocol of entities", a.protocol, protocols));
  }
  task.run.kind = a.type == "segm" ? CocoKind::kMasks : CocoKind::kBoxes;
  task.run.solid_angle = ParsePixelWeight(a.view.weights) == PixelWeight::kSolidAngle;
  if (task.run.solid_angle && a.type == "bbox")
    throw InputError("--weights solid_angle is for masks; boxes on the sphere are `eval boxes --kind bfov`");
  task.run.options.most_detections = ParseMost(a.most, task.run.options.most_detections);
  task.rows = InstanceFigures(task.run.options);
  task.unlimited = true;
  RunTask(a, task, globals, notes);
}

void RunKeypoints(const CocoArguments& a, const GlobalOptions& globals) {
  Task task;
  task.run.kind = CocoKind::kKeypoints;
  task.run.wrap = a.wrap;
  task.run.options = KeypointCocoOptions();
  task.rows = KeypointFigures();
  RunTask(a, task, globals, {"at most 20 detections of a picture count; sigmas are the category's `sigmas`, else COCO's 17"});
}

void RunBoxes(const CocoArguments& a, const GlobalOptions& globals) {
  Task task;
  task.run.options.most_detections = ParseMost(a.most, task.run.options.most_detections);
  std::vector<std::string> notes;
  if (a.kind == "bbox") {
    task.run.kind = CocoKind::kBoxes;
    task.run.wrap = a.wrap;
    task.rows = InstanceFigures(task.run.options);
    if (a.wrap) notes.push_back("columns go round: boxes are compared on the circle, x + width may exceed the picture's width");
  } else if (a.kind == "bfov" || a.kind == "box3d") {
    if (a.wrap) throw InputError("--wrap is for --kind bbox: the others have no seam");
    task.run.kind = a.kind == "bfov" ? CocoKind::kSphericalBoxes : CocoKind::kBoxes3d;
    task.run.options.areas = {{-1, std::numeric_limits<double>::infinity()}};
    task.rows = PlainFigures(task.run.options);
    notes.push_back(a.kind == "bfov" ? "overlap is the unbiased spherical IoU, exact" : "overlap is that of the volumes of upright boxes");
  } else {
    throw InputError("--kind: " + UnknownChoiceMessage("kind of box", a.kind, std::vector<std::string>{"bbox", "bfov", "box3d"}));
  }
  RunTask(a, task, globals, notes);
}

}  // namespace

void AddEvalCoco(CLI::App& command, GlobalOptions& globals) {
  const auto entity = std::make_shared<CocoArguments>(), keypoints = std::make_shared<CocoArguments>(),
             boxes = std::make_shared<CocoArguments>();
  CLI::App* one = command.add_subcommand("entity", "average precision of masks or boxes (COCO)");
  AddCommon(*one, *entity, true);
  one->add_option("--type", entity->type, "what is compared: segm (masks, the default) or bbox");
  one->add_option("--max-detections", entity->most, "N,…: how many detections of a picture and category count (default 1,10,100)")
      ->delimiter(',');
  one->add_option("--protocol", entity->protocol, "coco or entityseg");
  AddSheetFlags(*one, entity->sheet);
  one->callback([entity, &globals] { RunEntity(*entity, globals); });
  CLI::App* two = command.add_subcommand("keypoints", "average precision of keypoints by OKS (COCO)");
  AddCommon(*two, *keypoints);
  two->add_flag("--wrap", keypoints->wrap, "panoramas: columns go round; bbox_wrap is read where truths have it");
  two->callback([keypoints, &globals] { RunKeypoints(*keypoints, globals); });
  CLI::App* three = command.add_subcommand("boxes", "average precision of boxes: in pictures, on the sphere, in space");
  AddCommon(*three, *boxes);
  three->add_option(
      "--kind", boxes->kind,
      "bbox [x, y, width, height] (the default), bfov [lon, lat, width, height, turn] in degrees, or box3d {center, size, yaw_deg} in metres");
  three->add_option("--max-detections", boxes->most, "N,…: how many detections of a picture and category count (default 1,10,100)")
      ->delimiter(',');
  three->add_flag("--wrap", boxes->wrap, "bbox in panoramas: columns go round; bbox_wrap is read where objects have it");
  three->callback([boxes, &globals] { RunBoxes(*boxes, globals); });
}

}  // namespace airsim360
