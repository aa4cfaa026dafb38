// The paper's table of monocular pedestrian distance estimation: four training sets, four test sets, several seeds.
#pragma once

#include <array>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "airsim360/mpde/sources.h"
#include "airsim360/mpde/train.h"

namespace airsim360 {

/// A column of the table, with as many samples as the paper tested on: the weights of its "All" and "Pub" means.
struct MpdeTestSet {
  const char* name;
  const char* views;  ///< cameras that stand in for it (NamedViews); of ours its own
  int64_t weight;
  bool published;  ///< counts in Pub
};
inline constexpr std::array<MpdeTestSet, 4> kMpdeTests = {{{"nuscenes", "nuscenes", 15369, true},
                                                           {"kitti", "kitti", 1759, true},
                                                           {"freeman", "freeman", 43361, true},
                                                           {"omni360-human", "drone20", 11496, false}}};
inline constexpr const char* kMpdeRows[] = {"base", "base + ours, all", "base + ours, pitch 0", "base + ours, pitch 20"};

struct MpdeTableOptions {
  std::string people;  ///< folder with subsets.json: splits train and test
  std::map<std::string, std::string>
      real;  ///< FILE[:SPLIT] in MonoLoco's layout by name of test set (split val); nuscenes' train is trained on
  MpdeTraining training;
  uint64_t seeds = 3;
  uint64_t test_samples = 4000;  ///< views drawn for each stand-in
  double our_share = 1;          ///< of the batches, relative to the base
};

/// Mean over the seeds, and the standard deviation between them.
struct Spread {
  double mean = 0, deviation = 0;
};
struct MpdeCell {
  Spread distance_m, angle_deg, angle_unwrapped_deg;
};
struct MpdeTableRow {
  std::string training;
  std::vector<MpdeCell> cells;  ///< as kMpdeTests
  MpdeCell all, pub;            ///< weighted by the paper's numbers of samples
};
struct MpdeTable {
  bool base_is_real = false;
  std::vector<bool> test_is_real;  ///< as kMpdeTests; ours counts as simulated
  std::vector<int64_t> test_count;
  std::vector<double> constant_height_m;  ///< error of the baseline
  std::vector<MpdeTableRow> rows;
};

/// Trains rows x seeds networks. `progress` is called after each, with a line about it. InputError for data that are missing or wrong.
MpdeTable MakeMpdeTable(const MpdeTableOptions& options, const std::function<void(const std::string&)>& progress);

}  // namespace airsim360
