// Panoptic quality of pictures and of windows of video. Pure functions.
#pragma once

#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

namespace airsim360 {

struct PanopticSegment {
  uint32_t id = 0;      ///< of its pixels, not 0
  size_t category = 0;  ///< index
  bool crowd = false;   ///< of truths: neither has to be found nor counts as wrong
};

/// Of one category, over any number of pictures.
struct PanopticCount {
  double iou = 0;  ///< sum over the matched
  int64_t tp = 0, fp = 0, fn = 0;
  bool seen() const { return tp + fp + fn > 0; }
};

/// Adds each category's count to that of `sum`, `times` over.
void AddCounts(std::span<const PanopticCount> counts, std::span<PanopticCount> sum, int64_t times = 1);

/// Of one category, or means over those that were seen (`categories` of them; NaN for none).
struct PanopticQuality {
  double pq = 0, sq = 0, rq = 0;
  int64_t categories = 0;
};

/// How many pixels each pair of segments shares. Several pictures may be added: a window of video counts as one large picture.
class PanopticOverlap {
 public:
  /// Ids of pixels, 0 = void; `weights` empty = 1 each. InputError for arrays of different length.
  void Add(std::span<const uint32_t> prediction, std::span<const uint32_t> truth, std::span<const double> weights = {});
  void Add(const PanopticOverlap& other);

  /// Those segments that have pixels here: parts of pictures need not show all.
  std::vector<PanopticSegment> PresentPredictions(std::span<const PanopticSegment> segments) const;
  std::vector<PanopticSegment> PresentTruths(std::span<const PanopticSegment> segments) const;

  /// Adds matches and misses to `counts` (one a category), as panopticapi does: a prediction matches a truth of its category whose IoU
  /// is above 0.5, where pixels of the prediction that are void in the truth count for neither; what is left over is wrong unless more than
  /// half of it is void or (the last) crowd of its category. InputError where ids of pixels and segments differ, or an id is listed twice.
  void Count(std::span<const PanopticSegment> predictions, std::span<const PanopticSegment> truths, std::span<PanopticCount> counts) const;

 private:
  double Shared(uint32_t truth, uint32_t prediction) const;
  std::unordered_map<uint64_t, double> shared_;  // (truth, prediction) -> sum of weights
  std::unordered_map<uint32_t, double> predicted_, true_;
};

/// pq = sum of iou / (tp + fp / 2 + fn / 2), sq = mean iou of the matched, rq = tp / (the same); zeros where nothing was seen.
PanopticQuality QualityOf(const PanopticCount& count);
/// Means over the categories of `chosen` (one flag a category) that were seen.
PanopticQuality MeanQuality(std::span<const PanopticCount> counts, const std::vector<bool>& chosen);

}  // namespace airsim360
