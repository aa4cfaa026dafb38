#include "airsim360/eval/panoptic/panoptic_quality.h"

#include <algorithm>
#include <limits>
#include <string>
#include <unordered_set>

#include "airsim360/base/error.h"

namespace airsim360 {
namespace {

constexpr uint32_t kVoid = 0;

uint64_t Key(uint32_t truth, uint32_t prediction) { return uint64_t{truth} << 32 | prediction; }

// What is said of ids that differ where they would be the same with the first and the third byte exchanged; else "".
std::string ExchangedChannels(std::span<const PanopticSegment> segments, const std::unordered_map<uint32_t, double>& pixels) {
  const auto drawn = [&](const PanopticSegment& s) { return pixels.contains((s.id & 0xff) << 16 | (s.id & 0xff00) | (s.id >> 16 & 0xff)); };
  if (segments.empty() || !std::ranges::all_of(segments, drawn)) return "";
  return "; red and blue exchanged it would be: ids of PNGs are R + 256 G + 65536 B (cv2 takes blue, green, red)";
}

// Segment of each id; ids of pixels and of the list are the same.
std::unordered_map<uint32_t, const PanopticSegment*> Index(std::span<const PanopticSegment> segments,
                                                           const std::unordered_map<uint32_t, double>& pixels, const char* whose,
                                                           size_t categories) {
  std::unordered_map<uint32_t, const PanopticSegment*> index;
  for (const PanopticSegment& segment : segments) {
    const std::string name = std::string(whose) + " segment " + std::to_string(segment.id);
    if (segment.category >= categories) throw InputError(name + " has an unknown category");
    if (!index.emplace(segment.id, &segment).second) throw InputError(name + " is listed twice");
    if (!pixels.contains(segment.id)) throw InputError(name + " is listed, but no pixel has this id" + ExchangedChannels(segments, pixels));
  }
  for (const auto& [id, area] : pixels) {
    if (id != kVoid && !index.contains(id))
      throw InputError("pixels have the id " + std::to_string(id) + ", but no " + std::string(whose) + " segment of it is listed" +
                       ExchangedChannels(segments, pixels));
  }
  return index;
}

std::vector<PanopticSegment> Present(std::span<const PanopticSegment> segments, const std::unordered_map<uint32_t, double>& pixels) {
  std::vector<PanopticSegment> present;
  for (const PanopticSegment& segment : segments) {
    if (pixels.contains(segment.id)) present.push_back(segment);
  }
  return present;
}

}  // namespace

std::vector<PanopticSegment> PanopticOverlap::PresentPredictions(std::span<const PanopticSegment> segments) const {
  return Present(segments, predicted_);
}

std::vector<PanopticSegment> PanopticOverlap::PresentTruths(std::span<const PanopticSegment> segments) const {
  return Present(segments, true_);
}

void PanopticOverlap::Add(std::span<const uint32_t> prediction, std::span<const uint32_t> truth, std::span<const double> weights) {
  if (prediction.size() != truth.size() || (!weights.empty() && weights.size() != truth.size()))
    throw InputError("arrays of different length: " + std::to_string(prediction.size()) + " predictions, " + std::to_string(truth.size()) +
                     " truths");
  // Neighbours mostly belong to the same pair: look each run up once.
  for (size_t i = 0; i < truth.size();) {
    const uint32_t t = truth[i], p = prediction[i];
    double sum = 0;
    for (; i < truth.size() && truth[i] == t && prediction[i] == p; ++i) sum += weights.empty() ? 1 : weights[i];
    shared_[Key(t, p)] += sum;
    predicted_[p] += sum;
    true_[t] += sum;
  }
}

void PanopticOverlap::Add(const PanopticOverlap& other) {
  for (const auto& [key, sum] : other.shared_) shared_[key] += sum;
  for (const auto& [id, sum] : other.predicted_) predicted_[id] += sum;
  for (const auto& [id, sum] : other.true_) true_[id] += sum;
}

double PanopticOverlap::Shared(uint32_t truth, uint32_t prediction) const {
  const auto found = shared_.find(Key(truth, prediction));
  return found == shared_.end() ? 0 : found->second;
}

void PanopticOverlap::Count(std::span<const PanopticSegment> predictions, std::span<const PanopticSegment> truths,
                            std::span<PanopticCount> counts) const {
  const auto predicted = Index(predictions, predicted_, "predicted", counts.size()), real = Index(truths, true_, "true", counts.size());
  // A pair with an IoU above one half is the only such pair of both, so the order does not matter.
  std::unordered_map<uint32_t, double> matched_truths;
  std::unordered_set<uint32_t> matched_predictions;
  for (const auto& [key, shared] : shared_) {
    const auto t = static_cast<uint32_t>(key >> 32), p = static_cast<uint32_t>(key);
    if (t == kVoid || p == kVoid) continue;
    const PanopticSegment &truth = *real.at(t), &prediction = *predicted.at(p);
    if (truth.crowd || truth.category != prediction.category) continue;
    const double iou = shared / (predicted_.at(p) + true_.at(t) - shared - Shared(kVoid, p));
    if (iou <= 0.5) continue;
    matched_truths.emplace(t, iou);
    matched_predictions.insert(p);
  }
  std::unordered_map<size_t, uint32_t> crowds;  // the last of each category, as panopticapi has it
  for (const PanopticSegment& truth : truths) {
    // In the order of the list, so that sums do not depend on how ids are hashed.
    if (const auto match = matched_truths.find(truth.id); match != matched_truths.end()) {
      ++counts[truth.category].tp;
      counts[truth.category].iou += match->second;
    } else if (truth.crowd) {
      crowds[truth.category] = truth.id;
    } else {
      ++counts[truth.category].fn;
    }
  }
  for (const PanopticSegment& prediction : predictions) {
    if (matched_predictions.contains(prediction.id)) continue;
    double excused = Shared(kVoid, prediction.id);
    if (const auto crowd = crowds.find(prediction.category); crowd != crowds.end()) excused += Shared(crowd->second, prediction.id);
    if (excused / predicted_.at(prediction.id) <= 0.5) ++counts[prediction.category].fp;
  }
}

void AddCounts(std::span<const PanopticCount> counts, std::span<PanopticCount> sum, int64_t times) {
  for (size_t c = 0; c < counts.size(); ++c) {
    sum[c].iou += static_cast<double>(times) * counts[c].iou;
    sum[c].tp += times * counts[c].tp;
    sum[c].fp += times * counts[c].fp;
    sum[c].fn += times * counts[c].fn;
  }
}

PanopticQuality QualityOf(const PanopticCount& count) {
  if (!count.seen()) return {0, 0, 0, 0};
  const auto tp = static_cast<double>(count.tp);
  const double all = tp + 0.5 * static_cast<double>(count.fp) + 0.5 * static_cast<double>(count.fn);
  return {count.iou / all, count.tp > 0 ? count.iou / tp : 0, tp / all, 1};
}

PanopticQuality MeanQuality(std::span<const PanopticCount> counts, const std::vector<bool>& chosen) {
  PanopticQuality mean;
  for (size_t c = 0; c < counts.size(); ++c) {
    if (!chosen[c] || !counts[c].seen()) continue;
    const PanopticQuality one = QualityOf(counts[c]);
    mean.pq += one.pq;
    mean.sq += one.sq;
    mean.rq += one.rq;
    ++mean.categories;
  }
  const double n = mean.categories > 0 ? static_cast<double>(mean.categories) : std::numeric_limits<double>::quiet_NaN();
  return {mean.pq / n, mean.sq / n, mean.rq / n, mean.categories};
}

}  // namespace airsim360
