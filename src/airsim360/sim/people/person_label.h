// What one picture's labels say of one person. Frames: W world, C camera of the picture.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "airsim360/math/transform.h"
#include "airsim360/people/keypoints/sphere_box.h"
#include "airsim360/people/person_state.h"
#include "airsim360/people/skeleton.h"
#include "airsim360/scene/mesh.h"

namespace airsim360 {

/// Whether a keypoint can be seen, and if not why. Decided by the ray from the camera to it: what the ray
/// meets first. Numbers are those of people.jsonl.
enum class KeypointState : uint8_t {
  kAbsent,         ///< outside the picture
  kBehindScene,    ///< something that is no person's body is in front, a prop in the own hand too
  kBehindPerson,   ///< another person is in front
  kBehindOneself,  ///< another part of the own body is in front
  kVisible,
  kUnresolved  ///< nothing is in front, but the picture is too coarse: none of the nine pixels around the point
               ///< shows the person
};
inline constexpr const char* kKeypointStateNames[] = {"absent",        "occluded_by_scene", "occluded_by_person",
                                                      "self_occluded", "visible",           "unresolved"};

struct KeypointLabel {
  Vec3d p_W;
  Vec3d p_C;
  double lon = 0, lat = 0;  ///< radians, as FieldOfView
  double range = 0;         ///< metres from the camera
  Vec2d pixel;              ///< continuous; (0, 0) if absent
  KeypointState state = KeypointState::kAbsent;
  EntityId occluder = kNoEntity;  ///< what is in front, if anything
};

/// A box of pixels. In panoramas 0 <= x < W and x + w may exceed W: the box goes on at the left border.
struct PictureBox {
  int x = 0, y = 0, w = 0, h = 0;
  friend bool operator==(const PictureBox&, const PictureBox&) = default;
};

/// An upright box around a body: length along the heading, then width, then height.
struct PersonBox3d {
  Vec3d center_W, center_C;
  Vec3d bottom_C;                            ///< middle of the lower face
  double length = 0, width = 0, height = 0;  ///< metres
  double yaw = 0;                            ///< of the heading about +Z of W, 0 = +X
  double rotation_y = 0;                     ///< KITTI: of the heading about +Y (down) of C, 0 = +X (right); exact where C is level
  double alpha = 0;                          ///< KITTI: rotation_y less the azimuth atan2(x, z) of the centre, in [-pi, pi)
};

/// Where the person is in the picture if nothing were in front.
struct AmodalLabel {
  std::optional<PictureBox> box;  ///< nullopt: no pixel centre inside the silhouette
  int64_t pixels = 0;
  double truncation = 0;  ///< share of the unclipped box outside the picture; 0 in panoramas
  FieldOfView bfov, rbfov;
};

struct PersonLabel {
  PersonIndex person = 0;
  EntityId entity = kNoEntity;
  PersonState state;
  SkeletonPose pose;
  Mat3d R_CW;                            ///< from W to the camera, for rotations of joints
  std::vector<KeypointLabel> keypoints;  ///< sockets of the body (kSocketNames), then those of users
  PersonBox3d box3d;
  AmodalLabel amodal;
};

}  // namespace airsim360
