// Errors of distance and orientation of pedestrians (monocular pedestrian distance estimation, the task of MonoLoco++). Pure functions.
#pragma once

#include <array>
#include <cstdint>
#include <span>

namespace airsim360 {

/// What is known or believed of one person as a camera sees them.
struct PersonPose {
  double distance = 0;  ///< metres from the camera's centre to the centre of the person's box
  double angle = 0;     ///< rad, allocentric: heading relative to the line of sight, yaw - atan2(x, z) in the camera's frame; any turn
};

/// The distance itself; InputError naming `what` if it is not a finite number of at least 0.
double CheckPersonDistance(double distance, const char* what);

/// Means over `count` persons; NaN where there are none.
struct MpdeErrors {
  int64_t count = 0;
  double distance_mae_m = 0;           ///< mean |d - d*|: along the line of sight alone (the paper's "Euclidean" error)
  double angle_mae_deg = 0;            ///< mean of the shorter way round, 0 to 180
  double angle_unwrapped_mae_deg = 0;  ///< as MonoLoco's training log has it: |atan2 - atan2*| up to 360, times 180 / 3.14
};

/// How MonoLoco's tables group persons by true distance: below 10, 20, 30 m, and the rest.
inline constexpr std::array<double, 3> kMpdeGroupEnds = {10, 20, 30};

/// The angle brought to (-pi, pi].
double WrapAngle(double angle);

/// `predicted[i]` is of the person of `truth[i]`. InputError if the lengths differ or a number is not finite.
MpdeErrors MeasureMpde(std::span<const PersonPose> predicted, std::span<const PersonPose> truth);

/// The same of the persons of each group of `kMpdeGroupEnds`.
std::array<MpdeErrors, kMpdeGroupEnds.size() + 1> MeasureMpdeGroups(std::span<const PersonPose> predicted,
                                                                    std::span<const PersonPose> truth);

/// Mean of the errors, each weighted by its count (the "All" and "Pub" columns of the paper's table); sets without persons are left out.
MpdeErrors PoolMpde(std::span<const MpdeErrors> sets);

}  // namespace airsim360
