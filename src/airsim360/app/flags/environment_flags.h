// The flags of sun, sky, weather and wind, the same for every command that has them.
#pragma once

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

#include "airsim360/opening/world_environment.h"

namespace airsim360 {

/// Adds --weather, --clouds, --sky-seed, --sun, --time, --place, --hdri and --environment; `flags` must outlive the command.
void AddEnvironmentFlags(CLI::App& command, EnvironmentFlags& flags);

/// The names of those flags.
std::vector<std::string> EnvironmentFlagNames();

/// Adds --wind; `file` must outlive the command.
void AddWindFlag(CLI::App& command, std::string& file);

}  // namespace airsim360
