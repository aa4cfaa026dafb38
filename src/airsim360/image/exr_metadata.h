// What the headers of OpenEXR pictures say.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "airsim360/base/file.h"

namespace airsim360 {

/// As EncodeExr of any channels (image/codecs.h), with string attributes in the header.
Bytes EncodeExr(std::span<const float> pixels, int width, int height, std::span<const char* const> channels,
                const std::vector<std::pair<std::string, std::string>>& attributes);

/// The names of the channels, sorted. InputError naming `name` for what is no EXR that we read.
std::vector<std::string> ExrChannels(std::span<const std::byte> bytes, std::string_view name);

}  // namespace airsim360
