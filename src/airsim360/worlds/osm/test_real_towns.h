// For tests: figures of real towns (data/osm/distributions.csv) and how far a set of samples is from them.
#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "airsim360/base/file.h"
#include "airsim360/math/vector.h"

namespace airsim360::internal {

using Quantiles = std::vector<double>;

/// The rows of the file by name.
inline std::map<std::string, Quantiles> RealTowns() {
  std::map<std::string, Quantiles> rows;
  std::istringstream lines(ReadTextFile("data/osm/distributions.csv"));
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with('#') || line.starts_with("name")) continue;
    std::istringstream fields(line);
    std::string name, field;
    std::getline(fields, name, ',');
    std::getline(fields, field, ',');  // count
    while (std::getline(fields, field, ',')) rows[name].push_back(std::stod(field));
  }
  return rows;
}

/// Largest distance between the share of samples up to x and that of the reference, which is linear between its
/// quantiles (and jumps where several are equal).
inline double KolmogorovSmirnov(std::vector<double> samples, const Quantiles& q) {
  std::sort(samples.begin(), samples.end());
  const auto n = static_cast<double>(samples.size());
  // Share of the reference below x and up to x.
  const auto share = [&](double x, bool upto) {
    const auto it = upto ? std::upper_bound(q.begin(), q.end(), x) : std::lower_bound(q.begin(), q.end(), x);
    if (it == q.begin()) return 0.0;
    if (it == q.end()) return 1.0;
    const double low = *(it - 1), high = *it;
    const double t = high > low ? (x - low) / (high - low) : 0;
    return (static_cast<double>(it - q.begin()) - 1 + t) / static_cast<double>(q.size() - 1);
  };
  double worst = 0;
  const auto look = [&](double x) {
    const auto below = static_cast<double>(std::lower_bound(samples.begin(), samples.end(), x) - samples.begin());
    const auto upto = static_cast<double>(std::upper_bound(samples.begin(), samples.end(), x) - samples.begin());
    worst = std::max({worst, std::abs(upto / n - share(x, true)), std::abs(below / n - share(x, false))});
  };
  for (double x : samples) look(x);
  for (double x : q) look(x);
  return worst;
}

/// Metres from each place to the nearest other one.
inline std::vector<double> NearestDistances(const std::vector<Vec2d>& places) {
  std::vector<double> distances;
  for (size_t i = 0; i < places.size(); ++i) {
    double best = 1e18;
    for (size_t k = 0; k < places.size(); ++k)
      if (k != i) best = std::min(best, std::hypot(places[i].x - places[k].x, places[i].y - places[k].y));
    distances.push_back(best);
  }
  return distances;
}

}  // namespace airsim360::internal
