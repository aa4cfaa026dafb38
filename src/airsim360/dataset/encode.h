// From captures in memory to the files of a frame.
#pragma once

#include <vector>

#include "airsim360/base/file.h"
#include "airsim360/dataset/record.h"

namespace airsim360 {

/// A file of a frame before it is written.
struct EncodedFile {
  FileRecord record;
  Bytes bytes;
};

/// A frame ready to be written: its record is complete.
struct EncodedFrame {
  FrameRecord record;
  std::vector<EncodedFile> files;
};

/// What Encode needs beside the captures; the same for all frames.
struct EncodeContext {
  const DatasetSpec& spec;
  const Scene& scene;
  std::vector<View> views;
  std::vector<PixelSolidAngles> solid_angles;  ///< one for each view
};
EncodeContext MakeEncodeContext(const DatasetSpec& spec, const Scene& scene);

/// Encodes the captures of one frame (one for each view of the context) on all threads of ParallelFor.
EncodedFrame Encode(const EncodeContext& context, int64_t index, const std::vector<Capture>& captures);

}  // namespace airsim360
