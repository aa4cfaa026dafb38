// Bytes as text.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace airsim360 {

/// Base64 with padding (RFC 4648, section 4).
std::string Base64(std::string_view bytes);
/// The bytes again; nullopt for a text that is none, or lacks its padding.
std::optional<std::string> FromBase64(std::string_view text);

}  // namespace airsim360
