// One person as a camera sees them: what the network of monocular pedestrian distance estimation is given, and what it should say.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "airsim360/eval/mpde_metrics.h"

namespace airsim360 {

inline constexpr int kMpdeKeypoints = 17;  ///< COCO's, in its order

/// Keypoints with the intrinsics taken out: x / z and y / z in the camera's frame (right, down, ahead), one after the other.
using KeypointRays = std::array<float, static_cast<size_t>(2 * kMpdeKeypoints)>;

struct MpdeSample {
  KeypointRays rays{};
  PersonPose truth;
  uint64_t person = 0;  ///< equal for samples of one person of one file (mirrored copies too)
};

/// The sample in a mirror: left and right change places, the angle becomes pi minus itself.
MpdeSample Mirrored(const MpdeSample& sample);

/// How keypoints become the network's inputs.
enum class MpdeEncoding {
  kRays,   ///< the 34 numbers on the plane 10 m ahead, as MonoLoco has them
  kShape,  ///< 37: place of the trunk, logarithm of the size, and the points relative to both
};
inline constexpr const char* kMpdeEncodingNames[] = {"rays", "shape"};
int InputCount(MpdeEncoding encoding);
/// Fills InputCount numbers.
void Encode(const KeypointRays& rays, MpdeEncoding encoding, std::span<float> inputs);

/// Distance by a person of mean stature, without learning: the span of the keypoints from eyes to ankles is 0.897 of 1.72 m (Drillis and
/// Contini's proportions; MonoLoco's mean stature), upright in the picture.
double ConstantHeightDistance(const KeypointRays& rays);
/// The same by a trunk of 0.5 m from the middle of the shoulders to that of the hips.
double ConstantTrunkDistance(const KeypointRays& rays);

}  // namespace airsim360
