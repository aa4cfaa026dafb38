// Commands about plans of datasets: make one, make its frames, put shards together, see what is missing, let a cluster do it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "airsim360/app/commands.h"
#include "airsim360/dataset/plan/plan_run.h"

namespace airsim360 {

void AddDatasetPlan(CLI::App& dataset, GlobalOptions& globals);
void AddDatasetRun(CLI::App& dataset, GlobalOptions& globals);
void AddDatasetMerge(CLI::App& dataset, GlobalOptions& globals);
void AddDatasetStatus(CLI::App& dataset, GlobalOptions& globals);
void AddDatasetSlurm(CLI::App& dataset, GlobalOptions& globals);

/// Opens worlds as a plan needs them: without anything that flags could change.
OpenWorld PlanWorldOpener(const GlobalOptions& globals);

/// What a frame of a plan is: the recipe's values, over them the fields that flags gave, by name with their JSON text. The spec
/// remembers these, so that the same comes out again.
DatasetSpec SpecOfPictures(const RecipePicture& recipe, const std::map<std::string, std::string>& given);

}  // namespace airsim360
