// COCO's panoptic JSON (cocodataset.org/#format-data, 4), truth and prediction; VIPSeg's of videos, too.
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
  std::string image;     ///< its image_id; of videos VIDEO_ID/IMAGE_ID
  std::string file;      ///< the PNG of its ids
  std::string sequence;  ///< of its image: `video_id` or `sequence`, else ""
  std::vector<PanopticSegment> segments;
};
struct PanopticFile {
  std::vector<PanopticCategory> categories;      ///< what segments refer to
  std::vector<PanopticCategory> own_categories;  ///< as in the file, which may have none where others are known
  std::vector<PanopticFrame> frames;             ///< as in the file
};

/// In files of videos (VIPSeg's, what `dataset export --format vps` writes) `annotations` holds a {video_id, annotations} a video; their pictures lie in
/// folders named as the videos. Categories are those of `known` where it is not null (predictions need not repeat them). InputError naming the file and the field for damage,
/// unknown categories, pictures or ids that occur twice, and file names that lead out of a folder.
PanopticFile ReadPanopticFile(const std::filesystem::path& path, const std::vector<PanopticCategory>* known = nullptr);
PanopticFile ParsePanopticFile(std::string_view text, const std::string& name, const std::vector<PanopticCategory>* known = nullptr);

/// The folder of a file's PNGs: the one named as the file without .json (panopticapi's rule), else `entity` (our datasets) or `panomasksRGB` (VIPSeg's) beside it, else the file's own.
std::filesystem::path PanopticFolder(const std::filesystem::path& json);

}  // namespace airsim360
