// The figures that COCO's evaluation prints, by name.
#pragma once

#include <string>
#include <vector>

#include "airsim360/eval/coco/evaluation.h"

namespace airsim360 {

/// A mean precision or recall over thresholds, a range of area and a number of detections.
struct CocoFigure {
  std::string name;
  bool precision = true;
  double threshold = 0;  ///< of the overlap, 0 = all
  size_t area = 0, most = 0;
};

/// In COCO's order, the usual twelve for StandardCocoOptions: ap, ap50, ap75, ap_small, ap_medium, ap_large, an ar a number of detections ("ar100"),
/// ar_small, ar_medium, ar_large.
std::vector<CocoFigure> InstanceFigures(const CocoOptions& options);
/// The ten for KeypointCocoOptions: ap, ap50, ap75, ap_medium, ap_large, then ar likewise.
std::vector<CocoFigure> KeypointFigures();
/// ap, ap50, ap75, ar: of boxes that have no area in pixels.
std::vector<CocoFigure> PlainFigures(const CocoOptions& options);

/// Of all categories (CocoTable::kAll) or one; -1 where there is no truth.
double ValueOf(const CocoFigure& figure, const CocoTable& table, const CocoOptions& options, size_t category = CocoTable::kAll);

}  // namespace airsim360
