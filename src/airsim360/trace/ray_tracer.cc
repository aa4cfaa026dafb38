#include "airsim360/trace/ray_tracer.h"

#include <xmmintrin.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>
#include <utility>

#include "airsim360/base/error.h"
#include "airsim360/trace/dynamic_scene.h"
#include "airsim360/trace/embree_scene.h"
#include "airsim360/trace/packet_kernel.h"
#include "airsim360/trace/trace_limit.h"

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

// Lanes that Embree can be given. Returns `valid`, or `fixed`.
const int* TraceableLanes(const int* valid, const RayHit16& rays, int* fixed) {
  static const auto keep_traceable = AIRSIM360_SELECT_KERNEL(KeepTraceable);
  return keep_traceable(valid, rays, fixed) ? valid : fixed;
}

// Whether a ray with these can be traced; false too where a number is none.
bool IsTraceable(Vec3f origin, Vec3f direction) {
  return std::fabs(origin.x) + std::fabs(origin.y) + std::fabs(origin.z) + std::fabs(direction.x) + std::fabs(direction.y) +
             std::fabs(direction.z) <=
         kTraceLimit;
}

// Below AVX-512 Embree's calls for 16 rays ignore `valid` (3.13.5 hands them to a stream filter that looks at
// intervals alone): inactive lanes get an empty interval while this lives, and theirs back at its end.
class EmptyInactiveLanes {
 public:
  EmptyInactiveLanes(const int* lanes, RayHit16& rays) : lanes_(lanes), rays_(rays) {
    int all = -1;
    for (int i = 0; i < 16; ++i) all &= lanes[i];
    full_ = all == -1;
    if (full_) return;
    for (int i = 0; i < 16; ++i) {
      kept_[i] = rays.t_far[i];
      rays.t_far[i] = lanes[i] != 0 ? kept_[i] : -std::numeric_limits<float>::infinity();
    }
  }
  ~EmptyInactiveLanes() {
    if (full_) return;
    for (int i = 0; i < 16; ++i) rays_.t_far[i] = lanes_[i] != 0 ? rays_.t_far[i] : kept_[i];
  }
  EmptyInactiveLanes(const EmptyInactiveLanes&) = delete;
  EmptyInactiveLanes& operator=(const EmptyInactiveLanes&) = delete;

 private:
  const int* lanes_;
  RayHit16& rays_;
  bool full_;  // all lanes are active: nothing to do
  float kept_[16];
};

}  // namespace

FlushDenormals::FlushDenormals() : saved_(_mm_getcsr()) { _mm_setcsr(saved_ | kFlushToZero | kDenormalsAreZero); }
FlushDenormals::~FlushDenormals() { _mm_setcsr(saved_); }

struct RayTracer::Impl {
  std::shared_ptr<const Scene> scene;
  std::shared_ptr<internal::EmbreeScene> embree;
  // What has moved, traced after the static scene: nothing in a tracer of the scene as built.
  std::unique_ptr<internal::DynamicScene> dynamic = nullptr;
  std::shared_ptr<const SceneState> state = nullptr;
  uint32_t generation = 0;  // see EmbreeScene
  bool traces_static = true;

  const std::vector<HitSlot>& Slots() const { return dynamic ? dynamic->slots() : embree->slots(); }
  const HitSlot& Slot(uint32_t geometry, uint32_t instance) const {
    const auto& first = embree->first_slots();
    return Slots()[instance == kMiss ? first[geometry] : first[instance] + geometry];
  }
  // Mask for the static scene of a ray that asks for kMaskSolid, kMaskClearPanes or both.
  uint32_t StaticMask(uint32_t kinds) const { return (kinds & (kMaskSolid | kMaskClearPanes)) << (2 * generation); }
};

RayTracer::RayTracer(std::shared_ptr<const Scene> scene, const RayTracerOptions& options)
    : impl_(new Impl{scene, std::make_shared<internal::EmbreeScene>(*scene, options)}) {}
RayTracer::RayTracer(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
RayTracer::~RayTracer() = default;

bool RayTracer::has_clear_panes() const { return impl_->embree->has_clear_panes(); }
const Scene& RayTracer::scene() const { return *impl_->scene; }
std::span<const HitSlot> RayTracer::slots() const { return impl_->Slots(); }
std::span<const uint32_t> RayTracer::first_slots() const { return impl_->embree->first_slots(); }

std::span<const MovedInstance> RayTracer::moved() const {
  return impl_->dynamic ? std::span<const MovedInstance>(impl_->dynamic->moved()) : std::span<const MovedInstance>();
}

std::span<const DeformedMesh> RayTracer::deformed() const {
  return impl_->dynamic ? std::span<const DeformedMesh>(impl_->dynamic->deformed()) : std::span<const DeformedMesh>();
}

const AffineTransform& RayTracer::Place(uint32_t instance) const {
  const auto found = std::ranges::lower_bound(moved(), instance, {}, &MovedInstance::instance);
  return found != moved().end() && found->instance == instance ? found->X_WM : scene().instances[instance].X_WM;
}

std::span<const Vec3f> RayTracer::Positions(MeshId mesh) const {
  const auto found = std::ranges::lower_bound(deformed(), mesh, {}, &DeformedMesh::mesh);
  return found != deformed().end() && found->mesh == mesh ? *found->positions : scene().meshes[mesh].positions;
}

void RayTracer::Intersect16(const int* valid, RayHit16& rays, bool coherent) const { IntersectIn(false, valid, rays, coherent); }

void RayTracer::IntersectClearPanes16(const int* valid, RayHit16& rays) const { IntersectIn(true, valid, rays, false); }

void RayTracer::IntersectIn(bool panes, const int* valid, RayHit16& rays, bool coherent) const {
  static const auto mark_missed = AIRSIM360_SELECT_KERNEL(MarkMissed);
  mark_missed(valid, rays);
  alignas(64) int fixed[16];
  RTCIntersectContext context = Context(coherent);
  const int* lanes = TraceableLanes(valid, rays, fixed);
  const EmptyInactiveLanes others(lanes, rays);
  auto* packet = reinterpret_cast<RTCRayHit16*>(&rays);
  const RTCScene statics = panes ? impl_->embree->panes() : impl_->embree->top();
  if (impl_->dynamic == nullptr) {
    if (statics != nullptr) rtcIntersect16(lanes, statics, &context, packet);
    return;
  }
  if (impl_->traces_static && statics != nullptr) {
    uint32_t kinds[16];
    std::memcpy(kinds, rays.mask, sizeof kinds);
    for (uint32_t& mask : rays.mask) mask = impl_->StaticMask(mask);
    rtcIntersect16(lanes, statics, &context, packet);
    std::memcpy(rays.mask, kinds, sizeof kinds);
  }
  rtcIntersect16(lanes, impl_->dynamic->top(), &context, packet);
}

void RayTracer::Occluded16(const int* valid, RayHit16& rays, bool* occluded, bool coherent) const {
  // rtcOccluded16 with COHERENT may loop for ever in scenes with instances (Embree 3.13.5: it depends on what
  // the stack held before; seen with and without ROBUST, with any rays). rtcIntersect16 is not affected.
  alignas(64) int fixed[16], open[16];
  RTCIntersectContext context = Context(coherent && !impl_->embree->has_instances());
  const int* lanes = TraceableLanes(valid, rays, fixed);
  const EmptyInactiveLanes others(lanes, rays);
  auto* packet = reinterpret_cast<RTCRay16*>(&rays);
  uint32_t kinds[16];
  if (impl_->dynamic != nullptr) {
    std::memcpy(kinds, rays.mask, sizeof kinds);
    for (uint32_t& mask : rays.mask) mask = impl_->StaticMask(mask);
  }
  if (impl_->traces_static) rtcOccluded16(lanes, impl_->embree->top(), &context, packet);
  if (impl_->dynamic != nullptr) {
    std::memcpy(rays.mask, kinds, sizeof kinds);
    for (int i = 0; i < 16; ++i) open[i] = rays.t_far[i] < 0 ? 0 : lanes[i];
    context = Context(false);
    rtcOccluded16(open, impl_->dynamic->top(), &context, packet);
  }
  for (int i = 0; i < 16; ++i) {
    if (valid[i] != 0) occluded[i] = lanes[i] != 0 && rays.t_far[i] < 0;
  }
}

SurfaceRef RayTracer::Resolve(uint32_t geometry, uint32_t instance, uint32_t primitive) const {
  const HitSlot& slot = impl_->Slot(geometry, instance);
  return {slot.instance, slot.triangles == nullptr ? primitive : slot.triangles[primitive]};
}

std::optional<SurfaceHit> RayTracer::Intersect(Vec3f origin, Vec3f direction, float t_far) const {
  if (!IsTraceable(origin, direction) || std::isnan(t_far)) return std::nullopt;
  const FlushDenormals flush;
  RTCRayHit ray{SingleRay(origin, direction, t_far), {}};
  ray.hit.geomID = ray.hit.instID[0] = kMiss;
  RTCIntersectContext context = Context(false);
  ray.ray.mask = impl_->StaticMask(kMaskAll);
  if (impl_->traces_static) rtcIntersect1(impl_->embree->top(), &context, &ray);
  ray.ray.mask = kMaskAll;
  if (impl_->dynamic != nullptr) rtcIntersect1(impl_->dynamic->top(), &context, &ray);
  if (ray.hit.geomID == kMiss) return std::nullopt;

  // The normal to W, towards the origin.
  const HitSlot& slot = impl_->Slot(ray.hit.geomID, ray.hit.instID[0]);
  const SurfaceRef surface = Resolve(ray.hit.geomID, ray.hit.instID[0], ray.hit.primID);
  Vec3f normal{ray.hit.Ng_x, ray.hit.Ng_y, ray.hit.Ng_z};
  if (!slot.normal_in_world) normal = NormalToWorld(Place(surface.instance).A, normal);
  normal = Normalized(normal);
  if (Dot(normal, direction) > 0) normal = -normal;
  return SurfaceHit{ray.ray.tfar, surface, ray.hit.u, ray.hit.v, normal};
}

bool RayTracer::Occluded(Vec3f from, Vec3f to) const {
  if (!IsTraceable(from, to - from)) return false;
  const FlushDenormals flush;
  RTCRay ray = SingleRay(from, to - from, 1);
  RTCIntersectContext context = Context(false);
  ray.mask = impl_->StaticMask(kMaskAll);
  if (impl_->traces_static) rtcOccluded1(impl_->embree->top(), &context, &ray);
  ray.mask = kMaskAll;
  if (impl_->dynamic != nullptr && !(ray.tfar < 0)) rtcOccluded1(impl_->dynamic->top(), &context, &ray);
  return ray.tfar < 0;
}

namespace {

// The point query over both scenes, starting from `max_distance`.
template <class Impl>
internal::NearestTriangle FindNearest(const Impl& impl, std::span<const MovedInstance> moved, Vec3f p_W, float max_distance) {
  internal::NearestTriangle best{std::max(max_distance, 0.0f)};
  if (!IsTraceable(p_W, {}) || !(max_distance > 0)) return best;
  if (impl.traces_static) impl.embree->PointQueries(*impl.scene).Find(p_W, moved, best);
  if (impl.dynamic != nullptr) impl.dynamic->Find(p_W, best);
  return best;
}

}  // namespace

float RayTracer::Clearance(Vec3f p_W, float max_distance) const { return FindNearest(*impl_, moved(), p_W, max_distance).distance; }

std::optional<NearestSurface> RayTracer::Nearest(Vec3f p_W, float max_distance) const {
  const internal::NearestTriangle best = FindNearest(*impl_, moved(), p_W, max_distance);
  if (best.instance == kMiss) return std::nullopt;
  const uint32_t instance = best.placed ? impl_->embree->TopId(best.instance) : kMiss;
  return NearestSurface{best.distance, best.offset, Resolve(best.geometry, instance, best.primitive)};
}

namespace {

[[noreturn]] void ThrowBadState(const std::string& what) { throw InputError("scene state: " + what); }

// Instances that stand elsewhere or have another shape; throws on a state that does not fit the scene.
std::vector<uint32_t> CheckedMovers(const Scene& scene, const SceneState& state) {
  std::vector<uint32_t> movers;
  for (size_t k = 0; k < state.moved.size(); ++k) {
    const MovedInstance& m = state.moved[k];
    const std::string name = "instance " + std::to_string(m.instance);
    if (m.instance >= scene.instances.size()) {
      ThrowBadState(name + " is not in the scene, which has " + std::to_string(scene.instances.size()));
    }
    if (k > 0 && m.instance <= state.moved[k - 1].instance) ThrowBadState(name + " is out of order");
    if (!IsFinite(m.X_WM.p) || !IsFinite(m.X_WM.A.row(0)) || !IsFinite(m.X_WM.A.row(1)) || !IsFinite(m.X_WM.A.row(2))) {
      ThrowBadState("the place of " + name + " is not finite");
    }
    movers.push_back(m.instance);
  }
  std::vector<bool> deformed(state.deformed.empty() ? 0 : scene.meshes.size());
  for (size_t k = 0; k < state.deformed.size(); ++k) {
    const DeformedMesh& d = state.deformed[k];
    const std::string name = "mesh " + std::to_string(d.mesh);
    if (d.mesh >= scene.meshes.size()) {
      ThrowBadState(name + " is not in the scene, which has " + std::to_string(scene.meshes.size()));
    }
    if (k > 0 && d.mesh <= state.deformed[k - 1].mesh) ThrowBadState(name + " is out of order");
    const size_t vertices = scene.meshes[d.mesh].positions.size();
    if (d.positions == nullptr || d.positions->size() != vertices)
      ThrowBadState(name + " needs " + std::to_string(vertices) + " positions");
    if (!std::all_of(d.positions->begin(), d.positions->end(), IsFinite)) ThrowBadState("a position of " + name + " is not finite");
    deformed[d.mesh] = true;
  }
  for (uint32_t i = 0; !deformed.empty() && i < scene.instances.size(); ++i) {
    if (deformed[scene.instances[i].mesh]) movers.push_back(i);
  }
  return movers;
}

}  // namespace

DynamicTracer::DynamicTracer(std::shared_ptr<const RayTracer> base) : base_(std::move(base)) {}
DynamicTracer::~DynamicTracer() = default;

std::shared_ptr<const RayTracer> DynamicTracer::At(const std::shared_ptr<const SceneState>& state) {
  if (state == nullptr) return base_;
  const RayTracer::Impl& base = *base_->impl_;
  const internal::Movers movers = base.embree->Move(CheckedMovers(*base.scene, *state));

  // A tracer of this very state, or one that nobody uses, or a new one.
  size_t place = pool_.size();
  for (size_t k = 0; k < pool_.size(); ++k) {
    const RayTracer::Impl& impl = *pool_[k]->impl_;
    if (impl.state == state && impl.generation == movers.generation && impl.traces_static == !movers.all) return pool_[k];
    if (pool_[k].use_count() == 1) place = k;
  }
  if (place == pool_.size()) {
    pool_.push_back(std::shared_ptr<RayTracer>(new RayTracer(std::make_unique<RayTracer::Impl>())));
    pool_.back()->impl_->scene = base.scene;
    pool_.back()->impl_->embree = base.embree;
    pool_.back()->impl_->dynamic = std::make_unique<internal::DynamicScene>();
  }
  RayTracer::Impl& impl = *pool_[place]->impl_;
  impl.state = state;
  impl.generation = movers.generation;
  impl.traces_static = !movers.all;
  impl.dynamic->Update(*base.embree, *base.scene, *state, movers);
  return pool_[place];
}

}  // namespace airsim360
