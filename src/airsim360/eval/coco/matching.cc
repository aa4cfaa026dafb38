// Who matches whom (the rule of COCO's evaluation, cocodataset.org/#detection-eval).
#include <algorithm>
#include <limits>
#include <numeric>

#include "airsim360/eval/coco/evaluation.h"

namespace airsim360 {
namespace {

constexpr double kAlmostOne = 1 - 1e-10;  // so that a threshold of 1 can be met in spite of rounding

/// Indices of the detections by falling score, at most as many as any count asks for.
std::vector<uint32_t> ByScore(const CocoCell& cell, size_t most) {
  std::vector<uint32_t> order(cell.detections.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) { return cell.detections[a].score > cell.detections[b].score; });
  if (order.size() > most) order.resize(most);
  return order;
}

bool Outside(double area, const std::array<double, 2>& range) { return area < range[0] || area > range[1]; }

// The overlaps of one detection with those truths first that count, then with those that are ignored.
std::vector<CocoOverlap> Ordered(const std::vector<CocoOverlap>& overlaps, const std::vector<uint8_t>& ignored) {
  std::vector<CocoOverlap> ordered;
  for (const CocoOverlap& o : overlaps) {
    if (!ignored[o.truth]) ordered.push_back(o);
  }
  for (const CocoOverlap& o : overlaps) {
    if (ignored[o.truth]) ordered.push_back(o);
  }
  return ordered;
}

constexpr uint32_t kNone = std::numeric_limits<uint32_t>::max();

uint32_t Best(const std::vector<CocoOverlap>& candidates, double threshold, const CocoCell& cell, const std::vector<uint8_t>& ignored,
              const std::vector<uint8_t>& taken) {
  double least = std::min(threshold, kAlmostOne);
  uint32_t best = kNone;
  for (const CocoOverlap& candidate : candidates) {
    if (taken[candidate.truth] && !cell.truths[candidate.truth].crowd) continue;
    if (best != kNone && !ignored[best] && ignored[candidate.truth]) break;
    if (candidate.value < least) continue;
    least = candidate.value;
    best = candidate.truth;
  }
  return best;
}

}  // namespace

CocoMatches MatchCoco(const CocoCell& cell, const CocoOptions& options) {
  const std::vector<uint32_t> order = ByScore(cell, options.most_detections.back());
  const size_t n = order.size();
  CocoMatches matches;
  for (const uint32_t d : order) matches.scores.push_back(cell.detections[d].score);
  for (const auto& range : options.areas) {
    CocoMatches::Area area;
    std::vector<uint8_t> ignored;
    for (const CocoTruth& truth : cell.truths) {
      ignored.push_back(truth.ignore || Outside(truth.area, range));
      area.truths += !ignored.back();
    }
    std::vector<std::vector<CocoOverlap>> candidates;
    for (const uint32_t d : order) candidates.push_back(Ordered(cell.overlaps[d], ignored));
    area.matched.resize(options.thresholds.size() * n);
    area.ignored.resize(area.matched.size());
    for (size_t t = 0; t < options.thresholds.size(); ++t) {
      std::vector<uint8_t> taken(cell.truths.size(), 0);
      for (size_t d = 0; d < n; ++d) {
        const uint32_t best = Best(candidates[d], options.thresholds[t], cell, ignored, taken);
        const size_t at = t * n + d;
        if (best != kNone) {
          taken[best] = 1;
          area.matched[at] = 1;
          area.ignored[at] = ignored[best];
        } else {
          // What is wrong only because of its size is not held against this range.
          area.ignored[at] = Outside(cell.detections[order[d]].area, range);
        }
      }
    }
    matches.areas.push_back(std::move(area));
  }
  return matches;
}

}  // namespace airsim360
