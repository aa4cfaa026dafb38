// COCO's panoptic JSON (cocodataset.org/#format-data, 4), truth and prediction.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "airsim360/eval/panoptic/panoptic_quality.h"

namespace airsim360 {

struct PanopticCategory {
  int64_t id = 0;
  std::string name;
  bool thing = false;
};
/// The annotation of one picture.
struct PanopticFrame {
  int64_t image = 0;
  std::string file;      ///< the PNG of its ids
  std::string sequence;  ///< of its image: `video_id` or `sequence`, else ""
  std::vector<PanopticSegment> segments;
};
struct PanopticFile {
  std::vector<PanopticCategory> categories;  ///< as in the file
  std::vector<PanopticFrame> frames;         ///< as in the file
};

/// Categories are those of `known` where it is not null (predictions need not repeat them). InputError naming the file and the field for damage,
/// unknown categories, pictures or ids that occur twice, and file names that lead out of a folder.
PanopticFile ReadPanopticFile(const std::filesystem::path& path, const std::vector<PanopticCategory>* known = nullptr);
PanopticFile ParsePanopticFile(std::string_view text, const std::string& name, const std::vector<PanopticCategory>* known = nullptr);

/// The folder of a file's PNGs: the one named as the file without .json (panopticapi's rule), else `entity` beside it (our datasets), else the file's own.
std::filesystem::path PanopticFolder(const std::filesystem::path& json);

}  // namespace airsim360
