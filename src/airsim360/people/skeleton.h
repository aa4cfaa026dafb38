// The one skeleton of every person: named joints, their parents and order. Bodies differ in size, never in
// names, so that keypoints mean the same on each of them.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "airsim360/math/transform.h"

namespace airsim360 {

/// A joint turns the bone that hangs from it; parents come before children. Left is the person's left.
enum class Joint : uint8_t {
  kPelvis, kSpine1, kSpine2, kSpine3, kNeck, kHead,
  kLeftClavicle, kLeftShoulder, kLeftElbow, kLeftWrist,
  kRightClavicle, kRightShoulder, kRightElbow, kRightWrist,
  kLeftHip, kLeftKnee, kLeftAnkle, kLeftToes,
  kRightHip, kRightKnee, kRightAnkle, kRightToes,
  kLeftThumb1, kLeftThumb2, kLeftFingers1, kLeftFingers2,
  kRightThumb1, kRightThumb2, kRightFingers1, kRightFingers2,
  kCount
};

inline constexpr int kJointCount = static_cast<int>(Joint::kCount);

/// Snake-case name ("left_shoulder"), and back (kCount if there is none).
std::string_view JointName(Joint joint);
Joint JointByName(std::string_view name);

/// Parent of a joint; the pelvis is its own.
Joint ParentOf(Joint joint);

/// World poses of all joints of one person at one instant. The axes of every joint in the rest pose (upright,
/// arms hanging down 45 degrees from horizontal as MakeHuman's, palms down) are those of the person frame P: +X forward,
/// +Y left, +Z up, origin on the ground between the feet.
struct SkeletonPose {
  std::array<RigidTransform, kJointCount> X_WJ;
};

}  // namespace airsim360
