// Means and intervals of groups of results. For the .cc files of this folder.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "airsim360/eval/statistics/bootstrap.h"
#include "airsim360/vln/flights/run_episodes.h"

namespace airsim360::internal {

struct ScoreTable {
  size_t episodes = 0;
  std::vector<double> means = {};  ///< in the order of ScoreNames; empty without episodes
  std::vector<Interval> intervals = {};
};
std::vector<std::string> ScoreNames();
ScoreTable TableOf(const std::vector<const VlnResult*>& results);
std::vector<const VlnResult*> Pointers(const std::vector<VlnResult>& results);
std::map<std::string, std::vector<const VlnResult*>> GroupBy(const std::vector<VlnResult>& results, std::string VlnResult::*field);

}  // namespace airsim360::internal
