// Flags of the commands that open a world, and what they ask for.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "airsim360/app/flags/commands.h"
#include "airsim360/opening/world_loader.h"

namespace airsim360 {

struct DatasetSpec;

/// Adds --labels, and --bbox, --centre and --radius, which cut a map.
void AddWorldFlags(CLI::App& command, GlobalOptions& globals);
/// Adds --bbox alone.
void AddBoxFlag(CLI::App& command, GlobalOptions& globals);

/// The world of these flags. InputError naming a flag that is wrong.
WorldRequest RequestOf(const std::string& world, const GlobalOptions& globals);

/// What meta.json calls the world: its name, with the cut of a map behind it.
std::string DescribeWorld(const std::string& world, const GlobalOptions& globals);

/// Notes in a dataset's description which command draws what world, with which seed and labels.
void DescribeRun(const char* command, const std::string& world, const GlobalOptions& globals, DatasetSpec& spec);

/// `text` ("x,y,z…") with a place on the Earth for its first two numbers ("60.1708N,24.9375E,z…", in either order)
/// brought to metres of that world; without one, as it is. InputError naming `flag` for a world that has no place on
/// the Earth, and for places more than 100 km from its origin.
std::string WithPlace(const char* flag, const std::string& text, const WorldRequest& request);

}  // namespace airsim360
