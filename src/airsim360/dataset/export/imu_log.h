// The IMU that `airsim360 fly` logged beside its frames.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "airsim360/math/vector.h"

namespace airsim360::internal {

struct ImuRow {
  int64_t t_ns = 0;
  Vec3d w, f;        ///< rad/s and m/s^2 (specific force), body axes
  std::string text;  ///< the six numbers as they were written
};

/// imu.csv in the folder of a dataset or the one above; "" if there is none (collected, not flown).
std::filesystem::path FindImu(const std::filesystem::path& dataset);
/// InputError naming file and line for what is no such table.
std::vector<ImuRow> ReadImu(const std::filesystem::path& path);

}  // namespace airsim360::internal
