// Names from outside that become names of files, or parts of them.
#pragma once

#include <string_view>

namespace airsim360 {

/// InputError naming `what` unless `name` can be a file of any folder and nothing else: 1 to 200 bytes, no
/// slash, no control character (a NUL would end it early), no dot at the beginning.
void CheckFileName(std::string_view what, std::string_view name);

}  // namespace airsim360
