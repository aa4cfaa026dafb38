// Segmentation and tracking quality of video: STQ = sqrt(AQ x SQ) (Weber et al., "STEP: Segmenting and Tracking Every Pixel", NeurIPS
// 2021 track on datasets). Pure functions.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

namespace airsim360 {

struct TrackingScore {
  double stq = 0, aq = 0, sq = 0;
  int64_t tubes = 0, frames = 0;
};

/// All pixels of one sequence, frame by frame.
class TrackingQuality {
 public:
  /// Categories 0 … things.size() - 1; true = its instances are followed.
  explicit TrackingQuality(std::vector<bool> things);

  /// Category (kVoid for ignored pixels) and instance of each pixel; instance 0 of a thing is a crowd in the truth: pixels there do not count
  /// for association. `weights` empty = 1 each. InputError for arrays of different length.
  static constexpr uint32_t kVoid = 0xffffffffu;
  struct Labels {
    std::span<const uint32_t> category, instance;
  };
  void Add(const Labels& prediction, const Labels& truth, std::span<const double> weights = {});

  /// Of this sequence.
  TrackingScore Score() const;
  /// Of all: tubes and confusions of all sequences together, as STEP's code pools them. NaN where nothing is labelled.
  static TrackingScore Pool(std::span<const TrackingQuality* const> sequences);

 private:
  double AssociationSum() const;  // over tubes, of their quality
  size_t classes_;
  std::vector<bool> things_;
  int64_t frames_ = 0;
  std::vector<double> confusion_;                          // true x predicted, the last for void
  std::unordered_map<uint64_t, double> predicted_, true_;  // tube (category, instance) -> size
  std::map<std::pair<uint64_t, uint64_t>, double> shared_;
};

}  // namespace airsim360
