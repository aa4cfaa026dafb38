#include "airsim360/eval/panoptic/tracking_quality.h"

#include <cmath>
#include <limits>

#include "airsim360/base/error.h"

namespace airsim360 {
namespace {

uint64_t Tube(uint32_t category, uint32_t instance) { return uint64_t{category} << 32 | instance; }

// Mean IoU over classes with pixels in truth or prediction. Truths that are void do not count; predictions of void where the truth has
// a class make void a class of its own whose IoU is 0: STEP's code has it so.
double MeanIou(const std::vector<double>& confusion, size_t size) {
  double sum = 0;
  int64_t count = 0;
  for (size_t c = 0; c < size; ++c) {
    double row = 0, column = 0;
    for (size_t other = 0; other < size; ++other) {
      if (c + 1 < size) row += confusion[c * size + other];
      if (other + 1 < size) column += confusion[other * size + c];
    }
    const double both = c + 1 < size ? confusion[c * size + c] : 0, either = row + column - both;
    if (either <= 0) continue;
    sum += both / either;
    ++count;
  }
  return count > 0 ? sum / static_cast<double>(count) : std::numeric_limits<double>::quiet_NaN();
}

TrackingScore Compose(double association, int64_t tubes, double sq, int64_t frames) {
  const double aq = tubes > 0 ? association / static_cast<double>(tubes) : 0;
  return {std::sqrt(aq * sq), aq, sq, tubes, frames};
}

}  // namespace

TrackingQuality::TrackingQuality(std::vector<bool> things)
    : classes_(things.size()), things_(std::move(things)), confusion_((classes_ + 1) * (classes_ + 1), 0) {}

void TrackingQuality::Add(const Labels& prediction, const Labels& truth, std::span<const double> weights) {
  const size_t n = truth.category.size();
  if (prediction.category.size() != n || prediction.instance.size() != n || truth.instance.size() != n ||
      (!weights.empty() && weights.size() != n))
    throw InputError("arrays of different length");
  const auto run = [&](size_t a, size_t b) {
    return truth.category[a] == truth.category[b] && truth.instance[a] == truth.instance[b] &&
           prediction.category[a] == prediction.category[b] && prediction.instance[a] == prediction.instance[b];
  };
  for (size_t i = 0; i < n;) {
    const size_t first = i;
    double sum = 0;
    for (; i < n && run(first, i); ++i) sum += weights.empty() ? 1 : weights[i];
    const uint32_t t = truth.category[first], p = prediction.category[first];
    const size_t row = t < classes_ ? t : classes_, column = p < classes_ ? p : classes_;
    confusion_[row * (classes_ + 1) + column] += sum;
    const bool thing = t < classes_ && things_[t], crowd = thing && truth.instance[first] == 0,
               predicted = p < classes_ && things_[p] && !crowd;
    const uint64_t true_tube = Tube(t, truth.instance[first]), predicted_tube = Tube(p, prediction.instance[first]);
    if (thing && !crowd) true_[true_tube] += sum;
    if (predicted) predicted_[predicted_tube] += sum;
    if (thing && predicted) shared_[{true_tube, predicted_tube}] += sum;
  }
  ++frames_;
}

double TrackingQuality::AssociationSum() const {
  double sum = 0;
  for (const auto& [pair, tpa] : shared_) {
    const double size = true_.at(pair.first), fpa = predicted_.at(pair.second) - tpa, fna = size - tpa;
    sum += tpa * (tpa / (tpa + fpa + fna)) / size;
  }
  return sum;
}

TrackingScore TrackingQuality::Score() const {
  return Compose(AssociationSum(), static_cast<int64_t>(true_.size()), MeanIou(confusion_, classes_ + 1), frames_);
}

TrackingScore TrackingQuality::Pool(std::span<const TrackingQuality* const> sequences) {
  if (sequences.empty()) throw InputError("no sequences");
  std::vector<double> confusion(sequences[0]->confusion_.size(), 0);
  double association = 0;
  int64_t tubes = 0, frames = 0;
  for (const TrackingQuality* sequence : sequences) {
    association += sequence->AssociationSum();
    tubes += static_cast<int64_t>(sequence->true_.size());
    frames += sequence->frames_;
    for (size_t i = 0; i < confusion.size(); ++i) confusion[i] += sequence->confusion_[i];
  }
  return Compose(association, tubes, MeanIou(confusion, sequences[0]->classes_ + 1), frames);
}

}  // namespace airsim360
