// Virtual cameras: a person of a dataset, known in 3D, as a camera somewhere else would see them.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "airsim360/base/config.h"
#include "airsim360/base/random.h"
#include "airsim360/math/vector.h"
#include "airsim360/mpde/sample.h"

namespace airsim360 {

/// A person in 3D: metres, +Z up, the origin on the ground between the feet.
struct PersonShape {
  std::array<Vec3d, static_cast<size_t>(kMpdeKeypoints)> keypoints;
  Vec3d center;    ///< of the 3D box
  double yaw = 0;  ///< heading, counter-clockwise from +X
  uint64_t person = 0;
};

/// Whose idea of hips, ears and limbs the keypoints follow.
enum class KeypointConvention {
  kAnatomy,    ///< joints of the skeleton
  kAnnotators  ///< hips and ears wider, arms and shins shorter, as people and detectors trained on COCO mark them
};
inline constexpr const char* kKeypointConventionNames[] = {"anatomy", "annotators"};

/// From where people are seen, and how well their keypoints are found. Every draw is independent.
struct ViewDraw {
  double lowest = 1.4, highest = 1.95;  ///< metres of the camera above its ground, even
  double nearest = 3.5, farthest = 50;  ///< metres along the ground, even in the logarithm
  double bearing_deg = 37;              ///< to either side, even
  double pitch_deg = 0;                 ///< of the camera below the horizon
  double pitch_spread_deg = 0;          ///< standard deviation around it
  double half_height_deg = 45;          ///< keypoints farther above or below the axis are outside the picture: drawn again
  double slope = 0.02;                  ///< standard deviation of the ground's slope between camera and person
  double stature = 0;                   ///< standard deviation of the logarithm of a factor of every person's size, drawn anew each time
  double noise = 0.012;                 ///< standard deviation of a keypoint, as a share of the person's height in the picture
  double noise_px = 0.5;                ///< and in pixels, of a camera of `focal_px`
  double focal_px = 721;
  double blunder = 0;  ///< share of keypoints found `blunder_size` times as badly
  double blunder_size = 5;
  KeypointConvention convention = KeypointConvention::kAnatomy;

  void Visit(ConfigVisitor& v);
};

/// Cameras like those of known rigs: "kitti", "nuscenes", "freeman", "drone0", "drone20". InputError naming the nearest of them.
ViewDraw NamedViews(std::string_view name);
std::vector<std::string> ViewNames();

/// The shape as annotators of COCO would have it: apparent sizes of real people in MonoLoco's KITTI sample over those of our bodies.
PersonShape AsAnnotated(PersonShape shape);

/// One view, turned any way.
MpdeSample DrawView(const PersonShape& shape, const ViewDraw& draw, RngStream& random);

/// `rays` with the noise of `draw` on every keypoint.
void AddKeypointNoise(const ViewDraw& draw, RngStream& random, KeypointRays& rays);

}  // namespace airsim360
