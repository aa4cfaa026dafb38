// Any bytes as a file of poses: an error that names the place, or poses that are finite and in order.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "airsim360/base/error.h"
#include "airsim360/sim/pose_file.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace airsim360;
  try {
    int64_t last = -1;
    for (const TimedPose& pose : ParsePoses({reinterpret_cast<const char*>(data), size}, "fuzz")) {
      if (pose.t_ns <= last || !std::isfinite(Norm(pose.body.X_WB.p)) || !(std::abs(pose.body.X_WB.R.determinant() - 1) < 0.01))
        std::abort();
      last = pose.t_ns;
    }
  } catch (const InputError&) {
  }
  return 0;
}
