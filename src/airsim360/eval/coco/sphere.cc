#include "airsim360/eval/coco/sphere.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <unordered_map>

#include "airsim360/base/error.h"
#include "airsim360/base/parallel.h"
#include "airsim360/eval/sphere/panorama_ray.h"
#include "airsim360/eval/spherical_iou.h"
#include "airsim360/math/angles.h"

namespace airsim360 {
namespace {

double Around(double x, double columns) {
  const double rest = std::fmod(x, columns);
  return rest < 0 ? rest + columns : rest;
}

// change(object, its picture), on several threads.
std::vector<CocoObject> EachChanged(std::vector<CocoObject> objects, const CocoTruths& truths,
                                    const std::function<void(CocoObject&, const CocoImage&)>& change) {
  std::unordered_map<int64_t, const CocoImage*> images;
  for (const CocoImage& image : truths.images) {
    if (image.width != 2 * image.height || image.width < 1)
      throw InputError("picture " + std::to_string(image.id) + " is no panorama, twice as wide as high: it has " +
                       std::to_string(image.width) + "x" + std::to_string(image.height) + " pixels");
    images[image.id] = &image;
  }
  ParallelFor(static_cast<int64_t>(objects.size()), [&](int64_t i) {
    CocoObject& object = objects[static_cast<size_t>(i)];
    change(object, *images.at(object.image));
  });
  return objects;
}

void TurnBoxBack(std::array<double, 5>& bfov, const Mat3d& R_C_turned) {
  const Mat3d axes = R_C_turned * SphericalAxes(bfov[0] * kDegree, bfov[1] * kDegree, bfov[4] * kDegree);
  const Vec3d right = axes.column(0), ahead = axes.column(2);
  const double lon = std::atan2(ahead.x, ahead.z), lat = std::asin(std::clamp(-ahead.y, -1.0, 1.0));
  const Mat3d level = SphericalAxes(lon, lat, 0);
  bfov[0] = lon / kDegree;
  bfov[1] = lat / kDegree;
  bfov[4] = std::atan2(-Dot(right, level.column(1)), Dot(right, level.column(0))) / kDegree;
}

// The meridians that a box on the sphere reaches: along its border, which is convex.
std::array<double, 4> PlaceOfBfov(const std::array<double, 5>& bfov, const CocoImage& image) {
  const Mat3d axes = SphericalAxes(bfov[0] * kDegree, bfov[1] * kDegree, bfov[4] * kDegree);
  const double across = std::tan(bfov[2] * kDegree / 2), up = std::tan(bfov[3] * kDegree / 2);
  const Vec2d middle = PanoramaPlace(axes.column(2), image.width, image.height);
  double left = 0, right = 0, top = middle.y, bottom = middle.y;
  constexpr int kSteps = 32;
  for (int side = 0; side < 4; ++side) {
    for (int step = 0; step < kSteps; ++step) {
      const double along = 2.0 * step / kSteps - 1, u = side < 2 ? along : (side == 2 ? 1 : -1),
                   v = side < 2 ? (side == 0 ? 1 : -1) : along;
      const Vec2d p = PanoramaPlace(axes * Vec3d{u * across, v * up, 1}, image.width, image.height);
      const double dx = std::remainder(p.x - middle.x, static_cast<double>(image.width));
      left = std::min(left, dx), right = std::max(right, dx), top = std::min(top, p.y), bottom = std::max(bottom, p.y);
    }
  }
  return {Around(middle.x + left, image.width), top, right - left, bottom - top};
}

std::array<double, 4> PlaceOfKeypoints(const std::vector<double>& keypoints) {
  double left = INFINITY, right = -INFINITY, top = INFINITY, bottom = -INFINITY;
  for (const bool all : {false, true}) {
    for (size_t k = 0; k < keypoints.size(); k += 3) {
      if (!all && !(keypoints[k + 2] > 0)) continue;
      left = std::min(left, keypoints[k]), right = std::max(right, keypoints[k]);
      top = std::min(top, keypoints[k + 1]), bottom = std::max(bottom, keypoints[k + 1]);
    }
    if (left <= right) break;
  }
  return {left, top, right - left, bottom - top};
}

}  // namespace

std::array<double, 4> PlaceOf(const CocoObject& object, CocoKind kind, const CocoImage& image) {
  switch (kind) {
    case CocoKind::kMasks:
      return MaskBox(object.mask);
    case CocoKind::kKeypoints:
      return PlaceOfKeypoints(object.keypoints);
    case CocoKind::kSphericalBoxes:
      return PlaceOfBfov(object.bfov, image);
    case CocoKind::kBoxes:
    case CocoKind::kBoxes3d:
      break;
  }
  return object.box;
}

std::vector<CocoObject> RollBack(std::vector<CocoObject> objects, const CocoTruths& truths, CocoKind kind, int columns) {
  return EachChanged(std::move(objects), truths, [&](CocoObject& object, const CocoImage& image) {
    switch (kind) {
      case CocoKind::kMasks:
        object.mask = RollMaskBack(object.mask, columns);
        break;
      case CocoKind::kBoxes:
        object.box[0] = Around(object.box[0] - columns, image.width);
        break;
      case CocoKind::kKeypoints:
        for (size_t k = 0; k < object.keypoints.size(); k += 3) object.keypoints[k] = Around(object.keypoints[k] - columns, image.width);
        break;
      case CocoKind::kSphericalBoxes:
        object.bfov[0] = std::remainder(object.bfov[0] - 360.0 * columns / image.width, 360.0);
        break;
      case CocoKind::kBoxes3d:
        throw InputError("boxes in space have no columns");
    }
  });
}

std::vector<CocoObject> TurnBack(std::vector<CocoObject> objects, const CocoTruths& truths, CocoKind kind, double yaw, double pitch,
                                 double roll) {
  const Mat3d R_C_turned = TurnedCamera(yaw, pitch, roll);
  std::map<int, PixelView> views;  // by width
  if (kind == CocoKind::kMasks) {
    for (const CocoImage& image : truths.images) {
      if (!views.contains(image.width)) views.emplace(image.width, TurnedView(image.width, image.height, yaw, pitch, roll));
    }
  }
  return EachChanged(std::move(objects), truths, [&](CocoObject& object, const CocoImage& image) {
    switch (kind) {
      case CocoKind::kMasks:
        object.mask = EncodeMask(Take<uint8_t>(DecodeMask(object.mask), views.at(image.width)), image.width, image.height);
        break;
      case CocoKind::kKeypoints:
        for (size_t k = 0; k < object.keypoints.size(); k += 3) {
          const Vec3d ray = PanoramaRay(object.keypoints[k], object.keypoints[k + 1], image.width, image.height);
          const Vec2d place = PanoramaPlace(R_C_turned * ray, image.width, image.height);
          object.keypoints[k] = place.x, object.keypoints[k + 1] = place.y;
        }
        break;
      case CocoKind::kSphericalBoxes:
        TurnBoxBack(object.bfov, R_C_turned);
        break;
      case CocoKind::kBoxes:
      case CocoKind::kBoxes3d:
        throw InputError("boxes of columns and rows, and boxes in space, cannot be turned back");
    }
  });
}

std::vector<CocoObject> SeenThrough(std::vector<CocoObject> objects, const CocoTruths& truths,
                                    const std::function<std::shared_ptr<const PixelView>(int, int)>& view_of) {
  return EachChanged(std::move(objects), truths, [&](CocoObject& object, const CocoImage& image) {
    const auto view = view_of(image.width, image.height);
    const std::vector<uint8_t> seen = Take<uint8_t>(DecodeMask(object.mask), *view);
    object.mask = EncodeMask(seen, static_cast<int>(seen.size()), 1);
    object.area = static_cast<double>(MaskArea(object.mask));
  });
}

}  // namespace airsim360
