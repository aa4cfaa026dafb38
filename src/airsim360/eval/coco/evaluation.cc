#include "airsim360/eval/coco/evaluation.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include "airsim360/base/parallel.h"

namespace airsim360 {
namespace {

// One detection of one picture, as the curve of a category meets it.
struct Ranked {
  double score;
  uint32_t image, detection;
};

std::vector<Ranked> Rank(std::span<const std::vector<CocoMatches>> matches, size_t category, size_t most, std::span<const uint32_t> draws) {
  std::vector<Ranked> ranked;
  for (size_t i = 0; i < matches.size(); ++i) {
    const std::vector<double>& scores = matches[i][category].scores;
    const auto count = static_cast<uint32_t>(std::min(scores.size(), most));
    for (uint32_t draw = 0; draw < (draws.empty() ? 1 : draws[i]); ++draw) {
      for (uint32_t d = 0; d < count; ++d) ranked.push_back({scores[d], static_cast<uint32_t>(i), d});
    }
  }
  std::stable_sort(ranked.begin(), ranked.end(), [](const Ranked& a, const Ranked& b) { return a.score > b.score; });
  return ranked;
}

struct Curve {
  std::vector<double> recall, precision;
};

Curve Draw(std::span<const std::vector<CocoMatches>> matches, const std::vector<Ranked>& ranked, size_t category, size_t area,
           size_t threshold, size_t truths) {
  Curve curve;
  double right = 0, wrong = 0;
  for (const Ranked& r : ranked) {
    const CocoMatches& cell = matches[r.image][category];
    const size_t at = threshold * cell.scores.size() + r.detection;
    if (!cell.areas[area].ignored[at]) (cell.areas[area].matched[at] ? right : wrong) += 1;
    curve.recall.push_back(right / static_cast<double>(truths));
    // The smallest number above zero that 1 can be told from: 0 / 0 is 0.
    curve.precision.push_back(right / (wrong + right + std::numeric_limits<double>::epsilon()));
  }
  // Precision never rises with recall: the best that is still to come.
  for (size_t i = curve.precision.size(); i-- > 1;) curve.precision[i - 1] = std::max(curve.precision[i - 1], curve.precision[i]);
  return curve;
}

double Mean(double sum, size_t count) { return count == 0 ? -1 : sum / static_cast<double>(count); }

}  // namespace

CocoOptions StandardCocoOptions() {
  constexpr double kSmall = 32 * 32, kLarge = 96 * 96, kAll = 1e10;
  CocoOptions options;
  for (int i = 0; i < 10; ++i) options.thresholds.push_back(i * ((0.95 - 0.5) / 9) + 0.5);
  options.thresholds.back() = 0.95;
  options.areas = {{0, kAll}, {0, kSmall}, {kSmall, kLarge}, {kLarge, kAll}};
  options.most_detections = {1, 10, 100};
  return options;
}

CocoOptions KeypointCocoOptions() {
  CocoOptions options = StandardCocoOptions();
  options.areas.erase(options.areas.begin() + 1);
  options.most_detections = {20};
  return options;
}

CocoTable::CocoTable(const CocoOptions& options, size_t categories)
    : thresholds_(options.thresholds.size()),
      categories_(categories),
      areas_(options.areas.size()),
      mosts_(options.most_detections.size()),
      precision_(thresholds_ * kRecallSteps * categories_ * areas_ * mosts_, -1),
      recall_(thresholds_ * categories_ * areas_ * mosts_, -1) {}

double& CocoTable::Precision(size_t threshold, size_t recall, size_t category, size_t area, size_t most) {
  return precision_[(((threshold * categories_ + category) * areas_ + area) * mosts_ + most) * kRecallSteps + recall];
}

double& CocoTable::Recall(size_t threshold, size_t category, size_t area, size_t most) {
  return recall_[((threshold * categories_ + category) * areas_ + area) * mosts_ + most];
}

double CocoTable::MeanPrecision(size_t threshold, size_t category, size_t area, size_t most) const {
  double sum = 0;
  size_t count = 0;
  for (size_t t = 0; t < thresholds_; ++t) {
    if (threshold != kAll && t != threshold) continue;
    for (size_t k = 0; k < categories_; ++k) {
      if (category != kAll && k != category) continue;
      const double* values = &precision_[(((t * categories_ + k) * areas_ + area) * mosts_ + most) * kRecallSteps];
      if (values[0] < 0) continue;  // all of a curve or nothing
      sum += std::accumulate(values, values + kRecallSteps, 0.0);
      count += kRecallSteps;
    }
  }
  return Mean(sum, count);
}

double CocoTable::MeanRecall(size_t threshold, size_t category, size_t area, size_t most) const {
  double sum = 0;
  size_t count = 0;
  for (size_t t = 0; t < thresholds_; ++t) {
    if (threshold != kAll && t != threshold) continue;
    for (size_t k = 0; k < categories_; ++k) {
      const double value = recall_[((t * categories_ + k) * areas_ + area) * mosts_ + most];
      if ((category != kAll && k != category) || value < 0) continue;
      sum += value;
      ++count;
    }
  }
  return Mean(sum, count);
}

CocoTable AccumulateCoco(std::span<const std::vector<CocoMatches>> matches, const CocoOptions& options, size_t categories,
                         std::span<const uint32_t> draws) {
  CocoTable table(options, categories);
  const size_t mosts = options.most_detections.size();
  ParallelFor(static_cast<int64_t>(categories * mosts), [&](int64_t task) {
    const size_t k = static_cast<size_t>(task) / mosts, m = static_cast<size_t>(task) % mosts;
    const std::vector<Ranked> ranked = Rank(matches, k, options.most_detections[m], draws);
    for (size_t a = 0; a < options.areas.size(); ++a) {
      size_t truths = 0;
      for (size_t i = 0; i < matches.size(); ++i) {
        if (!matches[i][k].areas.empty()) truths += matches[i][k].areas[a].truths * (draws.empty() ? 1 : draws[i]);
      }
      if (truths == 0) continue;
      for (size_t t = 0; t < options.thresholds.size(); ++t) {
        const Curve curve = Draw(matches, ranked, k, a, t, truths);
        table.Recall(t, k, a, m) = curve.recall.empty() ? 0 : curve.recall.back();
        for (size_t r = 0; r < kRecallSteps; ++r) {
          const auto at =
              std::lower_bound(curve.recall.begin(), curve.recall.end(), r == kRecallSteps - 1 ? 1.0 : static_cast<double>(r) * 0.01);
          table.Precision(t, r, k, a, m) = at == curve.recall.end() ? 0 : curve.precision[static_cast<size_t>(at - curve.recall.begin())];
        }
      }
    }
  });
  return table;
}

}  // namespace airsim360
