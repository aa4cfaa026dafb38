// airsim360 dataset dedupe: frames that show what another one shows.
#pragma once

#include "airsim360/app/flags/commands.h"

namespace airsim360 {

/// Adds `dedupe` to the command `dataset`.
void AddDatasetDedupe(CLI::App& dataset, GlobalOptions& globals);

}  // namespace airsim360
