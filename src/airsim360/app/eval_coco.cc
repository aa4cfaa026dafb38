// airsim360 eval entity, keypoints, boxes: average precision as COCO defines it.
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <set>

#include "airsim360/app/arguments.h"
#include "airsim360/app/eval_commands.h"
#include "airsim360/app/eval_views.h"
#include "airsim360/base/error.h"
#include "airsim360/eval/coco/likely_reading.h"
#include "airsim360/eval/coco/summary.h"
#include "airsim360/eval/files/coco_file.h"

namespace airsim360 {
namespace {

using Json = nlohmann::ordered_json;

struct CocoArguments {
  std::string pred, gt, type = "segm", kind = "bbox", weights = "pixel", protocol;
  bool class_agnostic = false, wrap = false, force = false;
  std::vector<int64_t> most;
  std::vector<std::string> held_out;
  int seam = 0, bands = 0;
  ReportOptions report;
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

// [x, y, width, height] of what is compared.
std::array<double, 4> BoxOf(const CocoObject& object, CocoKind kind) {
  return kind == CocoKind::kMasks ? MaskBox(object.mask) : object.box;
}

// AP of the objects by where they are: `place` is a number of each, in ranges [low, high).
std::vector<double> PlaceAp(const CocoTruths& truths, const std::vector<CocoObject>& results, CocoRun run,
                            const std::vector<double>& borders, const std::function<double(const CocoObject&, const CocoImage&)>& place) {
  std::map<int64_t, const CocoImage*> images;
  for (const CocoImage& image : truths.images) {
    if (image.width != 2 * image.height)
      throw InputError("--seam and --latitude-bands need panoramas, twice as wide as high; picture " + std::to_string(image.id) + " is " +
                       std::to_string(image.width) + "x" + std::to_string(image.height));
    images[image.id] = &image;
  }
  CocoTruths placed = truths;
  std::vector<CocoObject> detections = results;
  for (auto* objects : {&placed.objects, &detections}) {
    for (CocoObject& object : *objects) object.area = place(object, *images.at(object.image));
  }
  run.own_areas = true;
  run.options.areas.clear();
  for (size_t i = 0; i + 1 < borders.size(); ++i) run.options.areas.push_back({borders[i], std::nextafter(borders[i + 1], borders[i])});
  const size_t categories = run.class_agnostic ? 1 : truths.categories.size(), last = run.options.most_detections.size() - 1;
  const CocoTable table = AccumulateCoco(MatchAll(placed, detections, run), run.options, categories);
  std::vector<double> aps;
  for (size_t i = 0; i + 1 < borders.size(); ++i) aps.push_back(table.MeanPrecision(CocoTable::kAll, CocoTable::kAll, i, last));
  return aps;
}

// Objects whose nearest column is within `--seam` columns of the seam, and the others; objects by the latitude of the middle of their box.
void AppendPlaces(Json& json, const CocoArguments& a, const CocoTruths& truths, const std::vector<CocoObject>& results,
                  const CocoRun& run) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  if (a.seam < 0 || a.bands < 0 || a.bands > 1000)
    throw InputError("--seam and --latitude-bands must be at least 1, and at most 1000 bands");
  if (a.seam > 0) {
    const auto aps = PlaceAp(truths, results, run, {-kInfinity, static_cast<double>(a.seam), kInfinity},
                             [&run](const CocoObject& o, const CocoImage& image) {
                               const auto box = BoxOf(o, run.kind);
                               return std::min(box[0], image.width - (box[0] + box[2]));
                             });
    json["seam"] = {{"columns", a.seam}, {"near", {{"ap", aps[0]}}}, {"far", {{"ap", aps[1]}}}};
  }
  if (a.bands == 0) return;
  std::vector<double> borders;
  for (int band = 0; band <= a.bands; ++band) borders.push_back(-90 + 180.0 * band / a.bands);
  borders.front() = -kInfinity;
  borders.back() = kInfinity;
  const auto aps = PlaceAp(truths, results, run, borders, [&run](const CocoObject& o, const CocoImage& image) {
    const auto box = BoxOf(o, run.kind);
    return 90 - 180 * (box[1] + box[3] / 2) / image.height;
  });
  for (int band = a.bands; band-- > 0;)
    json["latitude_bands"].push_back(
        {{"latitude_deg", {-90 + 180.0 * (band + 1) / a.bands, -90 + 180.0 * band / a.bands}}, {"ap", aps[static_cast<size_t>(band)]}});
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
  if (const std::string text = VoidTruths(truths, run.kind); !text.empty()) JudgeMistakes({{a.gt, {text, true}}}, a.force, json);
  JudgeMistakes({{a.pred, LikelyReading(truths, results, run, ap50)}}, a.force, json);
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
  if (count == results.size()) JudgeMistakes({{a.pred, {text, true}}}, a.force, json);
  if (count < results.size()) json["warnings"].push_back(a.pred + ": " + text + ": they are left out");
}

void RunTask(const CocoArguments& a, Task task, const GlobalOptions& globals, std::vector<std::string> notes) {
  CocoTruths truths = ReadCocoTruths(a.gt, task.run.kind, task.run.wrap);
  const std::vector<CocoObject> results = ReadCocoResults(a.pred, task.run.kind, truths, task.run.wrap);
  if (truths.images.empty()) throw InputError(a.gt + ": has no images");
  task.run.class_agnostic = a.class_agnostic;
  if (task.unlimited) task.run.options.most_detections.push_back(kUnlimited);
  const auto matches = MatchAll(truths, results, task.run);
  const size_t categories = a.class_agnostic ? 1 : truths.categories.size();
  const CocoTable table = AccumulateCoco(matches, task.run.options, categories);

  Json json;
  Judge(a, truths, results, task.run, table.MeanPrecision(0, CocoTable::kAll, 0, task.run.options.most_detections.size() - 1), json);
  Json summary = Json::array();
  for (const CocoFigure& row : task.rows) {
    json[row.name] = ValueOf(row, table, task.run.options);
    summary.push_back(json[row.name]);
  }
  json["summary"] = summary;
  if (task.unlimited)
    json["ap_all"] = table.MeanPrecision(CocoTable::kAll, CocoTable::kAll, 0, task.run.options.most_detections.size() - 1);
  json["pictures"] = truths.images.size();
  json["truths"] = truths.objects.size();
  json["detections"] = results.size();
  json["class_agnostic"] = a.class_agnostic;
  json["weights"] = a.weights;
  if (!a.class_agnostic) json["per_class"] = PerClass(table, truths, task);
  if (!a.held_out.empty()) {
    if (a.class_agnostic) throw InputError("--open-world and --class-agnostic exclude each other: without categories none is held out");
    json["open_world"] = OpenWorld(table, truths, task, a.held_out);
  }
  AppendPlaces(json, a, truths, results, task.run);
  std::vector<std::string> names;
  for (const CocoFigure& row : task.rows) names.push_back(row.name);
  AppendIntervals(json, a.report, globals.seed, matches.size(), names, [&](std::span<const uint32_t> draws) {
    const CocoTable drawn = AccumulateCoco(matches, task.run.options, categories, draws);
    std::vector<double> values;
    for (const CocoFigure& row : task.rows) {
      const double value = ValueOf(row, drawn, task.run.options);
      values.push_back(value < 0 ? std::numeric_limits<double>::quiet_NaN() : value);
    }
    return values;
  });
  WriteTable(a.report.csv, table, truths, task);
  notes.insert(notes.end(), truths.notes.begin(), truths.notes.end());
  if (!notes.empty()) json["notes"] = notes;
  if (globals.json)
    PrintJson(json);
  else
    PrintFigures(json);
}

void AddCommon(CLI::App& command, CocoArguments& a) {
  command.add_option("pred", a.pred, "COCO results: a list of image_id, category_id, score and what is compared")->required();
  command.add_option("gt", a.gt, "COCO annotations: images, annotations, categories")->required();
  command.add_flag("--class-agnostic", a.class_agnostic, "all categories are one");
  command.add_option("--open-world", a.held_out, "categories that training has not seen, by name: their AP beside that of the others")
      ->delimiter(',');
  AddForceFlag(command, a.force);
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
  task.run.solid_angle = ParsePixelWeight(a.weights) == PixelWeight::kSolidAngle;
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
  AddCommon(*one, *entity);
  one->add_option("--type", entity->type, "what is compared: segm (masks, the default) or bbox");
  one->add_option("--max-detections", entity->most, "N,…: how many detections of a picture and category count (default 1,10,100)")
      ->delimiter(',');
  one->add_option("--seam", entity->seam, "AP also of what comes within so many columns of the panorama's seam, and of the rest");
  one->add_option("--latitude-bands", entity->bands, "AP also in so many bands of latitude, by the middle of the box");
  one->add_option("--weights", entity->weights, "what a pixel counts: pixel (1, the default) or solid_angle (its steradians, panoramas)");
  one->add_option("--protocol", entity->protocol, "coco or entityseg");
  one->callback([entity, &globals] { RunEntity(*entity, globals); });
  CLI::App* two = command.add_subcommand("keypoints", "average precision of keypoints by OKS (COCO)");
  AddCommon(*two, *keypoints);
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
