// The tasks of `airsim360 eval`: one file each.
#pragma once

#include <CLI/CLI.hpp>

#include "airsim360/app/flags/commands.h"

namespace airsim360 {

void AddEvalDepth(CLI::App& command, GlobalOptions& globals);
void AddEvalSemantic(CLI::App& command, GlobalOptions& globals);
void AddEvalPanoptic(CLI::App& command, GlobalOptions& globals);
void AddEvalVideo(CLI::App& command, GlobalOptions& globals);
/// entity, keypoints and boxes: all that COCO's evaluation measures.
void AddEvalCoco(CLI::App& command, GlobalOptions& globals);
void AddEvalFlow(CLI::App& command, GlobalOptions& globals);
void AddEvalLayout(CLI::App& command, GlobalOptions& globals);
void AddEvalMpde(CLI::App& command, GlobalOptions& globals);
void AddEvalVln(CLI::App& command, GlobalOptions& globals);

}  // namespace airsim360
