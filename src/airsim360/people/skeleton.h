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
  kPelvis,
  kSpine1,
  kSpine2,
  kSpine3,
  kNeck,
  kHead,
  kLeftClavicle,
  kLeftShoulder,
  kLeftElbow,
  kLeftWrist,
  kRightClavicle,
  kRightShoulder,
  kRightElbow,
  kRightWrist,
  kLeftHip,
  kLeftKnee,
  kLeftAnkle,
  kLeftToes,
  kRightHip,
  kRightKnee,
  kRightAnkle,
  kRightToes,
  kLeftThumb1,
  kLeftThumb2,
  kLeftFingers1,
  kLeftFingers2,
  kRightThumb1,
  kRightThumb2,
  kRightFingers1,
  kRightFingers2,
  kCount
};

inline constexpr int kJointCount = static_cast<int>(Joint::kCount);

/// Snake-case name ("left_shoulder"), and back (kCount if there is none).
std::string_view JointName(Joint joint);
Joint JointByName(std::string_view name);

/// Parent of a joint; the pelvis is its own.
Joint ParentOf(Joint joint);

/// What a person may hold or push. Part of the person's mesh, but an entity of its own; shown by some
/// behaviours only.
enum class Prop : uint8_t { kNone, kPhone, kBag, kUmbrella, kStroller, kCount };
inline constexpr int kPropCount = static_cast<int>(Prop::kCount);

/// World poses of all joints of one person at one instant. The axes of every joint in the rest pose (upright,
/// arms hanging down 45 degrees from horizontal as MakeHuman's, palms down) are those of the person frame P: +X forward,
/// +Y left, +Z up, origin on the ground between the feet.
struct SkeletonPose {
  std::array<RigidTransform, kJointCount> X_WJ;
  RigidTransform X_WP;  ///< the person frame; carries what stands on the ground (stroller)
  uint32_t props = 0;   ///< bit 1 << Prop: what is shown

  const RigidTransform& operator[](Joint joint) const { return X_WJ[static_cast<size_t>(joint)]; }
  RigidTransform& operator[](Joint joint) { return X_WJ[static_cast<size_t>(joint)]; }
  bool Shows(Prop prop) const { return (props >> static_cast<int>(prop) & 1) != 0; }
};

/// Snake-case name of a prop ("phone").
std::string_view PropName(Prop prop);

}  // namespace airsim360
