// Files that hold people with their distances.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "airsim360/mpde/sample.h"
#include "airsim360/mpde/virtual_cameras.h"

namespace airsim360 {

/// Samples of one split ("train", "val", "test") of a file in MonoLoco's layout (X, Y of each split): of MonoLoco itself, of importers,
/// or of `collect --format monoloco`. Samples of one picture with the same depth and sizes are of one person: MonoLoco adds mirrored copies.
/// InputError naming the file and the entry for what is not of this layout, and for numbers that are not finite.
std::vector<MpdeSample> ReadMonolocoFile(const std::filesystem::path& file, const std::string& split);

/// Which persons of our pictures are taken.
struct PeopleFilter {
  double least_visible = 0.5;                       ///< visible share of the body
  int least_keypoints = 8;                          ///< visible ones of the 17
  double most_truncated = 0.2;                      ///< share of the body outside the picture
  double nearest = 1, farthest = 60;                ///< metres
  double pitch_low_deg = -90, pitch_high_deg = 90;  ///< of the camera below the horizon
};

/// Everything that one folder of ours says of people.
struct PeopleData {
  std::vector<MpdeSample> samples;  ///< of pinhole pictures, as their cameras see them; keypoints that are hidden or outside too
  std::vector<PersonShape> shapes;  ///< of every picture, one for each person and moment
};

/// Of the folder of a dataset, or of a set of them with subsets.json (`collect --recipe`), its subsets of `split` ("" = all).
/// InputError naming file and line for what people.jsonl should not hold.
PeopleData ReadPeopleFolder(const std::filesystem::path& folder, const std::string& split, const PeopleFilter& filter);

}  // namespace airsim360
