// Truths and detections of pictures in COCO's terms, and their evaluation.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "airsim360/eval/coco/evaluation.h"
#include "airsim360/eval/coco/mask.h"

namespace airsim360 {

enum class CocoKind { kMasks, kBoxes, kKeypoints, kSphericalBoxes, kBoxes3d };

struct CocoImage {
  int64_t id = 0;
  std::string name;  ///< file_name, or ""
  int width = 0, height = 0;
};
struct CocoCategory {
  int64_t id = 0;
  std::string name;
  std::vector<double> sigmas{};  ///< of keypoints, where the file has them
};

/// One truth or detection. Only what the kind of the file asks for is filled.
struct CocoObject {
  int64_t image = 0, category = 0;
  double score = 0, area = 0;
  double place = 0;  ///< what the ranges of `areas` are about where CocoRun::by_place
  bool crowd = false, no_keypoints = false;
  RleMask mask{};
  std::array<double, 4> box{};      ///< [x, y, width, height]; x + width may exceed the picture's in boxes on the circle of columns
  std::vector<double> keypoints{};  ///< [x, y, v] each
  std::array<double, 5> bfov{};     ///< [lon, lat, width, height, turn], degrees
  std::array<double, 7> box3d{};    ///< centre x, y, z, length, width, height, yaw in degrees
};

struct CocoTruths {
  std::vector<CocoImage> images;         ///< ascending by id
  std::vector<CocoCategory> categories;  ///< ascending by id
  std::vector<CocoObject> objects;
  std::vector<std::string> notes;  ///< what the user should know: quirks that the file touches
};

struct CocoRun {
  CocoKind kind = CocoKind::kMasks;
  bool class_agnostic = false;  ///< all categories are one
  bool solid_angle =
      false;  ///< of masks in panoramas: overlaps are of steradians instead of pixels, areas are those of as many pixels at the horizon
  bool wrap = false;      ///< of boxes and keypoints in panoramas: columns go round
  bool by_place = false;  ///< the ranges of `areas` are about the objects' `place`, any number
  CocoOptions options = StandardCocoOptions();
};

/// Matches of [image][category] (one category if class-agnostic), images on several threads. Detections of unknown categories are left
/// out, as pycocotools does.
std::vector<std::vector<CocoMatches>> MatchAll(const CocoTruths& truths, std::span<const CocoObject> results, const CocoRun& run);

}  // namespace airsim360
