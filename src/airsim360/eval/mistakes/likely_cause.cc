#include "airsim360/eval/mistakes/likely_cause.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace airsim360 {
namespace {

constexpr size_t kSamples = 5000;
constexpr size_t kLeastSamples = 50;

struct Place {
  int x = 0, y = 0;
};

struct Turn {
  const char* words;
  Place (*from)(Place p, int width, int height);  // where the right pixel is
};
constexpr std::array<Turn, 4> kTurns = {{
    {"mirrored left to right (longitude counted the other way)",
     [](Place p, int w, int) {
       return Place{w - 1 - p.x, p.y};
     }},
    {"turned by 180 degrees (half the width)",
     [](Place p, int w, int) {
       return Place{(p.x + w / 2) % w, p.y};
     }},
    {"upside down",
     [](Place p, int, int h) {
       return Place{p.x, h - 1 - p.y};
     }},
    {"upside down and mirrored",
     [](Place p, int w, int h) {
       return Place{w - 1 - p.x, h - 1 - p.y};
     }},
}};

double Median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

std::vector<Place> SamplePlaces(std::span<const double> truth, int width, int height) {
  std::vector<Place> places;
  // A step that shares no factor with a power of two, so that columns do not repeat.
  const size_t pixels = static_cast<size_t>(width) * static_cast<size_t>(height), step = std::max<size_t>(1, pixels / kSamples) | 1;
  for (size_t i = 0; i < pixels; i += step) {
    if (truth[i] > 0 && std::isfinite(truth[i]))
      places.push_back({static_cast<int>(i % static_cast<size_t>(width)), static_cast<int>(i / static_cast<size_t>(width))});
  }
  return places;
}

std::string UnitMistake(const std::vector<double>& ratios) {
  struct Unit {
    double factor;
    const char* words;
  };
  constexpr std::array<Unit, 4> kUnits = {{{100, "predictions in centimetres, truths in metres"},
                                           {1000, "predictions in millimetres, truths in metres"},
                                           {0.01, "predictions in metres, truths in centimetres"},
                                           {0.001, "predictions in metres, truths in millimetres"}}};
  const double median = Median(ratios);
  for (const auto& [factor, words] : kUnits) {
    if (median < 0.8 * factor || median > 1.25 * factor) continue;
    // Most pixels say so.
    const auto close =
        std::count_if(ratios.begin(), ratios.end(), [factor = factor](double r) { return r > 0.5 * factor && r < 2 * factor; });
    if (2 * static_cast<size_t>(close) < ratios.size()) continue;
    char text[160];
    std::snprintf(text, sizeof(text), "predictions are %.4g times the truth (median): %s? (--pred-scale %g)", median, words, 1 / factor);
    return text;
  }
  return "";
}

/// Median of |ratio / expected - 1|.
template <class Expected>
double Misfit(const std::vector<double>& ratios, const std::vector<Place>& places, const Expected& expected) {
  std::vector<double> errors;
  for (size_t i = 0; i < ratios.size(); ++i) errors.push_back(std::abs(ratios[i] / expected(places[i]) - 1));
  return Median(errors);
}

std::string AxisMistake(const std::vector<double>& ratios, const std::vector<Place>& places, int width, int height, double straight) {
  if (width != 2 * height) return "";
  const auto cosine = [&](Place p, bool horizontal) {
    const double theta = 2 * std::numbers::pi * ((p.x + 0.5) / width - 0.5), phi = std::numbers::pi * (0.5 - (p.y + 0.5) / height);
    if (horizontal) return std::cos(phi);
    return std::max({std::abs(std::cos(phi) * std::sin(theta)), std::abs(std::sin(phi)), std::abs(std::cos(phi) * std::cos(theta))});
  };
  constexpr std::array<const char*, 2> kWords = {"the depth along the axis of a cube face", "the horizontal distance"};
  for (const bool horizontal : {false, true}) {
    for (const bool of_truth : {false, true}) {
      const double misfit = Misfit(ratios, places, [&](Place p) { return of_truth ? 1 / cosine(p, horizontal) : cosine(p, horizontal); });
      if (misfit < 0.02 && misfit < 0.2 * straight)
        return std::string(of_truth ? "truths" : "predictions") + " follow the cosine of the ray: are they " + kWords[horizontal] +
               " instead of the range along the ray?";
    }
  }
  return "";
}

}  // namespace

std::string LikelyDepthMistake(std::span<const double> prediction, std::span<const double> truth, int width, int height) {
  std::vector<Place> places = SamplePlaces(truth, width, height);
  if (places.size() < kLeastSamples) return "";
  const auto ratio = [&](Place at, Place from) {
    const auto index = [width](Place p) { return static_cast<size_t>(p.y) * static_cast<size_t>(width) + static_cast<size_t>(p.x); };
    const double r = prediction[index(from)] / truth[index(at)];
    return std::isfinite(r) ? r : 0.0;
  };
  std::vector<double> ratios;
  for (const Place p : places) ratios.push_back(ratio(p, p));
  if (std::string unit = UnitMistake(ratios); !unit.empty()) return unit;
  const double straight = Misfit(ratios, places, [](Place) { return 1.0; });
  if (straight < 0.02) return "";
  if (std::string axis = AxisMistake(ratios, places, width, height, straight); !axis.empty()) return axis;
  for (const Turn& turn : kTurns) {
    std::vector<double> turned;
    for (const Place p : places) turned.push_back(ratio(p, turn.from(p, width, height)));
    if (Misfit(turned, places, [](Place) { return 1.0; }) < 0.25 * straight)
      return std::string("predictions fit far better when they are ") + turn.words + ": are they?";
  }
  return "";
}

std::string LikelyLabelMistake(std::span<const uint32_t> prediction, std::span<const uint32_t> truth, int width, int height) {
  const size_t pixels = static_cast<size_t>(width) * static_cast<size_t>(height), step = std::max<size_t>(1, pixels / kSamples) | 1;
  const auto equal = [&](const Turn* turn) {
    size_t count = 0, all = 0;
    for (size_t i = 0; i < pixels; i += step, ++all) {
      Place p{static_cast<int>(i % static_cast<size_t>(width)), static_cast<int>(i / static_cast<size_t>(width))};
      if (turn) p = turn->from(p, width, height);
      count += prediction[static_cast<size_t>(p.y) * static_cast<size_t>(width) + static_cast<size_t>(p.x)] == truth[i];
    }
    return static_cast<double>(count) / static_cast<double>(std::max<size_t>(1, all));
  };
  if (pixels < kLeastSamples) return "";
  const double straight = equal(nullptr);
  for (const Turn& turn : kTurns) {
    const double turned = equal(&turn);
    if (turned > 0.8 && turned > 2 * straight) return std::string("predictions fit far better when they are ") + turn.words + ": are they?";
  }
  return "";
}

}  // namespace airsim360
