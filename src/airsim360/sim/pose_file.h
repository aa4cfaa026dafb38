// Files of poses to be visited one after the other: CSV, TUM trajectories, JSON lines (frames.jsonl of a dataset too).
#pragma once

#include <cstdint>
#include <filesystem>
#include <string_view>
#include <vector>

#include "airsim360/sensors/rig.h"

namespace airsim360 {

struct TimedPose {
  int64_t t_ns = 0;  ///< since the first pose
  Kinematics body;   ///< at rest unless the file has velocities
};

/// Which format a text is in is told by its first line:
/// - '{': JSON lines with X_WB or else X_WC ({"p", "q_wxyz"}) and optionally t_ns, v_WB and w_WB_B, as in
///   frames.jsonl, or with the columns of CSV as keys.
/// - a letter: CSV with a header of x, y, z (metres, W), optionally yaw_deg, pitch_deg, roll_deg (of the body, as
///   BodyPose) or qw, qx, qy, qz, and optionally t (seconds), in any order.
/// - numbers with commas: CSV of x,y,z[,yaw_deg[,pitch_deg[,roll_deg]]].
/// - eight numbers without: TUM, t x y z qx qy qz qw.
/// Quaternions and X_WC turn camera axes C (right, down, forward) into W, the camera sitting at B. Empty lines and lines that
/// start with '#' are skipped. Without times the poses are one second apart. InputError "name:line: …" for anything else,
/// numbers that are not finite, quaternions whose length is not 1 to 0.001, times that do not grow, no poses, more than
/// 1,000,000.
std::vector<TimedPose> ParsePoses(std::string_view text, std::string_view name);

/// The same from a file of at most 1 GiB.
std::vector<TimedPose> ReadPoseFile(const std::filesystem::path& path);

}  // namespace airsim360
