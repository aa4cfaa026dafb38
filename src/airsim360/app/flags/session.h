// What the commands that open a world share: its flags, and reporting what a run did.
#pragma once

#include <filesystem>
#include <string>

#include "airsim360/app/flags/commands.h"
#include "airsim360/dataset/collector.h"
#include "airsim360/stage/stage.h"

namespace airsim360 {

/// A stage of the flags that all such commands have; seed, labels, cut and device are those of `globals`.
StageOptions StageOptionsOf(const std::string& world, const GlobalOptions& globals, const EnvironmentFlags& environment = {},
                            const PeopleRequest& people = {}, const TrafficRequest& traffic = {});

/// What a dataset of the stage is made of.
CollectInput InputOf(Stage& stage, const DatasetSpec& spec, const Flight& flight, const std::filesystem::path& out,
                     std::string trajectory_json = {});

/// Prints what a run did: JSON or a few lines of text.
void ReportRun(const Stage& stage, const DatasetSpec& spec, const CollectResult& result, const std::filesystem::path& out, bool json);

}  // namespace airsim360
