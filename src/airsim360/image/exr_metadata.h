// OpenEXR pictures with texts in their headers.
#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "airsim360/base/file.h"

namespace airsim360 {

/// As EncodeExr of any channels (image/codecs.h), with string attributes in the header.
Bytes EncodeExr(std::span<const float> pixels, int width, int height, std::span<const char* const> channels,
                const std::vector<std::pair<std::string, std::string>>& attributes);

}  // namespace airsim360
