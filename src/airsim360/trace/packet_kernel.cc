#include "airsim360/trace/packet_kernel.h"

#include <cmath>

namespace airsim360::internal::AIRSIM360_ISA {

bool KeepTraceable(const int* valid, const RayHit16& rays, int* traceable) {
  int bad = 0;
  for (int i = 0; i < 16; ++i) {
    const float sum = std::fabs(rays.origin_x[i]) + std::fabs(rays.origin_y[i]) + std::fabs(rays.origin_z[i]) +
                      std::fabs(rays.direction_x[i]) + std::fabs(rays.direction_y[i]) + std::fabs(rays.direction_z[i]);
    // False too where a number is none.
    const bool good = (sum <= kTraceLimit) & (rays.t_near[i] >= 0) & (rays.t_far[i] == rays.t_far[i]);
    traceable[i] = good ? valid[i] : 0;
    bad |= traceable[i] ^ valid[i];
  }
  return bad == 0;
}

void MarkMissed(const int* valid, RayHit16& rays) {
  for (int i = 0; i < 16; ++i) rays.geometry[i] |= static_cast<uint32_t>(valid[i]);
  for (int i = 0; i < 16; ++i) rays.instance[i] |= static_cast<uint32_t>(valid[i]);
}

}  // namespace airsim360::internal::AIRSIM360_ISA
