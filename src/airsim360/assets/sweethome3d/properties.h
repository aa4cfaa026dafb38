// Java .properties files: key=value lines in ISO-8859-1 with \uXXXX escapes.
#pragma once

#include <map>
#include <string>
#include <string_view>

namespace airsim360::internal {

/// Values by key, in UTF-8; the last of equal keys wins. InputError naming file:line for a damaged escape.
std::map<std::string, std::string> ParseProperties(const std::string& file, std::string_view text);

}  // namespace airsim360::internal
