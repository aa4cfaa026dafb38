// Names of files: those from outside that become one, and what they end in.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace airsim360 {

/// InputError naming `what` unless `name` can be a file of any folder and nothing else: 1 to 200 bytes, no
/// slash, no control character (a NUL would end it early), no dot at the beginning.
void CheckFileName(std::string_view what, std::string_view name);

/// What a file's name ends in, lower case with the dot (".png"); "" = nothing.
std::string LowerCaseExtension(const std::filesystem::path& path);

}  // namespace airsim360
