#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>
#include <numbers>
#include <numeric>
#include <vector>

#include "airsim360/eval/mistakes/depth_pairs.h"
#include "airsim360/eval/mistakes/likely_cause.h"
#include "airsim360/math/median.h"

namespace airsim360 {
namespace internal {

double MeanDistance(std::span<const double> values, double from) {
  double sum = 0;
  for (const double v : values) sum += std::min(1.0, std::abs(v - from));
  return sum / static_cast<double>(values.size());
}

double Agreement(std::span<const double> values, double from) {
  const double near = std::log(1.25);
  const auto count = std::ranges::count_if(values, [&](double v) { return std::abs(v - from) < near; });
  return static_cast<double>(count) / static_cast<double>(values.size());
}

double SlopeOf(std::span<const double> x, std::span<const double> y) {
  const double n = static_cast<double>(x.size());
  const double mx = std::accumulate(x.begin(), x.end(), 0.0) / n, my = std::accumulate(y.begin(), y.end(), 0.0) / n;
  double xy = 0, xx = 0;
  for (size_t i = 0; i < x.size(); ++i) xy += (x[i] - mx) * (y[i] - my), xx += (x[i] - mx) * (x[i] - mx);
  return xx > 0 ? xy / xx : 0;
}

}  // namespace internal

namespace {

using internal::Agreement;
using internal::DepthPairs;
using internal::kLeastSamples;
using internal::kNearlyAll;
using internal::MeanDistance;
using internal::SampleGrid;

constexpr double kNoLog = std::numeric_limits<double>::quiet_NaN();

// NaN for what is not above 0.
double Logarithm(double value) { return value > 0 && std::isfinite(value) ? std::log(value) : kNoLog; }

std::vector<double> LogarithmsAt(std::span<const double> values, std::span<const size_t> places) {
  std::vector<double> logs;
  logs.reserve(places.size());
  for (const size_t p : places) logs.push_back(Logarithm(values[p]));
  return logs;
}

DepthPairs PairUp(const std::vector<double>& predicted, const std::vector<double>& truth) {
  DepthPairs pairs;
  for (size_t p = 0; p < truth.size(); ++p) {
    if (std::isnan(truth[p]) || std::isnan(predicted[p])) continue;
    pairs.prediction.push_back(predicted[p]);
    pairs.truth.push_back(truth[p]);
    pairs.ratio.push_back(predicted[p] - truth[p]);
    pairs.places.push_back(p);
  }
  if (pairs.ratio.empty()) return pairs;
  pairs.middle = UpperMedian(pairs.ratio);
  pairs.scaled_error = MeanDistance(pairs.ratio, pairs.middle);
  return pairs;
}

std::vector<double> Ranks(const std::vector<double>& values) {
  std::vector<size_t> order(values.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) { return values[a] < values[b]; });
  std::vector<double> ranks(values.size());
  for (size_t first = 0; first < order.size();) {
    size_t end = first;
    while (end < order.size() && values[order[end]] == values[order[first]]) ++end;
    for (size_t i = first; i < end; ++i) ranks[order[i]] = 0.5 * static_cast<double>(first + end - 1);
    first = end;
  }
  return ranks;
}

double Correlation(const std::vector<double>& x, const std::vector<double>& y) {
  const double slope = internal::SlopeOf(x, y), product = slope * internal::SlopeOf(y, x);
  return product > 0 ? std::copysign(std::sqrt(product), slope) : 0;
}

std::string Format(const char* format, auto... values) {
  char text[256];
  std::snprintf(text, sizeof(text), format, values...);
  return text;
}

// How many different numbers there are, up to `most`.
size_t CountDifferent(const std::vector<double>& values, size_t most) {
  std::vector<double> found;
  for (const double v : values) {
    if (found.size() < most && std::ranges::find(found, v) == found.end()) found.push_back(v);
  }
  return found.size();
}

LikelyMistake ConstantMistake(const DepthPairs& pairs) {
  constexpr size_t kMany = 11;
  const size_t values = CountDifferent(pairs.prediction, kMany);
  if (values > 2 || CountDifferent(pairs.truth, kMany) < kMany) return {};
  return {Format("predictions have only %zu value%s: are they depths?", values, values == 1 ? "" : "s"), false};
}

// Predictions at the pixels of the grid; logarithms of the truths.
LikelyMistake EmptyMistake(const std::vector<double>& prediction, const std::vector<double>& truth) {
  size_t all = 0, none = 0;
  std::vector<double> negated;
  for (size_t i = 0; i < truth.size(); ++i) {
    if (std::isnan(truth[i])) continue;
    ++all;
    none += !(prediction[i] > 0);
    if (prediction[i] < 0 && std::isfinite(prediction[i])) negated.push_back(std::log(-prediction[i]) - truth[i]);
  }
  const double share = static_cast<double>(none) / static_cast<double>(all);
  if (share <= 0.5) return {};
  const bool fits = !negated.empty() &&
                    Agreement(negated, UpperMedian(negated)) * static_cast<double>(negated.size()) >= kNearlyAll * static_cast<double>(all);
  return {Format("%.3g %% of the predictions where there is a truth are not above 0: are they negated or empty?", 100 * share), fits};
}

struct Unit {
  double factor;
  const char* words;
};
constexpr std::array<Unit, 4> kUnits = {{{100, "predictions in centimetres, truths in metres"},
                                         {1000, "predictions in millimetres, truths in metres"},
                                         {0.01, "predictions in metres, truths in centimetres"},
                                         {0.001, "predictions in metres, truths in millimetres"}}};

LikelyMistake UnitMistake(const DepthPairs& pairs, const DepthLook& look) {
  // A constant scale is no mistake in itself. Only a known unit, met closely, is.
  constexpr double kClose = 0.03;
  const double median = std::exp(pairs.middle);
  // Most pixels say so; those of a net that saturates do not.
  const auto close = std::ranges::count_if(pairs.ratio, [&](double r) { return std::abs(r - pairs.middle) < std::log(2); });
  const bool steady = 2 * static_cast<size_t>(close) > pairs.ratio.size();
  const auto near = [median](double factor) { return median > 0.8 * factor && median < 1.25 * factor; };
  const std::string says = Format("predictions are %.4g times the truth (median): ", median);
  for (const auto& [factor, words] : kUnits) {
    if (steady && near(factor))
      return {says + words + Format("? (--pred-scale %g)", 1 / factor),
              std::abs(pairs.middle - std::log(factor)) < kClose && Agreement(pairs.ratio, std::log(factor)) >= kNearlyAll};
  }
  for (const double units : {256.0, 512.0}) {
    if (look.png_scale > 0 && steady && near(look.png_scale * units))
      return {says + Format("is a unit of the PNGs 1/%g m? (--png-scale %.9g)", units, 1 / units), false};
  }
  const double largest = std::exp(*std::ranges::max_element(pairs.prediction));
  if (median < 0.5 && largest < 1.0001 && largest > 0.5)
    return {says + "all lie between 0 and 1: are they divided by their largest?",
            std::abs(largest - 1) < 1e-4 && Agreement(pairs.ratio, pairs.middle) >= kNearlyAll};
  if (median > 5.5 || median < 1 / 5.5) return {says + Format("are they in another unit? (--pred-scale %.4g)", 1 / median), false};
  return {};
}

LikelyMistake OrderMistake(const DepthPairs& pairs) {
  // A part of the pixels is enough, of all columns.
  constexpr size_t kStep = 3;
  std::vector<double> prediction, truth, product;
  for (size_t i = 0; i < pairs.ratio.size(); ++i) {
    product.push_back(pairs.prediction[i] + pairs.truth[i]);
    if (i % kStep == 0) prediction.push_back(pairs.prediction[i]), truth.push_back(pairs.truth[i]);
  }
  const double correlation = Correlation(Ranks(prediction), Ranks(truth));
  if (correlation > -0.6) return {};
  // Inverse depths times the depths are the same everywhere.
  const double middle = UpperMedian(product);
  const bool inverse =
      correlation < -0.85 && Agreement(product, middle) >= kNearlyAll && MeanDistance(product, middle) < 0.5 * pairs.scaled_error;
  return {"predictions fall where truths rise: are they inverse depths or disparities?", inverse};
}

// Predictions that equal the logarithm of the truth, of a few bases. Both at the pixels of the grid, the truths as logarithms.
LikelyMistake LogarithmMistake(const std::vector<double>& prediction, const std::vector<double>& truth, const DepthPairs& pairs) {
  for (const auto& [base, name] : {std::pair{std::numbers::e, "natural"}, {10.0, "decimal"}, {2.0, "binary"}}) {
    std::vector<double> left;
    for (size_t i = 0; i < truth.size(); ++i) {
      if (!std::isnan(truth[i]) && std::isfinite(prediction[i])) left.push_back(prediction[i] * std::log(base) - truth[i]);
    }
    if (std::abs(UpperMedian(left)) < 0.15 && MeanDistance(left, 0) < 0.7 * pairs.scaled_error)
      return {std::string("predictions equal the ") + name + " logarithm of the truth: are they logarithms?", false};
  }
  return {};
}

// Of the rows that a grid and its mirror images have.
std::vector<double> TruthLogarithms(std::span<const double> truth, const SampleGrid& grid) {
  std::vector<double> logs(truth.size(), kNoLog);
  const auto width = static_cast<size_t>(grid.picture_width);
  for (const int row : grid.rows) {
    for (const int y : {row, grid.picture_height - 1 - row}) {
      const size_t first = static_cast<size_t>(y) * width;
      for (size_t p = first; p < first + width; ++p) logs[p] = Logarithm(truth[p]);
    }
  }
  return logs;
}

LikelyMistake TurnMistake(std::span<const double> prediction, std::span<const double> truth, int width, int height, bool panorama) {
  // What a turn must change of the truth to be told.
  constexpr double kChange = 0.1;
  const auto compare = [&](const SampleGrid& grid) {
    const auto predicted = std::make_shared<const std::vector<double>>(LogarithmsAt(prediction, grid.pixels));
    const auto wanted = std::make_shared<const std::vector<double>>(TruthLogarithms(truth, grid));
    const auto errors = [predicted, wanted](std::span<const size_t> places) {
      std::vector<double> all(places.size(), kNoLog), ratios;
      for (size_t p = 0; p < places.size(); ++p) {
        const double t = (*wanted)[places[p]], mine = (*predicted)[p];
        // No prediction is right where there is no truth; a prediction where there is none is not judged.
        if (std::isnan(mine)) {
          all[p] = std::isnan(t) ? 0 : 1;
        } else if (!std::isnan(t)) {
          all[p] = mine - t;
          if (p % 4 == 0) ratios.push_back(all[p]);
        }
      }
      if (ratios.empty()) return all;
      const double middle = UpperMedian(std::move(ratios));
      for (size_t p = 0; p < places.size(); ++p) {
        if (!std::isnan((*predicted)[p])) all[p] = std::min(1.0, std::abs(all[p] - middle));
      }
      return all;
    };
    const auto same = [wanted](std::span<const size_t> a, std::span<const size_t> b) {
      std::vector<uint8_t> equal;
      equal.reserve(a.size());
      for (size_t i = 0; i < a.size(); ++i) {
        const double x = (*wanted)[a[i]], y = (*wanted)[b[i]];
        equal.push_back(std::isnan(x) || std::isnan(y) ? std::isnan(x) && std::isnan(y) : std::abs(x - y) < kChange);
      }
      return equal;
    };
    return internal::TurnComparison{errors, same};
  };
  const internal::LikelyTurn found = internal::FindTurn(width, height, panorama, compare);
  if (found.words.empty()) return {};
  return {"predictions fit far better when they are " + found.words + ": are they?", found.sure};
}

}  // namespace

LikelyMistake LikelyDepthMistake(std::span<const double> prediction, std::span<const double> truth, int width, int height,
                                 const DepthLook& look) {
  const SampleGrid grid(width, height);
  std::vector<double> predicted;
  for (const size_t p : grid.pixels) predicted.push_back(prediction[p]);
  const std::vector<double> wanted = LogarithmsAt(truth, grid.pixels);
  const DepthPairs pairs = PairUp(LogarithmsAt(prediction, grid.pixels), wanted);
  if (static_cast<size_t>(std::ranges::count_if(wanted, [](double t) { return !std::isnan(t); })) < kLeastSamples) return {};
  LikelyMistake probable;
  // The first that is sure, else the first that is probable.
  const auto judge = [&](LikelyMistake found) {
    if (probable.text.empty() || (found.sure && !probable.sure)) probable = std::move(found);
    return probable.sure;
  };
  if (pairs.ratio.size() >= kLeastSamples) {
    if (LikelyMistake constant = ConstantMistake(pairs); !constant.text.empty()) return constant;
    if (judge(OrderMistake(pairs)) || judge(LogarithmMistake(predicted, wanted, pairs)) || judge(UnitMistake(pairs, look))) return probable;
    // What fits well is turned no way.
    if (pairs.scaled_error > 0.01 && look.panorama && judge(AxisMistake(pairs, grid))) return probable;
  }
  if (judge(TurnMistake(prediction, truth, width, height, look.panorama))) return probable;
  judge(EmptyMistake(predicted, wanted));
  return probable;
}

std::string SharedMaximum(std::span<const double> truth, double max_depth) {
  double largest = 0;
  size_t valid = 0, same = 0;
  for (const double t : truth) {
    if (!(t > 0 && t <= max_depth) || !std::isfinite(t)) continue;
    ++valid;
    if (t > largest) largest = t, same = 0;
    same += t == largest;
  }
  // A row along the horizon of a plane is less.
  const double share = valid > 0 ? static_cast<double>(same) / static_cast<double>(valid) : 0;
  if (same < kLeastSamples || share < 0.03 || share > 0.99) return "";
  return Format(
      "%.3g %% of the truths are exactly %.6g, the largest: is the sky or what is out of reach written so? (--max-depth leaves it out)",
      100 * share, largest);
}

}  // namespace airsim360
