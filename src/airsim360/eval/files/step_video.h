// Frames of panoptic video as STEP's PNGs: red = class, instance = 256 green + blue.
#pragma once

#include <filesystem>
#include <set>
#include <vector>

#include "airsim360/eval/files/picture_files.h"
#include "airsim360/eval/mistakes/likely_cause.h"
#include "airsim360/eval/panoptic/panoptic_quality.h"

namespace airsim360 {

struct StepClasses {
  int count = 19;     ///< classes 0 … count - 1
  int ignored = 255;  ///< class of pixels that do not count
  std::set<int> things;
};
struct StepFrame {
  LabelPicture ids;                       ///< 65536 (class + 1) + instance, 0 = ignored
  std::vector<uint8_t> blue;              ///< as stored
  std::vector<PanopticSegment> segments;  ///< in the order of ids
  bool reversed = false;                  ///< as a truth it looks as if its channels were the other way round
};
/// Instance 0 of a thing is a crowd in truths. InputError naming the file for a class that does not exist and what is no 8-bit RGB PNG.
StepFrame ReadStepFrame(const std::filesystem::path& path, const StepClasses& classes, bool truth);

/// Blue says far oftener than red what the class is: whoever wrote the prediction had the channels the other way round. Pixels of class 0 say nothing.
LikelyMistake ChannelMistake(const StepFrame& prediction, const StepFrame& truth);

}  // namespace airsim360
