#include "airsim360/eval/coco/similarity.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace airsim360 {

double BoxOverlap(const std::array<double, 4>& d, const std::array<double, 4>& t, bool crowd) {
  const double width = std::min(d[0] + d[2], t[0] + t[2]) - std::max(d[0], t[0]),
               height = std::min(d[1] + d[3], t[1] + t[3]) - std::max(d[1], t[1]);
  if (!(width > 0 && height > 0)) return 0;
  const double shared = width * height, area = d[2] * d[3];
  return shared / (crowd ? area : area + t[2] * t[3] - shared);
}

std::span<const double> CocoKeypointSigmas() {
  // Nose, eyes, ears, shoulders, elbows, wrists, hips, knees, ankles (cocodataset.org/#keypoints-eval).
  static constexpr std::array<double, 17> kSigmas = {.026, .025, .025, .035, .035, .079, .079, .072, .072,
                                                     .062, .062, .107, .107, .087, .087, .089, .089};
  return kSigmas;
}

double KeypointSimilarity(std::span<const double> detection, std::span<const double> truth, std::span<const double> sigmas,
                          double truth_area, const std::array<double, 4>& box, double columns) {
  size_t labelled = 0;
  for (size_t k = 0; k < sigmas.size(); ++k) labelled += truth[3 * k + 2] > 0;
  // The box with its own width and height more on each side.
  const double left = box[0] - box[2], right = box[0] + 2 * box[2], top = box[1] - box[3], bottom = box[1] + 2 * box[3];
  // The nearest of the places that a column stands for.
  const auto nearest = [columns](double x, double to) { return columns > 0 ? to + std::remainder(x - to, columns) : x; };
  double sum = 0;
  for (size_t k = 0; k < sigmas.size(); ++k) {
    if (labelled > 0 && !(truth[3 * k + 2] > 0)) continue;
    const double x = nearest(detection[3 * k], labelled > 0 ? truth[3 * k] : box[0] + box[2] / 2), y = detection[3 * k + 1];
    double dx = x - truth[3 * k], dy = y - truth[3 * k + 1];
    if (labelled == 0) {
      dx = std::max(0.0, left - x) + std::max(0.0, x - right);
      dy = std::max(0.0, top - y) + std::max(0.0, y - bottom);
    }
    const double variance = 4 * sigmas[k] * sigmas[k];
    sum += std::exp(-(dx * dx + dy * dy) / variance / (truth_area + std::numeric_limits<double>::epsilon()) / 2);
  }
  return sum / static_cast<double>(labelled > 0 ? labelled : sigmas.size());
}

double KeypointArea(std::span<const double> keypoints) {
  double left = keypoints[0], right = left, top = keypoints[1], bottom = top;
  for (size_t k = 0; k < keypoints.size(); k += 3) {
    left = std::min(left, keypoints[k]), right = std::max(right, keypoints[k]);
    top = std::min(top, keypoints[k + 1]), bottom = std::max(bottom, keypoints[k + 1]);
  }
  return (right - left) * (bottom - top);
}

}  // namespace airsim360
