// SHA-256 of bytes and files, in lower-case hex.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

namespace airsim360 {

/// SHA-256 (FIPS 180-4) of `bytes`, 64 lower-case hex digits.
std::string Sha256Hex(std::span<const std::byte> bytes);

/// SHA-256 of a file's content; RuntimeError if it cannot be read.
std::string Sha256HexOfFile(const std::filesystem::path& path);

}  // namespace airsim360
