// Motion-capture clips in Biovision's BVH format, played on any body.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "airsim360/people/body/body.h"

namespace airsim360 {

/// A joint of a clip: where it hangs and which numbers of a frame turn and move it.
struct BvhJoint {
  enum class Channel : uint8_t { kX, kY, kZ, kTurnX, kTurnY, kTurnZ };
  std::string name;
  int parent = -1;  ///< -1: the root; parents come before children
  Vec3d offset;     ///< from the parent at rest, the file's units and axes (+Y up)
  std::vector<Channel> channels;
  int first_channel = 0;
  bool end = false;  ///< "End Site": has no channels
};

struct BvhClip {
  std::vector<BvhJoint> joints;
  int frames = 0, channels = 0;
  double frame_time = 0;      ///< seconds
  std::vector<float> values;  ///< frame by frame; degrees and the file's units
  /// Our joints by index of the clip's, -1 where it has none (names of CMU, Mixamo and MakeHuman exports).
  std::array<int, kJointCount> match{};

  double duration() const { return frames * frame_time; }
};

/// InputError "name:line: what is wrong" for text that is not BVH; at most 256 joints, 64 deep, and 20 million
/// numbers. Joints of unknown names are kept but move nothing.
BvhClip ParseBvh(std::string_view text, const std::string& name);

/// The pose of a clip at `t` seconds (clamped) on this body, standing at X_WP: the clip's first frame is over
/// the origin of P and faces along +X, its movement is scaled to the body's legs. Bones keep the body's
/// lengths; turns are the clip's, so that hands and feet may be off by what the proportions differ.
SkeletonPose ClipPose(const BvhClip& clip, const Body& body, double t, const RigidTransform& X_WP);

}  // namespace airsim360
