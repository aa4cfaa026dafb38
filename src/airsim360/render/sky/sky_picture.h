// A sky given as a picture, taken apart into a sun and the rest.
#pragma once

#include "airsim360/render/sky/sky_table.h"
#include "airsim360/scene/environment.h"

namespace airsim360::internal {

/// The sun found in a picture.
struct PictureSun {
  Vec3f direction;
  Vec3f irradiance;  ///< what was taken out of the picture; zero = none found
};

struct SplitPicture {
  SkyTable above, below;  ///< below: mirrored, see Sky::below
  PictureSun sun;
};

/// Turns and scales the environment's picture. Pixels that are no finite number count as black, brighter ones
/// than 65504 (half floats' largest) times the scale as that. A sun is a peak above the horizon, 40 times
/// brighter than the mean, whose light beyond its surroundings is at least four fifths within 3 degrees of it
/// and a tenth of all light of the upper hemisphere; it is replaced by its surroundings. Light is conserved.
SplitPicture SplitSkyPicture(const Environment& environment);

}  // namespace airsim360::internal
