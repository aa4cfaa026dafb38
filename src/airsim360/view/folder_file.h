// Files of one folder for somebody who must see nothing else.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace airsim360 {

/// "%2e" → "."; "" for a text that is no percent-encoding.
std::string PercentDecoded(std::string_view text);

/// Descriptor of a regular file below `folder` ("rgb/000000.png"), for reading; -1 if there is none. No component of the path
/// is empty, ".", ".." or a symbolic link.
int OpenInFolder(const std::filesystem::path& folder, std::string_view path);

}  // namespace airsim360
