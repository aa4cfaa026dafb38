// The text forms in which glTF refers to bytes.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "airsim360/base/file.h"

namespace airsim360::internal {

/// "a%20b" -> "a b"; nullopt if an escape is damaged.
std::optional<std::string> DecodePercent(std::string_view text);
/// RFC 4648 base64, padding optional, blanks ignored; nullopt for any other character.
std::optional<Bytes> DecodeBase64(std::string_view text);
/// Is this a "data:" URI?
bool IsDataUri(std::string_view uri);
/// The bytes of a "data:" URI; nullopt if it is damaged.
std::optional<Bytes> DecodeDataUri(std::string_view uri);

}  // namespace airsim360::internal
