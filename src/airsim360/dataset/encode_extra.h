// Files of the products that datasets hold on request.
#pragma once

#include <string>

#include "airsim360/base/file.h"
#include "airsim360/render/renderer.h"

namespace airsim360::internal {

/// The file of "position", "albedo", "material", "part", "sky", "flow" or "coverage", encoded as docs/reference/dataset_format.md
/// says.
Bytes EncodeExtra(const std::string& product, const Frame& frame, const Scene& scene);

}  // namespace airsim360::internal
