// `collect --recipe`: Omni360-Human, one dataset for each subset of a table.
#pragma once

#include <functional>
#include <string>

#include "airsim360/app/flags/commands.h"
#include "airsim360/app/flags/environment_flags.h"
#include "airsim360/app/flags/people_arguments.h"
#include "airsim360/dataset/record/spec.h"

namespace airsim360 {

struct HumanRun {
  std::string recipe;  ///< "omni360-human" or a file
  std::string world;   ///< only its subsets, or every row's world instead; empty = as the table says
  std::string out;
  std::string subset;       ///< only this one ("downtown_city/03"); empty = all
  int64_t frames = 0;       ///< of each subset at most; 0 = as the table says
  DatasetSpec spec;         ///< size, tier, formats
  bool has_camera = false;  ///< flags say what is looked through
  EnvironmentFlags environment;
  PeopleArguments people;
};

/// Writes OUT/WORLD/NN, each a dataset that can be finished after any interruption, and OUT/subsets.json.
/// Subsets of worlds that do not exist are named and left out. Shard I/N takes the subsets with index % N == I.
void CollectHumanSets(const HumanRun& run, const GlobalOptions& globals);

}  // namespace airsim360
