#include "airsim360/eval/coco/objects.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <unordered_map>

#include "airsim360/base/error.h"
#include "airsim360/base/parallel.h"
#include "airsim360/eval/boxes/box_overlap.h"
#include "airsim360/eval/coco/similarity.h"
#include "airsim360/eval/sphere/pixel_view.h"
#include "airsim360/eval/spherical_iou.h"
#include "airsim360/math/angles.h"

namespace airsim360 {
namespace {

using Group = std::vector<const CocoObject*>;

// What comparing many pairs needs to know of one object.
struct MaskFacts {
  std::array<double, 4> box;
  double area;
};

bool Apart(const std::array<double, 4>& a, const std::array<double, 4>& b) {
  return a[0] + a[2] <= b[0] || b[0] + b[2] <= a[0] || a[1] + a[3] <= b[1] || b[1] + b[3] <= a[1];
}

class Overlaps {
 public:
  Overlaps(const CocoRun& run, const CocoImage& image) : run_(run), image_(image), sums_(Weights(run, image)) {}

  std::vector<MaskFacts> Facts(const Group& group) const {
    std::vector<MaskFacts> facts;
    if (run_.kind != CocoKind::kMasks) return facts;
    for (const CocoObject* object : group)
      facts.push_back(
          {MaskBox(object->mask), run_.solid_angle ? WeighedArea(object->mask, sums_) : static_cast<double>(MaskArea(object->mask))});
    return facts;
  }

  /// What the ranges of area are about: of solid angles the number of pixels at the horizon that have as much.
  double Area(const CocoObject& object, const std::vector<MaskFacts>& facts, size_t index) const {
    if (run_.by_place) return object.place;
    if (!run_.solid_angle) return object.area;
    const auto middle = static_cast<uint64_t>(image_.height / 2);
    return facts[index].area / (sums_.Before(middle + 1) - sums_.Before(middle));
  }

  double Mask(const CocoObject& d, const MaskFacts& df, const CocoObject& t, const MaskFacts& tf) const {
    if (Apart(df.box, tf.box)) return 0;
    const double shared = run_.solid_angle ? WeighedSharedArea(d.mask, t.mask, sums_) : static_cast<double>(SharedArea(d.mask, t.mask));
    if (!(shared > 0)) return 0;
    return shared / (t.crowd ? df.area : df.area + tf.area - shared);
  }

  double Other(const CocoObject& d, const CocoObject& t, std::span<const double> sigmas) const {
    switch (run_.kind) {
      case CocoKind::kBoxes:
        return run_.wrap ? WrappedBoxOverlap(d.box, t.box, t.crowd, image_.width) : BoxOverlap(d.box, t.box, t.crowd);
      case CocoKind::kKeypoints:
        if (t.keypoints.size() != 3 * sigmas.size() || d.keypoints.size() != t.keypoints.size())
          throw InputError("keypoints of different number: a truth has " + std::to_string(t.keypoints.size() / 3) + ", a detection " +
                           std::to_string(d.keypoints.size() / 3) + ", and there are " + std::to_string(sigmas.size()) + " sigmas");
        return KeypointSimilarity(d.keypoints, t.keypoints, sigmas, t.area, t.box, run_.wrap ? image_.width : 0);
      case CocoKind::kSphericalBoxes:
        return SphericalIou(Bfov(d), Bfov(t));
      case CocoKind::kBoxes3d:
        return VolumeOverlap(Upright(d), Upright(t));
      case CocoKind::kMasks:
        break;
    }
    return 0;
  }

 private:
  static std::vector<double> Weights(const CocoRun& run, const CocoImage& image) {
    if (!run.solid_angle) return {1.0};
    if (image.width != 2 * image.height)
      throw InputError("--weights solid_angle needs panoramas, twice as wide as high; picture " + std::to_string(image.id) + " is " +
                       std::to_string(image.width) + "x" + std::to_string(image.height));
    return RowWeights(image.height, image.width, PixelWeight::kSolidAngle);
  }
  static SphericalBox Bfov(const CocoObject& o) {
    return {o.bfov[0] * kDegree, o.bfov[1] * kDegree, o.bfov[2] * kDegree, o.bfov[3] * kDegree, o.bfov[4] * kDegree};
  }
  static UprightBox Upright(const CocoObject& o) {
    return {{o.box3d[0], o.box3d[1], o.box3d[2]}, o.box3d[3], o.box3d[4], o.box3d[5], o.box3d[6] * std::numbers::pi / 180};
  }

  const CocoRun& run_;
  const CocoImage& image_;
  RowSums sums_;
};

CocoCell MakeCell(const Group& truths, const Group& detections, const Overlaps& overlaps, const CocoRun& run,
                  std::span<const double> sigmas) {
  CocoCell cell;
  const std::vector<MaskFacts> true_facts = overlaps.Facts(truths), facts = overlaps.Facts(detections);
  for (size_t t = 0; t < truths.size(); ++t) {
    const bool ignore = truths[t]->crowd || (run.kind == CocoKind::kKeypoints && truths[t]->no_keypoints);
    cell.truths.push_back({overlaps.Area(*truths[t], true_facts, t), truths[t]->crowd, ignore});
  }
  const double least = run.options.thresholds.front() * (1 - 1e-9);
  for (size_t d = 0; d < detections.size(); ++d) {
    cell.detections.push_back({detections[d]->score, overlaps.Area(*detections[d], facts, d)});
    auto& list = cell.overlaps.emplace_back();
    for (size_t t = 0; t < truths.size(); ++t) {
      const double value = facts.empty() ? overlaps.Other(*detections[d], *truths[t], sigmas)
                                         : overlaps.Mask(*detections[d], facts[d], *truths[t], true_facts[t]);
      if (value >= least) list.push_back({static_cast<uint32_t>(t), value});
    }
  }
  return cell;
}

// Objects of each picture and category, in the order of the file.
std::vector<std::vector<Group>> GroupObjects(std::span<const CocoObject> objects, const CocoTruths& truths, bool class_agnostic) {
  std::unordered_map<int64_t, size_t> images, categories;
  for (const CocoImage& image : truths.images) images.emplace(image.id, images.size());
  for (const CocoCategory& category : truths.categories) categories.emplace(category.id, categories.size());
  std::vector<std::vector<Group>> groups(truths.images.size(), std::vector<Group>(class_agnostic ? 1 : categories.size()));
  for (const CocoObject& object : objects) {
    const auto category = categories.find(object.category);
    if (!class_agnostic && category == categories.end()) continue;
    groups[images.at(object.image)][class_agnostic ? 0 : category->second].push_back(&object);
  }
  return groups;
}

}  // namespace

std::vector<std::vector<CocoMatches>> MatchAll(const CocoTruths& truths, std::span<const CocoObject> results, const CocoRun& run) {
  const auto true_groups = GroupObjects(truths.objects, truths, run.class_agnostic),
             groups = GroupObjects(results, truths, run.class_agnostic);
  std::vector<std::vector<CocoMatches>> matches(truths.images.size());
  ParallelFor(static_cast<int64_t>(truths.images.size()), [&](int64_t index) {
    const auto i = static_cast<size_t>(index);
    const Overlaps overlaps(run, truths.images[i]);
    matches[i].resize(groups[i].size());
    for (size_t k = 0; k < groups[i].size(); ++k) {
      if (groups[i][k].empty() && true_groups[i][k].empty()) continue;
      const auto& own = truths.categories.empty() || run.class_agnostic ? std::vector<double>{} : truths.categories[k].sigmas;
      const std::span<const double> sigmas = own.empty() ? CocoKeypointSigmas() : std::span<const double>(own);
      matches[i][k] = MatchCoco(MakeCell(true_groups[i][k], groups[i][k], overlaps, run, sigmas), run.options);
    }
  });
  return matches;
}

}  // namespace airsim360
