// The body of one person: skeleton at rest, meshes at several levels of detail with skin weights, sockets
// (keypoints) and dimensions. Constant; shared by pointer.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "airsim360/people/skeleton.h"
#include "airsim360/scene/material.h"
#include "airsim360/scene/mesh.h"

namespace airsim360 {

enum class Sex : uint8_t { kFemale, kMale };

/// Who it is. The same specification gives the same body, byte for byte.
struct BodySpec {
  Sex sex = Sex::kMale;
  double age = 35;        ///< years, 4 to 95
  double stature = 1.75;  ///< metres, 0.95 to 2.15
  double build = 0;       ///< -1 slim, 0 average, 1 stout
  uint64_t look = 0;      ///< seeds face, hair, clothes and their colours
};

/// A named point of the body: the keypoints of annotations, and whatever users add.
struct Socket {
  std::string name;  ///< "nose", "left_eye", …; see kSocketNames
  Joint joint = Joint::kPelvis;
  Vec3d p_J;          ///< in the joint's frame: p_W = X_WJ * p_J
  double radius = 0;  ///< metres from the point to the skin around it: tolerance of the self-occlusion test
};

/// Every body has these, in this order: COCO's 17 (0 to 16), then those of OpenPose-25, JTA, SMPL and hands.
inline constexpr std::string_view kSocketNames[] = {
    "nose", "left_eye", "right_eye", "left_ear", "right_ear", "left_shoulder", "right_shoulder", "left_elbow", "right_elbow", "left_wrist",
    "right_wrist", "left_hip", "right_hip", "left_knee", "right_knee", "left_ankle", "right_ankle",
    // 17
    "head_top", "head_center", "neck", "chin", "mid_hip", "pelvis", "spine1", "spine2", "spine3", "left_clavicle", "right_clavicle",
    // 28
    "left_big_toe", "left_small_toe", "left_heel", "right_big_toe", "right_small_toe", "right_heel",
    // 34
    "left_hand", "right_hand", "left_thumb_tip", "left_finger_tip", "right_thumb_tip", "right_finger_tip", "left_foot", "right_foot"};
inline constexpr int kSocketCount = static_cast<int>(std::size(kSocketNames));
inline constexpr int kCocoSocketCount = 17;

/// Up to four bones that a vertex follows; weights sum to 1, unused ones are 0. Joint kRootInfluence is the
/// person frame itself.
struct Influences {
  std::array<uint8_t, 4> joint{};
  std::array<float, 4> weight{};
};
inline constexpr uint8_t kRootInfluence = kJointCount;

/// Vertices that belong to one prop; they lie behind those of the body itself.
struct PropRange {
  Prop prop = Prop::kNone;
  uint32_t first_vertex = 0, vertex_count = 0;
};

/// One level of detail. `mesh` is in the person frame P at rest; its parts carry indices into
/// Body::materials, and in MeshPart::entity the Prop they belong to (0 = the body).
struct BodyLevel {
  Mesh mesh;
  std::vector<Influences> influences;  ///< as long as mesh.positions
  uint32_t body_vertices = 0;          ///< the first ones; the rest are props
  std::vector<PropRange> props;
};

/// Sizes that motion and collision need, metres.
struct BodyDimensions {
  double thigh = 0, shank = 0;  ///< hip to knee, knee to ankle
  double upper_arm = 0, forearm = 0;
  double ankle_height = 0;  ///< ankle over the sole when standing flat
  double heel_length = 0;   ///< heel behind the ankle
  double ball_length = 0;   ///< ball of the foot (toes joint) before the ankle
  double hip_half_width = 0;
  double radius = 0;  ///< of the upright cylinder round torso and arms: for crowds
};

/// Immutable after it is made. Material texture ids are indices into `textures`.
struct Body {
  BodySpec spec;
  std::string character;                ///< "procedural", or the name in the pack
  std::string outfit;                   ///< "shirt trousers", …
  std::array<Vec3d, kJointCount> p_PJ;  ///< joints at rest, in P
  /// Rotation from rest to the anatomical zero (arms straight down, palms inwards, legs straight), per joint.
  std::array<Mat3d, kJointCount> R_zero;
  std::vector<Socket> sockets;    ///< kSocketNames first
  std::vector<BodyLevel> levels;  ///< 0 is the finest
  std::vector<Material> materials;
  std::vector<std::shared_ptr<const Texture>> textures;
  BodyDimensions size;
};

/// A procedural body: needs no files. Levels finer than `finest_level` are left empty, which saves memory in
/// large crowds (a body of all levels is about 1.5 MB, from level 2 on 0.1 MB). InputError for a stature or age
/// that no person has.
std::shared_ptr<const Body> MakeProceduralBody(const BodySpec& spec, int finest_level = 0);

/// A body of the pack that comes nearest to `spec`, or a procedural one where there is no pack (see
/// body_pack.h).
std::shared_ptr<const Body> MakeBody(const BodySpec& spec, int finest_level = 0);

/// Index into Body::sockets; -1 if there is none of this name.
int FindSocket(const Body& body, std::string_view name);

/// Where a socket is in the world.
inline Vec3d SocketPosition(const Socket& socket, const SkeletonPose& pose) { return pose[socket.joint] * socket.p_J; }

/// The pose at rest of a person who stands at X_WP.
SkeletonPose RestPose(const Body& body, const RigidTransform& X_WP);

}  // namespace airsim360
