#include "airsim360/trace/ray_tracer.h"

#include <xmmintrin.h>

#include <cstddef>
#include <utility>

#include "airsim360/trace/closest_point.h"
#include "airsim360/trace/embree_scene.h"

namespace airsim360 {
namespace {

// RayHit16 is Embree's packet, so that no copy is made.
static_assert(RTC_MAX_INSTANCE_LEVEL_COUNT == 1);
static_assert(sizeof(RayHit16) == sizeof(RTCRayHit16) && alignof(RayHit16) >= alignof(RTCRayHit16));
static_assert(offsetof(RayHit16, t_near) == offsetof(RTCRayHit16, ray.tnear));
static_assert(offsetof(RayHit16, direction_x) == offsetof(RTCRayHit16, ray.dir_x));
static_assert(offsetof(RayHit16, time) == offsetof(RTCRayHit16, ray.time));
static_assert(offsetof(RayHit16, t_far) == offsetof(RTCRayHit16, ray.tfar));
static_assert(offsetof(RayHit16, mask) == offsetof(RTCRayHit16, ray.mask));
static_assert(offsetof(RayHit16, flags) == offsetof(RTCRayHit16, ray.flags));
static_assert(offsetof(RayHit16, normal_x) == offsetof(RTCRayHit16, hit.Ng_x));
static_assert(offsetof(RayHit16, u) == offsetof(RTCRayHit16, hit.u));
static_assert(offsetof(RayHit16, primitive) == offsetof(RTCRayHit16, hit.primID));
static_assert(offsetof(RayHit16, geometry) == offsetof(RTCRayHit16, hit.geomID));
static_assert(offsetof(RayHit16, instance) == offsetof(RTCRayHit16, hit.instID));

constexpr unsigned kFlushToZero = 0x8000, kDenormalsAreZero = 0x0040;  // bits of MXCSR

RTCIntersectContext Context(bool coherent) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  return context;
}

RTCRay SingleRay(Vec3f origin, Vec3f direction, float t_far) {
  return {origin.x, origin.y, origin.z, 0, direction.x, direction.y, direction.z, 0, t_far, ~0u, 0, 0};
}

bool IsFinite(Vec3f v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

// Normal of a mesh surface in W: the cofactor matrix of A (its inverse transpose times its determinant).
Vec3f NormalToWorld(const Mat3f& A, Vec3f n) {
  const Vec3f a = A.column(0), b = A.column(1), c = A.column(2);
  return Mat3f::FromColumns(Cross(b, c), Cross(c, a), Cross(a, b)) * n;
}

// Embree aborts the process on an active ray that is not finite: such lanes are taken out. Returns `valid`,
// or `fixed`.
const int* FiniteLanes(const int* valid, const RayHit16& rays, int* fixed) {
  int bad[16], any = 0;
  for (int i = 0; i < 16; ++i) {
    const float sum = rays.origin_x[i] + rays.origin_y[i] + rays.origin_z[i] + rays.direction_x[i] +
                      rays.direction_y[i] + rays.direction_z[i];
    bad[i] = sum - sum == 0 ? 0 : -1;
    any |= bad[i] & valid[i];
  }
  if (any == 0) return valid;
  for (int i = 0; i < 16; ++i) fixed[i] = valid[i] & ~bad[i];
  return fixed;
}

}  // namespace

FlushDenormals::FlushDenormals() : saved_(_mm_getcsr()) {
  _mm_setcsr(saved_ | kFlushToZero | kDenormalsAreZero);
}
FlushDenormals::~FlushDenormals() { _mm_setcsr(saved_); }

struct RayTracer::Impl {
  std::shared_ptr<const Scene> scene;
  internal::EmbreeScene embree;

  const HitSlot& Slot(uint32_t geometry, uint32_t instance) const {
    const auto& first = embree.first_slots();
    return embree.slots()[instance == kMiss ? first[geometry] : first[instance] + geometry];
  }
};

RayTracer::RayTracer(std::shared_ptr<const Scene> scene, const RayTracerOptions& options)
    : impl_(new Impl{scene, internal::EmbreeScene(*scene, options.isa)}) {}

RayTracer::~RayTracer() = default;

bool RayTracer::has_clear_panes() const { return impl_->embree.has_clear_panes(); }
const Scene& RayTracer::scene() const { return *impl_->scene; }
std::span<const HitSlot> RayTracer::slots() const { return impl_->embree.slots(); }
std::span<const uint32_t> RayTracer::first_slots() const { return impl_->embree.first_slots(); }

void RayTracer::Intersect16(const int* valid, RayHit16& rays, bool coherent) const {
  // valid is -1 in active lanes, so that "or" marks them as missed and leaves the others alone.
  for (int i = 0; i < 16; ++i) rays.geometry[i] |= static_cast<uint32_t>(valid[i]);
  for (int i = 0; i < 16; ++i) rays.instance[i] |= static_cast<uint32_t>(valid[i]);
  alignas(64) int fixed[16];
  RTCIntersectContext context = Context(coherent);
  rtcIntersect16(FiniteLanes(valid, rays, fixed), impl_->embree.top(), &context,
                 reinterpret_cast<RTCRayHit16*>(&rays));
}

void RayTracer::Occluded16(const int* valid, RayHit16& rays, bool* occluded, bool coherent) const {
  // rtcOccluded16 with COHERENT may loop for ever in scenes with instances (Embree 3.13.5: it depends on what
  // the stack held before; seen with and without ROBUST, with any rays). rtcIntersect16 is not affected.
  alignas(64) int fixed[16];
  RTCIntersectContext context = Context(coherent && !impl_->embree.has_instances());
  rtcOccluded16(FiniteLanes(valid, rays, fixed), impl_->embree.top(), &context,
                reinterpret_cast<RTCRay16*>(&rays));
  for (int i = 0; i < 16; ++i) {
    if (valid[i] != 0) occluded[i] = rays.t_far[i] < 0;
  }
}

SurfaceRef RayTracer::Resolve(uint32_t geometry, uint32_t instance, uint32_t primitive) const {
  const HitSlot& slot = impl_->Slot(geometry, instance);
  return {slot.instance, slot.triangles == nullptr ? primitive : slot.triangles[primitive]};
}

std::optional<SurfaceHit> RayTracer::Intersect(Vec3f origin, Vec3f direction, float t_far) const {
  if (!IsFinite(origin) || !IsFinite(direction)) return std::nullopt;
  const FlushDenormals flush;
  RTCRayHit ray{SingleRay(origin, direction, t_far), {}};
  ray.hit.geomID = ray.hit.instID[0] = kMiss;
  RTCIntersectContext context = Context(false);
  rtcIntersect1(impl_->embree.top(), &context, &ray);
  if (ray.hit.geomID == kMiss) return std::nullopt;

  // The normal to W, towards the origin.
  const HitSlot& slot = impl_->Slot(ray.hit.geomID, ray.hit.instID[0]);
  const SurfaceRef surface = Resolve(ray.hit.geomID, ray.hit.instID[0], ray.hit.primID);
  Vec3f normal{ray.hit.Ng_x, ray.hit.Ng_y, ray.hit.Ng_z};
  if (!slot.normal_in_world) normal = NormalToWorld(scene().instances[surface.instance].X_WM.A, normal);
  normal = Normalized(normal);
  if (Dot(normal, direction) > 0) normal = -normal;
  return SurfaceHit{ray.ray.tfar, surface, ray.hit.u, ray.hit.v, normal};
}

bool RayTracer::Occluded(Vec3f from, Vec3f to) const {
  if (!IsFinite(from) || !IsFinite(to)) return false;
  const FlushDenormals flush;
  RTCRay ray = SingleRay(from, to - from, 1);
  RTCIntersectContext context = Context(false);
  rtcOccluded1(impl_->embree.top(), &context, &ray);
  return ray.tfar < 0;
}

float RayTracer::Clearance(Vec3f p_W, float max_distance) const {
  return internal::ClosestSurfaceDistance(*this, impl_->embree.top(), p_W, max_distance);
}

}  // namespace airsim360
