#include "airsim360/people/skeleton.h"

#include <algorithm>

namespace airsim360 {
namespace {

struct JointRow {
  std::string_view name;
  Joint parent;
};

// In the order of Joint.
constexpr JointRow kJoints[] = {
    {"pelvis", Joint::kPelvis},
    {"spine1", Joint::kPelvis},
    {"spine2", Joint::kSpine1},
    {"spine3", Joint::kSpine2},
    {"neck", Joint::kSpine3},
    {"head", Joint::kNeck},
    {"left_clavicle", Joint::kSpine3},
    {"left_shoulder", Joint::kLeftClavicle},
    {"left_elbow", Joint::kLeftShoulder},
    {"left_wrist", Joint::kLeftElbow},
    {"right_clavicle", Joint::kSpine3},
    {"right_shoulder", Joint::kRightClavicle},
    {"right_elbow", Joint::kRightShoulder},
    {"right_wrist", Joint::kRightElbow},
    {"left_hip", Joint::kPelvis},
    {"left_knee", Joint::kLeftHip},
    {"left_ankle", Joint::kLeftKnee},
    {"left_toes", Joint::kLeftAnkle},
    {"right_hip", Joint::kPelvis},
    {"right_knee", Joint::kRightHip},
    {"right_ankle", Joint::kRightKnee},
    {"right_toes", Joint::kRightAnkle},
    {"left_thumb1", Joint::kLeftWrist},
    {"left_thumb2", Joint::kLeftThumb1},
    {"left_fingers1", Joint::kLeftWrist},
    {"left_fingers2", Joint::kLeftFingers1},
    {"right_thumb1", Joint::kRightWrist},
    {"right_thumb2", Joint::kRightThumb1},
    {"right_fingers1", Joint::kRightWrist},
    {"right_fingers2", Joint::kRightFingers1},
};
static_assert(std::size(kJoints) == kJointCount);

constexpr std::string_view kProps[] = {"none", "phone", "bag", "umbrella", "stroller"};
static_assert(std::size(kProps) == kPropCount);

}  // namespace

std::string_view JointName(Joint joint) { return joint < Joint::kCount ? kJoints[static_cast<size_t>(joint)].name : "none"; }

Joint JointByName(std::string_view name) {
  const auto found = std::ranges::find(kJoints, name, &JointRow::name);
  return static_cast<Joint>(found - std::begin(kJoints));
}

Joint ParentOf(Joint joint) { return kJoints[static_cast<size_t>(joint)].parent; }

std::string_view PropName(Prop prop) { return kProps[static_cast<size_t>(prop)]; }

}  // namespace airsim360
