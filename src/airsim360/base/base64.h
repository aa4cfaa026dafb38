// Bytes as text.
#pragma once

#include <string>
#include <string_view>

namespace airsim360 {

/// Base64 with padding (RFC 4648, section 4).
std::string Base64(std::string_view bytes);

}  // namespace airsim360
