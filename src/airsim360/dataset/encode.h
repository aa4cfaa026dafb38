// From captures in memory to the files of a frame.
#pragma once

#include <vector>

#include "airsim360/base/file.h"
#include "airsim360/dataset/record/record.h"
#include "airsim360/sim/people/labels.h"

namespace airsim360 {

inline constexpr int kJpegQuality = 95;

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
  const SimPeople* people = nullptr;           ///< null: nobody
};
EncodeContext MakeEncodeContext(const DatasetSpec& spec, const Scene& scene, const SimPeople* people = nullptr);

/// Labels of the people in one frame: of each view those who are in it.
using FrameLabels = std::vector<std::vector<PersonLabel>>;

/// Encodes the captures of one frame (one for each view of the context) on all threads of ParallelFor.
/// `people`: as many lists as views, or none.
EncodedFrame Encode(const EncodeContext& context, int64_t index, const std::vector<Capture>& captures, const FrameLabels& people = {});

}  // namespace airsim360
