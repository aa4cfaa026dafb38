#include "airsim360/trace/packet_kernel.h"

namespace airsim360::internal::AIRSIM360_ISA {

bool KeepFinite(const int* valid, const RayHit16& rays, int* finite) {
  int bad = 0;
  for (int i = 0; i < 16; ++i) {
    const float sum = rays.origin_x[i] + rays.origin_y[i] + rays.origin_z[i] + rays.direction_x[i] +
                      rays.direction_y[i] + rays.direction_z[i];
    finite[i] = sum - sum == 0 ? valid[i] : 0;
    bad |= finite[i] ^ valid[i];
  }
  return bad == 0;
}

void MarkMissed(const int* valid, RayHit16& rays) {
  for (int i = 0; i < 16; ++i) rays.geometry[i] |= static_cast<uint32_t>(valid[i]);
  for (int i = 0; i < 16; ++i) rays.instance[i] |= static_cast<uint32_t>(valid[i]);
}

}  // namespace airsim360::internal::AIRSIM360_ISA
