#include "airsim360/vln/episodes/ground.h"

namespace airsim360::internal {
namespace {

EntityId EntityAt(const Scene& scene, const SurfaceRef& surface) {
  const Instance& instance = scene.instances[surface.instance];
  for (const MeshPart& part : scene.meshes[instance.mesh].parts)
    if (surface.triangle - part.first_triangle < part.triangle_count && part.entity != kNoEntity) return part.entity;
  return instance.entity;
}

}  // namespace

VlnGround::VlnGround(std::shared_ptr<const RayTracer> tracer)
    : tracer_(std::move(tracer)),
      box_(FlightBox(*tracer_)),
      top_(scene().sky_entity == kNoEntity ? box_.max.z - 0.01 : scene().bounds.max.z + 10.0) {}

std::optional<GroundHit> VlnGround::Below(Vec3d p) const {
  const auto hit = tracer_->Intersect(VecCast<float>(p), {0, 0, -1});
  if (!hit) return std::nullopt;
  return GroundHit{p.z - hit->distance, EntityAt(scene(), hit->surface)};
}

bool VlnGround::Is(EntityId entity, const char* category) const {
  return entity != kNoEntity && scene().tree[scene().entity(entity).category].path.starts_with(category);
}

bool VlnGround::IsFree(Vec3d p, double radius) const {
  return box_.Contains(p) && tracer_->Clearance(VecCast<float>(p), static_cast<float>(radius)) >= static_cast<float>(radius);
}

EntityId VlnGround::Meets(Vec3d from, Vec3d to) const {
  const auto hit = tracer_->Intersect(VecCast<float>(from), VecCast<float>(to - from), 1);
  return hit ? EntityAt(scene(), hit->surface) : kNoEntity;
}

}  // namespace airsim360::internal
