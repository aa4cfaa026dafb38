// Which class was taken for which: one table of a whole dataset. Pure functions.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace airsim360 {

/// Sums of weights of pixels by true and predicted class.
class Confusion {
 public:
  /// Of classes 0 … classes - 1.
  explicit Confusion(size_t classes) : classes_(classes), table_(classes * (classes + 1), 0) {}

  /// Index of a class, or kOther: such truths are left out, such predictions are wrong.
  static constexpr uint16_t kOther = 0xffff;
  /// `weights` empty = 1 each. InputError for arrays of different length.
  void Add(std::span<const uint16_t> prediction, std::span<const uint16_t> truth, std::span<const double> weights = {});
  /// `times` what another table holds.
  void Add(const Confusion& other, double times = 1);

  size_t classes() const { return classes_; }
  double True(size_t truth) const;            ///< of a class, whatever was predicted
  double Predicted(size_t prediction) const;  ///< as a class, where the truth has one
  double At(size_t truth, size_t prediction) const { return table_[truth * (classes_ + 1) + prediction]; }

  /// Intersection over union of a class; NaN where neither truth nor prediction has it.
  double Iou(size_t c) const;
  /// Share of the truth of a class that is right; NaN without any.
  double Accuracy(size_t c) const;
  /// Mean over classes that truth or prediction has (absent ones are left out, as mmsegmentation's nanmean does).
  double MeanIou() const;
  /// The same over classes that the truth has.
  double MeanIouOfPresent() const;
  double MeanAccuracy() const;
  /// Mean weighted by the share of each class in the truth.
  double FrequencyWeightedIou() const;
  double PixelAccuracy() const;  ///< NaN without pixels

 private:
  size_t classes_;
  std::vector<double> table_;  // one column more: predicted as none of the classes
};

}  // namespace airsim360
