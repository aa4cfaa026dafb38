// Bytes to a file descriptor, whatever write(2) takes at a time.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

namespace airsim360::internal {

/// Writes all of `bytes`; 0, or the errno of what failed.
int WriteAll(int file, std::span<const std::byte> bytes);

/// RuntimeError: the path and the reason.
[[noreturn]] void ThrowWriteError(const std::filesystem::path& path, int error);

}  // namespace airsim360::internal
