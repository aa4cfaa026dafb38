#include <algorithm>
#include <cmath>
#include <map>

#include "airsim360/eval/statistics/bootstrap.h"
#include "airsim360/vln/predicates/query_json.h"
#include "airsim360/vln/report/score_table.h"
#include "airsim360/vln/report/vln_report.h"

namespace airsim360 {
namespace {

using internal::VlnJson;

constexpr int kReplicates = 2000;
constexpr uint64_t kSeed = 360;
constexpr const char* kCosts[] = {"process_fidelity", "collision_rate", "decisions", "moves",
                                  "yaw_turned_deg",   "seconds",        "faults",    "path_over_geodesic"};

// The figures of one result: those of eval, then what it cost.
std::vector<double> FiguresOf(const VlnResult& r) {
  const auto figures = Figures(ScoreOf(r));
  std::vector<double> values(figures.begin(), figures.end());
  for (const double cost :
       {ProcessFidelity(r), r.collided ? 1.0 : 0.0, static_cast<double>(r.decisions), static_cast<double>(r.moves), r.yaw_turned_deg,
        r.seconds, static_cast<double>(r.faults), r.geodesic_length > 0 ? r.path_length / r.geodesic_length : 1.0})
    values.push_back(cost);
  return values;
}

VlnJson NumberJson(double value) { return std::isfinite(value) ? VlnJson(value) : VlnJson(nullptr); }

}  // namespace

namespace internal {

std::vector<std::string> ScoreNames() {
  std::vector<std::string> names(kVlnFigures.begin(), kVlnFigures.end());
  names.insert(names.end(), std::begin(kCosts), std::end(kCosts));
  return names;
}

ScoreTable TableOf(const std::vector<const VlnResult*>& results) {
  std::vector<std::vector<double>> values;
  for (const VlnResult* r : results) values.push_back(FiguresOf(*r));
  const size_t width = ScoreNames().size();
  const auto means = [&](std::span<const uint32_t> draws) {
    std::vector<double> sums(width);
    double count = 0;
    for (size_t i = 0; i < values.size(); ++i) {
      for (size_t k = 0; k < width; ++k) sums[k] += draws[i] * values[i][k];
      count += draws[i];
    }
    for (double& sum : sums) sum /= count;
    return sums;
  };
  ScoreTable table{results.size()};
  if (results.empty()) return table;
  table.means = means(std::vector<uint32_t>(results.size(), 1));
  table.intervals = BootstrapIntervals(results.size(), kReplicates, kSeed, means);
  return table;
}

std::vector<const VlnResult*> Pointers(const std::vector<VlnResult>& results) {
  std::vector<const VlnResult*> pointers;
  for (const VlnResult& r : results) pointers.push_back(&r);
  return pointers;
}

std::map<std::string, std::vector<const VlnResult*>> GroupBy(const std::vector<VlnResult>& results, std::string VlnResult::*field) {
  std::map<std::string, std::vector<const VlnResult*>> groups;
  for (const VlnResult& r : results) groups[r.*field].push_back(&r);
  return groups;
}

}  // namespace internal

std::string ScoresJson(const std::vector<VlnResult>& results) {
  const std::vector<std::string> names = internal::ScoreNames();
  const auto object = [&](const std::vector<const VlnResult*>& group) {
    const internal::ScoreTable table = internal::TableOf(group);
    VlnJson json = {{"episodes", table.episodes}}, intervals;
    for (size_t i = 0; i < table.means.size(); ++i) {
      json[names[i]] = NumberJson(table.means[i]);
      intervals[names[i]] = {NumberJson(table.intervals[i].low), NumberJson(table.intervals[i].high)};
    }
    json["intervals"] = intervals;
    return json;
  };
  VlnJson json = object(internal::Pointers(results));
  if (!results.empty()) {
    const VlnResult& first = results.front();
    json["agent"] = first.agent;
    json["view"] = first.view;
    json["decisions_by"] = first.decisions_by;
    json["protocol"] = first.protocol;
  }
  // 3-D distances of the same flights, whatever the protocol.
  for (const double radius : {5.0, 10.0, 20.0}) {
    double sum = 0;
    for (const VlnResult& r : results) sum += r.stopped && Norm(r.pred.back() - r.goal.value_or(r.ref.back())) <= radius;
    json["sr_" + std::to_string(static_cast<int>(radius))] = results.empty() ? 0 : sum / static_cast<double>(results.size());
  }
  VlnJson by;
  for (const auto& [difficulty, group] : internal::GroupBy(results, &VlnResult::difficulty)) by[difficulty] = object(group);
  json["by_difficulty"] = by;
  VlnJson ends;
  for (const auto& [end, group] : internal::GroupBy(results, &VlnResult::end)) ends[end] = group.size();
  json["ends"] = ends;
  return json.dump();
}

}  // namespace airsim360
