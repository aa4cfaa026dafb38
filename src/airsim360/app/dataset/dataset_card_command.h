// airsim360 dataset card: what a dataset holds, and a page that shows it.
#pragma once

#include "airsim360/app/flags/commands.h"

namespace airsim360 {

/// Adds `card` to the command `dataset`.
void AddDatasetCard(CLI::App& dataset, GlobalOptions& globals);

}  // namespace airsim360
