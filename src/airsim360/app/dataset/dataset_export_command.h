// airsim360 dataset export: a dataset in other tools' formats.
#pragma once

#include "airsim360/app/flags/commands.h"

namespace airsim360 {

/// Adds `export` to the command `dataset`.
void AddDatasetExport(CLI::App& dataset, GlobalOptions& globals);

}  // namespace airsim360
