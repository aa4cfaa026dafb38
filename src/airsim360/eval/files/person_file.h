// Persons with distance and orientation, for the errors of eval/mpde_metrics.h.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "airsim360/eval/mpde_metrics.h"

namespace airsim360 {

struct PersonPairs {
  std::vector<std::string> ids;
  std::vector<PersonPose> prediction, truth;  ///< one an id
  size_t extra = 0;                           ///< predictions without a truth, left out
  std::string first_extra;
};

/// JSON or JSON lines: a list of persons {id, distance or xyz, angle_deg or yaw_deg} (or an object whose `persons` is one). `distance` is metres; `xyz` the centre in the
/// camera's frame (+Z forward), whose length is the distance. `angle_deg` is relative to the line of sight; `yaw_deg`, which needs `xyz`, about the vertical, so that the
/// angle is yaw - atan2(x, z). InputError naming the file and field, ids that occur twice, and how many truths have no prediction.
PersonPairs ReadPersonFiles(const std::filesystem::path& prediction, const std::filesystem::path& truth);
PersonPairs ParsePersonFiles(std::string_view prediction, std::string_view truth, bool lines);

}  // namespace airsim360
