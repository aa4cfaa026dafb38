// A drone as a YAML file: every parameter with its unit and the law it came from; reads back bit for bit.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "airsim360/flight/prompt/design.h"

namespace airsim360 {

/// The design as YAML. Numbers are written so that they read back exactly.
std::string DroneYaml(const DroneDesign& design);
/// A model without a design (from the catalogue): its laws are empty but for `source`.
std::string DroneYaml(const DroneModel& model, std::string_view source);

/// Reads what DroneYaml wrote, or was written by hand. InputError "file:line:column: …" for an unknown key, a
/// value of the wrong kind or out of range, and for a model that cannot fly (CheckModel).
DroneDesign ReadDroneYaml(std::string_view text, std::string_view name);
DroneDesign ReadDroneFile(const std::filesystem::path& file);

}  // namespace airsim360
