#include "airsim360/app/eval/eval_coco_sphere.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>

#include "airsim360/base/error.h"
#include "airsim360/eval/coco/sphere.h"

namespace airsim360 {
namespace {

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
    for (CocoObject& object : *objects) object.place = place(object, *images.at(object.image));
  }
  run.by_place = true;
  run.options.areas.clear();
  for (size_t i = 0; i + 1 < borders.size(); ++i) run.options.areas.push_back({borders[i], std::nextafter(borders[i + 1], borders[i])});
  const size_t categories = run.class_agnostic ? 1 : truths.categories.size(), last = run.options.most_detections.size() - 1;
  const CocoTable table = AccumulateCoco(MatchAll(placed, detections, run), run.options, categories);
  std::vector<double> aps;
  for (size_t i = 0; i + 1 < borders.size(); ++i) aps.push_back(table.MeanPrecision(CocoTable::kAll, CocoTable::kAll, i, last));
  return aps;
}

}  // namespace

void AppendPlaces(nlohmann::ordered_json& json, const ViewOptions& view, const CocoTruths& truths, const std::vector<CocoObject>& results,
                  const CocoRun& run) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  if (view.seam > 0) {
    const auto aps = PlaceAp(truths, results, run, {-kInfinity, static_cast<double>(view.seam), kInfinity},
                             [&run](const CocoObject& o, const CocoImage& image) {
                               const auto box = PlaceOf(o, run.kind, image);
                               return std::min(box[0], image.width - (box[0] + box[2]));
                             });
    json["seam"] = {{"columns", view.seam}, {"near", {{"ap", aps[0]}}}, {"far", {{"ap", aps[1]}}}};
  }
  if (view.bands == 0) return;
  std::vector<double> borders;
  for (int band = 0; band <= view.bands; ++band) borders.push_back(-90 + 180.0 * band / view.bands);
  borders.front() = -kInfinity;
  borders.back() = kInfinity;
  const auto aps = PlaceAp(truths, results, run, borders, [&run](const CocoObject& o, const CocoImage& image) {
    const auto box = PlaceOf(o, run.kind, image);
    return 90 - 180 * (box[1] + box[3] / 2) / image.height;
  });
  for (int band = view.bands; band-- > 0;)
    json["latitude_bands"].push_back({{"latitude_deg", {-90 + 180.0 * (band + 1) / view.bands, -90 + 180.0 * band / view.bands}},
                                      {"ap", aps[static_cast<size_t>(band)]}});
}

void CheckSphere(const ViewOptions& view, CocoKind kind, bool wrap) {
  if (view.rolled.empty() && view.turned.empty() && view.seam == 0 && view.bands == 0) return;
  if (kind == CocoKind::kBoxes3d)
    throw InputError("--seam, --latitude-bands, --rolled and --turned are of pictures; boxes in space are in none");
  if (kind == CocoKind::kBoxes && !view.turned.empty())
    throw InputError("--turned: a turned box is no box of columns and rows; `eval boxes --kind bfov` has such");
  if ((kind == CocoKind::kBoxes || kind == CocoKind::kKeypoints) && !wrap && !(view.rolled.empty() && view.turned.empty()))
    throw InputError("--rolled and --turned move objects over the seam: " +
                     std::string(kind == CocoKind::kBoxes ? "`eval boxes --wrap`" : "--wrap") + " compares them there");
}

std::vector<CocoObject> MovedBack(std::vector<CocoObject> objects, const CocoTruths& truths, CocoKind kind, const Rolled& rolled) {
  if (!rolled.turn_deg) return RollBack(std::move(objects), truths, kind, rolled.columns);
  const Vec3d turn = *rolled.turn_deg * kDegree;
  return TurnBack(std::move(objects), truths, kind, turn.x, turn.y, turn.z);
}

}  // namespace airsim360
