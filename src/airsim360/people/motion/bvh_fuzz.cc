// Any bytes as a BVH clip: an error that names the line, or a clip whose poses are finite at both ends.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "airsim360/base/error.h"
#include "airsim360/people/motion/bvh_clip.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace airsim360;
  static const std::shared_ptr<const Body> body = MakeProceduralBody({});
  try {
    const BvhClip clip = ParseBvh({reinterpret_cast<const char*>(data), size}, "fuzz");
    for (const double t : {0.0, clip.duration()}) {
      const SkeletonPose pose = ClipPose(clip, *body, t, {});
      for (const RigidTransform& X : pose.X_WJ) {
        if (!std::isfinite(X.R.m[0][0])) std::abort();
      }
    }
  } catch (const InputError&) {
  }
  return 0;
}
