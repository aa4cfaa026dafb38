// Flags of a command from the fields of a configuration (base/config.h): `edge_samples` is --edge-samples.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "airsim360/base/config.h"

namespace airsim360 {

/// Adds a flag for every field; a truth value that is true unless told otherwise has --no-NAME. Parsing writes into the
/// fields, which must outlive it. InputError naming the flag, the value and the nearest valid one.
void AddConfigFlags(CLI::App& command, const ConfigFields& fields);

/// Names of the flags, "--tone", in the order of the fields.
std::vector<std::string> ConfigFlagNames(const ConfigFields& fields);
/// InputError for one of the flags that is given where `owner`, the flag that it is of, is not.
void RefuseWithout(const CLI::App& command, const std::vector<std::string>& flags, const std::string& owner);
/// What the flag of a field can be, for completion; empty where it is no choice.
std::vector<std::string> ConfigFlagChoices(const ConfigFields& fields, std::string_view flag);

}  // namespace airsim360
