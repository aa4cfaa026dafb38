// Data of training and tests as they are named on the command line.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "airsim360/mpde/sources.h"
#include "airsim360/mpde/train.h"

namespace airsim360 {

/// "PATH[:SPLIT][#PERSONS][@SHARE]": a file in MonoLoco's layout, or the folder of a dataset or of a set with subsets.json.
struct MpdeDataName {
  std::string path;
  std::string split;     ///< "" = as the caller says
  uint64_t persons = 0;  ///< so many persons alone, drawn by the seed; 0 = all
  double share = 1;      ///< of the batches, relative to other data
};

/// InputError naming the text for a number that is none, and a share that is not above 0.
MpdeDataName ParseMpdeData(const std::string& text);

/// Cameras of people in folders: names of NamedViews apart by commas, or YAML files of ViewDraw's fields with `like: NAME`. Empty: the
/// pictures' own pinholes. `convention` replaces the views' where it is not empty.
std::vector<ViewDraw> ParseViews(const std::string& text, const std::string& convention);

/// Sets to train on, one for each of the views where there are any (they divide the share); of folders keypoints follow the views'
/// convention. InputError if there is nobody.
std::vector<MpdeSet> ReadTrainingSets(const MpdeDataName& name, std::span<const ViewDraw> views, uint64_t seed);

/// Samples to test on, of split "test" ("val" of MonoLoco's files, whose test is empty) unless named; `count` draws of views.
std::vector<MpdeSample> ReadTestSamples(const MpdeDataName& name, std::span<const ViewDraw> views, uint64_t count, uint64_t seed);

}  // namespace airsim360
