// Makes an MP4 file of a panorama known as such, and gives its pictures their times.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>

#include "airsim360/base/file.h"

namespace airsim360::internal {

/// Ticks of an MP4 clock of `timescale` Hz from the first picture to each one, and after them the end of the last, which
/// is shown as long as the one before (one picture alone: `lone_ns`).
std::vector<uint64_t> TicksOf(std::span<const int64_t> times_ns, uint32_t timescale, int64_t lone_ns);

/// Metadata of Google's "Spherical Video V2" (st3d, sv3d: monoscopic, a whole equirectangular sphere) and, for older players,
/// V1 (a uuid box of XML) in the `moov` box of a file with one video track; the pictures get `times_ns` (ascending), and
/// offsets into the file grow by `shift` bytes. RuntimeError where the box is not as expected: another number of pictures,
/// pictures out of order.
Bytes EditMovie(std::span<const std::byte> moov, bool spherical, std::span<const int64_t> times_ns, int64_t lone_ns, int64_t shift);

/// Writes what ffmpeg left in `file` (ftyp, mdat, moov) to `path`, moov first so that players can begin before they have it
/// all, with EditMovie's changes. Temporary name, fsync, rename. RuntimeError if that fails.
void WriteMovie(int file, bool spherical, std::span<const int64_t> times_ns, int64_t lone_ns, const std::filesystem::path& path);

}  // namespace airsim360::internal
