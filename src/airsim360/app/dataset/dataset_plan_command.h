// Commands about plans of datasets: make one, make its frames, put shards together, see what is missing, let a cluster do it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "airsim360/app/flags/commands.h"
#include "airsim360/dataset/plan/plan_run.h"

namespace airsim360 {

void AddDatasetPlan(CLI::App& dataset, GlobalOptions& globals);
void AddDatasetRun(CLI::App& dataset, GlobalOptions& globals);
void AddDatasetMerge(CLI::App& dataset, GlobalOptions& globals);
void AddDatasetStatus(CLI::App& dataset, GlobalOptions& globals);
void AddDatasetSlurm(CLI::App& dataset, GlobalOptions& globals);

}  // namespace airsim360
