// Any bytes as a socket file: sockets with finite numbers, or an InputError.
#include <cmath>
#include <cstdint>
#include <cstdlib>

#include "airsim360/base/error.h"
#include "airsim360/people/keypoints/keypoint_orders.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace airsim360;
  try {
    for (const Socket& socket : ParseSockets({reinterpret_cast<const char*>(data), size}, "fuzz")) {
      if (!std::isfinite(Norm(socket.p_J) + socket.radius) || socket.joint >= Joint::kCount) std::abort();
    }
  } catch (const InputError&) {
  }
  return 0;
}
