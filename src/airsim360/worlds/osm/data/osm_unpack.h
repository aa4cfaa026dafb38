// Packed map files of several parts, one after the other, as bgzip, pbzip2 and `cat` make them: libosmium reads the first.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace airsim360::internal {

/// The text of a gzip or bzip2 file of several parts; nothing where there is one part, or another kind of file.
/// std::runtime_error for damage and for more than `limit` bytes of text.
std::optional<std::string> UnpackParts(std::span<const std::byte> bytes, uint64_t limit);

}  // namespace airsim360::internal
