#include "airsim360/eval/coco/likely_reading.h"

#include <algorithm>
#include <cstdio>
#include <functional>
#include <limits>
#include <numbers>
#include <unordered_map>
#include <vector>

namespace airsim360 {
namespace {

// Changes a result of a picture; false: it cannot be read so, and then none can.
using Change = std::function<bool(CocoObject&, const CocoImage&)>;
struct Reading {
  const char* text;
  Change change;
  bool of_categories = false;
};

bool SizeKnown(const CocoImage& image) { return image.width > 1 && image.height > 1; }

// The category in this place of the truth's list; one that does not exist beyond it.
int64_t CategoryAt(const CocoTruths& truths, int64_t place) {
  const bool there = place >= 0 && static_cast<size_t>(place) < truths.categories.size();
  return there ? truths.categories[static_cast<size_t>(place)].id : std::numeric_limits<int64_t>::min();
}

std::vector<Reading> ReadingsOf(const CocoTruths& truths, const CocoRun& run) {
  std::vector<Reading> readings;
  if (!run.class_agnostic) {
    readings.push_back({"category ids that are one too large (counted from 1 where the truth counts from 0?)",
                        [](CocoObject& o, const CocoImage&) {
                          --o.category;
                          return true;
                        },
                        true});
    readings.push_back({"category ids that are one too small (counted from 0 where the truth counts from 1?)",
                        [](CocoObject& o, const CocoImage&) {
                          ++o.category;
                          return true;
                        },
                        true});
    for (const int64_t first : {0, 1})
      readings.push_back({first == 0 ? "category ids that are places in the truth's list, counted from 0"
                                     : "category ids that are places in the truth's list, counted from 1",
                          [&truths, first](CocoObject& o, const CocoImage&) {
                            o.category = CategoryAt(truths, o.category - first);
                            return true;
                          },
                          true});
  }
  switch (run.kind) {
    case CocoKind::kBoxes:
      readings.push_back({"boxes that are [x1, y1, x2, y2] instead of [x, y, width, height]", [](CocoObject& o, const CocoImage&) {
                            o.box[2] -= o.box[0], o.box[3] -= o.box[1];
                            return o.box[2] >= 0 && o.box[3] >= 0;
                          }});
      readings.push_back({"boxes whose x, y are their middle instead of their left upper corner", [](CocoObject& o, const CocoImage&) {
                            o.box[0] -= o.box[2] / 2, o.box[1] -= o.box[3] / 2;
                            return true;
                          }});
      readings.push_back({"boxes in fractions of the picture instead of pixels", [](CocoObject& o, const CocoImage& image) {
                            o.box[0] *= image.width, o.box[1] *= image.height, o.box[2] *= image.width, o.box[3] *= image.height;
                            return SizeKnown(image);
                          }});
      break;
    case CocoKind::kKeypoints:
      readings.push_back({"keypoints in fractions of the picture instead of pixels", [](CocoObject& o, const CocoImage& image) {
                            for (size_t k = 0; k < o.keypoints.size(); k += 3)
                              o.keypoints[k] *= image.width, o.keypoints[k + 1] *= image.height;
                            return SizeKnown(image);
                          }});
      break;
    case CocoKind::kSphericalBoxes:
      readings.push_back({"boxes in radians instead of degrees", [](CocoObject& o, const CocoImage&) {
                            for (double& value : o.bfov) value *= 180 / std::numbers::pi;
                            return o.bfov[2] < 180 && o.bfov[3] < 180;
                          }});
      break;
    case CocoKind::kMasks:
    case CocoKind::kBoxes3d:
      break;
  }
  return readings;
}

}  // namespace

LikelyMistake LikelyReading(const CocoTruths& truths, std::span<const CocoObject> results, const CocoRun& run, double ap50) {
  constexpr double kWellEnough = 0.15, kFarBetter = 0.25;
  if (results.empty() || ap50 < 0 || ap50 >= kWellEnough) return {};
  CocoRun quick = run;
  quick.options.thresholds = {0.5};
  quick.options.areas.resize(1);
  quick.options.most_detections = {100};
  std::unordered_map<int64_t, const CocoImage*> images;
  for (const CocoImage& image : truths.images) images.emplace(image.id, &image);
  const Reading* best = nullptr;
  double best_ap50 = kFarBetter + 4 * ap50;
  const std::vector<Reading> readings = ReadingsOf(truths, run);
  for (const Reading& reading : readings) {
    std::vector<CocoObject> changed(results.begin(), results.end());
    if (!std::ranges::all_of(changed, [&](CocoObject& o) { return reading.change(o, *images.at(o.image)); })) continue;
    const size_t categories = run.class_agnostic ? 1 : truths.categories.size();
    const CocoTable table = AccumulateCoco(MatchAll(truths, changed, quick), quick.options, categories);
    const double read_so = table.MeanPrecision(0, CocoTable::kAll, 0, 0);
    if (read_so > best_ap50) best = &reading, best_ap50 = read_so;
  }
  if (best == nullptr) return {};
  const bool known = std::ranges::all_of(results, [&](const CocoObject& o) {
    return std::ranges::any_of(truths.categories, [&](const CocoCategory& c) { return c.id == o.category; });
  });
  char figures[64];
  std::snprintf(figures, sizeof figures, " (AP50 is %.2g, read so %.2g)", ap50, best_ap50);
  return {std::string(best->text) + figures, best_ap50 >= internal::kNearlyAll && !(best->of_categories && known)};
}

std::string VoidTruths(const CocoTruths& truths, CocoKind kind) {
  if (kind != CocoKind::kKeypoints) return "";
  size_t count = 0, flat = 0, denied = 0;
  for (const CocoObject& o : truths.objects) {
    bool labelled = false;
    for (size_t k = 2; k < o.keypoints.size(); k += 3) labelled |= o.keypoints[k] > 0;
    if (o.crowd || !labelled) continue;
    ++count;
    flat += !(o.area > 0);
    denied += o.no_keypoints;
  }
  const std::string of = " of " + std::to_string(count) + " truths with keypoints";
  if (2 * flat > count)
    return "'area' is 0 for " + std::to_string(flat) + of +
           ": their similarity to anything is 0; leave 'area' out, then that of the box counts";
  if (2 * denied > count)
    return "'num_keypoints' is 0 for " + std::to_string(denied) + of + ": they do not count; leave it out or count them";
  return "";
}

}  // namespace airsim360
