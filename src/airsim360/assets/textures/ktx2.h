// Pictures in KTX 2.0 containers, as KHR_texture_basisu has them. After the KTX File Format Specification 2.0 and its
// BasisLZ supercompression.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "airsim360/image/image.h"

namespace airsim360::internal {

/// By the first bytes.
bool IsKtx2(std::span<const std::byte> bytes);

/// The largest level of a two-dimensional picture: ETC1S in BasisLZ, or plain 8-bit RGB and RGBA. `unread` says what is
/// not read where nothing comes back (UASTC, video, other formats). InputError, which `where` starts, for damage or
/// more than `most_pixels`.
std::optional<Image<Rgba8>> DecodeKtx2(std::span<const std::byte> bytes, const std::string& where, uint64_t most_pixels,
                                       std::string& unread);

}  // namespace airsim360::internal
