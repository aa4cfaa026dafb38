#include "ray_recorder.h"

#include <dlfcn.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "airsim360/base/parallel.h"
#include "airsim360/trace/ray_tracer.h"

namespace airsim360::bench {
namespace {

using Intersect = void (*)(const int*, RTCScene, RTCIntersectContext*, RTCRayHit16*);
using Occluded = void (*)(const int*, RTCScene, RTCIntersectContext*, RTCRay16*);

template <class Function>
Function Real(const char* name) {
  return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}
const Intersect real_intersect = Real<Intersect>("rtcIntersect16");
const Occluded real_occluded = Real<Occluded>("rtcOccluded16");
std::vector<RecordedPacket>* recording = nullptr;

void Record(const int* valid, RTCScene scene, const RTCIntersectContext& context, const RTCRay16& ray, bool occlusion) {
  RecordedPacket& p = recording->emplace_back();
  std::memcpy(p.origin, ray.org_x, sizeof p.origin);
  std::memcpy(p.t_near, ray.tnear, sizeof p.t_near);
  std::memcpy(p.direction, ray.dir_x, sizeof p.direction);
  std::memcpy(p.t_far, ray.tfar, sizeof p.t_far);
  std::memcpy(p.mask, ray.mask, sizeof p.mask);
  std::memcpy(p.valid, valid, sizeof p.valid);
  p.scene = scene, p.flags = context.flags, p.occlusion = occlusion;
}

float Again(const RecordedPacket& p, bool trace) {
  RTCRayHit16 rays;
  RTCRay16& ray = rays.ray;
  std::memcpy(ray.org_x, p.origin, sizeof p.origin);
  std::memcpy(ray.tnear, p.t_near, sizeof p.t_near);
  std::memcpy(ray.dir_x, p.direction, sizeof p.direction);
  std::memcpy(ray.tfar, p.t_far, sizeof p.t_far);
  std::memcpy(ray.mask, p.mask, sizeof p.mask);
  for (int i = 0; i < 16; ++i) {
    ray.time[i] = 0, ray.id[i] = ray.flags[i] = 0;
    rays.hit.geomID[i] = rays.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
  }
  alignas(64) int valid[16];
  std::memcpy(valid, p.valid, sizeof valid);
  if (trace) {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = p.flags;
    if (p.occlusion)
      real_occluded(valid, p.scene, &context, &ray);
    else
      real_intersect(valid, p.scene, &context, &rays);
  }
  float sum = 0;
  for (int i = 0; i < 16; ++i) sum += valid[i] != 0 && std::fabs(ray.tfar[i]) < 1e9f ? ray.tfar[i] : 0;
  return sum + ray.dir_x[0] + ray.org_x[15] + ray.mask[3] * 1e-30f;
}

}  // namespace

RayRecorder::RayRecorder() { recording = &packets_; }
RayRecorder::~RayRecorder() { recording = nullptr; }

RayCounts RayRecorder::Count() const {
  RayCounts counts;
  for (const RecordedPacket& p : packets_) {
    const auto active = static_cast<double>(std::count(p.valid, p.valid + 16, -1));
    (p.occlusion ? counts.occlusion : counts.nearest) += active;
  }
  return counts;
}

double Replay(const std::vector<RecordedPacket>& packets, bool trace) {
  constexpr int64_t kRun = 64;
  const auto count = static_cast<int64_t>(packets.size());
  std::vector<double> sums(static_cast<size_t>((count + kRun - 1) / kRun));
  ParallelFor(static_cast<int64_t>(sums.size()), [&](int64_t run) {
    const FlushDenormals flush;
    double sum = 0;
    for (int64_t i = run * kRun; i < std::min(count, (run + 1) * kRun); ++i) sum += Again(packets[static_cast<size_t>(i)], trace);
    sums[static_cast<size_t>(run)] = sum;
  });
  double sum = 0;
  for (double s : sums) sum += s;
  return sum;
}

}  // namespace airsim360::bench

// What our ray tracer calls.
extern "C" void rtcIntersect16(const int* valid, RTCScene scene, RTCIntersectContext* context, RTCRayHit16* rays) {
  using namespace airsim360::bench;
  if (recording != nullptr) Record(valid, scene, *context, rays->ray, false);
  real_intersect(valid, scene, context, rays);
}

extern "C" void rtcOccluded16(const int* valid, RTCScene scene, RTCIntersectContext* context, RTCRay16* rays) {
  using namespace airsim360::bench;
  if (recording != nullptr) Record(valid, scene, *context, *rays, true);
  real_occluded(valid, scene, context, rays);
}
