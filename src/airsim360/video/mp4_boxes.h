// The tree of boxes of an MP4 file (ISO/IEC 14496-12), as far as a video track needs it.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "airsim360/base/file.h"

namespace airsim360::internal {

struct Mp4Box {
  std::string type;              ///< four characters
  Bytes head;                    ///< what comes before the children; everything where there are none
  std::vector<Mp4Box> children;  ///< of moov, trak, edts, mdia, minf, stbl, stsd and of sample entries of video

  size_t Size() const;  ///< with its own eight bytes
  /// The first child of that type; nullptr if there is none.
  Mp4Box* Find(std::string_view wanted);
};

/// The boxes in `bytes`, with their children. RuntimeError for sizes that do not fit.
std::vector<Mp4Box> ParseBoxes(std::span<const std::byte> bytes);
/// Appends the box as it stands in a file.
void AppendBox(const Mp4Box& box, Bytes& to);

/// Big-endian numbers of `size` bytes (1 … 8). RuntimeError beyond the end.
uint64_t GetNumber(std::span<const std::byte> bytes, size_t at, int size);
void SetNumber(Bytes& bytes, size_t at, int size, uint64_t value);
void AppendNumber(Bytes& bytes, int size, uint64_t value);

}  // namespace airsim360::internal
