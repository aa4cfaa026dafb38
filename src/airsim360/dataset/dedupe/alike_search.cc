#include "airsim360/dataset/dedupe/alike_search.h"

#include <algorithm>
#include <utility>

#include "airsim360/base/parallel.h"
#include "airsim360/dataset/dedupe/upright_band.h"

namespace airsim360::internal {
namespace {

constexpr size_t kAhead = 16;  // frames
constexpr size_t kRowsOfTask = 2048;

// In lanes, so that the compiler may keep the order of the sums.
double Product(const float* a, const float* b, size_t n) {
  constexpr size_t kLanes = 16;
  float sums[kLanes] = {};
  size_t i = 0;
  for (; i + kLanes <= n; i += kLanes) {
    for (size_t k = 0; k < kLanes; ++k) sums[k] += a[i + k] * b[i + k];
  }
  double sum = 0;
  for (; i < n; ++i) sum += double{a[i]} * double{b[i]};
  for (const float lane : sums) sum += double{lane};
  return sum;
}

}  // namespace

std::optional<std::pair<size_t, double>> LargestProduct(std::span<const float> rows, std::span<const float> row) {
  const size_t length = row.size(), count = length == 0 ? 0 : rows.size() / length;
  if (count == 0) return std::nullopt;
  std::vector<std::pair<size_t, double>> best((count + kRowsOfTask - 1) / kRowsOfTask);
  ParallelFor(static_cast<int64_t>(best.size()), [&](int64_t task) {
    const size_t begin = static_cast<size_t>(task) * kRowsOfTask, end = std::min(begin + kRowsOfTask, count);
    std::pair<size_t, double> found{begin, Product(&rows[begin * length], row.data(), length)};
    for (size_t r = begin + 1; r < end; ++r) {
      const double product = Product(&rows[r * length], row.data(), length);
      if (product > found.second) found = {r, product};
    }
    best[static_cast<size_t>(task)] = found;
  });
  return *std::ranges::max_element(best, [](const auto& a, const auto& b) { return a.second < b.second; });
}

AlikeSearch::AlikeSearch(const NativeDataset& data, std::vector<AlikeFrame> frames, const std::filesystem::path& model)
    : data_(data), frames_(std::move(frames)), detector_(model) {}

Image<Rgb8> AlikeSearch::Picture(size_t number) {
  if (!ahead_.contains(number)) {
    ahead_.clear();
    const size_t n = std::min(kAhead, frames_.size() - number);
    std::vector<Image<Rgb8>> pictures(n);
    ParallelFor(static_cast<int64_t>(n), [&](int64_t i) {
      const AlikeFrame& frame = frames_[number + static_cast<size_t>(i)];
      const Image<Rgb8> panorama = data_.Rgb(data_.Frame(frame.position), data_.views().front());
      pictures[static_cast<size_t>(i)] = UprightBand(panorama, frame.R_WC, detector_.width(), detector_.height());
    });
    for (size_t i = 0; i < n; ++i) ahead_.emplace(number + i, std::move(pictures[i]));
  }
  return std::move(ahead_.extract(number).mapped());
}

std::optional<AlikeSearch::Twin> AlikeSearch::MostAlike(size_t number) {
  last_ = number;
  last_descriptor_ = detector_.Describe(Picture(number));
  ++described_;
  const Kept& kept = kept_[frames_[number].place];
  const auto best = LargestProduct(kept.descriptors, last_descriptor_);
  if (!best) return std::nullopt;
  return Twin{kept.numbers[best->first], best->second};
}

void AlikeSearch::Keep() {
  Kept& kept = kept_[frames_[last_].place];
  kept.descriptors.insert(kept.descriptors.end(), last_descriptor_.begin(), last_descriptor_.end());
  kept.numbers.push_back(last_);
}

}  // namespace airsim360::internal
