#include "airsim360/eval/semantic/confusion.h"

#include <cmath>
#include <limits>
#include <string>

#include "airsim360/base/error.h"

namespace airsim360 {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

// Mean over classes whose value is a number.
template <class Value>
double MeanOf(size_t classes, const Value& value) {
  double sum = 0;
  size_t count = 0;
  for (size_t c = 0; c < classes; ++c) {
    const double v = value(c);
    if (std::isnan(v)) continue;
    sum += v;
    ++count;
  }
  return count == 0 ? kNan : sum / static_cast<double>(count);
}

}  // namespace

void Confusion::Add(std::span<const uint16_t> prediction, std::span<const uint16_t> truth, std::span<const double> weights) {
  if (prediction.size() != truth.size() || (!weights.empty() && weights.size() != truth.size()))
    throw InputError("arrays of different length: " + std::to_string(prediction.size()) + " predictions, " + std::to_string(truth.size()) +
                     " truths");
  for (size_t i = 0; i < truth.size(); ++i) {
    if (truth[i] >= classes_) continue;
    const size_t predicted = prediction[i] < classes_ ? prediction[i] : classes_;
    table_[truth[i] * (classes_ + 1) + predicted] += weights.empty() ? 1 : weights[i];
  }
}

void Confusion::Add(const Confusion& other, double times) {
  if (other.classes_ != classes_) throw InputError("tables of different classes");
  for (size_t i = 0; i < table_.size(); ++i) table_[i] += times * other.table_[i];
}

double Confusion::True(size_t truth) const {
  double sum = 0;
  for (size_t p = 0; p <= classes_; ++p) sum += At(truth, p);
  return sum;
}

double Confusion::Predicted(size_t prediction) const {
  double sum = 0;
  for (size_t t = 0; t < classes_; ++t) sum += At(t, prediction);
  return sum;
}

double Confusion::Iou(size_t c) const {
  const double both = At(c, c), either = True(c) + Predicted(c) - both;
  return either > 0 ? both / either : kNan;
}

double Confusion::Accuracy(size_t c) const {
  const double truth = True(c);
  return truth > 0 ? At(c, c) / truth : kNan;
}

double Confusion::MeanIou() const {
  return MeanOf(classes_, [this](size_t c) { return Iou(c); });
}

double Confusion::MeanIouOfPresent() const {
  return MeanOf(classes_, [this](size_t c) { return True(c) > 0 ? Iou(c) : kNan; });
}

double Confusion::MeanAccuracy() const {
  return MeanOf(classes_, [this](size_t c) { return Accuracy(c); });
}

double Confusion::FrequencyWeightedIou() const {
  double sum = 0, all = 0;
  for (size_t c = 0; c < classes_; ++c) {
    const double truth = True(c);
    if (truth > 0) sum += truth * Iou(c);
    all += truth;
  }
  return all > 0 ? sum / all : kNan;
}

double Confusion::PixelAccuracy() const {
  double right = 0, all = 0;
  for (size_t c = 0; c < classes_; ++c) {
    right += At(c, c);
    all += True(c);
  }
  return all > 0 ? right / all : kNan;
}

}  // namespace airsim360
