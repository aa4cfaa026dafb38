// The flags of sun, sky and weather that `render` and `collect` share.
#pragma once

#include <CLI/CLI.hpp>

#include "airsim360/opening/world_environment.h"

namespace airsim360 {

/// Adds --weather, --sun, --time, --place, --hdri and --environment; `flags` must outlive the command.
void AddEnvironmentFlags(CLI::App& command, EnvironmentFlags& flags);

}  // namespace airsim360
