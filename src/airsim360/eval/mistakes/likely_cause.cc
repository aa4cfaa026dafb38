#include "airsim360/eval/mistakes/likely_cause.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>
#include <numeric>
#include <set>
#include <vector>

#include "airsim360/eval/mistakes/turns.h"

namespace airsim360 {
namespace {

using internal::SampleGrid;
using internal::Turn;

constexpr size_t kLeastSamples = 50;
constexpr double kNoLog = std::numeric_limits<double>::quiet_NaN();

// NaN for what is not above 0.
std::vector<double> Logarithms(std::span<const double> values) {
  std::vector<double> logs;
  logs.reserve(values.size());
  for (const double v : values) logs.push_back(v > 0 && std::isfinite(v) ? std::log(v) : kNoLog);
  return logs;
}

std::vector<double> At(std::span<const double> values, const SampleGrid& grid) {
  std::vector<double> taken;
  for (const size_t p : grid.pixels) taken.push_back(values[p]);
  return taken;
}

double Median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

double MeanDistance(const std::vector<double>& values, double from) {
  double sum = 0;
  for (const double v : values) sum += std::min(1.0, std::abs(v - from));
  return sum / static_cast<double>(values.size());
}

double SlopeOf(const std::vector<double>& x, const std::vector<double>& y) {
  const double n = static_cast<double>(x.size());
  const double mx = std::accumulate(x.begin(), x.end(), 0.0) / n, my = std::accumulate(y.begin(), y.end(), 0.0) / n;
  double xy = 0, xx = 0;
  for (size_t i = 0; i < x.size(); ++i) xy += (x[i] - mx) * (y[i] - my), xx += (x[i] - mx) * (x[i] - mx);
  return xx > 0 ? xy / xx : 0;
}

// Standard error of the slope where the rests are independent.
double SlopeError(const std::vector<double>& x, const std::vector<double>& y, double slope) {
  const double n = static_cast<double>(x.size());
  const double mx = std::accumulate(x.begin(), x.end(), 0.0) / n, my = std::accumulate(y.begin(), y.end(), 0.0) / n;
  double rest = 0, xx = 0;
  for (size_t i = 0; i < x.size(); ++i) rest += std::pow(y[i] - my - slope * (x[i] - mx), 2), xx += (x[i] - mx) * (x[i] - mx);
  return std::sqrt(rest / n / xx);
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
  const double product = SlopeOf(x, y) * SlopeOf(y, x);
  return product > 0 ? std::copysign(std::sqrt(product), SlopeOf(x, y)) : 0;
}

std::string Format(const char* format, auto... values) {
  char text[256];
  std::snprintf(text, sizeof(text), format, values...);
  return text;
}

// What both have above 0.
struct Pairs {
  std::vector<double> prediction, truth, ratio;  // logarithms
  std::vector<size_t> places;
};

// Of the places that have a truth.
LikelyMistake ConstantMistake(std::span<const double> prediction, const std::vector<double>& truth, const SampleGrid& grid) {
  std::set<double> predicted, wanted;
  for (size_t i = 0; i < truth.size(); ++i) {
    if (std::isnan(truth[i])) continue;
    if (std::isfinite(prediction[grid.pixels[i]])) predicted.insert(prediction[grid.pixels[i]]);
    wanted.insert(truth[i]);
  }
  // Nothing above 0 is for EmptyMistake, after the turns: the sky of a picture that is upside down is 0.
  if (predicted.empty() || predicted.size() > 2 || *predicted.rbegin() <= 0 || wanted.size() <= 10) return {};
  return {Format("predictions have only %zu value%s: are they depths?", predicted.size(), predicted.size() == 1 ? "" : "s"), false};
}

LikelyMistake EmptyMistake(const std::vector<double>& predicted, const std::vector<double>& truth) {
  size_t all = 0, none = 0;
  for (size_t i = 0; i < truth.size(); ++i) {
    all += !std::isnan(truth[i]);
    none += !std::isnan(truth[i]) && std::isnan(predicted[i]);
  }
  const double share = static_cast<double>(none) / static_cast<double>(all);
  if (share <= 0.5) return {};
  return {Format("%.3g %% of the predictions where there is a truth are not above 0: are they negated or empty?", 100 * share),
          share > 0.95};
}

LikelyMistake UnitMistake(const Pairs& pairs, const DepthLook& look) {
  struct Unit {
    double factor;
    const char* words;
  };
  constexpr std::array<Unit, 4> kUnits = {{{100, "predictions in centimetres, truths in metres"},
                                           {1000, "predictions in millimetres, truths in metres"},
                                           {0.01, "predictions in metres, truths in centimetres"},
                                           {0.001, "predictions in metres, truths in millimetres"}}};
  const double middle = Median(pairs.ratio), median = std::exp(middle);
  // Most pixels say so; those of a net that saturates do not.
  const auto close =
      std::count_if(pairs.ratio.begin(), pairs.ratio.end(), [middle](double r) { return std::abs(r - middle) < std::log(2); });
  const bool steady = 2 * static_cast<size_t>(close) > pairs.ratio.size();
  const auto near = [median](double factor) { return median > 0.8 * factor && median < 1.25 * factor; };
  const std::string says = Format("predictions are %.4g times the truth (median): ", median);
  for (const auto& [factor, words] : kUnits) {
    if (steady && near(factor)) return {says + words + Format("? (--pred-scale %g)", 1 / factor), true};
  }
  for (const double units : {256.0, 512.0}) {
    if (look.png_scale > 0 && steady && near(look.png_scale * units))
      return {says + Format("is a unit of the PNGs 1/%g m? (--png-scale %.9g)", units, 1 / units), false};
  }
  double largest = 0;
  for (const double p : pairs.prediction) largest = std::max(largest, std::exp(p));
  if (median < 0.5 && largest < 1.0001 && largest > 0.5)
    return {says + "all lie between 0 and 1: are they divided by their largest?", std::abs(largest - 1) < 1e-4};
  if (median > 5.5 || median < 1 / 5.5)
    return {says + Format("are they in another unit? (--pred-scale %.4g)", 1 / median), steady && (median > 20 || median < 0.05)};
  return {};
}

LikelyMistake OrderMistake(const Pairs& pairs) {
  const double correlation = Correlation(Ranks(pairs.prediction), Ranks(pairs.truth));
  if (correlation < -0.6) return {"predictions fall where truths rise: are they inverse depths or disparities?", correlation < -0.85};
  return {};
}

// Predictions that equal the logarithm of the truth, of a few bases.
LikelyMistake LogarithmMistake(std::span<const double> prediction, const std::vector<double>& truth, const SampleGrid& grid,
                               const Pairs& pairs) {
  const double scaled = pairs.ratio.empty() ? 1 : MeanDistance(pairs.ratio, Median(pairs.ratio));
  for (const auto& [base, name] : {std::pair{std::numbers::e, "natural"}, {10.0, "decimal"}, {2.0, "binary"}}) {
    std::vector<double> left;
    for (size_t i = 0; i < truth.size(); ++i) {
      const double p = prediction[grid.pixels[i]];
      if (!std::isnan(truth[i]) && std::isfinite(p)) left.push_back(p * std::log(base) - truth[i]);
    }
    if (std::abs(Median(left)) < 0.15 && MeanDistance(left, 0) < 0.7 * scaled)
      return {std::string("predictions equal the ") + name + " logarithm of the truth: are they logarithms?", false};
  }
  return {};
}

// Whether the ratio follows a cosine of the ray, in each part of the sphere by itself: errors of a net that are even over a part do not.
double FollowingParts(const Pairs& pairs, const SampleGrid& grid, const std::vector<double>& cosine, double sign) {
  constexpr int kSectors = 8;
  int parts = 0, follow = 0;
  for (int part = 0; part < kSectors; ++part) {
    std::vector<double> x, y;
    for (size_t i = 0; i < pairs.places.size(); ++i) {
      const int column = static_cast<int>(pairs.places[i]) % grid.width, row = static_cast<int>(pairs.places[i]) / grid.width;
      if (column * 4 / grid.width + 4 * (row * 2 / grid.height) != part) continue;
      x.push_back(std::log(cosine[pairs.places[i]]));
      y.push_back(pairs.ratio[i]);
    }
    if (x.size() < kLeastSamples) continue;
    // Outliers (edges) are drawn in.
    const double middle = Median(y);
    for (double& v : y) v = std::clamp(v, middle - 2, middle + 2);
    const double slope = sign * SlopeOf(x, y);
    // Where the cosine hardly differs, chance decides.
    if (!(SlopeError(x, y, sign * slope) < 0.25)) continue;
    ++parts;
    follow += slope > 0.6 && slope < 1.5;
  }
  return parts < 3 ? 0 : static_cast<double>(follow) / parts;
}

LikelyMistake AxisMistake(const Pairs& pairs, const SampleGrid& grid) {
  constexpr std::array<const char*, 3> kWords = {"the depth along the axis of a cube face", "the horizontal distance",
                                                 "the depth along the axis in the middle of the picture"};
  LikelyMistake best;
  const double straight = MeanDistance(pairs.ratio, Median(pairs.ratio));
  double best_share = 0, best_left = straight;
  for (size_t axis = 0; axis < kWords.size(); ++axis) {
    std::vector<double> cosine;
    for (int y = 0; y < grid.height; ++y) {
      const double phi = std::numbers::pi * (0.5 - (y + 0.5) / grid.height);
      for (int x = 0; x < grid.width; ++x) {
        const double theta = 2 * std::numbers::pi * ((x + 0.5) / grid.width - 0.5);
        const double right = std::abs(std::cos(phi) * std::sin(theta)), forward = std::abs(std::cos(phi) * std::cos(theta)),
                     up = std::abs(std::sin(phi));
        cosine.push_back(std::max(1e-3, axis == 0 ? std::max({right, forward, up}) : axis == 1 ? std::cos(phi) : forward));
      }
    }
    for (const double sign : {1.0, -1.0}) {
      std::vector<double> left;
      for (size_t i = 0; i < pairs.ratio.size(); ++i) left.push_back(pairs.ratio[i] - sign * std::log(cosine[pairs.places[i]]));
      const double rest = MeanDistance(left, Median(left)), share = FollowingParts(pairs, grid, cosine, sign);
      if (rest >= best_left || share < 0.74) continue;
      best_left = rest, best_share = share;
      best.text = std::string(sign > 0 ? "predictions" : "truths") + " follow the cosine of the ray: are they " + kWords[axis] +
                  " instead of the range along the ray?";
    }
  }
  best.sure = best_share > 0.86 && best_left < 0.97 * straight;
  return best;
}

// Logarithms: predictions at the grid's pixels, truths of the whole picture.
LikelyMistake TurnMistake(const std::vector<double>& prediction, const std::vector<double>& truth, const SampleGrid& grid, bool panorama) {
  // What a turn must change of the truth to be told.
  constexpr double kChange = 0.1;
  const auto errors = [&](const Turn& turn) {
    std::vector<double> all(prediction.size(), kNoLog), ratios;
    for (size_t p = 0; p < prediction.size(); ++p) {
      const double t = truth[turn.From(grid, grid.pixels[p])];
      // No prediction is right where there is no truth; a prediction where there is none is not judged.
      if (std::isnan(prediction[p])) {
        all[p] = std::isnan(t) ? 0 : 1;
      } else if (!std::isnan(t)) {
        all[p] = prediction[p] - t;
        if (p % 4 == 0) ratios.push_back(all[p]);
      }
    }
    if (ratios.empty()) return all;
    const double middle = Median(ratios);
    for (size_t p = 0; p < prediction.size(); ++p) {
      if (!std::isnan(prediction[p])) all[p] = std::min(1.0, std::abs(all[p] - middle));
    }
    return all;
  };
  const auto same = [&](size_t a, size_t b) {
    if (std::isnan(truth[a]) || std::isnan(truth[b])) return std::isnan(truth[a]) && std::isnan(truth[b]);
    return std::abs(truth[a] - truth[b]) < kChange;
  };
  const internal::LikelyTurn found = internal::FindTurn(grid, panorama, errors, same);
  if (found.words.empty()) return {};
  return {"predictions fit far better when they are " + found.words + ": are they?", found.sure};
}

}  // namespace

LikelyMistake LikelyDepthMistake(std::span<const double> prediction, std::span<const double> truth, int width, int height,
                                 const DepthLook& look) {
  const SampleGrid grid(width, height);
  const std::vector<double> predicted = Logarithms(At(prediction, grid)), logarithms = Logarithms(truth), wanted = At(logarithms, grid);
  Pairs pairs;
  size_t truths = 0;
  for (size_t p = 0; p < grid.pixels.size(); ++p) {
    truths += !std::isnan(wanted[p]);
    if (std::isnan(wanted[p]) || std::isnan(predicted[p])) continue;
    pairs.prediction.push_back(predicted[p]);
    pairs.truth.push_back(wanted[p]);
    pairs.ratio.push_back(predicted[p] - wanted[p]);
    pairs.places.push_back(p);
  }
  if (truths < kLeastSamples) return {};
  if (LikelyMistake constant = ConstantMistake(prediction, wanted, grid); !constant.text.empty()) return constant;
  LikelyMistake probable;
  // The first that is sure, else the first that is probable.
  const auto judge = [&](LikelyMistake found) {
    if (probable.text.empty() || (found.sure && !probable.sure)) probable = std::move(found);
    return probable.sure;
  };
  if (pairs.ratio.size() >= kLeastSamples) {
    if (judge(OrderMistake(pairs)) || judge(LogarithmMistake(prediction, wanted, grid, pairs)) || judge(UnitMistake(pairs, look)))
      return probable;
    // What fits well is turned no way.
    if (MeanDistance(pairs.ratio, Median(pairs.ratio)) > 0.01 && look.panorama && judge(AxisMistake(pairs, grid))) return probable;
  }
  if (judge(TurnMistake(predicted, logarithms, grid, look.panorama))) return probable;
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
