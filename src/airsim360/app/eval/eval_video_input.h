// The files of `eval video`, whatever their layout: sequences of frames with ids of pixels and segments.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "airsim360/app/eval/eval_panoptic_input.h"
#include "airsim360/eval/mistakes/likely_cause.h"

namespace airsim360 {

/// What STEP's PNGs do not say themselves.
struct StepOptions {
  int classes = 19, void_class = 255;
  std::vector<int> things = {11, 13};
};

struct VideoFrame {
  LabelPicture prediction, truth;
  std::vector<PanopticSegment> predicted, real;
  std::string file;       ///< of what looks like a mistake
  LikelyMistake mistake;  ///< in the files, whatever they show
};
struct Sequence {
  std::string name;
  std::vector<std::function<VideoFrame()>> frames;  ///< read when called; InputError naming the file
};
struct Video {
  std::vector<PanopticCategory> categories;
  std::vector<Sequence> sequences;
  std::vector<std::string> notes, warnings;
};

/// COCO panoptic JSON, VIPSeg's, or datasets of ours; a picture's sequence is its video.
Video PanopticVideo(const PanopticPaths& paths);

/// Folders of STEP's PNGs: a folder is a sequence. InputError for options out of range, files without a partner, or none.
Video StepVideo(const PanopticPaths& paths, const StepOptions& options);

}  // namespace airsim360
