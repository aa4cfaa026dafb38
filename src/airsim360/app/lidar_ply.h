// A lidar scan as a file that point cloud viewers open.
#pragma once

#include <string>

#include "airsim360/sensors/lidar.h"

namespace airsim360 {

/// Binary little-endian PLY: one vertex a point, with x, y, z in S at the time of the scan, range, intensity
/// and time as float, category as ushort, entity and shot as uint. docs/reference/sensors.md says what they
/// are.
std::string LidarPly(const LidarScan& scan);

}  // namespace airsim360
