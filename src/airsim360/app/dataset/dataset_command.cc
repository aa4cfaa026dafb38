// airsim360 dataset: what is done with whole datasets; a file for each of its commands.
#include "airsim360/app/dataset/dataset_card_command.h"
#include "airsim360/app/dataset/dataset_dedupe_command.h"
#include "airsim360/app/dataset/dataset_export_command.h"
#include "airsim360/app/dataset/dataset_plan_command.h"
#include "airsim360/app/flags/commands.h"

namespace airsim360 {

void AddDatasetCommand(CLI::App& app, GlobalOptions& globals) {
  CLI::App* command =
      app.add_subcommand("dataset", "datasets as a whole: plans, shards, clusters, other formats, duplicates, what is in them");
  command->require_subcommand(1);
  AddDatasetPlan(*command, globals);
  AddDatasetRun(*command, globals);
  AddDatasetMerge(*command, globals);
  AddDatasetStatus(*command, globals);
  AddDatasetSlurm(*command, globals);
  AddDatasetExport(*command, globals);
  AddDatasetDedupe(*command, globals);
  AddDatasetCard(*command, globals);
}

}  // namespace airsim360
