// Overlaps of boxes and keypoints that COCO's evaluation compares. Pure functions.
#pragma once

#include <array>
#include <span>

namespace airsim360 {

/// Of [x, y, width, height]: intersection over union; over the detection's area where the truth is a crowd.
double BoxOverlap(const std::array<double, 4>& detection, const std::array<double, 4>& truth, bool crowd);

/// COCO's standard deviations of its 17 keypoints, relative to the square root of the person's area.
std::span<const double> CocoKeypointSigmas();

/// Object keypoint similarity of [x, y, v] * k: mean of exp(-d² / (2 area (2 sigma)²)) over keypoints that are labelled (v > 0) in
/// the truth; without any, d is how far the detection lies outside the truth's box doubled on all sides. `columns` above 0 = x goes round
/// after so many.
double KeypointSimilarity(std::span<const double> detection, std::span<const double> truth, std::span<const double> sigmas,
                          double truth_area, const std::array<double, 4>& truth_box, double columns = 0);

/// Of the box around [x, y, v] * k, whatever v says: the area of a detection in COCO's terms.
double KeypointArea(std::span<const double> keypoints);

}  // namespace airsim360
