// What clients are told through the log.
#pragma once

#include <string>

namespace airsim360 {

/// Writes a notice to the log, each text once in the life of the process and at most a few hundred.
void NoticeOnce(const std::string& text);

}  // namespace airsim360
