// Reading whole files with a size limit, and writing files that are never half-written.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace airsim360 {

using Bytes = std::vector<std::byte>;

/// Views of the same memory as bytes or as text.
std::span<const std::byte> AsBytes(std::string_view text);
std::string_view AsText(std::span<const std::byte> bytes);

/// The whole file. InputError if it does not exist (naming a file beside it whose name is near), is not a regular
/// file, cannot be read or is larger than `max_size`.
Bytes ReadFile(const std::filesystem::path& path, uint64_t max_size = uint64_t{4} << 30);
std::string ReadTextFile(const std::filesystem::path& path, uint64_t max_size = uint64_t{256} << 20);

/// Writes `bytes` to a temporary name beside `path`, fsyncs, then renames over `path`: readers see the old
/// file or the whole new one, also after a crash. RuntimeError naming the path and the reason (disk full, no
/// permission); then the temporary file is gone and `path` is as it was.
void WriteFileAtomically(const std::filesystem::path& path, std::span<const std::byte> bytes);
void WriteFileAtomically(const std::filesystem::path& path, std::string_view text);

/// Creates the folder and its parents; RuntimeError naming the path and the reason if it cannot, or if it is
/// not writable.
void CreateWritableFolder(const std::filesystem::path& path);

}  // namespace airsim360
