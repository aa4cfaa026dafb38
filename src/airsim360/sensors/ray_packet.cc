#include "airsim360/sensors/ray_packet.h"

#include <algorithm>
#include <cmath>

namespace airsim360 {
namespace {

// Normal of a hit in W, not unit length.
Vec3f WorldNormal(const RayTracer& tracer, const HitSlot& slot, Vec3f n) {
  if (slot.normal_in_world) return n;
  const Mat3f& A = tracer.Place(slot.instance).A;
  const Vec3f a = A.column(0), b = A.column(1), c = A.column(2);
  return Mat3f::FromColumns(Cross(b, c), Cross(c, a), Cross(a, b)) * n;
}

SensorHit Resolve(const RayTracer& tracer, const RayHit16& packet, int i) {
  if (packet.geometry[i] == kMiss) return {};
  const uint32_t geometry = packet.geometry[i], instance = packet.instance[i];
  const auto first = tracer.first_slots();
  const HitSlot& slot = tracer.slots()[instance == kMiss ? first[geometry] : first[instance] + geometry];
  const Vec3f direction{packet.direction_x[i], packet.direction_y[i], packet.direction_z[i]};
  const Vec3f normal = WorldNormal(tracer, slot, {packet.normal_x[i], packet.normal_y[i], packet.normal_z[i]});
  const float cosine = std::abs(Dot(Normalized(normal), direction));
  return {packet.t_far[i], std::min(cosine, 1.0f), LabelOf(tracer, tracer.Resolve(geometry, instance, packet.primitive[i]))};
}

}  // namespace

void TraceRays(const RayTracer& tracer, std::span<const SensorRay> rays, float near, float far, bool through_panes,
               std::span<SensorHit> hits) {
  RayHit16 packet{};
  alignas(64) int valid[16];
  const int count = static_cast<int>(std::min<size_t>(rays.size(), 16));
  for (int i = 0; i < 16; ++i) {
    const SensorRay& ray = rays[static_cast<size_t>(std::min(i, count - 1))];
    valid[i] = i < count ? -1 : 0;
    packet.origin_x[i] = ray.origin.x;
    packet.origin_y[i] = ray.origin.y;
    packet.origin_z[i] = ray.origin.z;
    packet.direction_x[i] = ray.direction.x;
    packet.direction_y[i] = ray.direction.y;
    packet.direction_z[i] = ray.direction.z;
    packet.t_near[i] = near;
    packet.t_far[i] = far;
    packet.mask[i] = through_panes ? kMaskSolid : kMaskAll;
  }
  const FlushDenormals flush;
  tracer.Intersect16(valid, packet, true);
  for (int i = 0; i < count; ++i) hits[static_cast<size_t>(i)] = Resolve(tracer, packet, i);
}

}  // namespace airsim360
