// Comparing the entity pictures of a dataset with panoptic.json.
#pragma once

#include <filesystem>
#include <vector>

#include "airsim360/dataset/verify.h"

namespace airsim360::internal {

/// Adds a finding for every picture whose ids or areas are not those of its annotation, in either direction.
/// Pictures that are missing are left to the check of files.
void CheckLabels(const std::filesystem::path& folder, std::vector<Finding>& findings);

}  // namespace airsim360::internal
